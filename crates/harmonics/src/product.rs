//! Integrals and coefficients of products of functions.

mod gaunt;

pub(crate) use gaunt::Gaunt;

use crate::{Real, count};

/// ∫ f g dω of two functions: the scalar product of their coefficients (thesis 2.46).
pub fn double<R: Real>(f: &[R], g: &[R]) -> R {
    assert_eq!(f.len(), g.len(), "two functions of as many bands");
    f.iter().zip(g).map(|(&f, &g)| f * g).sum()
}

/// ∫ f g dω from the coefficients of the product f g: 2√π times the first one (thesis 4.4).
///
/// With f the light under a cosine and g one, the diffuse integral comes free with the specular one.
pub fn diffuse_from_specular<R: Real>(product: &[R]) -> R {
    R::of(2.0 * std::f64::consts::PI.sqrt()) * product[0]
}

/// The product of any two functions, by a sparse table of ∫ Y_i Y_j Y_k dω (thesis 2.48).
///
/// The table grows as n⁵: 52 integrals at 3 bands (83 with both orders), 12 057 at 9.
#[derive(Clone, Debug)]
pub struct Product<R> {
    bands: usize,
    /// The integrals with i ≤ j, those of one k after those of another.
    entries: Vec<TripleProduct<R>>,
}

#[derive(Clone, Copy, Debug)]
struct TripleProduct<R> {
    i: u32,
    j: u32,
    k: u32,
    value: R,
}

impl<R: Real> Product<R> {
    /// The table for `bands` ≥ 1 bands of both functions and of the result.
    pub fn new(bands: usize) -> Self {
        let gaunt = Gaunt::new(bands);
        let mut entries = Vec::new();
        for k in 0..count(bands) {
            for j in 0..count(bands) {
                for i in 0..=j {
                    if let Some(value) = gaunt.integral([i, j, k]) {
                        let value = R::of(value);
                        entries.push(TripleProduct {
                            i: i as u32,
                            j: j as u32,
                            k: k as u32,
                            value,
                        });
                    }
                }
            }
        }
        Self { bands, entries }
    }

    /// Number of tabulated integrals.
    pub fn integrals(&self) -> usize {
        self.entries.len()
    }

    /// Writes the coefficients of f g, cut at the table's bands; each slice holds bands² numbers.
    pub fn apply(&self, f: &[R], g: &[R], product: &mut [R]) {
        for length in [f.len(), g.len(), product.len()] {
            assert_eq!(length, count(self.bands), "bands² coefficients");
        }
        product.fill(R::zero());
        for &TripleProduct { i, j, k, value } in &self.entries {
            let (i, j) = (i as usize, j as usize);
            let pair = if i == j { f[i] * g[i] } else { f[i] * g[j] + f[j] * g[i] };
            product[k as usize] += value * pair;
        }
    }

    /// ∫ f g h dω (thesis 2.47): the product of two against the third.
    pub fn triple(&self, f: &[R], g: &[R], h: &[R], product: &mut [R]) -> R {
        self.apply(f, g, product);
        double(product, h)
    }
}
