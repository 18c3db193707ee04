//! Quadrature over a GGX lobe, for every width, by its half vectors.

use std::f64::consts::PI;

use glam::DVec3;
use manylights_harmonics::quadrature::gauss_legendre;
use manylights_scene::DBrdf;

use crate::LobeShape;

/// Half vectors about the normal z with weights D(h) n·h dω.
pub(crate) struct HalfVectors {
    shape: LobeShape,
    ggx: DBrdf,
    nodes: Vec<(DVec3, f64)>,
}

impl HalfVectors {
    /// Rings in the polar angle, sectors in half a turn. With w² = 1 − u of the distribution's inverse,
    /// tan² θ = α² (1 − w²)/w², du = 2w dw, so the integrand over w is smooth for every α.
    pub(crate) fn new(shape: LobeShape, [rings, sectors]: [usize; 2]) -> Self {
        let ggx = DBrdf::from(shape.brdf());
        let alpha = ggx.alpha;
        let ring = |(node, weight): (f64, f64)| {
            let w: f64 = 0.5 + 0.5 * node;
            let sin = alpha * (1.0 - w * w).sqrt();
            let inverse = 1.0 / sin.hypot(w);
            // Both halves of the turn alike.
            let share = w * weight / sectors as f64;
            (0..sectors).map(move |sector| {
                let (s, c) = ((sector as f64 + 0.5) / sectors as f64 * PI).sin_cos();
                (DVec3::new(sin * c, sin * s, w) * inverse, share)
            })
        };
        let nodes = gauss_legendre(rings).into_iter().flat_map(ring).collect();
        Self { shape, ggx, nodes }
    }

    /// Directions l above the horizon with weights for the lobe without its cosine, dl = 4 v·h dh: one
    /// for f0, the other for f90. `view` lies in the xz-plane; half a turn stands for both.
    pub(crate) fn reflected(&self, view: DVec3) -> impl Iterator<Item = (DVec3, [f64; 2])> {
        self.nodes.iter().filter_map(move |&(h, weight)| {
            let along = view.dot(h);
            let direction = 2.0 * along * h - view;
            let visible = along > 0.0 && direction.z > 0.0;
            visible.then(|| {
                let visibility = self.ggx.visibility(view.z, direction.z);
                let flux = weight * visibility * 4.0 * along / h.z;
                (direction, self.shape.fresnel(along).map(|fresnel| flux * fresnel))
            })
        })
    }
}
