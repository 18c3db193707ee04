//! WGSL of the mirror-plane form of polygons ([`crate::polygon::MirrorPlane`]): what lobes even in y see of
//! them, by integrals over their edges.
//!
//! An edge is described from the middle of its arc, in which nothing cancels for short ones (as printed the
//! integrals come from differences of both ends): with u the unit vector to the middle, p the unit tangent
//! there and μ = u × p turned so that p = μ × u, a direction d has α = d·u, β = d·p, c = d·μ, and for an arc
//! of the angle γ, s = sin γ/2, k = cos γ/2
//! - at the ends z = kα ± sβ;
//! - E_l = −[z' P_l(z)] of both ends, with F_l the same sum instead of the difference, times sβ:
//!   E_0 = 2sα, F_0 = −2ksβ², and, since Bonnet's recurrence holds at each end,
//!   E_{l+1} ∝ kα E_l + F_l, F_{l+1} ∝ kα F_l + (sβ)² E_l;
//! - B_l = (2l − 1)/l² (E_{l−1} − c² D_{l−1}) + ((l − 1)/l)² B_{l−2}, D_l = (2l − 1) B_{l−1} + D_{l−2}.
//!
//! E and F are those of polynomials with leading coefficient 1, B over Π((l − 1)/l)²: one multiplication less
//! each. Everything holds a factor c.

use super::Generated;
use super::lines::{Factor, Lines, sum};
use crate::polygon::{MirrorPlane, boundary, carry};
use crate::{even_count, even_index};

/// Lengths of the arrays of weights for so many bands: of a zonal lobe and of an even one.
pub fn weight_counts(bands: usize) -> (usize, usize) {
    ((bands - 1).max(1), (bands * (bands - 1)).max(1))
}

/// `polygon_weights(lobe: array<f32, H>) -> array<f32, n (n − 1)>` of a lobe's coefficients of m ≥ 0, for
/// [`edge`]; the solid angle's weight is that of coefficient 0 alone, Y_00. One 0 for one band.
pub fn weights(bands: usize) -> Generated {
    let plane = MirrorPlane::<f64>::new(bands);
    let mut lines = Lines::default();
    for l in (1..bands).rev() {
        for k in 0..=bands / 2 {
            let row = plane.row(l, k);
            let halves = [0, 1].map(|parity| {
                let orders = (parity..=l).step_by(2).filter(|&m| row[m].abs() > 1e-12);
                let terms: Vec<_> = orders
                    .map(|m| {
                        let factor = row[m] * edge_scale(l);
                        let lobe = format!("lobe[{}]", even_index(l, m));
                        (factor > 0.0, term(factor.abs(), &lobe))
                    })
                    .collect();
                let name = format!("h{parity}_{l}_{k}");
                (!terms.is_empty()).then(|| lines.bind(&name, sum(terms)))
            });
            // The mirror image of direction k is the opposite of direction n − k.
            let opposite = if l % 2 == 0 { [true, false] } else { [false, true] };
            let both = [(k, [true, true]), (bands - k, opposite)];
            let distinct = if k == 0 || 2 * k == bands { &both[..1] } else { &both };
            for &(k, signs) in distinct {
                let parts = signs.into_iter().zip(&halves);
                let parts = parts.filter_map(|(sign, half)| Some((sign, half.clone()?)));
                let carried = carried(l, bands, &format!("v{}_{k}", l + 2));
                lines.bind(&format!("v{l}_{k}"), sum(parts.chain(carried)));
            }
        }
    }
    let names = (0..bands).flat_map(|k| (1..bands).map(move |l| format!("v{l}_{k}")));
    give(lines, names.collect()).function(&format!(
        "polygon_weights(lobe: array<f32, {}>) -> array<f32, {}>",
        even_count(bands),
        weight_counts(bands).1
    ))
}

