//! Products of coefficient vectors.

use super::lines::{Factor, Lines, product, sum};
use crate::clamped_cosine::Local;
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
    Lines::default().give_array("f32", &values)
}
