//! Products of coefficient vectors.

use std::f64::consts::PI;

use super::constants::z_part;
use super::lines::{Factor, Lines, product, sum};
use crate::quadrature::gauss_legendre;
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

/// Thesis 4.6 by blocks of equal m; see [`clamped_cosine_entry`] for the zeros.
pub(super) fn clamped_cosine(bands: usize, even: bool) -> Lines {
    let nodes = gauss_legendre(bands + 1);
    let mut values = vec![String::new(); if even { even_count(bands) } else { count(bands) }];
    for m in 0..bands {
        for l in m..bands {
            let row: Vec<_> = (m..bands)
                .filter(|&other| couples(l, other))
                .map(|other| (other, clamped_cosine_entry(&nodes, [l, other], m)))
                .collect();
            let signed = m as isize;
            let orders = if m == 0 || even { vec![signed] } else { vec![signed, -signed] };
            for order in orders {
                let place = |l: usize| if even { even_index(l, m) } else { index(l, order) };
                values[place(l)] = sum(row.iter().map(|&(other, entry)| {
                    let term = Factor::element("a", place(other));
                    (entry >= 0.0, product(&[&Factor::Constant(entry.abs()), &term]))
                }));
            }
        }
    }
    Lines::default().give_array("f32", &values)
}

/// max(0, z) = (z + |z|)/2: z couples bands one apart, |z| those of equal parity.
fn couples(l: usize, other: usize) -> bool {
    let apart = l.abs_diff(other);
    apart == 1 || apart.is_multiple_of(2)
}

/// ∫ Y_lm Y_l'm max(0, z) dω, by a quadrature on 0 ≤ z ≤ 1 that is exact for it.
fn clamped_cosine_entry(nodes: &[(f64, f64)], bands: [usize; 2], m: usize) -> f64 {
    let around = if m == 0 { 2.0 * PI } else { PI };
    let integral: f64 = nodes
        .iter()
        .map(|&(node, weight)| {
            let z = 0.5 * (1.0 + node);
            let [one, two] = bands.map(|l| z_part(l, m, z));
            0.5 * weight * z * (1.0 - z * z).powi(m as i32) * one * two
        })
        .sum();
    around * integral
}
