//! Named reflectances: fits of the MERL materials that the thesis uses (its table B.1, 1 … 21).
//!
//! Fits of kd/π + ks F(v·h; n) D(h) V(v, l) with GGX, height-correlated Smith and the exact Fresnel
//! reflectance of a dielectric, in the form of Ribardière et al. 2017, to the microfacet ("ABC") fits of
//! the measurements by Löw et al. 2012, by least Hellinger distance. They are not the fits of the
//! thesis, whose numbers were not published. The distance is above 0.15 (the lobe's shape is visibly
//! another) for aluminium, alum-bronze and two-layer-gold; this module's tests measure it for each.

use glam::Vec3;

use crate::{Brdf, Lobe};

/// Smallest α that a preset gets: the fits of near-mirror coats (0.0075 for red-specular-plastic) are
/// narrower than 20 bands of spherical harmonics or a picture of some hundred virtual lights can show.
/// References use the same clamped value. It widens alumina-oxide, aluminium, blue-acrylic,
/// green-plastic, red-specular-plastic, white-marble and yellow-phenolic.
pub const MIN_ALPHA: f32 = 0.02;

/// A fit.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// As in the MERL database.
    pub name: &'static str,
    diffuse: [f32; 3],
    /// ks: F at normal incidence is ks ((n − 1)/(n + 1))².
    scale: [f32; 3],
    alpha: f32,
    index: f32,
}

impl Preset {
    /// Its reflectance, with α from [`MIN_ALPHA`].
    pub fn brdf(&self) -> Brdf {
        let amplitude = (self.index - 1.0) / (self.index + 1.0);
        Brdf {
            diffuse: self.diffuse.into(),
            f0: Vec3::from(self.scale) * (amplitude * amplitude),
            lobe: Lobe::Dielectric { index: self.index },
            alpha: self.alpha.max(MIN_ALPHA),
        }
    }
}

const fn fit(
    name: &'static str,
    diffuse: [f32; 3],
    scale: [f32; 3],
    alpha: f32,
    index: f32,
) -> Preset {
    Preset { name, diffuse, scale, alpha, index }
}

/// All of them, in the order of the thesis' table: name, kd, ks, α, n.
#[rustfmt::skip]
pub const PRESETS: [Preset; 21] = [
    fit("alum-bronze", [0.05847, 0.04751, 0.03439], [0.5113, 0.3739, 0.2698], 0.09419, 2.042),
    fit("alumina-oxide", [0.3135, 0.291, 0.2559], [0.414, 0.3493, 0.3907], 0.008284, 1.416),
    fit("aluminium", [0.02011, 0.02202, 0.02707], [0.2947, 0.2818, 0.2867], 0.01456, 4.02),
    fit("beige-fabric", [0.206, 0.1351, 0.1132], [1.513, 1.387, 1.254], 0.8332, 1.823),
    fit("blue-acrylic", [0.014, 0.03832, 0.108], [0.202, 0.1819, 0.1747], 0.01189, 1.438),
    fit("blue-fabric", [0.01008, 0.0117, 0.03727], [0.7343, 0.8116, 1.297], 0.7863, 1.499),
    fit("blue-rubber", [0.03546, 0.07417, 0.1547], [0.5775, 0.5693, 0.5554], 0.2721, 1.335),
    fit("gold-metallic-paint", [0.005848, 0.003364, 0.0], [0.759, 0.5166, 0.1871], 0.2438, 3.569),
    fit("gold-paint", [0.1469, 0.07732, 0.02036], [0.3566, 0.2865, 0.1783], 0.2253, 3.81),
    fit("green-plastic", [0.01417, 0.08198, 0.08957], [0.2036, 0.1766, 0.1635], 0.007826, 1.399),
    fit("red-fabric2", [0.1226, 0.01409, 0.003447], [3.795, 0.9171, 0.8758], 0.8592, 1.306),
    fit("red-phenolic", [0.1687, 0.0267, 0.0109], [0.1461, 0.1492, 0.156], 0.024, 1.697),
    fit("red-specular-plastic", [0.2484, 0.0371, 0.01637], [0.3256, 0.2833, 0.2973], 0.007475, 1.304),
    fit("silver-metallic-paint", [0.0, 0.0, 0.0], [0.729, 0.7139, 0.7048], 0.2036, 3.886),
    fit("silver-metallic-paint2", [0.05592, 0.06619, 0.07233], [1.046, 0.9421, 0.8415], 0.2598, 3.14093),
    fit("teflon", [0.3204, 0.3128, 0.3047], [0.3996, 0.406, 0.4128], 0.2069, 1.514),
    fit("two-layer-gold", [0.08551, 0.07547, 0.0628], [0.3973, 0.3507, 0.2918], 0.1405, 3.194),
    fit("white-fabric", [0.3276, 0.2305, 0.1574], [13.7, 13.64, 13.34], 0.8853, 1.05),
    fit("white-marble", [0.228, 0.214, 0.1887], [0.2192, 0.2077, 0.2034], 0.01724, 1.598),
    fit("white-paint", [0.3206, 0.3125, 0.3053], [0.5575, 0.5118, 0.4882], 0.03016, 1.194),
    fit("yellow-phenolic", [0.2999, 0.2184, 0.1044], [0.2238, 0.2158, 0.2221], 0.01867, 1.486),
];

#[cfg(test)]
mod tests;
