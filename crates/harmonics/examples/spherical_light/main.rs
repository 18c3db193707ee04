//! Operations and time of a spherical light's coefficients with their gradients, the stable form
//! against the thesis' analytical one. `scripts/speed-harmonics` writes it to
//! results/sh-speed/spherical-light.md.

#[path = "../operations/counted.rs"]
mod counted;
mod forms;
#[path = "../timing/mod.rs"]
mod timing;

use std::hint::black_box;

use counted::{Counted, Operations, count};
use forms::Light;
use manylights_harmonics::thesis::SphericalGradients;

fn main() {
    println!("# Spherical light: coefficients and gradients of one light at one point\n");
    println!(
        "Position and radius in, bands² coefficients and their 3 bands² derivatives out. The \
         thesis' form is 3.10 and 3.30–3.32 with *Direct* or *Sloan's-like* gradients of the basis \
         and their conversion 3.15. Operations: additions/multiplications of the crate's code on a \
         counting scalar (subtractions are additions, negations free). Time: ns per light, f32, \
         one thread, medians of interleaved rounds over 1 000 lights. The difference is the largest \
         between coefficients or gradients of the forms in f64, relative to the largest.\n"
    );
    println!(
        "| bands | stable: operations | Sloan's-like | Direct | stable: ns | Sloan's-like | Direct \
         | Sloan's-like/stable | Direct/stable | difference |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for bands in 5..=9 {
        let [stable, like, direct] = operations(bands);
        let [a, b, c] = times(bands);
        println!(
            "| {bands} | {stable} | {like} | {direct} | {a:.0} | {b:.0} | {c:.0} | {:.2} | {:.2} \
             | {:.0e} |",
            b / a,
            c / a,
            difference(bands)
        );
    }
}

fn operations(bands: usize) -> [Operations; 3] {
    let mut light = Light::new(bands);
    let (offset, radius) = ([0.72, 0.96, 1.6].map(Counted), Counted(1.0));
    [
        count(|| light.stable(offset, radius)),
        count(|| light.thesis(SphericalGradients::sloans_like, offset, radius)),
        count(|| light.thesis(SphericalGradients::direct, offset, radius)),
    ]
}

/// Lights all around, r/d from 0.05 to 0.95.
fn lights() -> Vec<([f32; 3], f32)> {
    (0..1_000)
        .map(|i| {
            let (z, angle) = (0.999 - 0.001_998 * i as f32, 2.4 * i as f32);
            let sine = (1.0 - z * z).sqrt();
            let offset = [sine * angle.cos(), sine * angle.sin(), z].map(|c| 3.0 * c);
            (offset, 3.0 * (0.05 + 0.9 * (i * 7 % 1_000) as f32 / 1_000.0))
        })
        .collect()
}

/// Median nanoseconds of the stable form, Sloan's-like, Direct.
fn times(bands: usize) -> [f64; 3] {
    let [mut a, mut b, mut c] = [(); 3].map(|()| Light::<f32>::new(bands));
    timing::medians(
        &lights(),
        [
            &mut |&(offset, radius)| {
                a.stable(black_box(offset), radius);
                black_box((&a.coefficients, &a.gradients));
            },
            &mut |&(offset, radius)| {
                b.thesis(SphericalGradients::sloans_like, black_box(offset), radius);
                black_box((&b.coefficients, &b.gradients));
            },
            &mut |&(offset, radius)| {
                c.thesis(SphericalGradients::direct, black_box(offset), radius);
                black_box((&c.coefficients, &c.gradients));
            },
        ],
    )
}

/// The largest relative difference of the three forms.
fn difference(bands: usize) -> f64 {
    let mut worst = 0.0_f64;
    let [mut stable, mut thesis] = [(); 2].map(|()| Light::<f64>::new(bands));
    for (offset, radius) in lights() {
        let (offset, radius) = (offset.map(f64::from), f64::from(radius));
        stable.stable(offset, radius);
        for form in [SphericalGradients::sloans_like, SphericalGradients::direct] {
            thesis.thesis(form, offset, radius);
            let ours = [&stable.coefficients].into_iter().chain(&stable.gradients);
            let theirs = [&thesis.coefficients].into_iter().chain(&thesis.gradients);
            for (ours, theirs) in ours.zip(theirs) {
                let largest = ours.iter().fold(0.0_f64, |most, value| value.abs().max(most));
                for (a, b) in ours.iter().zip(theirs) {
                    worst = worst.max((a - b).abs() / largest);
                }
            }
        }
    }
    worst
}
