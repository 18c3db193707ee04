//! The specular lobe without its cosine as one circular lobe about the mirror direction (thesis 4.1.5): what
//! the thesis multiplies the product of light and cosine with. It has a floor of 11–35 % at roughness 0.7 and 1,
//! the same with 15 bands as with 9: the lobe is not circular there, and its peak leaves the mirror direction.

use glam::DVec3;
use rayon::prelude::*;

use crate::LobeShape;
use crate::lobe_quadrature::{Fixed, LobeQuadrature};
use crate::lobes::{ANGLES, NODES, interpolated};

/// The circular lobes of one shape.
#[derive(Clone, Debug)]
pub struct MirrorTable {
    /// For each angle of the view the scales of A and B, see [`LobeTable`](crate::lobes::LobeTable).
    values: Vec<[f64; 2]>,
}

impl MirrorTable {
    /// Those of all shapes of a reflectance, by quadrature.
    pub(crate) fn integrate(shape: LobeShape, bands: usize) -> Vec<Self> {
        let lobe = LobeQuadrature::new(shape, NODES, Fixed::View);
        let row = |degrees: usize| project(&lobe, bands, (degrees as f64).to_radians());
        let lobes: Vec<_> = (0..ANGLES).into_par_iter().flat_map_iter(row).collect();
        shape.pairs(&lobes).into_iter().map(|values| Self { values }).collect()
    }

    /// All rows.
    pub fn values(&self) -> &[[f64; 2]] {
        &self.values
    }

    /// The scales for a view at this angle from the normal, linear between whole degrees.
    pub fn at(&self, radians: f64) -> Vec<[f64; 2]> {
        interpolated(&self.values, radians)
    }
}

/// ∫ f(v, l) P_l(r·l) dl about the mirror direction r; normal z, view in the xz-plane.
fn project(lobe: &LobeQuadrature, bands: usize, view: f64) -> Vec<[f64; 3]> {
    let mirror = DVec3::new(-view.sin(), 0.0, view.cos());
    let mut sums = vec![[0.0; 3]; bands];
    for (direction, weights) in lobe.reflected(DVec3::new(view.sin(), 0.0, view.cos())) {
        let cosine = mirror.dot(direction);
        let (mut before, mut legendre) = (0.0, 1.0);
        for (l, sum) in sums.iter_mut().enumerate() {
            for (sum, weight) in sum.iter_mut().zip(weights) {
                *sum += legendre * weight;
            }
            let (l, value) = (l as f64, legendre);
            legendre = ((2.0 * l + 1.0) * cosine * value - l * before) / (l + 1.0);
            before = value;
        }
    }
    sums
}
