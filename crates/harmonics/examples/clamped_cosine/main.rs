//! Time and error of each variant of thesis table 4.1, the product of a light with the clamped cosine.
//! `scripts/speed-harmonics` writes it to results/sh-speed/clamped-cosine.md.

#[path = "../timing/mod.rs"]
mod timing;
mod variants;

use std::hint::black_box;

use manylights_harmonics::{Basis, count, quadrature};
use variants::{Case, Variants, cases};

/// The bands of the thesis' table, and its milliseconds (of whole images).
const BANDS: [usize; 4] = [3, 5, 7, 9];
const THESIS: [[f64; 4]; 5] = [
    [1.65, 6.92, 183.54, 836.34],
    [1.65, 6.42, 128.22, 590.13],
    [1.63, 3.78, 41.54, 289.88],
    [1.59, 2.19, 5.08, 15.78],
    [1.46, 1.78, 2.92, 6.09],
];
const NAMES: [&str; 5] = ["2.47", "4.5", "4.5, cosine in 3 bands", "4.6 with rotation", "4.6"];

fn main() {
    let measured = BANDS.map(measure);
    println!("# The product with the clamped cosine, thesis table 4.1\n");
    println!(
        "A light (a cap of half-angle 0.3 in as many bands) times max(0, n·ω), f32, one thread. In: \
         its coefficients and the normal n; in the frame of the surface for 4.6 without rotation. \
         Turning the cosine to the normal and the light to the frame is part of the time.\n"
    );
    println!("## Nanoseconds a product\n");
    println!(
        "Medians of interleaved rounds over 100 normals; in brackets the thesis' milliseconds \
         of an image on its GPU (table 4.2). Our 2.47 takes each pair i, j of its symmetric table \
         once, which 4.5 cannot with its folded cosine: hence no gain over 2.47.\n"
    );
    table(|variant, i| format!("{:.0} ({})", measured[i].0[variant], THESIS[variant][i]));
    println!("\n## Error\n");
    println!(
        "Root mean square over coefficients, lights and normals of the difference to the product \
         of the light's expansion with the cosine itself by quadrature (f64), relative to the root \
         mean square of that product. By Parseval this is the error over the sphere.\n"
    );
    table(|variant, i| format!("{:.1e}", measured[i].1[variant]));
}

fn table(cell: impl Fn(usize, usize) -> String) {
    println!("| equation | {} bands |", BANDS.map(|bands| bands.to_string()).join(" | "));
    println!("|---|{}", "---|".repeat(BANDS.len()));
    for (variant, name) in NAMES.iter().enumerate() {
        let cells = [0, 1, 2, 3].map(|i| cell(variant, i));
        println!("| {name} | {} |", cells.join(" | "));
    }
}

/// Median nanoseconds and relative error of every variant.
fn measure(bands: usize) -> ([f64; 5], [f64; 5]) {
    let cases = cases(bands);
    (times(bands, &cases), errors(bands, &cases))
}

fn times(bands: usize, cases: &[Case]) -> [f64; 5] {
    let [mut a, mut b, mut c, mut d, mut e] = [(); 5].map(|()| Variants::new(bands));
    let keep = |product: &[f32]| {
        black_box(product);
    };
    timing::medians(
        cases,
        [
            &mut |case| keep(a.run(0, case)),
            &mut |case| keep(b.run(1, case)),
            &mut |case| keep(c.run(2, case)),
            &mut |case| keep(d.run(3, case)),
            &mut |case| keep(e.run(4, case)),
        ],
    )
}

fn errors(bands: usize, cases: &[Case]) -> [f64; 5] {
    let mut variants = Variants::new(bands);
    let mut squares = [0.0; 5];
    let mut total = 0.0;
    for case in cases {
        let [world, local] = truth(bands, case);
        total += world.iter().map(|t| t * t).sum::<f64>();
        for (variant, sum) in squares.iter_mut().enumerate() {
            let truth = if variant < 3 { &world } else { &local };
            let product = variants.run(variant, case);
            let errors = product.iter().zip(truth).map(|(&p, t)| (f64::from(p) - t).powi(2));
            *sum += errors.sum::<f64>();
        }
    }
    squares.map(|sum| (sum / total).sqrt())
}

/// The product by quadrature over the half sphere, in the frame of the world and in that of the surface.
fn truth(bands: usize, case: &Case) -> [Vec<f64>; 2] {
    let basis = Basis::<f64>::new(bands);
    let [mut world, mut local] = [(); 2].map(|()| vec![0.0; count(bands)]);
    let mut values = world.clone();
    // Degree 2 (bands − 1) + 1.
    for (direction, weight) in quadrature::sphere_nodes(bands + 1, [0.0, 1.0]) {
        basis.evaluate(direction, &mut values);
        let light: f64 = values.iter().zip(&case.local).map(|(y, &f)| y * f64::from(f)).sum();
        let weighted = weight * direction[2] * light;
        local.iter_mut().zip(&values).for_each(|(sum, y)| *sum += weighted * y);
        basis.evaluate(case.to_world(direction), &mut values);
        world.iter_mut().zip(&values).for_each(|(sum, y)| *sum += weighted * y);
    }
    [world, local]
}
