//! Values and fused dot products of the basis; names as in [`crate::basis`].

use super::lines::{Factor, Lines, product, sum};
use crate::recurrence::{diagonal, step, three_term};
use crate::{count, even_count, even_index, index};

/// Up to here the three-term recurrence of Q_l^0 serves at the poles; it takes second differences
/// there, and in f32 loses 1e-5 of band 29.
const THREE_TERM_BANDS: usize = 10;

/// What is in scope: U_m, V_m and Q_l^m.
pub(super) struct Scope {
    bands: usize,
    pub(super) lines: Lines,
    even: bool,
    /// U_m at m, V_m where it is not 0.
    azimuth: Vec<[Factor; 2]>,
    /// Q_l^m at `even_index(l, m)`.
    z_parts: Vec<Factor>,
}

impl Scope {
    /// Names x, y, z; `even` leaves V_m out where no U_m needs it.
    pub(super) fn new(bands: usize, even: bool) -> Self {
        let mut lines = Lines::default();
        if bands > 1 {
            for axis in ["x", "y", "z"] {
                lines.bind(axis, format_args!("direction.{axis}"));
            }
        }
        if bands > 2 {
            lines.bind("z2", "z * z");
        }
        if bands > THREE_TERM_BANDS {
            lines.bind("s2", "x * x + y * y");
        }
        let azimuth = Vec::with_capacity(bands);
        let z_parts = vec![Factor::Constant(0.0); even_count(bands)];
        Self { bands, lines, even, azimuth, z_parts }
    }

    /// Names U_m, V_m and Q_l^m of the next m. In this order few names live at once.
    pub(super) fn next_order(&mut self) -> usize {
        let m = self.azimuth.len();
        self.name_azimuth(m);
        for l in m..self.bands {
            let factor = self.z_part(l, m);
            self.z_parts[even_index(l, m)] = factor;
        }
        m
    }

    fn name_azimuth(&mut self, m: usize) {
        let pair = match m {
            0 => [Factor::Constant(1.0), Factor::Constant(0.0)],
            1 => [Factor::named("x"), Factor::named("y")],
            _ => {
                let [u, v] = self.azimuth[m - 1].clone();
                let next = self.lines.bind(&format!("u{m}"), format_args!("x * {u} - y * {v}"));
                let unused = self.even && m + 1 == self.bands;
                let odd = if unused {
                    Factor::Constant(0.0)
                } else {
                    self.lines.bind(&format!("v{m}"), format_args!("x * {v} + y * {u}"))
                };
                [next, odd]
            }
        };
        self.azimuth.push(pair);
    }

    /// Polynomials in z² for l − m ≤ 3, where they take fewer operations than the recurrence.
    fn z_part(&mut self, l: usize, m: usize) -> Factor {
        let diagonal = diagonal(m);
        let step = |l: usize| three_term(l, m);
        let number = Factor::Constant;
        let name = format!("q{l}_{m}");
        let expression = match l - m {
            0 => return number(diagonal),
            1 => format!("{} * z", number(step(l)[0] * diagonal)),
            2 => {
                let [a, b] = step(l);
                let lead = a * step(l - 1)[0] * diagonal;
                format!("{} * z2 - {}", number(lead), number(b * diagonal))
            }
            3 => {
                let ([a, b], [a1, b1]) = (step(l), step(l - 1));
                let first = step(l - 2)[0] * diagonal;
                let rest = a * b1 * diagonal + b * first;
                format!("z * ({} * z2 - {})", number(a * a1 * first), number(rest))
            }
            _ if m == 0 && self.bands > THREE_TERM_BANDS => return self.zonal_part(l),
            _ => {
                let [a, b] = step(l);
                let (one, two) = (self.q(l - 1, m), self.q(l - 2, m));
                format!("{} * z * {one} - {} * {two}", number(a), number(b))
            }
        };
        self.lines.bind(&name, expression)
    }

