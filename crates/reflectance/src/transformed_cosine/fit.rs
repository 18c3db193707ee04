//! The transformed cosine nearest to a GGX lobe.

use glam::DVec3;
use manylights_scene::{Brdf, Lobe};

use super::minimum::minimum;
use super::{TransformedCosine, TransformedLobe};
use crate::{Fixed, LobeQuadrature, LobeShape};

/// Nodes of the quadrature in the polar angle and in the half turn of the half vector.
pub const NODES: [usize; 2] = [48, 48];
/// Of the error that is minimised.
pub const EXPONENT: i32 = 2;
/// Where a search ends: the share of the error that it may still fall, and steps.
const SEARCH: (f64, usize) = (1e-7, 2000);

/// A lobe at quadrature nodes above the horizon.
pub struct Target {
    alpha: f64,
    view: DVec3,
    nodes: Vec<Node>,
    /// ∫ of it for f0 and for f90.
    albedo: [f64; 2],
}

struct Node {
    direction: DVec3,
    solid_angle: f64,
    /// Cosine-weighted and normalised, F = 1.
    lobe: f64,
}

impl Target {
    /// The lobe of GGX width α at a view with this cosine, for `nodes` as in [`NODES`].
    pub fn new(alpha: f32, cosine: f64, nodes: [usize; 2]) -> Self {
        let brdf = Brdf {
            diffuse: glam::Vec3::ZERO,
            f0: glam::Vec3::ONE,
            lobe: Lobe::Schlick { f90: 1.0 },
            alpha,
        };
        let view = DVec3::new(((1.0 - cosine) * (1.0 + cosine)).sqrt(), 0.0, cosine);
        let quadrature = LobeQuadrature::new(LobeShape::from(brdf), nodes, Fixed::View);
        let exact = manylights_scene::DBrdf::from(brdf);
        let mut albedo = [0.0; 2];
        let mut nodes = Vec::new();
        for (direction, [f0, f90, _]) in quadrature.reflected(view) {
            let [a, b] = [f0, f90].map(|share| share * direction.z);
            albedo = [albedo[0] + a, albedo[1] + b];
            let lobe = exact.specular(DVec3::Z, view, direction).x * direction.z;
            if lobe > 0.0 {
                nodes.push(Node { direction, solid_angle: (a + b) / lobe, lobe });
            }
        }
        let all = albedo[0] + albedo[1];
        nodes.iter_mut().for_each(|node| node.lobe /= all);
        Self { alpha: alpha.into(), view, nodes, albedo }
    }

    /// ∫ |lobe − transformed cosine|^exponent over the directions above the horizon, where both have integral 1:
    /// of exponent 1 a bound for the error under any light, over that of a light all around.
    pub fn error(&self, cosine: &TransformedCosine, exponent: i32) -> f64 {
        let above = cosine.above_horizon();
        let term = |node: &Node| {
            let difference = cosine.density(node.direction) / above - node.lobe;
            difference.abs().powi(exponent) * node.solid_angle
        };
        self.nodes.iter().map(term).sum()
    }

    /// The nearest one, searched for from what is known to be near and from the lobe's curvature.
    pub fn nearest(&self, near: Option<TransformedCosine>) -> TransformedLobe {
        let of = |p: &[f64; 4]| TransformedCosine {
            across: [p[0].exp(), p[1]],
            along: [self.alpha * p[2], self.alpha * p[3].exp()],
        };
        let value = |cosine: TransformedCosine| {
            if cosine.determinant() > 0.0 { self.error(&cosine, EXPONENT) } else { f64::INFINITY }
        };
        let search = |start: TransformedCosine| {
            let [zx, zz] = start.along.map(|entry| entry / self.alpha);
            let start = [start.across[0].ln(), start.across[1], zx, zz.ln()];
            let search = |start| minimum(start, 0.1, SEARCH, |p| value(of(p)));
            // The second search leaves where the first one's simplex has collapsed.
            search(search(start).0)
        };
        let cosine = if self.view.x == 0.0 {
            let isotropic = |[p]: &[f64; 1]| of(&[0.0, 0.0, 0.0, *p]);
            let start = [(2.0_f64.min(1.0 / self.alpha)).ln()];
            let (point, _) = minimum(start, 0.1, SEARCH, |p| value(isotropic(p)));
            isotropic(&point)
        } else {
            let starts = [near, Some(self.curved())].into_iter().flatten();
            let found = starts.map(search).min_by(|(_, a), (_, b)| a.total_cmp(b));
            of(&found.expect("one start or two").0)
        };
        let above = cosine.above_horizon();
        TransformedLobe { cosine, magnitudes: self.albedo.map(|albedo| albedo / above) }
    }

    /// About the mirror direction, with the curvature of a narrow lobe there.
    fn curved(&self) -> TransformedCosine {
        let DVec3 { x: sin, z: cos, .. } = self.view;
        let xx = (cos * cos).max(self.alpha * self.alpha);
        TransformedCosine { across: [xx, sin * cos], along: [0.0, (2.0 * self.alpha).min(1.0)] }
    }
}
