//! The numbers of what kernels over points bind, given once: for their WGSL and for their layout.

use crate::pipeline::Binding;

/// A table in storage that kernels read: `var<storage, read> name: array<element>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Table {
    /// As kernels import it from `package::bindings`.
    pub name: &'static str,
    /// A type that WGSL knows by itself.
    pub element: &'static str,
}

/// What a kernel of a [`PointPass`](crate::PointPass) binds beside its entry's own four (0 what all
/// points are told, 1 points, 2 batch, 3 results): which points see which records, settings, tables.
/// The module `bindings` declares it, so no two shaders can claim one number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PointBindings {
    /// Fields of the uniform `settings`, each a name and a type of WGSL; none, no such uniform.
    pub settings: &'static [(&'static str, &'static str)],
    /// In the order of their buffers.
    pub tables: Vec<Table>,
}

impl PointBindings {
    /// The kinds of all bindings, those of the entry included.
    pub fn layout(&self) -> Vec<Binding> {
        let mut layout = vec![Binding::Uniform, Binding::Storage, Binding::Batch];
        layout.extend([Binding::StorageMut, Binding::Storage]);
        layout.extend((!self.settings.is_empty()).then_some(Binding::Uniform));
        layout.resize(layout.len() + self.tables.len(), Binding::Storage);
        layout
    }

    /// The text of the module `bindings`: `occluded`, `settings` and each table by its name.
    pub fn module(&self) -> String {
        let mut variables = vec!["var<storage, read> occluded: array<u32>".to_owned()];
        let mut text = String::new();
        if !self.settings.is_empty() {
            let field = |(name, kind): &(_, _)| format!("    {name}: {kind},\n");
            let fields: String = self.settings.iter().map(field).collect();
            text = format!("struct Settings {{\n{fields}}}\n\n");
            variables.push("var<uniform> settings: Settings".to_owned());
        }
        let table = |Table { name, element }: &Table| {
            format!("var<storage, read> {name}: array<{element}>")
        };
        variables.extend(self.tables.iter().map(table));
        for (number, variable) in (4..).zip(variables) {
            text += &format!("@group(0) @binding({number}) {variable};\n");
        }
        text
    }
}