    /// Q_l^0 from Q and D = dQ/dz of band l − 1 ≥ 3, as [`crate::Basis`] steps.
    fn zonal_part(&mut self, l: usize) -> Factor {
        let number = Factor::Constant;
        let before = l - 1;
        if before == 3 {
            let k = (7.0 / (4.0 * std::f64::consts::PI)).sqrt();
            self.lines.bind("d3", format_args!("{} * z2 - {}", number(7.5 * k), number(1.5 * k)));
        }
        // At m = 0 one factor serves both Q and D.
        let step = step::<f64>(l, 0);
        let (q, ratio) = (self.q(before, 0), number(step.d_from_d));
        let (fall, rise) = (number(step.q_from_d), number(step.d_from_q));
        if l + 1 < self.bands {
            let slope = format!("{ratio} * z * d{before} + {rise} * {q}");
            self.lines.bind(&format!("d{l}"), slope);
        }
        let value = format!("{ratio} * z * {q} - {fall} * s2 * d{before}");
        self.lines.bind(&format!("q{l}_0"), value)
    }

    fn q(&self, l: usize, m: usize) -> Factor {
        self.z_parts[even_index(l, m)].clone()
    }

    /// Y_lm or Y_l,−m as a product.
    pub(super) fn value(&self, l: usize, m: isize) -> Factor {
        let order = m.unsigned_abs();
        product(&[&self.q(l, order), &self.azimuth[order][usize::from(m < 0)]])
    }

    /// The orders that the expansion holds of band l, with the position of each.
    fn orders(&self, l: usize) -> Vec<(isize, usize)> {
        if self.even {
            return (0..=l).map(|m| (m as isize, even_index(l, m))).collect();
        }
        let l_signed = l as isize;
        (-l_signed..=l_signed).map(|m| (m, index(l, m))).collect()
    }
}

pub(super) fn evaluate(bands: usize, even: bool) -> Lines {
    let mut scope = Scope::new(bands, even);
    let mut values = vec![String::new(); if even { even_count(bands) } else { count(bands) }];
    for _ in 0..bands {
        scope.next_order();
    }
    for l in 0..bands {
        for (m, position) in scope.orders(l) {
            values[position] = scope.value(l, m).to_string();
        }
    }
    scope.lines.give_array("f32", &values)
}

/// Σ_m (U_m Σ_l c_l Q_l^m b_lm + V_m Σ_l c_l Q_l^m b_l,−m).
pub(super) fn zonal_dot(bands: usize, even: bool) -> Lines {
    let mut scope = Scope::new(bands, even);
    let mut total = None;
    for _ in 0..bands {
        let m = scope.next_order();
        let signed = m as isize;
        let weights: Vec<_> = (m..bands)
            .map(|l| {
                let weight = product(&[&scope.q(l, m), &Factor::element("scales", l)]);
                if even || m == 0 {
                    return weight;
                }
                // Two sums share it.
                scope.lines.bind(&format!("w{l}_{m}"), weight)
            })
            .collect();
        let column = |order: isize| {
            sum((m..bands).zip(&weights).map(|(l, weight)| {
                let position = if even { even_index(l, m) } else { index(l, order) };
                (true, product(&[weight, &Factor::element("b", position)]))
            }))
        };
        let [u, v] = scope.azimuth[m].clone();
        let cosines = scope.lines.bind(&format!("a{m}"), column(signed));
        let mut terms: Vec<_> = total.take().into_iter().collect();
        terms.push((true, product(&[&cosines, &u])));
        if m > 0 && !even {
            let sines = scope.lines.bind(&format!("b{m}"), column(-signed));
            terms.push((true, product(&[&sines, &v])));
        }
        total = Some((true, scope.lines.bind(&format!("sum{m}"), sum(terms))));
    }
    scope.lines.give(format_args!("sum{}", bands - 1))
}

/// Σ_m Y_lm b_lm of each l.
pub(super) fn bands(bands: usize, even: bool) -> Lines {
    let mut scope = Scope::new(bands, even);
    for _ in 0..bands {
        scope.next_order();
    }
    let sums: Vec<_> = (0..bands)
        .map(|l| {
            let term = |(m, position)| {
                (true, product(&[&scope.value(l, m), &Factor::element("b", position)]))
            };
            sum(scope.orders(l).into_iter().map(term))
        })
        .collect();
    scope.lines.give_array("vec3f", &sums)
}
