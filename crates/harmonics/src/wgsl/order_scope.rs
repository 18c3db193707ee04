//! What the functions of one order have in scope: U_m, V_m, and Q_l^m and its derivative.

use super::lines::{Factor, Lines, product, sum};
use crate::recurrence::{diagonal, step};
use crate::thesis::{binomial, zonal_part};

/// How the functions of an order come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evaluation {
    /// Band from band, by the pair of recurrences that [`crate::Basis`] has.
    Recurrence,
    /// Each as a polynomial in x, y, z, the "analytical" columns of thesis table 3.2, up to
    /// [`POLYNOMIAL_BANDS`](crate::thesis::POLYNOMIAL_BANDS) bands: Q_l^m and its derivative by Horner's scheme in
    /// z², times (x + iy)^m multiplied out.
    Polynomial,
}

/// Without products that vanish.
pub(super) fn nonzero(
    terms: impl IntoIterator<Item = (bool, Factor)>,
) -> impl Iterator<Item = (bool, Factor)> {
    terms.into_iter().filter(|(_, factor)| !matches!(factor, Factor::Constant(0.0)))
}

pub(super) struct Scope {
    bands: usize,
    order: usize,
    evaluation: Evaluation,
    pub(super) lines: Lines,
}

impl Scope {
    pub(super) fn new(bands: usize, order: usize, evaluation: Evaluation) -> Self {
        assert!(order < bands, "{bands} bands have no order {order}");
        let mut lines = Lines::default();
        for axis in ["x", "y", "z"] {
            lines.bind(axis, format_args!("direction.{axis}"));
        }
        match evaluation {
            Evaluation::Recurrence => lines.bind("s2", "x * x + y * y"),
            Evaluation::Polynomial => lines.bind("z2", "z * z"),
        };
        Self { bands, order, evaluation, lines }
    }

    /// U and V of m − 1 and of m; those of −1, which nothing needs, are 0.
    pub(super) fn powers(&mut self) -> [[Factor; 2]; 2] {
        match self.evaluation {
            Evaluation::Recurrence => self.stepped_powers(),
            Evaluation::Polynomial => self.expanded_powers(),
        }
    }

    fn stepped_powers(&mut self) -> [[Factor; 2]; 2] {
        let zero = || Factor::Constant(0.0);
        let (mut before, mut power) = ([zero(), zero()], [Factor::Constant(1.0), zero()]);
        for m in 1..=self.order {
            let next = if m == 1 {
                [Factor::named("x"), Factor::named("y")]
            } else {
                let [u, v] = &power;
                let even = self.lines.bind(&format!("u{m}"), format_args!("x * {u} - y * {v}"));
                [even, self.lines.bind(&format!("v{m}"), format_args!("x * {v} + y * {u}"))]
            };
            before = std::mem::replace(&mut power, next);
        }
        [before, power]
    }

    /// Re and Im (x + iy)^m by the binomial theorem.
    fn expanded_powers(&mut self) -> [[Factor; 2]; 2] {
        let mut monomials = [[Factor::Constant(1.0)], [Factor::Constant(1.0)]].map(Vec::from);
        for (axis, powers) in ["x", "y"].into_iter().zip(&mut monomials) {
            for k in 1..=self.order {
                powers.push(match k {
                    1 => Factor::named(axis),
                    _ => self.lines.bind(
                        &format!("{axis}_{k}"),
                        product(&[&powers[k - 1], &Factor::named(axis)]),
                    ),
                });
            }
        }
        let [of_x, of_y] = &monomials;
        let mut part = |m: usize, first: usize| {
            let term = |j: usize| {
                let factor = Factor::Constant(binomial(m, j));
                (j % 4 < 2, product(&[&factor, &of_x[m - j], &of_y[j]]))
            };
            let mut terms = (first..=m).step_by(2).map(term);
            match (m, terms.next()) {
                (_, None) => Factor::Constant(0.0),
                (0 | 1, Some((_, only))) => only,
                (_, Some(lead)) => {
                    let name = format!("{}{m}", if first == 0 { "u" } else { "v" });
                    self.lines.bind(&name, sum([lead].into_iter().chain(terms)))
                }
            }
        };
        let before = match self.order.checked_sub(1) {
            None => [Factor::Constant(0.0), Factor::Constant(0.0)],
            Some(m) => [part(m, 0), part(m, 1)],
        };
        [before, [part(self.order, 0), part(self.order, 1)]]
    }

    /// Q and D = dQ/dz of each l; D where `slopes` are asked for, or Q of the next band needs it.
    pub(super) fn each_band(&mut self, slopes: bool, write: impl FnMut(&mut Lines, [&Factor; 2])) {
        match self.evaluation {
            Evaluation::Recurrence => self.each_step(slopes, write),
            Evaluation::Polynomial => self.each_polynomial(slopes, write),
        }
    }

    fn each_step(&mut self, slopes: bool, mut write: impl FnMut(&mut Lines, [&Factor; 2])) {
        let z = Factor::named("z");
        let mut q = Factor::Constant(diagonal(self.order));
        let mut slope = Factor::Constant(0.0);
        write(&mut self.lines, [&q, &slope]);
        for l in self.order + 1..self.bands {
            let step = step::<f64>(l, self.order);
            let number = Factor::Constant;
            let kept = product(&[&number(step.q_from_q), &z, &q]);
            let turned = product(&[&number(step.q_from_d), &Factor::named("s2"), &slope]);
            let steep = product(&[&number(step.d_from_d), &z, &slope]);
            let raised = product(&[&number(step.d_from_q), &q]);
            let next =
                self.lines.bind(&format!("q{l}"), sum(nonzero([(true, kept), (false, turned)])));
            if slopes || l + 1 < self.bands {
                let terms = sum(nonzero([(true, steep), (true, raised)]));
                slope = self.lines.bind(&format!("d{l}"), terms);
            }
            q = next;
            write(&mut self.lines, [&q, &slope]);
        }
    }

    fn each_polynomial(&mut self, slopes: bool, mut write: impl FnMut(&mut Lines, [&Factor; 2])) {
        for l in self.order..self.bands {
            let coefficients = zonal_part(l, self.order);
            let q = self.horner(&format!("q{l}"), &coefficients);
            let mut slope = Factor::Constant(0.0);
            if slopes {
                let powers = (1..).zip(&coefficients[1..]);
                let derivative: Vec<_> = powers.map(|(k, c)| f64::from(k) * c).collect();
                slope = self.horner(&format!("d{l}"), &derivative);
            }
            write(&mut self.lines, [&q, &slope]);
        }
    }

    /// Σ_k c_k zᵏ of an even or odd polynomial.
    fn horner(&mut self, name: &str, coefficients: &[f64]) -> Factor {
        let Some(degree) = coefficients.len().checked_sub(1) else { return Factor::Constant(0.0) };
        let mut text = Factor::Constant(coefficients[degree]).to_string();
        for k in (0..degree).rev().skip(1).step_by(2) {
            text = format!("({} + z2 * {text})", Factor::Constant(coefficients[k]));
        }
        match degree {
            0 => Factor::Constant(coefficients[0]),
            _ if degree % 2 == 1 => self.lines.bind(name, format_args!("z * {text}")),
            _ => self.lines.bind(name, text),
        }
    }
}
