//! What shadow rays are cast against.

use manylights_scene::Scene;
use manylights_scene::bvh::Bvh;

use crate::{Buffer, Error, Gpu};

/// The hierarchy over a scene's triangles on the adapter.
pub(crate) struct Occluders {
    pub(crate) nodes: Buffer,
    pub(crate) blocks: Buffer,
    pub(crate) stack: u32,
    pub(crate) shift: f32,
}

impl Occluders {
    pub(crate) fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, Error> {
        let bvh = Bvh::build(scene);
        let words = bvh.words();
        Ok(Self {
            nodes: gpu.storage("hierarchy", &words.nodes)?,
            blocks: gpu.storage("triangles of the hierarchy", &words.blocks)?,
            stack: words.stack,
            shift: bvh.shift(),
        })
    }
}
