//! The kernels.

use std::sync::Arc;

use manylights_gpu::{Binding, Error, Gpu, Kernel, link};
use manylights_harmonics::wgsl::{self, Function};
use manylights_reflectance::{Damping, Form, LOBES, MODULES, SHAPES, diffuse, lobe_wgsl};

use crate::sorted_wgsl::sorted_entry;
use crate::view::VIEW;
use crate::{Scheme, Settings, Storage, corner_wgsl, reading_wgsl};

/// Lanes of a workgroup: few, since several pixels a lane of each cell are rounded up to whole workgroups.
pub(crate) const LANES: u32 = 32;

/// A linked kernel with what it binds.
pub struct Shader {
    /// The text.
    pub wgsl: String,
    name: &'static str,
    bindings: Vec<Binding>,
}

impl Shader {
    pub(crate) fn compile(&self, gpu: &Gpu) -> Result<Arc<Kernel>, Error> {
        gpu.kernel(self.name, &self.wgsl, &self.bindings)
    }

    /// Reads pixels: each by itself, or those of a cell.
    ///
    /// # Errors
    /// Where it does not link.
    pub fn read(settings: &Settings) -> Result<Self, Error> {
        let tables = [SHAPES, LOBES].map(|name| format!("{name}: array<vec2f>"));
        let start =
            [(Binding::Uniform, "view: View"), (Binding::Storage, "surfaces: array<Surface>")];
        let pixels = settings.pixels_a_lane();
        let (own, source, entry) = if settings.is_sorted() {
            let own = [
                (Binding::StorageMut, "pixels: array<vec4f>"),
                (Binding::Storage, "order: array<u32>"),
                (Binding::Batch, "block: Block"),
            ];
            (own, ("block.corners", pixels), sorted_entry(pixels))
        } else {
            let own = [
                (Binding::StorageMut, "pixels: array<vec4f>"),
                (Binding::StorageMut, "outside: atomic<u32>"),
                (Binding::Storage, "coefficients: array<Vertex>"),
            ];
            (own, ("coefficients", 1), include_str!("shaders/plain.wesl").to_owned())
        };
        let mut bindings = [&start[..], &own].concat();
        if settings.kinds.specular {
            bindings.extend(tables.iter().map(|table| (Binding::Storage, &**table)));
        }
        let Settings { scheme, bands, kinds, .. } = *settings;
        let gradients = scheme.reads_gradients();
        let made = [
            ("sh", wgsl::module(bands, &[Function::Evaluate, Function::SpreadEven])),
            ("diffuse", diffuse::module(bands, Damping::None)),
            ("lobe", lobe_wgsl::module(bands, Form::Full)),
            ("world_lobe", reading_wgsl::world_lobe(bands, kinds)),
            ("corner", corner_wgsl::corner(settings, source)),
        ];
        let mut modules: Vec<_> = made.iter().map(|(name, text)| (*name, &**text)).collect();
        modules.extend(MODULES);
        modules.push(("weights", include_str!("shaders/weights.wesl")));
        let features = [
            ("gradients", gradients),
            ("hermite", matches!(scheme, Scheme::HermiteFlat | Scheme::Hermite)),
            ("mixed", scheme == Scheme::Hermite),
            // Kernels read the tables of harmonics alone.
            ("measured", false),
        ];
        let features = [&features[..], &kinds.features(Form::Full)].concat();
        let wgsl = linked(settings, ("read", &entry), &bindings, &modules, &features)?;
        Ok(Self { wgsl, name: "read", bindings: layout(&bindings) })
    }

    /// Counts the pixels of each cell.
    pub(crate) fn count(settings: &Settings) -> Result<Self, Error> {
        let own = [
            (Binding::StorageMut, "places: array<u32>"),
            (Binding::StorageMut, "counts: array<atomic<u32>>"),
        ];
        Self::sorting(settings, ("count", include_str!("shaders/count.wesl")), &own)
    }

    /// Puts the pixels of each cell together.
    pub(crate) fn scatter(settings: &Settings) -> Result<Self, Error> {
        let own = [
            (Binding::Storage, "places: array<u32>"),
            (Binding::Storage, "firsts: array<u32>"),
            (Binding::StorageMut, "order: array<u32>"),
        ];
        Self::sorting(settings, ("scatter", include_str!("shaders/scatter.wesl")), &own)
    }

    fn sorting(
        settings: &Settings,
        (name, entry): (&'static str, &str),
        own: &[(Binding, &str)],
    ) -> Result<Self, Error> {
        let start =
            [(Binding::Uniform, "view: View"), (Binding::Storage, "surfaces: array<Surface>")];
        let bindings = [&start[..], own].concat();
        let wgsl = linked(settings, (name, entry), &bindings, &[], &[])?;
        Ok(Self { wgsl, name, bindings: layout(&bindings) })
    }

    /// Brings the corners of cells together, in blocks at this stride of 16 bytes.
    pub(crate) fn assemble(settings: &Settings, stride: usize) -> Result<Self, Error> {
        let bindings = [
            (Binding::Uniform, "view: View"),
            (Binding::Storage, "coefficients: array<Vertex>"),
            (Binding::Storage, "cells: array<vec4u>"),
            (Binding::StorageMut, "blocks: array<vec4u>"),
        ];
        let size =
            format!("const STRIDE = {stride}u;\nconst VECTORS = {}u;\n", settings.stored_vectors());
        let entry = include_str!("shaders/assemble.wesl");
        let wgsl = linked(settings, ("assemble", entry), &bindings, &[("block_size", &size)], &[])?;
        Ok(Self { wgsl, name: "assemble", bindings: layout(&bindings) })
    }
}

fn layout(bindings: &[(Binding, &str)]) -> Vec<Binding> {
    bindings.iter().map(|&(kind, _)| kind).collect()
}

fn linked(
    settings: &Settings,
    (name, entry): (&str, &str),
    bindings: &[(Binding, &str)],
    modules: &[(&str, &str)],
    features: &[(&str, bool)],
) -> Result<String, Error> {
    let declared = declarations(settings, bindings);
    let layout = format!("const LANES = {LANES}u;\n");
    let own = [
        ("layout", &*layout),
        ("bindings", &*declared),
        ("place", include_str!("shaders/place.wesl")),
    ];
    link(name, entry, &[&own, modules].concat(), features)
}

/// The module `bindings`: what a kernel binds, in the order of the numbers, and the structures in it.
fn declarations(settings: &Settings, bindings: &[(Binding, &str)]) -> String {
    let variable = |(number, &(kind, variable)): (usize, &(Binding, &str))| {
        let space = match kind {
            Binding::Storage => "storage, read",
            Binding::StorageMut => "storage, read_write",
            Binding::Uniform | Binding::Batch | Binding::TextureUint => "uniform",
        };
        format!("@group(0) @binding({number}) var<{space}> {variable};\n")
    };
    let variables: String = bindings.iter().enumerate().map(variable).collect();
    let element = match settings.storage {
        Storage::F32 => "vec4f",
        Storage::Packed => "vec4u",
    };
    format!(
        "import package::surface::Surface;\n\n{VIEW}\n\
         struct Vertex {{\n    values: array<{element}, {}>,\n}}\n\n\
         struct Block {{\n    cell: vec3u,\n    first: u32,\n    corners: array<Vertex, 8>,\n}}\n\n\
         {variables}",
        settings.stored_vectors()
    )
}
