use super::jacobi;
use crate::{Basis, Real, count};

/// What is done about small singular values σ, relative to the largest.
///
/// They belong to combinations of basis functions that the samples hardly see; 1/σ turns their noise
/// into coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter<R> {
    /// 1/σ where σ exceeds this share of the largest, 0 elsewhere; the thesis (5.3.1) truncates.
    ///
    /// Share 0 cuts exact zeros only. A combination that the samples do not see at all mostly has a σ
    /// of rounding, and comes out as rounding over rounding: where there may be some, the share is
    /// well above the scalar's ε.
    Truncated(R),
    /// σ/(σ² + λ²), λ this share > 0 of the largest: Tikhonov.
    Tikhonov(R),
}

/// The least-squares fit of an expansion to samples (thesis 2.2.4): M directions, N = bands²
/// coefficients. With M < N it is the smallest of the fits that are exact.
///
/// Near M = N it is ill-conditioned (thesis figure 5.18): see [`Self::condition`].
#[derive(Clone, Debug)]
pub struct LeastSquares<R> {
    samples: usize,
    coefficients: usize,
    /// σ_k of the matrix Y_j(ω_i), k < min(M, N).
    singular: Vec<R>,
    /// Of each σ_k the unit vector of M samples, and that of N coefficients, one after the other.
    sample_vectors: Vec<R>,
    coefficient_vectors: Vec<R>,
}

impl<R: Real> LeastSquares<R> {
    /// Decomposes the matrix Y_j(ω_i) of at least one direction: min(M, N)² max(M, N) operations, some
    /// ten times over.
    pub fn new(basis: &Basis<R>, directions: &[[R; 3]]) -> Self {
        assert!(!directions.is_empty(), "a fit has at least one sample");
        let (samples, coefficients) = (directions.len(), count(basis.bands()));
        let mut rows = vec![R::zero(); samples * coefficients];
        for (&direction, row) in directions.iter().zip(rows.chunks_mut(coefficients)) {
            basis.evaluate(direction, row);
        }
        // The decomposition turns min(M, N) vectors of max(M, N) numbers.
        if samples < coefficients {
            let (singular, sample_vectors) = jacobi::orthogonalise(&mut rows, coefficients);
            let coefficient_vectors = rows;
            Self { samples, coefficients, singular, sample_vectors, coefficient_vectors }
        } else {
            let mut columns = transposed(&rows, coefficients);
            let (singular, coefficient_vectors) = jacobi::orthogonalise(&mut columns, samples);
            let sample_vectors = columns;
            Self { samples, coefficients, singular, sample_vectors, coefficient_vectors }
        }
    }

    /// Largest over smallest of the min(M, N) singular values. Where all of M ≥ N samples leave a
    /// combination unseen that is 1/ε or more, but seldom infinite: the smallest is then rounding.
    pub fn condition(&self) -> R {
        let smallest = self.singular.iter().fold(R::infinity(), |a, &b| a.min(b));
        self.largest() / smallest
    }

    fn largest(&self) -> R {
        self.singular.iter().fold(R::zero(), |a, &b| a.max(b))
    }

    /// Writes the fit to the samples f(ω_i), in the order of the directions, to `coefficients`.
    pub fn fit(&self, samples: &[R], filter: Filter<R>, coefficients: &mut [R]) {
        assert_eq!(samples.len(), self.samples, "one sample a direction");
        assert_eq!(coefficients.len(), self.coefficients, "bands² coefficients");
        coefficients.fill(R::zero());
        let largest = self.largest();
        let vectors = self.sample_vectors.chunks(self.samples);
        let vectors = vectors.zip(self.coefficient_vectors.chunks(self.coefficients));
        for (&sigma, (seen, meant)) in self.singular.iter().zip(vectors) {
            let gain = match filter {
                Filter::Truncated(share) if sigma > share * largest => sigma.recip(),
                Filter::Truncated(_) => R::zero(),
                Filter::Tikhonov(share) => {
                    let lambda = share * largest;
                    sigma / (sigma * sigma + lambda * lambda)
                }
            };
            let part: R = samples.iter().zip(seen).map(|(&f, &u)| f * u).sum();
            for (coefficient, &v) in coefficients.iter_mut().zip(meant) {
                *coefficient += gain * part * v;
            }
        }
    }
}

fn transposed<R: Real>(rows: &[R], width: usize) -> Vec<R> {
    (0..width).flat_map(|column| rows.iter().skip(column).step_by(width).copied()).collect()
}
