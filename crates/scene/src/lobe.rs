//! Which lobe lies over the Lambertian one, and how it fits into one number.

use crate::Measured;

/// The kind of the specular lobe of a [`Brdf`](crate::Brdf).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// GGX with Schlick's Fresnel reflectance, as glTF has it, coupled with the Lambertian lobe.
    Schlick {
        /// Reflectance at grazing incidence; 0 together with `f0` = 0 removes the lobe.
        f90: f32,
    },
    /// GGX with the exact Fresnel reflectance of a smooth dielectric, scaled to `f0` at normal
    /// incidence, beside an uncoupled Lambertian lobe: the form in which measured materials were
    /// fitted (Ribardière et al. 2017).
    Dielectric {
        /// Real index of refraction, above 1 and below [`Lobe::MAX_INDEX`].
        index: f32,
    },
    /// A measurement, instead of both lobes: those that the other fields describe are for samplers.
    Measured(Measured),
}

impl Lobe {
    /// No lobe, where `f0` = 0.
    pub const NONE: Self = Self::Schlick { f90: 0.0 };

    /// Indices of refraction stay below.
    pub const MAX_INDEX: f32 = 16.0;

    /// Reflectance at grazing incidence of Schlick's form, 0 of another: for methods that know no other.
    pub fn f90(self) -> f32 {
        match self {
            Self::Schlick { f90 } => f90,
            Self::Dielectric { .. } | Self::Measured(_) => 0.0,
        }
    }

    /// The lobe as one number, which records on the adapter carry in their slot `f90`: f90 itself
    /// (from 0) for Schlick's form, −index for the exact one, −(16 + number) of a measurement, which only
    /// this process knows ([`Measured::number`]). These
    /// functions are the only places that know it in Rust, `shaders/brdf.wesl` in WGSL.
    pub fn slot(self) -> f32 {
        match self {
            Self::Schlick { f90 } => f90,
            Self::Dielectric { index } => -index,
            // Exact up to 2²³ tables of a process.
            Self::Measured(measured) => -(Self::MAX_INDEX + measured.number() as f32),
        }
    }

    /// The slot of a virtual light, whose fixed direction is that of its incident light, not of its
    /// viewer: half a number further for measurements, which are not quite reciprocal.
    pub fn light_slot(self) -> f32 {
        match self {
            Self::Measured(_) => self.slot() - 0.5,
            _ => self.slot(),
        }
    }

    /// The lobe of a [`Self::slot`].
    ///
    /// # Panics
    /// Where the slot is of a measurement that this process never read.
    pub fn from_slot(slot: f32) -> Self {
        if slot >= 0.0 {
            Self::Schlick { f90: slot }
        } else if slot > -Self::MAX_INDEX {
            Self::Dielectric { index: -slot }
        } else {
            let number = (-slot - Self::MAX_INDEX) as u32;
            Self::Measured(Measured::numbered(number).expect("a slot made by this process"))
        }
    }
}
