//! Linearly transformed cosines (Heitz, Dupuy, Hill, Neubelt 2016): a specular lobe as a clamped cosine about z,
//! of directions that a matrix has turned, stretched and sheared.
//!
//! In the frame of normal (z) and view (in the xz-plane) a lobe is
//!
//! f(v, l) n·l ≈ (f0 A + f90 B) · max(0, (M⁻¹l)_z)/(π |M⁻¹l|⁴ det M)   for n·l > 0,
//!
//! so that its integral over a polygon of light is Lambert's formula for the polygon that M⁻¹ makes of what
//! lies above the horizon. M⁻¹ and the magnitudes are tabulated over roughness and view ([`Table`]); the table is
//! fitted to this repository's GGX by `cargo run --release -p manylights-reflectance --example
//! fit_transformed_cosines` ([`fit`]).
//!
//! # Deviations from the paper
//! - What lies below the surface's horizon is cut off before the transform, and the magnitudes are over the
//!   rest: the paper cuts at the transformed horizon alone, so that lights below the surface shine.
//! - The four entries of M⁻¹ are free: the paper fixes the lobe's axis to the mean direction.
//! - The squared error is minimised, where the paper takes the cubed one: narrow peaks weigh less, which
//!   grazing views gain from.
//! - Errors are integrated over fixed half vectors, so that equal inputs give equal tables.

pub mod fit;
mod layered;
mod minimum;
mod table;
mod wgsl;

use glam::DVec3;
use manylights_scene::DBrdf;

pub use layered::Layered;
pub use table::{FINGERPRINT, Table, VIEWS, at, roughness, view_cosine, view_place};
pub(crate) use wgsl::record;
pub use wgsl::{TRANSFORMED_LOBES, module};

/// M⁻¹ over its middle entry, in the frame of normal and view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformedCosine {
    /// Row x: the entries at x and z.
    pub across: [f64; 2],
    /// Row z: the entries at x and z.
    pub along: [f64; 2],
}

impl TransformedCosine {
    /// The clamped cosine itself.
    pub const COSINE: Self = Self { across: [1.0, 0.0], along: [0.0, 1.0] };

    /// M⁻¹ of a vector.
    pub fn apply(&self, w: DVec3) -> DVec3 {
        let Self { across: [xx, xz], along: [zx, zz] } = *self;
        DVec3::new(xx * w.x + xz * w.z, w.y, zx * w.x + zz * w.z)
    }

    /// det M⁻¹.
    pub fn determinant(&self) -> f64 {
        let Self { across: [xx, xz], along: [zx, zz] } = *self;
        xx * zz - xz * zx
    }

    /// What of it lies above the horizon, from 1/2 to 1: behind the transform a lune between two half-spaces, which
    /// holds half of 1 and the height of the horizon's normal.
    pub fn above_horizon(&self) -> f64 {
        let ([xx, _], [zx, _]) = (self.across, self.along);
        0.5 + 0.5 * xx / xx.hypot(zx)
    }

    /// Of a unit vector, sr⁻¹: 1 in all over the sphere.
    pub fn density(&self, w: DVec3) -> f64 {
        let turned = self.apply(w);
        let length2 = turned.length_squared();
        turned.z.max(0.0) * self.determinant() / (std::f64::consts::PI * length2 * length2)
    }
}

/// The transform of a surface's specular lobe for a view at this cosine from the normal, and its magnitude over π:
/// what kernels read, in f64.
pub fn of_surface(brdf: &DBrdf, cosine: f64) -> (TransformedCosine, DVec3) {
    let lobe = at(&Table::shared().lobes(brdf.alpha), cosine);
    let [a, b] = lobe.magnitudes;
    let magnitude = brdf.f0 * a + DVec3::splat(f64::from(brdf.lobe.f90()) * b);
    (lobe.cosine, magnitude * std::f64::consts::FRAC_1_PI)
}

/// A transformed cosine and its magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformedLobe {
    /// The transform.
    pub cosine: TransformedCosine,
    /// A and B: of f0 and of f90.
    pub magnitudes: [f64; 2],
}