/// `polygon_zonal_weights(lobe: array<f32, n>) -> array<f32, n − 1>` of Σ_l lobe_l P_l about the first
/// direction, z, for [`edge`]; the solid angle's weight is lobe_0. One 0 for one band.
pub fn zonal_weights(bands: usize) -> Generated {
    let mut lines = Lines::default();
    for l in (1..bands).rev() {
        let mut terms = vec![(true, term(edge_scale(l), &format!("lobe[{l}]")))];
        terms.extend(carried(l, bands, &format!("v{}", l + 2)));
        lines.bind(&format!("v{l}"), sum(terms));
    }
    give(lines, (1..bands).map(|l| format!("v{l}")).collect()).function(&format!(
        "polygon_zonal_weights(lobe: array<f32, {bands}>) -> array<f32, {}>",
        weight_counts(bands).0
    ))
}

/// `polygon_edge(middle: vec3f, along: vec3f, normal: vec3f, angle: f32, half: vec2f, diffuse: array<f32, n − 1>,
/// a: array<f32, n (n − 1)>, …) -> vec_f`: what an arc adds for a zonal lobe about z and so many even ones, in
/// that order, the weights of all given. `half` has sine and cosine of half its angle; of the vectors x and z
/// count.
///
/// # Panics
/// For other than one to three even lobes.
pub fn edge(bands: usize, lobes: usize) -> Generated {
    assert!((1..=3).contains(&lobes), "{lobes} lobes");
    let names = &["a", "b", "c"][..lobes];
    let directions = MirrorPlane::<f64>::new(bands).directions().to_vec();
    let (last, most) = weight_counts(bands);
    let mut lines = Lines::default();
    lines.bind("sk", "half.x * half.y");
    lines.bind("ss", "half.x * half.x");
    let mut sums = vec![Vec::new(); lobes];
    let mut of_diffuse = String::new();
    for (k, &direction) in directions.iter().enumerate() {
        let integrals = integrals(&mut lines, k, direction, [bands.saturating_sub(2); 2]);
        let weighted = |array: &str, first: usize| {
            let products = integrals.iter().enumerate();
            let products = products.map(|(l, b)| (true, format!("{array}[{}] * {b}", first + l)));
            sum(products.map(|(sign, product)| (sign, Factor::named(product))))
        };
        if k == 0 {
            of_diffuse = weighted("diffuse", 0);
        }
        for (name, sums) in names.iter().zip(&mut sums) {
            let value = lines.bind(&format!("{name}{k}"), weighted(name, k * last));
            sums.push((true, value));
        }
    }
    let values = [of_diffuse].into_iter().chain(sums.into_iter().map(sum));
    let values: Vec<_> = values.collect();
    let arrays: String = names.iter().map(|n| format!(", {n}: array<f32, {most}>")).collect();
    lines.give(format_args!("vec{}f({})", lobes + 1, values.join(", "))).function(&format!(
        "polygon_edge({ARC}, diffuse: array<f32, {last}>{arrays}) -> vec{}f",
        lobes + 1
    ))
}

/// `polygon_edge(middle: vec3f, along: vec3f, normal: vec3f, angle: f32, half: vec2f) -> f32`: the same for the
/// zonal lobe Σ_l lobe_l P_l about z alone, whose weights are constants.
pub fn zonal_edge(lobe: &[f64]) -> Generated {
    let mut weights: Vec<_> = lobe.to_vec();
    crate::polygon::transpose(&mut weights);
    let last = |parity: usize| {
        weights
            .iter()
            .enumerate()
            .filter(|(l, w)| l % 2 == parity && **w != 0.0)
            .map(|(l, _)| l)
            .max()
    };
    let mut lines = Lines::default();
    lines.bind("sk", "half.x * half.y");
    lines.bind("ss", "half.x * half.x");
    let needed = [0, 1].map(|parity| last(parity).unwrap_or(0));
    let integrals = integrals(&mut lines, 0, [0.0, 1.0], needed);
    let products = integrals.iter().zip(&weights).enumerate().filter(|(_, (_, w))| **w != 0.0);
    let value = sum(products.map(|(l, (b, &weight))| {
        let weight = weight * reduction(l);
        (weight > 0.0, term(weight.abs(), b))
    }));
    lines.give(value).function(&format!("polygon_edge({ARC}) -> f32"))
}

const ARC: &str = "middle: vec3f, along: vec3f, normal: vec3f, angle: f32, half: vec2f";

/// Π ((i − 1)/i)², i = l, l − 2, …: what B_l is divided by.
fn reduction(l: usize) -> f64 {
    (2..=l).rev().step_by(2).map(|i| ((i - 1) as f64 / i as f64).powi(2)).product()
}

