//! Directions and weights for integrals over the scalar lobes of one reflectance.

use glam::DVec3;
use manylights_scene::{DBrdf, Lobe};

use crate::LobeShape;
use crate::half_vectors::{HalfVectors, reflected};

/// The widest distribution whose half vectors stand for those of a measurement: they reach the horizon.
const WIDEST: f64 = 0.2;

/// For one shape.
pub struct LobeQuadrature {
    shape: LobeShape,
    brdf: DBrdf,
    half_vectors: HalfVectors,
    fixed: Fixed,
}

/// The direction that the tables run over: measurements are not quite reciprocal.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Fixed {
    /// The viewer's.
    View,
    /// The light's.
    Light,
}

impl LobeQuadrature {
    /// `nodes` in the polar angle of the half vector, and in half a turn.
    pub fn new(shape: LobeShape, nodes: [usize; 2], fixed: Fixed) -> Self {
        let brdf = DBrdf::from(shape.brdf());
        // That of a measurement is an estimate.
        let alpha = if shape.is_measured() { brdf.alpha.min(WIDEST) } else { brdf.alpha };
        Self { shape, brdf, half_vectors: HalfVectors::new(alpha, nodes), fixed }
    }

    /// Directions above the horizon with weights for the scalar lobes, without their cosine: for f0, for
    /// f90, and nothing; or red, green and blue of a measurement. `from`, the fixed direction, lies in
    /// the xz-plane, and what is integrated does not know y from −y.
    pub fn reflected(&self, from: DVec3) -> impl Iterator<Item = (DVec3, [f64; 3])> {
        self.half_vectors.above_horizon(from).map(move |node| {
            let (direction, ratio) = reflected(from, node.h);
            // Rounding may put it below.
            let direction = direction.with_z(direction.z.max(0.0));
            let weights = if let Lobe::Measured(_) = self.brdf.lobe {
                self.measured(from, direction) * (node.solid_angle * ratio)
            } else {
                let visibility = self.brdf.visibility(from.z, direction.z);
                let flux = node.density * visibility * ratio / node.h.z;
                let [f0, f90] = self.shape.fresnel(from.dot(node.h));
                DVec3::new(f0, f90, 0.0) * flux
            };
            (direction, weights.to_array())
        })
    }

    /// Summed over both sides of the plane of incidence: measurements are not quite alike on both.
    fn measured(&self, from: DVec3, direction: DVec3) -> DVec3 {
        let sides = [direction, direction * DVec3::new(1.0, -1.0, 1.0)].map(|w| match self.fixed {
            Fixed::View => self.brdf.eval(DVec3::Z, from, w),
            Fixed::Light => self.brdf.eval(DVec3::Z, w, from),
        });
        sides[0] + sides[1]
    }
}
