use glam::{DVec3, Vec3};
use manylights_scene::{Brdf, DBrdf, Lobe};

/// What the table of a specular lobe depends on beside bands and window: materials of one shape share it,
/// whatever their colours. A table holds two scalar lobes, so a measurement has two shapes: red with
/// green, and blue.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LobeShape {
    alpha: f32,
    /// [`Lobe::slot`], 0 for Schlick's Fresnel term.
    slot: f32,
    blue: bool,
}

/// A GGX width with Schlick's Fresnel term.
impl From<f32> for LobeShape {
    fn from(alpha: f32) -> Self {
        Self { alpha, slot: 0.0, blue: false }
    }
}

/// That of a specular lobe; red with green of a measurement.
impl From<Brdf> for LobeShape {
    fn from(brdf: Brdf) -> Self {
        Self { alpha: brdf.alpha, slot: brdf.lobe.slot().min(0.0), blue: false }
    }
}

impl LobeShape {
    /// Both, of a measurement.
    pub fn of_measurement(self) -> [Self; 2] {
        [false, true].map(|blue| Self { blue, ..self })
    }

    /// All shapes of a reflectance.
    pub(crate) fn all_of(brdf: Brdf) -> impl Iterator<Item = Self> {
        let shape = Self::from(brdf);
        let count = if shape.is_measured() { 2 } else { 1 };
        shape.of_measurement().into_iter().take(count)
    }

    pub(crate) fn is_measured(self) -> bool {
        matches!(self.brdf().lobe, Lobe::Measured(_))
    }

    /// A lobe of this shape and no reflectance; of a measurement, the measurement.
    pub(crate) fn brdf(self) -> Brdf {
        let lobe = Lobe::from_slot(self.slot);
        Brdf { diffuse: Vec3::ZERO, f0: Vec3::ZERO, lobe, alpha: self.alpha }
    }

    /// α and slot: as a surface has them.
    pub(crate) fn record(self) -> [f32; 2] {
        [self.alpha, self.slot]
    }

    /// What a measurement's table holds of a colour: red and green, or blue and nothing.
    pub(crate) fn channels(self, color: DVec3) -> [f64; 2] {
        if self.blue { [color.z, 0.0] } else { [color.x, color.y] }
    }

    /// Its numbers as bits.
    pub(crate) fn bits(self) -> [u32; 3] {
        [self.alpha.to_bits(), self.slot.to_bits(), self.blue.into()]
    }

    /// Fresnel reflectance at this cosine for f0 = 1 and for f90 = 1, which the exact term has not.
    pub(crate) fn fresnel(self, cosine: f64) -> [f64; 2] {
        if let Lobe::Dielectric { index } = self.brdf().lobe {
            return [DBrdf::relative_fresnel(index.into(), cosine), 0.0];
        }
        let grazing = (1.0 - cosine).powi(5);
        [1.0 - grazing, grazing]
    }
}
