//! The Lambertian lobe under a specular layer.
//!
//! T(n·l) n·l with Schlick's transmission T(c) = T(0) + (T(1) − T(0)) (1 − (1 − c)⁵) is the clamped cosine T(0)
//! times, and (1 − (1 − c)⁵) c the rest: one function of the angle, whatever f0, as a transformed cosine that is
//! circular about the normal.

use std::f64::consts::PI;

use glam::DVec3;
use manylights_harmonics::quadrature::gauss_legendre;

use super::TransformedCosine;
use super::minimum::minimum;

/// The fit of (1 − (1 − c)⁵) c, to 0.051 of its largest value 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layered {
    /// M⁻¹_zz.
    pub height: f64,
}

impl Layered {
    /// ∫ (1 − (1 − c)⁵) c over the hemisphere, over π: 20/21.
    pub const ALBEDO: f64 = 20.0 / 21.0;
    /// What [`Self::fit`] finds.
    pub const FITTED: Self = Self { height: 0.964897 };

    /// Of the same integral and least squared error.
    pub fn fit() -> Self {
        let (point, _) = minimum([1.0], 0.1, (1e-12, 200), |&[height]| Self { height }.error2());
        Self { height: point[0] }
    }

    /// The transform.
    pub fn cosine(self) -> TransformedCosine {
        TransformedCosine { along: [0.0, self.height], ..TransformedCosine::COSINE }
    }

    /// Its value at a cosine and the lobe's.
    pub fn values(self, cosine: f64) -> [f64; 2] {
        let direction = DVec3::new(((1.0 - cosine) * (1.0 + cosine)).sqrt(), 0.0, cosine);
        let fitted = PI * Self::ALBEDO * self.cosine().density(direction);
        [fitted, (1.0 - (1.0 - cosine).powi(5)) * cosine]
    }

    /// ∫ (difference)² dω/2π.
    fn error2(self) -> f64 {
        let term = |(node, weight): (f64, f64)| {
            let [fitted, lobe] = self.values(0.5 + 0.5 * node);
            0.5 * weight * (fitted - lobe).powi(2)
        };
        gauss_legendre(64).into_iter().map(term).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fit_is_what_is_kept_and_errs_as_said() {
        let made = Layered::fit().height;
        assert!((made - Layered::FITTED.height).abs() < 1e-5, "{made}");
        let errors = (0..=1000).map(|i| {
            let [fitted, lobe] = Layered::FITTED.values(f64::from(i) / 1000.0);
            (fitted - lobe).abs()
        });
        let worst = errors.fold(0.0, f64::max);
        assert!((worst - 0.0505).abs() < 5e-4, "{worst}");
    }
}
