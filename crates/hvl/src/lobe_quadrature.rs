//! Directions and weights for integrals over the lobes of one table.

use glam::DVec3;
use manylights_scene::DBrdf;

use crate::LobeShape;
use crate::half_vectors::{HalfVector, half_vectors, reflected};

/// Width of the distribution whose half vectors stand for those of a measurement: it reaches a tenth of a
/// degree from the mirrored direction, and the horizon.
const MEASURED_WIDTH: f64 = 0.2;

/// For one shape.
pub(crate) struct LobeQuadrature {
    shape: LobeShape,
    brdf: DBrdf,
    half_vectors: Vec<HalfVector>,
    fixed: Fixed,
}

/// The direction that the tables run over: measurements are not quite reciprocal.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fixed {
    View,
    Light,
}

impl LobeQuadrature {
    /// `nodes` in the polar angle of the half vector, and in half a turn.
    pub(crate) fn new(shape: LobeShape, nodes: [usize; 2], fixed: Fixed) -> Self {
        let brdf = DBrdf::from(shape.brdf());
        let alpha = if shape.is_measured() { MEASURED_WIDTH } else { brdf.alpha };
        Self { shape, brdf, half_vectors: half_vectors(alpha, nodes), fixed }
    }

    /// Directions above the horizon with weights for the two lobes of a table, without their cosine: for
    /// f0 and for f90, or of a measurement's channels. `from`, the fixed direction, lies in the xz-plane,
    /// and what is integrated does not know y from −y.
    pub(crate) fn reflected(&self, from: DVec3) -> Vec<(DVec3, [f64; 2])> {
        let one = |node: &HalfVector| {
            let (direction, ratio) = reflected(from, node.h)?;
            let weights = if self.shape.is_measured() {
                self.measured(from, direction).map(|value| value * node.solid_angle * ratio)
            } else {
                let visibility = self.brdf.visibility(from.z, direction.z);
                let flux = node.density * visibility * ratio / node.h.z;
                self.shape.fresnel(from.dot(node.h)).map(|fresnel| flux * fresnel)
            };
            Some((direction, weights))
        };
        self.half_vectors.iter().filter_map(one).collect()
    }

    /// The channels of a measurement, summed over both sides of the plane of incidence: measurements are
    /// not quite alike on both.
    fn measured(&self, from: DVec3, direction: DVec3) -> [f64; 2] {
        let sides = [direction, direction * DVec3::new(1.0, -1.0, 1.0)].map(|w| match self.fixed {
            Fixed::View => self.brdf.eval(DVec3::Z, from, w),
            Fixed::Light => self.brdf.eval(DVec3::Z, w, from),
        });
        self.shape.channels(sides[0] + sides[1])
    }

    /// What turns the flux of an expansion of both lobes into the flux of the lobes: one factor for A + B,
    /// but one for each channel of a measurement, which may be black.
    pub(crate) fn kept(&self, flux: [f64; 2], expanded: [f64; 2]) -> [f64; 2] {
        if !self.shape.is_measured() {
            return [(flux[0] + flux[1]) / (expanded[0] + expanded[1]); 2];
        }
        [0, 1].map(|k| if flux[k] > 0.0 { flux[k] / expanded[k] } else { 1.0 })
    }
}
