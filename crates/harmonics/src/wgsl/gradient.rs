//! Values and tangential gradients, ∇Y = ∇R − l Y ω.
//!
//! The derivatives of R_lm are combinations of band l − 1 (spherical-harmonic addition rules):
//! ∂_z keeps m, ∂_x ± i∂_y move it by one. With g = (2l + 1)/(2l − 1),
//! α = √(g (l − m)(l − m − 1))/2, β = √(g (l + m)(l + m − 1))/2 and m > 0:
//! ∂_x R_l,±m = β R_l−1,±(m−1) − α R_l−1,±(m+1),
//! ∂_y R_l,±m = ∓β R_l−1,∓(m−1) ∓ α R_l−1,∓(m+1).

use std::f64::consts::SQRT_2;

use super::basis::Scope;
use super::lines::{Factor, Lines, product, sum};
use crate::recurrence::step;
use crate::{count, index};

/// Y_lm of one band, named.
struct Band {
    /// At l + m.
    values: Vec<Factor>,
}

impl Band {
    fn new(scope: &mut Scope, l: usize) -> Self {
        let signed = l as isize;
        let values = (-signed..=signed).map(|m| match scope.value(l, m) {
            constant @ Factor::Constant(_) => constant,
            Factor::Named(expression) => scope.lines.bind(&format!("y{}", label(l, m)), expression),
        });
        Self { values: values.collect() }
    }

    fn last(&self) -> isize {
        (self.values.len() / 2) as isize
    }

    fn value(&self, m: isize) -> &Factor {
        &self.values[(self.last() + m) as usize]
    }
}

fn label(l: usize, m: isize) -> String {
    let sign = if m < 0 { "n" } else { "" };
    format!("{l}_{sign}{}", m.unsigned_abs())
}

/// A signed product, absent where it is 0.
type Term = Option<(bool, Factor)>;

pub(super) fn evaluate_with_gradient(bands: usize) -> Lines {
    let mut scope = Scope::new(bands, false);
    for _ in 0..bands {
        scope.next_order();
    }
    let mut results = vec![String::new(); count(bands)];
    let mut before = Band::new(&mut scope, 0);
    results[0] = format!("vec4f(0.0, 0.0, 0.0, {})", before.value(0));
    for l in 1..bands {
        let band = Band::new(&mut scope, l);
        for m in 0..=l as isize {
            for (m, across) in across(&mut scope.lines, &before, l, m) {
                let rise = rise(&before, l, m);
                let [x, y] = across;
                results[index(l, m)] =
                    tangential(&mut scope.lines, &label(l, m), l, band.value(m), [x, y, rise]);
            }
        }
        before = band;
    }
    scope.lines.give_array("vec4f", &results)
}

/// ∂_z R_lm = c R_l−1,m: what D takes of Q in a step of the recurrence.
fn rise(before: &Band, l: usize, m: isize) -> Vec<Term> {
    if m.unsigned_abs() == l {
        return Vec::new();
    }
    let factor = Factor::Constant(step::<f64>(l, m.unsigned_abs()).d_from_q);
    vec![Some((true, product(&[&factor, before.value(m)])))]
}

/// ∂_x and ∂_y of R_lm and, for m > 0, of R_l,−m.
fn across(lines: &mut Lines, before: &Band, l: usize, m: isize) -> Vec<(isize, [Vec<Term>; 2])> {
    let (degree, order) = (l as f64, m as f64);
    let gain = 0.25 * (2.0 * degree + 1.0) / (2.0 * degree - 1.0);
    let alpha = (gain * (degree - order) * (degree - order - 1.0)).sqrt();
    let beta = (gain * (degree + order) * (degree + order - 1.0)).sqrt();
    let mut scaled = |name: &str, factor: f64, order: isize| -> Option<Factor> {
        if order.abs() > before.last() {
            return None;
        }
        let term = product(&[&Factor::Constant(factor), before.value(order)]);
        // Two derivatives share it.
        let Factor::Named(expression) = term else { return Some(term) };
        Some(lines.bind(&format!("{name}{}_{m}", if order < 0 { "n" } else { "" }), expression))
    };
    let (up, down) = (format!("up{l}"), format!("down{l}"));
    let signed = |positive: bool, factor: &Option<Factor>| -> Term {
        factor.clone().map(|factor| (positive, factor))
    };
    if m == 0 {
        let x = scaled(&up, SQRT_2 * alpha, 1);
        let y = scaled(&up, SQRT_2 * alpha, -1);
        return vec![(0, [vec![signed(false, &x)], vec![signed(false, &y)]])];
    }
    let up_cosine = scaled(&up, alpha, m + 1);
    let up_sine = scaled(&up, alpha, -m - 1);
    // R_l−1,0 lacks the √2 of the others, and there is no R_l−1,−0.
    let down_cosine = scaled(&down, if m == 1 { SQRT_2 * beta } else { beta }, m - 1);
    let down_sine = if m == 1 { None } else { scaled(&down, beta, 1 - m) };
    let cosine = [
        vec![signed(true, &down_cosine), signed(false, &up_cosine)],
        vec![signed(false, &down_sine), signed(false, &up_sine)],
    ];
    let sine = [
        vec![signed(true, &down_sine), signed(false, &up_sine)],
        vec![signed(true, &down_cosine), signed(true, &up_cosine)],
    ];
    vec![(m, cosine), (-m, sine)]
}

fn tangential(
    lines: &mut Lines,
    label: &str,
    l: usize,
    value: &Factor,
    slopes: [Vec<Term>; 3],
) -> String {
    let radial = product(&[&Factor::Constant(l as f64), value]);
    let radial = lines.bind(&format!("r{label}"), radial);
    let axes = ["x", "y", "z"].into_iter().zip(slopes).map(|(axis, mut slope)| {
        slope.push(Some((false, product(&[&radial, &Factor::named(axis)]))));
        sum(slope.into_iter().flatten())
    });
    format!("vec4f({}, {value})", axes.collect::<Vec<_>>().join(", "))
}
