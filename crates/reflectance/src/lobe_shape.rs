use glam::Vec3;
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
    pub fn all_of(brdf: Brdf) -> impl Iterator<Item = Self> {
        let shape = Self::from(brdf);
        let count = if shape.is_measured() { 2 } else { 1 };
        shape.of_measurement().into_iter().take(count)
    }

    /// Whether the lobe is a measurement's.
    pub fn is_measured(self) -> bool {
        self.slot <= -Lobe::MAX_INDEX
    }

    /// A lobe of this shape and no reflectance; of a measurement, the measurement.
    pub fn brdf(self) -> Brdf {
        let lobe = Lobe::from_slot(self.slot);
        Brdf { diffuse: Vec3::ZERO, f0: Vec3::ZERO, lobe, alpha: self.alpha }
    }

    /// α and slot: as a surface has them.
    pub fn record(self) -> [f32; 2] {
        [self.alpha, self.slot]
    }

    /// The first shape of the reflectance, and which of its shapes this is.
    pub fn place(self) -> (Self, usize) {
        (Self { blue: false, ..self }, self.blue.into())
    }

    /// Scalar lobes (f0 and f90; red, green and blue) as the tables of all shapes hold them.
    pub fn pairs(self, lobes: &[[f64; 3]]) -> Vec<Vec<[f64; 2]>> {
        let first = lobes.iter().map(|&[a, b, _]| [a, b]).collect();
        let blue = || lobes.iter().map(|&[.., c]| [c, 0.0]).collect();
        if self.is_measured() { vec![first, blue()] } else { vec![first] }
    }

    /// Its numbers as bits.
    pub fn bits(self) -> [u32; 3] {
        [self.alpha.to_bits(), self.slot.to_bits(), self.blue.into()]
    }

    /// Fresnel reflectance at this cosine for f0 = 1 and for f90 = 1, which the exact term has not.
    pub fn fresnel(self, cosine: f64) -> [f64; 2] {
        if let Lobe::Dielectric { index } = self.brdf().lobe {
            return [DBrdf::relative_fresnel(index.into(), cosine), 0.0];
        }
        let grazing = (1.0 - cosine).powi(5);
        [1.0 - grazing, grazing]
    }
}
