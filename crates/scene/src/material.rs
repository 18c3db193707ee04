//! Materials: glTF's metallic-roughness model mapped to [`Brdf`], reflectances given whole, and
//! base-colour textures.

use std::sync::LazyLock;

use glam::{Vec2, Vec3};

use crate::{Brdf, Lobe};

/// Smallest roughness: narrower lobes are mirrors, which no method here can gather.
pub const MIN_ROUGHNESS: f32 = 0.03;

/// A glTF metallic-roughness material with `KHR_materials_ior`, `_specular`, `_emissive_strength`.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name in the file.
    pub name: String,
    /// Linear Rec. 709, in [0, 1].
    pub base_color: Vec3,
    /// Index into [`crate::Scene::textures`]; multiplies `base_color`.
    pub base_color_texture: Option<u32>,
    /// 0 dielectric … 1 metal.
    pub metallic: f32,
    /// Perceptual roughness; α is its square.
    pub roughness: f32,
    /// Index of refraction of the dielectric part.
    pub ior: f32,
    /// `specularFactor`: 0 makes the dielectric part purely Lambertian.
    pub specular: f32,
    /// `specularColorFactor`.
    pub specular_color: Vec3,
    /// Emitted radiance, W·m⁻²·sr⁻¹.
    pub emission: Vec3,
    /// Whether the emission leaves both sides (glTF's `doubleSided`), else the front alone, as of
    /// Mitsuba's area lights. All surfaces reflect on both.
    pub two_sided: bool,
    /// A reflectance given whole ([`crate::presets`]): the factors above but the emission do not
    /// count then.
    pub given: Option<Brdf>,
}

impl Material {
    /// A Lambertian material of the given albedo.
    pub fn lambert(name: &str, base_color: Vec3) -> Self {
        Self {
            name: name.to_owned(),
            base_color,
            base_color_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            ior: 1.5,
            specular: 0.0,
            specular_color: Vec3::ONE,
            emission: Vec3::ZERO,
            two_sided: false,
            given: None,
        }
    }

    /// The same material with another reflectance, given whole.
    pub fn with_brdf(self, brdf: Brdf) -> Self {
        Self {
            base_color: brdf.diffuse,
            base_color_texture: None,
            metallic: 0.0,
            given: Some(brdf),
            ..self
        }
    }

    /// A dielectric (ior 1.5) coat of the given roughness over a Lambertian base.
    pub fn glossy(name: &str, base_color: Vec3, roughness: f32) -> Self {
        Self { roughness, specular: 1.0, ..Self::lambert(name, base_color) }
    }

    /// A metal.
    pub fn metal(name: &str, base_color: Vec3, roughness: f32) -> Self {
        Self { roughness, metallic: 1.0, ..Self::lambert(name, base_color) }
    }

    /// Whether the specular lobe exists.
    pub fn has_specular(&self) -> bool {
        match &self.given {
            Some(brdf) => brdf.has_specular(),
            None => self.metallic > 0.0 || self.specular > 0.0,
        }
    }

    /// Base colour at a texture coordinate.
    pub fn base_color_at(&self, textures: &[Texture], uv: Vec2) -> Vec3 {
        match self.base_color_texture {
            Some(texture) => self.base_color * textures[texture as usize].sample(uv),
            None => self.base_color,
        }
    }

    /// Reflectance for a base colour (glTF 2.0 appendix B, `KHR_materials_ior`, `_specular`).
    pub fn brdf(&self, base_color: Vec3) -> Brdf {
        if let Some(brdf) = self.given {
            return brdf;
        }
        let (f0, f90) = self.dielectric_fresnel();
        let roughness = self.roughness.clamp(MIN_ROUGHNESS, 1.0);
        Brdf {
            diffuse: base_color * (1.0 - self.metallic),
            f0: f0.lerp(base_color, self.metallic),
            lobe: Lobe::Schlick { f90: f90 + (1.0 - f90) * self.metallic },
            alpha: roughness * roughness,
        }
    }

    /// (f0, f90) of the dielectric part.
    pub fn dielectric_fresnel(&self) -> (Vec3, f32) {
        let ratio = (self.ior - 1.0) / (self.ior + 1.0);
        let f0 = (ratio * ratio * self.specular_color).min(Vec3::ONE) * self.specular;
        (f0, self.specular)
    }
}

/// A base-colour image, repeated in both directions, filtered bilinearly in linear light, without
/// mip levels: all methods and the reference read the same texels.
#[derive(Clone, Debug)]
pub struct Texture {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// sRGB-encoded, row 0 first (glTF: v = 0); the fourth byte is unused.
    pub texels: Vec<[u8; 4]>,
}

impl Texture {
    /// Linear Rec. 709 colour at a texture coordinate.
    pub fn sample(&self, uv: Vec2) -> Vec3 {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let texel = (uv - uv.floor()) * size - 0.5;
        let base = texel.floor();
        let fraction = texel - base;
        let (x, y) = (base.x as i32, base.y as i32);
        let lower = self.texel(x, y).lerp(self.texel(x + 1, y), fraction.x);
        let upper = self.texel(x, y + 1).lerp(self.texel(x + 1, y + 1), fraction.x);
        lower.lerp(upper, fraction.y)
    }

    fn texel(&self, x: i32, y: i32) -> Vec3 {
        let x = x.rem_euclid(self.width as i32) as usize;
        let y = y.rem_euclid(self.height as i32) as usize;
        let [r, g, b, _] = self.texels[y * self.width as usize + x];
        Vec3::new(LINEAR[usize::from(r)], LINEAR[usize::from(g)], LINEAR[usize::from(b)])
    }
}

/// [`srgb_to_linear`] of all bytes: a bilinear sample needs twelve.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| srgb_to_linear(byte as u8)));

/// The sRGB transfer function of an 8-bit value (IEC 61966-2-1).
pub fn srgb_to_linear(encoded: u8) -> f32 {
    let value = f32::from(encoded) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}
