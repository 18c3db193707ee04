//! The one entry shader of all estimators, around the module of one of them.

use std::sync::Arc;

use manylights_gpu::{Binding, Error, Feature, Gpu, Kernel, Module, PointBindings, link};

/// Lanes of a workgroup.
pub(crate) const LANES: u32 = 64;

/// What an estimator brings to `shaders/gather.wesl`.
pub struct EstimatorShader<'a> {
    /// The module `estimator`. It has
    /// - `Light`: a record of a batch;
    /// - `Receiver`: what a lane keeps of a pixel;
    /// - `receiver(surface: Surface, camera: vec3f) -> Receiver`;
    /// - `Sum`: what a lane sums over a batch, radiance or coefficients, from zeros on;
    /// - `add_light(sum: ptr<function, Sum>, r: Receiver, light: Light)`;
    /// - `radiance(sum: Sum, r: Receiver) -> vec3f`: of the batch towards the camera, W·m⁻²·sr⁻¹.
    pub estimator: &'a str,
    /// What it imports beside the shared modules.
    pub modules: &'a [Module<'a>],
    /// The position of each switch that it asks for.
    pub features: &'a [Feature<'a>],
    /// Lights a batch; a batch has at most 64 KiB.
    pub capacity: usize,
    /// Its settings and tables.
    pub bindings: PointBindings,
}

/// A linked gather with all that must be alike in its WGSL and around it.
pub struct GatherShader {
    /// The text.
    pub wgsl: String,
    pub(crate) capacity: usize,
    bindings: Vec<Binding>,
}

impl EstimatorShader<'_> {
    /// The gather of this estimator.
    ///
    /// # Errors
    /// Where a module does not link.
    pub fn link(&self) -> Result<GatherShader, Error> {
        let layout = format!("const CAPACITY = {}u;\nconst LANES = {LANES}u;\n", self.capacity);
        let bindings = self.bindings.module();
        let own = [("estimator", self.estimator), ("layout", &*layout), ("bindings", &*bindings)];
        let modules = [&own, self.modules].concat();
        Ok(GatherShader {
            wgsl: link("gather", include_str!("shaders/gather.wesl"), &modules, self.features)?,
            capacity: self.capacity,
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