/// What turns a weight of S_l into one of B_{l−1} as the edges have it.
fn edge_scale(l: usize) -> f64 {
    boundary(l) * reduction(l - 1)
}

/// What the weight of band l has of that of band l + 2, named.
fn carried(l: usize, bands: usize, name: &str) -> Option<(bool, Factor)> {
    let factor = || carry(l) * edge_scale(l) / edge_scale(l + 2);
    (l + 2 < bands).then(|| (true, term(factor(), name)))
}

fn term(factor: f64, name: &str) -> Factor {
    super::lines::product(&[&Factor::Constant(factor), &Factor::named(name)])
}

/// An array of these, or of one 0.
fn give(lines: Lines, names: Vec<String>) -> Lines {
    lines.give_array("f32", &if names.is_empty() { vec!["0.0".to_owned()] } else { names })
}

/// Names the reduced c B_l about one direction, up to the last even and odd l that are asked for, and returns
/// the names, "0.0" for those that are not computed.
fn integrals(lines: &mut Lines, k: usize, [x, z]: [f64; 2], last: [usize; 2]) -> Vec<String> {
    let most = last[0].max(last[1]);
    let name = |what: &str, l: usize| format!("{what}{l}_{k}");
    let along = |vector: &str| {
        let parts = [(x, "x"), (z, "z")].into_iter().filter(|(part, _)| part.abs() > 1e-12);
        sum(parts.map(|(part, axis)| (part > 0.0, term(part.abs(), &format!("{vector}.{axis}")))))
    };
    let mut bind = |what: &str, l: usize, text: String| lines.bind(&name(what, l), text);
    bind("n", 0, along("normal"));
    bind("b", 0, format!("n0_{k} * angle"));
    let mut names = vec![name("b", 0)];
    if most == 0 {
        return names;
    }
    bind("m", 0, along("middle"));
    bind("b", 1, format!("2.0 * half.x * m0_{k} * n0_{k}"));
    names.push(name("b", 1));
    if most > 1 {
        bind("t", 0, along("along"));
        bind("t", 2, format!("t0_{k} * t0_{k}"));
        bind("n", 2, format!("n0_{k} * n0_{k}"));
        bind("z", 1, format!("half.y * m0_{k}"));
        bind("z", 2, format!("ss * t2_{k}"));
        bind("f", 0, format!("-2.0 * sk * t2_{k} * n0_{k}"));
        bind("e", 1, format!("z1_{k} * b1_{k} + f0_{k}"));
    }
    let mut lead = 1.0;
    for l in 2..=most {
        // The leading coefficient of P_{l−1}.
        lead *= (2 * l - 3) as f64 / (l - 1) as f64;
        if l > 2 {
            // Of Bonnet's recurrence.
            let pull = |j: usize, before: String| {
                let square = (j * j) as f64;
                term(square / (4.0 * square - 1.0), &before)
            };
            let e = |j: usize| if j == 0 { name("b", 1) } else { name("e", j) };
            let mut f = format!("z1_{k} * {} + z2_{k} * {}", name("f", l - 3), e(l - 3));
            if l > 3 {
                f += &format!(" - {}", pull(l - 3, name("f", l - 4)));
            }
            bind("f", l - 2, f);
            let e_pulled = pull(l - 2, e(l - 3));
            let text = format!("z1_{k} * {} + {} - {e_pulled}", e(l - 2), name("f", l - 2));
            bind("e", l - 1, text);
        }
        if l > last[l % 2] {
            names.push("0.0".to_owned());
            continue;
        }
        let scale = (2 * l - 1) as f64 / ((l * l) as f64 * reduction(l));
        // D_{l−1}.
        let mut d = term((2 * l - 3) as f64 * reduction(l - 2), &name("b", l - 2)).to_string();
        if l > 3 {
            d += &format!(" + {}", name("d", l - 3));
        }
        bind("d", l - 1, d);
        let (ends, inner) =
            (term(scale * lead, &name("e", l - 1)), term(scale, &format!("n2_{k}")));
        bind("b", l, format!("{ends} - {inner} * {} + {}", name("d", l - 1), name("b", l - 2)));
        names.push(name("b", l));
    }
    names
}
