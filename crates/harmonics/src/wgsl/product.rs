//! Products of coefficient vectors.

use super::lines::{Factor, Lines, product, sum};
use crate::clamped_cosine::{Local, scales};
use crate::product::Gaunt;
use crate::{count, even_count, even_index, index};

pub(super) fn dot(bands: usize, even: bool) -> Lines {
    let mut lines = Lines::default();
    let mut total = None;
    // One sum a band: short chains round less, and parsers need not nest a thousand deep.
    for l in 0..bands {
        let range = if even {
            even_index(l, 0)..even_index(l + 1, 0)
        } else {
            index(l, -(l as isize))..count(l + 1)
        };
        let pairs =
            range.map(|i| (true, product(&[&Factor::element("a", i), &Factor::element("b", i)])));
        let name = format!("sum{l}");
        let before = total.take().into_iter();
        total = Some((true, lines.bind(&name, sum(before.chain(pairs)))));
    }
    lines.give(format_args!("sum{}", bands - 1))
}

/// Thesis 4.6: the matrix of [`Local`], row by row.
pub(super) fn clamped_cosine(bands: usize, even: bool) -> Lines {
    let size = if even { even_count(bands) } else { count(bands) };
    let mut rows = vec![Vec::new(); size];
    // In this order the terms of every row come with their bands ascending.
    for &(l, other, m, entry) in Local::<f64>::new(bands).entries() {
        let (l, other, m) = (l as usize, other as usize, m as usize);
        let signs: &[isize] = if m == 0 || even { &[1] } else { &[1, -1] };
        for sign in signs {
            let place = |l| if even { even_index(l, m) } else { index(l, sign * m as isize) };
            let (i, j) = (place(l), place(other));
            let mut couple = |row: usize, column| {
                let factors = [Factor::Constant(entry.abs()), Factor::element("a", column)];
                rows[row].push((entry >= 0.0, product(&factors.each_ref())));
            };
            couple(i, j);
            if i != j {
                couple(j, i);
            }
        }
    }
    let values: Vec<_> = rows.into_iter().map(sum).collect();
    Lines::default().give_array("vec3f", &values)
}

/// Thesis 2.48.
pub(super) fn general(bands: usize) -> Lines {
    by_matrix(bands, "b", &vec![1.0; bands])
}

/// Thesis 4.5.
pub(super) fn folded(bands: usize, cosine_bands: usize) -> Lines {
    let mut cosine = vec![0.0; cosine_bands];
    scales(&mut cosine);
    by_matrix(bands, "normal", &cosine)
}

/// a times the function of `factors`_l `other`_j. The symmetric matrix Σ_j ∫ Y_i Y_j Y_k `other`_j comes
/// first, entry by entry, and serves all channels, (i, k) and (k, i): with three channels that is a third of
/// what products of coefficients would take. At once its two terms are added, so no entry waits in memory.
fn by_matrix(bands: usize, other: &str, factors: &[f64]) -> Lines {
    let (gaunt, size) = (Gaunt::new(bands), count(bands));
    let mut lines = Lines::default();
    lines.sums("sums", size);
    for i in 0..size {
        for k in i..size {
            let terms = (0..count(factors.len())).filter_map(|j| {
                let value = gaunt.integral([i, j, k])? * factors[j.isqrt()];
                let factors = [Factor::Constant(value.abs()), Factor::element(other, j)];
                (value != 0.0).then(|| (value > 0.0, product(&factors.each_ref())))
            });
            let terms: Vec<_> = terms.collect();
            if terms.is_empty() {
                continue;
            }
            let entry = lines.bind(&format!("c{i}_{k}"), sum(terms));
            lines.add("sums", k, product(&[&entry, &Factor::element("a", i)]));
            if i != k {
                lines.add("sums", i, product(&[&entry, &Factor::element("a", k)]));
            }
        }
    }
    lines.give("sums")
}
