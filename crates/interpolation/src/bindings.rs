//! What kernels bind, declared once: for their WGSL and for their layout.

use manylights_gpu::Binding;

/// Kinds with what the module `bindings` declares of them, in the order of their numbers.
pub(crate) struct Bindings<'a>(pub(crate) Vec<(Binding, &'a str)>);

impl Bindings<'_> {
    pub(crate) fn layout(&self) -> Vec<Binding> {
        self.0.iter().map(|&(kind, _)| kind).collect()
    }

    /// With the structures that they name.
    pub(crate) fn module(&self, structures: &str) -> String {
        let declaration = |(number, &(kind, variable)): (usize, &(Binding, &str))| {
            let space = match kind {
                Binding::Storage => "storage, read",
                Binding::StorageMut => "storage, read_write",
                Binding::Uniform | Binding::Batch => "uniform",
                Binding::TextureUint => "handle",
            };
            format!("@group(0) @binding({number}) var<{space}> {variable};\n")
        };
        let variables: String = self.0.iter().enumerate().map(declaration).collect();
        format!("import package::surface::Surface;\n\n{structures}\n{variables}")
    }
}
