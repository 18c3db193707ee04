use bytemuck::{Pod, Zeroable};
use manylights_scene::{Brdf, DBrdf, Lobe};

/// What the table of a specular lobe depends on beside bands and window: materials of one shape share it,
/// whatever their colours.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Pod, Zeroable)]
#[repr(C)]
pub struct LobeShape {
    alpha: f32,
    /// [`Lobe::slot`] of the exact Fresnel term, 0 for Schlick's.
    slot: f32,
}

/// A GGX width with Schlick's Fresnel term.
impl From<f32> for LobeShape {
    fn from(alpha: f32) -> Self {
        Self { alpha, slot: 0.0 }
    }
}

/// That of a specular lobe.
impl From<Brdf> for LobeShape {
    fn from(brdf: Brdf) -> Self {
        Self { alpha: brdf.alpha, slot: brdf.lobe.slot().min(0.0) }
    }
}

impl LobeShape {
    /// A lobe of this shape and no reflectance.
    pub(crate) fn brdf(self) -> Brdf {
        let lobe = Lobe::from_slot(self.slot);
        Brdf { diffuse: glam::Vec3::ZERO, f0: glam::Vec3::ZERO, lobe, alpha: self.alpha }
    }

    /// Its numbers as bits.
    pub(crate) fn bits(self) -> [u32; 2] {
        [self.alpha, self.slot].map(f32::to_bits)
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
