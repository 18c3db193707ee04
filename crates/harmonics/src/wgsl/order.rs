//! All functions of one order ±m: what a lane needs that sums the coefficients of one order alone (the
//! "reverse" loops of thesis 3.3.3). Together the orders are all of [`Function::Evaluate`] and
//! [`Function::EvaluateWithGradient`], by the pair of recurrences that [`crate::Basis`] has.
//!
//! [`Function::Evaluate`]: super::Function::Evaluate
//! [`Function::EvaluateWithGradient`]: super::Function::EvaluateWithGradient

use super::Generated;
use super::lines::{Factor, Lines, product, sum};
use crate::index;
use crate::recurrence::{diagonal, step};

/// Where the values of an order stand in an expansion, in the order in which its functions return them: l
/// from m on, of each the cosine's (m) before the sine's (−m).
pub fn indices(bands: usize, order: usize) -> Vec<usize> {
    let signed = order as isize;
    let signs = if order == 0 { &[0][..] } else { &[signed, -signed] };
    (order..bands).flat_map(|l| signs.iter().map(move |&m| index(l, m))).collect()
}

/// `sh_order_M(direction: vec3f) -> array<f32, K>`: Y_l,±m, K as [`indices`] has it.
///
/// # Panics
/// Where the expansion has no such order.
pub fn values(bands: usize, order: usize) -> Generated {
    let mut scope = Scope::new(bands, order);
    let [_, [u, v]] = scope.powers();
    let mut results = Vec::new();
    scope.each_band(false, |_, [q, _]| {
        results.push(product(&[q, &u]).to_string());
        if order > 0 {
            results.push(product(&[q, &v]).to_string());
        }
    });
    let length = results.len();
    let signature = format!("sh_order_{order}(direction: vec3f) -> array<f32, {length}>");
    scope.lines.give_array("f32", &results).function(&signature)
}

/// `sh_order_M_with_gradient(direction: vec3f) -> array<vec4f, K>`: in w the value, in xyz the tangential
/// gradient on the unit sphere, K as [`indices`] has it.
///
/// # Panics
/// Where the expansion has no such order.
pub fn with_gradient(bands: usize, order: usize) -> Generated {
    let mut scope = Scope::new(bands, order);
    let [[u0, v0], [u, v]] = scope.powers();
    let mut results = Vec::new();
    scope.each_band(true, |lines, [q, slope]| {
        let l = order + results.len() / if order == 0 { 1 } else { 2 };
        let number = Factor::Constant(order as f64);
        // m Q, E = −(m Q + z D), D + z E.
        let turn = product(&[&number, q]);
        let steep = product(&[&Factor::named("z"), slope]);
        let inward =
            lines.bind(&format!("e{l}"), sum(nonzero([(false, turn.clone()), (false, steep)])));
        let along = product(&[&Factor::named("z"), &inward]);
        let rise =
            lines.bind(&format!("f{l}"), sum(nonzero([(true, slope.clone()), (true, along)])));
        // U_{m−1}, V_{m−1} with their signs in ∂x and ∂y.
        let both = [(&u, "u", [(true, &u0), (false, &v0)]), (&v, "v", [(true, &v0), (true, &u0)])];
        for (power, name, lower) in both.into_iter().take(if order == 0 { 1 } else { 2 }) {
            let radial = lines.bind(&format!("r{name}{l}"), product(&[&inward, power]));
            let mut axes = Vec::new();
            for (axis, (sign, lower)) in ["x", "y"].into_iter().zip(lower) {
                let terms = [
                    (sign, product(&[&turn, lower])),
                    (true, product(&[&Factor::named(axis), &radial])),
                ];
                axes.push(sum(nonzero(terms)));
            }
            axes.push(product(&[&rise, power]).to_string());
            results.push(format!("vec4f({}, {})", axes.join(", "), product(&[q, power])));
        }
    });
    let length = results.len();
    let name = format!("sh_order_{order}_with_gradient");
    let signature = format!("{name}(direction: vec3f) -> array<vec4f, {length}>");
    scope.lines.give_array("vec4f", &results).function(&signature)
}

/// Without products that vanish.
fn nonzero(
    terms: impl IntoIterator<Item = (bool, Factor)>,
) -> impl Iterator<Item = (bool, Factor)> {
    terms.into_iter().filter(|(_, factor)| !matches!(factor, Factor::Constant(0.0)))
}

struct Scope {
    bands: usize,
    order: usize,
    lines: Lines,
}

impl Scope {
    fn new(bands: usize, order: usize) -> Self {
        assert!(order < bands, "{bands} bands have no order {order}");
        let mut lines = Lines::default();
        for axis in ["x", "y", "z"] {
            lines.bind(axis, format_args!("direction.{axis}"));
        }
        lines.bind("s2", "x * x + y * y");
        Self { bands, order, lines }
    }

    /// U and V of m − 1 and of m; those of −1, which nothing needs, are 0.
    fn powers(&mut self) -> [[Factor; 2]; 2] {
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

    /// Q and D = dQ/dz of each l, `last_slope` D of the last as well.
    fn each_band(&mut self, last_slope: bool, mut write: impl FnMut(&mut Lines, [&Factor; 2])) {
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
            if last_slope || l + 1 < self.bands {
                let terms = sum(nonzero([(true, steep), (true, raised)]));
                slope = self.lines.bind(&format!("d{l}"), terms);
            }
            q = next;
            write(&mut self.lines, [&q, &slope]);
        }
    }
}
