//! Quadrature over reflected directions by half vectors, which follow a lobe wherever it points.

use std::f64::consts::PI;

use glam::DVec3;
use manylights_harmonics::quadrature::gauss_legendre;

/// Half vectors about the normal z, as the GGX distribution of a width has them.
pub(crate) struct HalfVectors {
    alpha: f64,
    /// Nodes and weights on [0, 1].
    rings: Vec<(f64, f64)>,
    /// In half a turn.
    sectors: usize,
}

/// One of them, in the half turn y > 0.
pub(crate) struct HalfVector {
    pub(crate) h: DVec3,
    /// D(h) n·h dh of the GGX distribution, over both halves of the turn.
    pub(crate) density: f64,
    /// dh, over one of them.
    pub(crate) solid_angle: f64,
}

impl HalfVectors {
    pub(crate) fn new(alpha: f64, [rings, sectors]: [usize; 2]) -> Self {
        let unit = |(node, weight): (f64, f64)| (0.5 + 0.5 * node, 0.5 * weight);
        Self { alpha, rings: gauss_legendre(rings).into_iter().map(unit).collect(), sectors }
    }

    /// Those that reflect a view of the xz-plane above the horizon.
    ///
    /// With w² = 1 − u of the distribution's inverse, tan² θ = α² (1 − w²)/w², du = 2w dw, so
    /// D n·h dh over w is smooth for every α; dh = α² (n·h/w)³ dw dφ is as well. In each sector w runs
    /// from where the reflection meets the horizon, tan θ = (v_x c + √(v_x² c² + v_z²))/v_z with
    /// c = cos φ: what is integrated ends there in a step.
    pub(crate) fn above_horizon(&self, view: DVec3) -> impl Iterator<Item = HalfVector> {
        let Self { alpha, rings, sectors } = self;
        (0..*sectors).flat_map(move |sector| {
            let (sin, cos) = ((sector as f64 + 0.5) / *sectors as f64 * PI).sin_cos();
            let along = view.x * cos;
            let root = along.hypot(view.z);
            // The second form is the first one without its difference.
            let reach = if along > 0.0 { along + root } else { view.z * view.z / (root - along) };
            let least = alpha * view.z / (alpha * view.z).hypot(reach);
            rings.iter().map(move |&(node, weight)| {
                let (w, dw) = (least + (1.0 - least) * node, (1.0 - least) * weight);
                let tangent = alpha * ((1.0 - w) * (1.0 + w)).sqrt();
                let inverse = 1.0 / tangent.hypot(w);
                HalfVector {
                    h: DVec3::new(tangent * cos, tangent * sin, w) * inverse,
                    density: 2.0 * w * dw / *sectors as f64,
                    solid_angle: dw * (PI / *sectors as f64) * (alpha * alpha * inverse.powi(3)),
                }
            })
        })
    }
}

/// The direction that `view` is reflected into, and dl/dh = 4 v·h.
pub(crate) fn reflected(view: DVec3, h: DVec3) -> (DVec3, f64) {
    let along = view.dot(h);
    (2.0 * along * h - view, 4.0 * along)
}
