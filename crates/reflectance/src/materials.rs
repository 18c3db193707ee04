//! The materials of a picture, and the tables that its kernels read of them.

use std::cmp::Ordering;

use glam::Vec3;
use manylights_scene::{Brdf, Lobe, Material, Scene};

use crate::transformed_cosine::{self, Table};
use crate::{Damping, Form, LobeShape, Tables};

/// The lobes that kernels must know of receivers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReceiverKinds {
    /// Some have a specular lobe.
    pub specular: bool,
    /// Some specular lobe is not grey at normal incidence.
    pub colored: bool,
    /// Some specular lobe has the exact Fresnel term.
    pub exact_fresnel: bool,
    /// Some reflectance is measured: receivers have a lobe for each channel.
    pub measured: bool,
    /// Some specular lobe is narrower than [`NARROW`].
    pub narrow: bool,
}

/// No affordable number of bands sees a lamp in lobes of a smaller roughness.
pub const NARROW: f32 = 0.3;

/// Whether a GGX width is that of a smaller roughness: a number that is as it was written must not fail by the
/// rounding of its square.
pub fn is_narrow(alpha: f32) -> bool {
    alpha < NARROW_ALPHA
}

/// As [`is_narrow`] has it, and the kernels.
pub(crate) const NARROW_ALPHA: f32 = NARROW * NARROW * (1.0 - 1e-6);

impl ReceiverKinds {
    /// The switches of [`crate::MODULES`], for a linker.
    pub fn features(self, form: Form) -> [(&'static str, bool); 7] {
        [
            ("glossy_receivers", self.specular),
            ("colored", self.colored && !self.measured),
            ("rgb_lobes", self.measured),
            ("zonal", form == Form::Zonal),
            ("mirror", false),
            ("transformed", false),
            ("exact_fresnel", self.exact_fresnel),
        ]
    }

    /// The same for receivers with lobes about the mirror direction, which products of light and cosine meet
    /// ([`crate::CosineProduct`]).
    pub fn mirror_features(self) -> [(&'static str, bool); 7] {
        self.features(Form::Full).map(|(name, on)| (name, on || name == "mirror"))
    }

    /// The same for receivers whose narrow lobes are transformed cosines, where some are
    /// ([`crate::transformed_cosine`]).
    pub fn transformed_features(self) -> [(&'static str, bool); 7] {
        self.features(Form::Full)
            .map(|(name, on)| (name, on || name == "transformed" && self.narrow))
    }

    /// Scalar lobes that a pixel is multiplied with.
    pub fn channels(self) -> usize {
        if self.measured { 3 } else { 1 + usize::from(self.colored) }
    }
}

/// What all specular lobes of a picture have.
#[derive(Debug)]
pub struct Materials {
    /// Their shapes, in order.
    shapes: Vec<LobeShape>,
    kinds: ReceiverKinds,
}

impl Materials {
    /// Of single points.
    pub fn new(brdfs: impl Iterator<Item = Brdf>) -> Self {
        let specular: Vec<_> = brdfs.filter(Brdf::has_specular).collect();
        let mut shapes: Vec<_> = specular.iter().copied().flat_map(LobeShape::all_of).collect();
        shapes.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        shapes.dedup();
        let grey = |brdf: &Brdf| brdf.f0 == Vec3::splat(brdf.f0.x);
        let measured = |brdf: &Brdf| matches!(brdf.lobe, Lobe::Measured(_));
        let exact = |brdf: &Brdf| matches!(brdf.lobe, Lobe::Dielectric { .. });
        let kinds = ReceiverKinds {
            specular: !shapes.is_empty(),
            colored: !specular.iter().all(grey),
            exact_fresnel: specular.iter().any(exact),
            measured: specular.iter().any(measured),
            narrow: specular.iter().any(|brdf| is_narrow(brdf.alpha)),
        };
        Self { shapes, kinds }
    }

    /// Of a scene.
    pub fn of_scene(scene: &Scene) -> Self {
        let materials = &scene.materials;
        let mut all =
            Self::new(materials.iter().map(|material| material.brdf(material.base_color)));
        let textured = |m: &Material| m.metallic > 0.0 && m.base_color_texture.is_some();
        all.kinds.colored |= materials.iter().any(textured);
        all
    }

    /// What kernels must know.
    pub fn kinds(&self) -> ReceiverKinds {
        self.kinds
    }

    /// Of all specular lobes, in order, none twice.
    pub fn shapes(&self) -> &[LobeShape] {
        &self.shapes
    }

    /// The table [`crate::SHAPES`].
    pub fn shape_records(&self) -> Vec<[f32; 2]> {
        self.shapes.iter().map(|shape| shape.record()).collect()
    }

    /// The table [`crate::LOBES`].
    pub fn lobe_records(
        &self,
        tables: &Tables,
        bands: usize,
        form: Form,
        damping: Damping,
    ) -> Vec<[f32; 2]> {
        let lobes = |&shape: &LobeShape| match form {
            Form::Full => single(tables.lobes(shape, bands, damping).values()),
            Form::Zonal => single(tables.zonal(shape, bands, damping).values()),
        };
        self.shapes.iter().flat_map(lobes).collect()
    }

    /// The same of lobes about the mirror direction.
    pub fn mirror_records(&self, tables: &Tables, bands: usize) -> Vec<[f32; 2]> {
        let lobes = |&shape: &LobeShape| single(tables.mirror(shape, bands).values());
        self.shapes.iter().flat_map(lobes).collect()
    }

    /// The table [`crate::transformed_cosine::TRANSFORMED_LOBES`]: of Schlick's lobes; what stands for others has
    /// no meaning.
    pub fn transformed_records(&self) -> Vec<[f32; 4]> {
        let lobes = |shape: &LobeShape| Table::shared().lobes(shape.record()[0].into());
        self.shapes
            .iter()
            .flat_map(lobes)
            .flat_map(|lobe| transformed_cosine::record(&lobe))
            .collect()
    }
}

/// A table as kernels read it.
pub fn single(values: &[[f64; 2]]) -> Vec<[f32; 2]> {
    values.iter().map(|pair| pair.map(|value| value as f32)).collect()
}
