//! De-ringing: the weakest window under which an expansion does not fall below zero.
//!
//! P.-P. Sloan, "Deringing Spherical Harmonics", SIGGRAPH Asia 2017 technical briefs. His are the
//! window [`Window::SincFourth`], whose width is bisected per function instead of fixed per number of
//! bands, and the criterion that the reconstructed function is nowhere negative.
//!
//! Ours: any [`Window`] and up to 30 bands (he finds the minimum of low bands only), so the minimum
//! is sought on a grid and refined from there; zonal functions on their profile; a tolerance; the
//! search runs over the strength 1/width, which is 0 where nothing is damped.
//!
//! The minimum is not monotonic in the strength: under sinc⁴, twenty bands of max(0, cos) stay above −1 %
//! of their mean at strengths 0.02 to 0.04 and from 0.3 on, not between. So 32 strengths are tried from
//! the weakest on before one is bisected. What is found does not ring, and 2⁻²⁴ less of strength rings;
//! between two tries a still weaker window might do. Apply the weights by
//! [`crate::convolution::convolve`].

mod profile;
mod sphere;

pub use profile::Profile;
pub use sphere::Sphere;

use crate::Real;
use crate::window::Window;

/// Strengths that are tried, the k-th (k/32)²: the first ones are narrower than a band.
const TRIES: usize = 32;

/// Halvings of the strength.
const STEPS: usize = 24;

/// The first strength that does not ring, bisected; writes the weights found. `None` if even the mean
/// rings.
fn weakest<R: Real>(
    window: Window,
    weights: &mut [R],
    mut rings: impl FnMut(&[R]) -> bool,
) -> Option<R> {
    weights.fill(R::one());
    if !rings(weights) {
        return Some(R::zero());
    }
    let strength = |k: usize| R::of((k as f64 / TRIES as f64).powi(2));
    // At width one the mean alone is left.
    let first = (1..=TRIES).find(|&k| {
        window.weights(strength(k).recip(), weights);
        !rings(weights)
    })?;
    let (mut weak, mut strong) = (strength(first - 1), strength(first));
    for _ in 0..STEPS {
        let middle = R::of(0.5) * (weak + strong);
        window.weights(middle.recip(), weights);
        if rings(weights) {
            weak = middle;
        } else {
            strong = middle;
        }
    }
    window.weights(strong.recip(), weights);
    Some(strong)
}
