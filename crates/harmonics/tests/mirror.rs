//! Polygons as lobes with a plane of symmetry see them: weights against the addition theorem, the generated
//! WGSL, run in f32, against sums of coefficients in f64.

use std::f64::consts::PI;

use crate::straight_line::{Numbers, run};
use manylights_harmonics::polygon::{
    MAX_BANDS, MirrorPlane, PolygonProjection, solid_angle, transpose,
};
use manylights_harmonics::projection::fibonacci;
use manylights_harmonics::wgsl::polygon::{edge, weights, zonal_edge, zonal_weights};
use manylights_harmonics::zonal::evaluate;
use manylights_harmonics::{Basis, Real, count, even_count, even_index, index};

/// Any numbers between −1 and 1.
fn any(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|i| ((i + 31 * seed + 1) as f64 * 0.754_877_666).fract() * 2.0 - 1.0).collect()
}

/// P_l.
fn legendre(l: usize, cosine: f64) -> f64 {
    let mut scales = vec![0.0; l + 1];
    scales[l] = 4.0 * PI / (2 * l + 1) as f64;
    evaluate(&scales, cosine)
}

/// Largest difference between lobes and the zonal functions that they are made of.
fn lost<R: Real>(bands: usize) -> f64 {
    let plane = MirrorPlane::<R>::new(bands);
    let basis = Basis::<f64>::new(bands);
    let lobe = any(even_count(bands), bands);
    let narrow: Vec<R> = lobe.iter().map(|&value| R::of(value)).collect();
    let weights = plane.weights(&narrow);
    let mut worst = 0.0_f64;
    for (direction, _) in fibonacci::<f64>(50, [-1.0, 1.0]) {
        let mut y = vec![0.0; count(bands)];
        basis.evaluate(direction, &mut y);
        let orders = (0..bands).flat_map(|l| (0..=l).map(move |m| (l, m)));
        let truth: f64 =
            orders.map(|(l, m)| lobe[even_index(l, m)] * y[index(l, m as isize)]).sum();
        let mut found = 0.0;
        for (k, [x, z]) in plane.directions().iter().map(|d| d.map(Real::to_f64)).enumerate() {
            let cosine = x * direction[0] + z * direction[2];
            let terms = weights[k * bands..][..bands].iter().enumerate();
            found += terms.map(|(l, w)| Real::to_f64(*w) * legendre(l, cosine)).sum::<f64>();
        }
        worst = worst.max((found - truth).abs());
    }
    let largest = weights.iter().map(|weight| Real::to_f64(*weight).abs()).fold(0.0, f64::max);
    println!(
        "{bands} bands: condition {:.2}, weights to {largest:.2}, lost {worst:.1e}",
        plane.condition()
    );
    worst
}

#[test]
fn lobes_are_zonal_functions_about_directions_of_the_plane() {
    for bands in 1..=MAX_BANDS {
        assert!(lost::<f64>(bands) < 1e-13);
        assert!(lost::<f32>(bands) < 1e-5);
        assert!(MirrorPlane::<f64>::new(bands).condition() < 2.1);
    }
}

/// An arc as the WGSL takes it, of corners in f64.
fn arc(from: [f64; 3], to: [f64; 3]) -> Vec<(&'static str, Numbers)> {
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let unit = |v: [f64; 3]| v.map(|c| c / dot(v, v).sqrt());
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let (start, end) = (unit(from), unit(to));
    let (normal, middle) = (unit(cross(from, to)), unit([0, 1, 2].map(|i| start[i] + end[i])));
    let along = cross(normal, middle);
    let half = dot(middle, end).acos();
    let mut arguments = Vec::new();
    for (names, vector) in [
        (["middle.x", "middle.z"], middle),
        (["along.x", "along.z"], along),
        (["normal.x", "normal.z"], normal),
    ] {
        arguments.push((names[0], vec![vector[0] as f32]));
        arguments.push((names[1], vec![vector[2] as f32]));
    }
    arguments.push(("angle", vec![2.0 * half as f32]));
    arguments.push(("half.x", vec![half.sin() as f32]));
    arguments.push(("half.y", vec![half.cos() as f32]));
    arguments
}

fn narrow(values: &[f64]) -> Numbers {
    values.iter().map(|&value| value as f32).collect()
}

fn corners() -> Vec<[[f64; 3]; 3]> {
    let triangle = |i: usize| {
        let corner = |j: usize| {
            let offset = any(3, 7 * i + j);
            [offset[0], 0.3 + offset[1], 1.2 + offset[2]]
        };
        [corner(0), corner(1), corner(2)]
    };
    (0..20).map(triangle).collect()
}

