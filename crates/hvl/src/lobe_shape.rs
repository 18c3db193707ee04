use manylights_scene::{Brdf, DBrdf, Lobe};

/// What the table of a specular lobe depends on beside bands and window: materials of one shape share it,
/// whatever their colours. A measurement has a shape for each of its channels.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LobeShape {
    alpha: f32,
    /// [`Lobe::slot`], 0 for Schlick's Fresnel term.
    slot: f32,
    channel: usize,
}

/// A GGX width with Schlick's Fresnel term.
impl From<f32> for LobeShape {
    fn from(alpha: f32) -> Self {
        Self { alpha, slot: 0.0, channel: 0 }
    }
}

/// That of a specular lobe; red of a measurement.
impl From<Brdf> for LobeShape {
    fn from(brdf: Brdf) -> Self {
        Self { alpha: brdf.alpha, slot: brdf.lobe.slot().min(0.0), channel: 0 }
    }
}

impl LobeShape {
    /// Red, green and blue, of a measurement.
    pub fn channels(self) -> [Self; 3] {
        [0, 1, 2].map(|channel| Self { channel, ..self })
    }

    /// All shapes of a reflectance.
    pub(crate) fn all_of(brdf: Brdf) -> impl Iterator<Item = Self> {
        let count = if matches!(brdf.lobe, Lobe::Measured(_)) { 3 } else { 1 };
        Self::from(brdf).channels().into_iter().take(count)
    }

    /// A lobe of this shape and no reflectance; of a measurement, the measurement.
    pub(crate) fn brdf(self) -> Brdf {
        let lobe = Lobe::from_slot(self.slot);
        Brdf { diffuse: glam::Vec3::ZERO, f0: glam::Vec3::ZERO, lobe, alpha: self.alpha }
    }

    /// α and slot: as a surface has them.
    pub(crate) fn record(self) -> [f32; 2] {
        [self.alpha, self.slot]
    }

    /// Red, green or blue of a measurement: 0, 1, 2.
    pub(crate) fn channel(self) -> usize {
        self.channel
    }

    /// Its numbers as bits.
    pub(crate) fn bits(self) -> [u32; 3] {
        [self.alpha.to_bits(), self.slot.to_bits(), self.channel as u32]
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
