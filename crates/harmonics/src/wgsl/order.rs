//! All functions of one order ±m: what a lane needs that sums the coefficients of one order alone (the
//! "reverse" loops of thesis 3.3.3). Together the orders are all of [`Function::Evaluate`] and
//! [`Function::EvaluateWithGradient`].
//!
//! [`Function::Evaluate`]: super::Function::Evaluate
//! [`Function::EvaluateWithGradient`]: super::Function::EvaluateWithGradient

use super::Generated;
use super::lines::{Factor, product, sum};
use super::order_scope::{Scope, nonzero};
use crate::index;

pub use super::order_scope::Evaluation;

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
/// Where the expansion has no such order, or too many bands for polynomials.
pub fn values(bands: usize, order: usize, evaluation: Evaluation) -> Generated {
    let mut scope = Scope::new(bands, order, evaluation);
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
/// Where the expansion has no such order, or too many bands for polynomials.
pub fn with_gradient(bands: usize, order: usize, evaluation: Evaluation) -> Generated {
    let mut scope = Scope::new(bands, order, evaluation);
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
