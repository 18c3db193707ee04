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
//! What is found does not ring, and 2⁻²⁴ less of strength rings. Were the minimum not monotonic in the
//! strength, a still weaker window might do as well. Apply the weights by
//! [`crate::convolution::convolve`].

mod profile;
mod sphere;

pub use profile::Profile;
pub use sphere::Sphere;

use crate::Real;
use crate::window::Window;

/// Halvings of the strength.
const STEPS: usize = 24;

/// Bisects the strength; writes the weights found. `None` if even the mean rings.
fn weakest<R: Real>(
    window: Window,
    weights: &mut [R],
    mut rings: impl FnMut(&[R]) -> bool,
) -> Option<R> {
    weights.fill(R::one());
    if !rings(weights) {
        return Some(R::zero());
    }
    // At width one the mean alone is left.
    let (mut weak, mut strong) = (R::zero(), R::one());
    window.weights(strong, weights);
    if rings(weights) {
        return None;
    }
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
