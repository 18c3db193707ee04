//! Quadrature over reflected directions by half vectors, which follow a lobe wherever it points.

use std::f64::consts::PI;

use glam::DVec3;
use manylights_harmonics::quadrature::gauss_legendre;

/// A half vector about the normal z, in the half turn y > 0.
pub(crate) struct HalfVector {
    pub(crate) h: DVec3,
    /// D(h) n·h dh of the GGX distribution, over both halves of the turn.
    pub(crate) density: f64,
    /// dh, over one of them.
    pub(crate) solid_angle: f64,
}

/// `rings` in the polar angle, `sectors` in half a turn, as the GGX distribution of this width has them.
/// With w² = 1 − u of the distribution's inverse, tan² θ = α² (1 − w²)/w², du = 2w dw, so D n·h dh over
/// w is smooth for every α; dh = α² (n·h/w)³ dw dφ is as well.
pub(crate) fn half_vectors(alpha: f64, [rings, sectors]: [usize; 2]) -> Vec<HalfVector> {
    let ring = |(node, weight): (f64, f64)| {
        let w: f64 = 0.5 + 0.5 * node;
        let sin = alpha * (1.0 - w * w).sqrt();
        let inverse = 1.0 / sin.hypot(w);
        let density = w * weight / sectors as f64;
        let solid_angle = 0.5 * weight * (PI / sectors as f64) * alpha * alpha * inverse.powi(3);
        (0..sectors).map(move |sector| {
            let (s, c) = ((sector as f64 + 0.5) / sectors as f64 * PI).sin_cos();
            let h = DVec3::new(sin * c, sin * s, w) * inverse;
            HalfVector { h, density, solid_angle }
        })
    };
    gauss_legendre(rings).into_iter().flat_map(ring).collect()
}

/// The direction that `view` is reflected into at this half vector, where both are above the horizon,
/// and dl/dh = 4 v·h.
pub(crate) fn reflected(view: DVec3, h: DVec3) -> Option<(DVec3, f64)> {
    let along = view.dot(h);
    let direction = 2.0 * along * h - view;
    (along > 0.0 && direction.z > 0.0).then_some((direction, 4.0 * along))
}
