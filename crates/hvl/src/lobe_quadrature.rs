//! Directions and weights for integrals over a lobe.

use glam::DVec3;
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_scene::{DBrdf, Lobe};

use crate::LobeShape;
use crate::half_vectors::HalfVectors;

/// Rings of the hemisphere, by twice as many sectors: 0.7°, where measurements that have a lobe in 20
/// bands interpolate linearly between coarser angles.
const RINGS: usize = 128;

/// For one shape.
pub(crate) enum LobeQuadrature {
    Ggx(HalfVectors),
    Measured { brdf: DBrdf, channel: usize, fixed: Fixed, directions: Vec<([f64; 3], f64)> },
}

/// The direction that the tables run over: measurements are not quite reciprocal.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fixed {
    View,
    Light,
}

impl LobeQuadrature {
    /// `nodes` in the polar angle of the half vector, and in half a turn, of GGX.
    pub(crate) fn new(shape: LobeShape, nodes: [usize; 2], fixed: Fixed) -> Self {
        let (brdf, channel) = (DBrdf::from(shape.brdf()), shape.channel());
        if matches!(brdf.lobe, Lobe::Measured(_)) {
            let directions = sphere_nodes(RINGS, [0.0, 1.0]);
            return Self::Measured { brdf, channel, fixed, directions };
        }
        Self::Ggx(HalfVectors::new(shape, nodes))
    }

    /// Directions above the horizon with weights for the lobe without its cosine, one for f0, the other
    /// for f90; of a measurement the first holds all. The fixed direction lies in the xz-plane, and
    /// what is integrated does not know y from −y.
    pub(crate) fn reflected(&self, fixed_direction: DVec3) -> Vec<(DVec3, [f64; 2])> {
        match self {
            Self::Ggx(half_vectors) => half_vectors.reflected(fixed_direction).collect(),
            Self::Measured { brdf, channel, fixed, directions } => {
                let value = |&(w, weight): &([f64; 3], f64)| {
                    let w = DVec3::from(w);
                    let [v, l] = match fixed {
                        Fixed::View => [fixed_direction, w],
                        Fixed::Light => [w, fixed_direction],
                    };
                    (w, [weight * brdf.eval(DVec3::Z, v, l)[*channel], 0.0])
                };
                directions.iter().map(value).collect()
            }
        }
    }
}
