//! The one entry shader of all estimators, around the module of one of them.

use std::sync::Arc;

use manylights_gpu::{Binding, Error, Feature, Gpu, Kernel, Module, PointBindings, link};

/// Lanes of a workgroup.
const LANES: u32 = 64;

/// What an estimator brings to `shaders/gather.wesl`.
pub struct EstimatorShader<'a> {
    /// The module `estimator`. It has
    /// - `Light`: a record of a batch;
    /// - `Receiver`: what a lane keeps of a pixel;
    /// - `receiver(surface: Surface, pixel: u32, camera: vec3f) -> Receiver`;
    /// - `add_light(sum: vec3f, r: Receiver, light: Light) -> vec3f`: the radiance so far and what a
    ///   light adds to it, W·m⁻²·sr⁻¹.
    pub estimator: &'a str,
    /// What it imports beside the shared modules.
    pub modules: &'a [Module<'a>],
    /// The position of each switch that it asks for.
    pub features: &'a [Feature<'a>],
    /// Whether a pass of shadow rays tells which lights a pixel sees.
    pub traced: bool,
    /// Lights a batch; a batch has at most 64 KiB.
    pub capacity: usize,
    /// Four where reading a light costs more than shading with it.
    pub pixels_a_lane: PixelsALane,
    /// Its settings and tables.
    pub bindings: PointBindings,
}

/// How many pixels a lane serves with each light that it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelsALane {
    /// One.
    One,
    /// Four, a workgroup apart.
    Four,
}

impl PixelsALane {
    fn count(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
        }
    }
}

/// A linked gather with all that must be alike in its WGSL and around it.
pub struct GatherShader {
    /// The text.
    pub wgsl: String,
    pub(crate) capacity: usize,
    pub(crate) pixels_a_group: u32,
    bindings: Vec<Binding>,
}

impl EstimatorShader<'_> {
    /// The gather of this estimator.
    ///
    /// # Errors
    /// Where a module does not link.
    pub fn link(&self) -> Result<GatherShader, Error> {
        let pixels_a_group = LANES * self.pixels_a_lane.count();
        let layout = format!(
            "const CAPACITY = {}u;\nconst LANES = {LANES}u;\nconst PIXELS_A_GROUP = {pixels_a_group}u;\n",
            self.capacity
        );
        let bindings = self.bindings.module();
        let modules =
            [("estimator", self.estimator), ("layout", &*layout), ("bindings", &*bindings)];
        let modules = [&modules, self.modules].concat();
        let features =
            [("traced", self.traced), ("four_pixels", self.pixels_a_lane == PixelsALane::Four)];
        let features = [&features, self.features].concat();
        Ok(GatherShader {
            wgsl: link("gather", include_str!("shaders/gather.wesl"), &modules, &features)?,
            capacity: self.capacity,
            pixels_a_group,
            bindings: self.bindings.layout(),
        })
    }
}

impl GatherShader {
    /// Its kernel.
    ///
    /// # Errors
    /// Where the WGSL is invalid.
    pub fn compile(&self, gpu: &Gpu) -> Result<Arc<Kernel>, Error> {
        gpu.kernel("gather", &self.wgsl, &self.bindings)
    }
}
