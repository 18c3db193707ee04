//! Virtual spherical Gaussian lights as the gather reads them from uniform memory.

use std::f32::consts::TAU;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::{GaussianLight, GaussianLobe, Settings};

/// A light without specular power: 48 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LambertLight {
    position: Vec3,
    variance: f32,
    /// Against the emission.
    axis: Vec3,
    sharpness: f32,
    /// P/(2π ∫G), W·sr⁻¹, with the integral over what is sent.
    strength: Vec3,
    padding: f32,
}

/// A light with both lobes: 96 bytes. Its position is that of its diffuse lobe, where it has one.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GlossyLight {
    diffuse: LambertLight,
    specular: LambertLight,
}

impl LambertLight {
    fn from_lobe(lobe: &GaussianLobe) -> Self {
        Self {
            position: lobe.position,
            variance: lobe.variance,
            axis: -lobe.axis,
            sharpness: lobe.sharpness,
            strength: lobe.power / (TAU * integral(lobe.sharpness)),
            padding: 0.0,
        }
    }

    /// The Lambertian lobe: its axis is the normal, so 1/(1 + e^{−λ}) of it is in front.
    pub(crate) fn new(light: &GaussianLight, settings: &Settings) -> Self {
        let mut record = Self::from_lobe(&light.diffuse);
        if settings.cut_behind {
            record.strength *= 1.0 + (-record.sharpness).exp();
        }
        record
    }
}

impl GlossyLight {
    pub(crate) fn new(light: &GaussianLight, settings: &Settings) -> Self {
        let specular = LambertLight::from_lobe(&light.specular);
        let mut diffuse = LambertLight::new(light, settings);
        if light.diffuse.power == Vec3::ZERO {
            diffuse = LambertLight { strength: Vec3::ZERO, ..specular };
        }
        Self { diffuse, specular }
    }
}

/// ∫ exp(λ(p·w − 1)) dw over the sphere.
fn integral(sharpness: f32) -> f32 {
    let twice = 2.0 * sharpness;
    2.0 * TAU * if twice > 0.0 { -(-twice).exp_m1() / twice } else { 1.0 }
}