/// Of a triangle: coefficients, solid angle.
fn truth(bands: usize, corners: &[[f64; 3]; 3]) -> (Vec<f64>, f64) {
    let projection = PolygonProjection::<f64>::new(bands);
    let mut sums = projection.zero();
    projection.add(corners, 1.0, &mut sums);
    let mut values = vec![0.0; count(bands)];
    projection.coefficients(&sums, &mut values, &mut vec![[0.0; 3]; count(bands)]);
    (values, solid_angle(corners))
}

#[test]
fn the_generated_text_is_the_double_product() {
    for bands in [1, 2, 3, 4, 5, 8, 9, 12, MAX_BANDS] {
        let zonal = any(bands, 3);
        let lobes = [0, 1, 2].map(|seed| any(even_count(bands), seed));
        let of_lobe = weights(bands).wgsl;
        let weights = lobes.each_ref().map(|lobe| run(&of_lobe, &[("lobe", narrow(lobe))]));
        let diffuse = run(&zonal_weights(bands).wgsl, &[("lobe", narrow(&zonal))]);
        let (edge, alone) = (edge(bands, 3).wgsl, zonal_edge(&zonal).wgsl);
        let mut worst = 0.0_f64;
        for corners in corners() {
            let (coefficients, solid_angle) = truth(bands, &corners);
            let of_lobe = |lobe: &Vec<f64>| {
                let orders = (0..bands).flat_map(|l| (0..=l).map(move |m| (l, m)));
                orders
                    .map(|(l, m)| lobe[even_index(l, m)] * coefficients[index(l, m as isize)])
                    .sum::<f64>()
            };
            let of_zonal = |l: usize| {
                let scale = (4.0 * PI / (2 * l + 1) as f64).sqrt();
                zonal[l] * scale * coefficients[index(l, 0)]
            };
            let mut expected = vec![(0..bands).map(of_zonal).sum::<f64>()];
            expected.extend(lobes.iter().map(of_lobe));
            let harmonic = (0.25 / PI).sqrt();
            let first = [zonal[0]].into_iter().chain(lobes.iter().map(|lobe| harmonic * lobe[0]));
            let mut found: Vec<_> = first.map(|weight| weight * solid_angle).collect();
            let mut found_alone = found[0];
            for (i, from) in corners.iter().enumerate() {
                let mut arguments = arc(*from, corners[(i + 1) % 3]);
                found_alone += f64::from(run(&alone, &arguments)[0]);
                arguments.push(("diffuse", diffuse.clone()));
                for (name, weights) in ["a", "b", "c"].into_iter().zip(&weights) {
                    arguments.push((name, weights.clone()));
                }
                let added = run(&edge, &arguments);
                found.iter_mut().zip(added).for_each(|(sum, value)| *sum += f64::from(value));
            }
            found.push(found_alone);
            expected.push(expected[0]);
            for (found, expected) in found.iter().zip(&expected) {
                worst = worst.max((found - expected).abs());
            }
        }
        println!("{bands} bands: {worst:.1e}");
        assert!(worst < 1e-5, "{bands} bands: {worst:e}");
    }
}

/// Short arcs: every integral keeps its digits relative to the arc, which those from differences of both ends
/// lose.
#[test]
fn short_arcs_keep_their_digits() {
    const BANDS: usize = 9;
    // P_l alone, of which B_{l−1} is the highest.
    for l in 1..BANDS {
        let mut lobe = [0.0; BANDS];
        lobe[l] = 1.0;
        let text = zonal_edge(&lobe[..=l]).wgsl;
        let mut weights = lobe[..=l].to_vec();
        transpose(&mut weights);
        for seed in 0..20 {
            let at = any(6, seed);
            let from = [at[0], at[1], at[2] + 1.5];
            let to = [0, 1, 2].map(|i| from[i] + 1e-4 * at[3 + i]);
            let arguments = arc(from, to);
            let found = f64::from(run(&text, &arguments)[0]);
            let value = |name: &str| {
                f64::from(arguments.iter().find(|(n, _)| *n == name).expect("one").1[0])
            };
            let (m, t, c) = (value("middle.z"), value("along.z"), value("normal.z"));
            let angle = value("angle");
            // Gauss with 3 nodes: exact to 1e-24 for so short an arc.
            let truth: f64 =
                [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)]
                    .into_iter()
                    .map(|(node, share)| {
                        let (sine, cosine) = (0.5 * angle * node).sin_cos();
                        let z = m * cosine + t * sine;
                        let terms = weights.iter().enumerate().map(|(j, w)| w * legendre(j, z));
                        share * angle * c * terms.sum::<f64>()
                    })
                    .sum();
            let error = (found - truth).abs() / angle;
            assert!(error < 2e-6, "{l}: {error:e}");
        }
    }
}
