//! Weights of the bands of a tabulated lobe: windows (thesis 2.45, whose labels are permuted) and the
//! weakest of them that keeps the lobe from ringing below zero. They cost nothing at run time.

use manylights_harmonics::dering::{Profile, Sphere};
use manylights_harmonics::window::Window;
use manylights_harmonics::{count, even_index, index};

use crate::expansion::Damping;

/// How far below zero a de-ringed lobe may fall, relative to its mean over the sphere.
const TOLERANCE: f64 = 0.01;

impl Damping {
    /// For the expansion of one row, its coefficients of m ≥ 0.
    pub(crate) fn of_lobe(self, bands: usize, even: &[f64]) -> Vec<f64> {
        self.weights(bands, |weights| {
            let mut all = vec![0.0; count(bands)];
            for l in 0..bands {
                for m in 0..=l {
                    all[index(l, m as isize)] = even[even_index(l, m)];
                }
            }
            let mean = all[0] / (4.0 * std::f64::consts::PI).sqrt();
            Sphere::new(bands).search(Window::SincFourth, &all, TOLERANCE * mean, weights)
        })
    }

    /// For a zonal function of these scales.
    pub(crate) fn of_zonal(self, scales: &[f64]) -> Vec<f64> {
        self.weights(scales.len(), |weights| {
            let mean = scales[0] / (4.0 * std::f64::consts::PI);
            let mut profile = Profile::new(scales.len());
            profile.search(Window::SincFourth, scales, TOLERANCE * mean, weights)
        })
    }

    fn weights(self, bands: usize, weakest: impl FnOnce(&mut [f64]) -> Option<f64>) -> Vec<f64> {
        let mut weights = vec![1.0; bands];
        match self {
            Self::None => {}
            Self::Window(window) => window.weights(bands as f64, &mut weights),
            Self::Weakest => {
                // A lobe whose mean is not positive is black: there is nothing to damp.
                if weakest(&mut weights).is_none() {
                    weights.fill(1.0);
                }
            }
        }
        weights
    }
}
