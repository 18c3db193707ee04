//! The one entry shader of all lights whose coefficients are zonal about a direction.

use std::sync::Arc;

use manylights_gpu::{Binding, Error, Feature, Gpu, Kernel, Module, link};

use super::ProjectionSettings;
use super::loops::modules;

/// Lanes of a workgroup.
pub(super) const LANES: u32 = 64;

/// What such lights bring to `shaders/projection.wesl`.
pub struct SourceShader<'a> {
    /// The module `source`. It has
    /// - `Light`: a record of a batch;
    /// - `sight(light: Light, position: vec3f) -> Sighting`, of `package::sighting`, whose scales are those of
    ///   a light of radiance one.
    pub source: &'a str,
    /// What it imports beside the shared modules.
    pub modules: &'a [Module<'a>],
    /// The position of each switch that it asks for, but for `gradients`.
    pub features: &'a [Feature<'a>],
    /// Lights a batch; a batch has at most 64 KiB.
    pub capacity: usize,
}

/// A linked projection.
pub struct ProjectionShader {
    /// The text.
    pub wgsl: String,
    pub(super) capacity: usize,
    pub(super) bands: usize,
    pub(super) gradients: bool,
    /// Lanes a vertex.
    pub(super) lanes: u32,
}

impl SourceShader<'_> {
    /// The projection of these lights on so many bands.
    ///
    /// # Errors
    /// Where a module does not link.
    pub fn link(&self, bands: usize, how: ProjectionSettings) -> Result<ProjectionShader, Error> {
        let ProjectionSettings { gradients, loops, .. } = how;
        let layout = format!("const CAPACITY = {}u;\nconst LANES = {LANES}u;\n", self.capacity);
        let made = modules(bands, how);
        let made = made.each_ref().map(|(name, text)| (*name, &**text));
        let own = [
            ("layout", &*layout),
            ("source", self.source),
            ("sighting", include_str!("../shaders/sighting.wesl")),
            ("store", include_str!("../shaders/store.wesl")),
            ("vertices", include_str!("../shaders/vertices.wesl")),
        ];
        let modules = [&own[..], &made, self.modules].concat();
        let features = [self.features, &[("gradients", gradients)]].concat();
        let entry = include_str!("../shaders/projection.wesl");
        let wgsl = link("projection", entry, &modules, &features)?;
        let lanes = loops.lanes(bands);
        Ok(ProjectionShader { wgsl, capacity: self.capacity, bands, gradients, lanes })
    }
}

impl ProjectionShader {
    /// Its kernel.
    ///
    /// # Errors
    /// Where the WGSL is invalid.
    pub(super) fn compile(&self, gpu: &Gpu) -> Result<Arc<Kernel>, Error> {
        let layout = [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
        gpu.kernel("projection", &self.wgsl, &layout)
    }
}
