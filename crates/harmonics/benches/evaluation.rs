//! Evaluation at one direction in every form, and in batches; see results/sh-speed.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use manylights_harmonics::batch::{gradients_length, values_length};
use manylights_harmonics::thesis::{Polynomials, SphericalGradients, to_cartesian};
use manylights_harmonics::{Basis, Vectors, count};

fn single(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("values and gradient at one direction");
    let direction = black_box([0.36_f32, 0.48, 0.8]);
    for bands in [3, 4, 5, 6, 8, 10] {
        let slice = || vec![0.0_f32; count(bands)];
        let (mut y, mut a, mut b) = (slice(), slice(), slice());
        let (mut gx, mut gy, mut gz) = (slice(), slice(), slice());
        let basis = Basis::new(bands);
        group.bench_function(BenchmarkId::new("pole-free", bands), |bencher| {
            bencher.iter(|| {
                basis.evaluate_with_gradient(direction, &mut y, [&mut gx, &mut gy, &mut gz]);
                black_box(&y);
            });
        });
        let polynomials = Polynomials::new(bands);
        group.bench_function(BenchmarkId::new("polynomial", bands), |bencher| {
            bencher.iter(|| {
                polynomials.evaluate(direction, &mut y);
                polynomials.gradient(direction, [&mut gx, &mut gy, &mut gz]);
                black_box(&y);
            });
        });
        let spherical = SphericalGradients::new(bands);
        let forms = [
            ("Sloan's-like", SphericalGradients::sloans_like as fn(&_, _, &mut _, &mut _, &mut _)),
            ("Direct", SphericalGradients::direct),
        ];
        for (name, form) in forms {
            group.bench_function(BenchmarkId::new(name, bands), |bencher| {
                bencher.iter(|| {
                    form(&spherical, direction, &mut y[..], &mut a[..], &mut b[..]);
                    to_cartesian(direction, &a, &b, [&mut gx, &mut gy, &mut gz]);
                    black_box(&y);
                });
            });
        }
    }
}

fn batch<R: Vectors>(criterion: &mut Criterion) {
    let name = format!("batch f{}", 8 * size_of::<R>());
    let mut group = criterion.benchmark_group(name);
    for l_max in [2, 4, 6, 9, 14, 19] {
        let basis = Basis::<R>::new(l_max + 1);
        for directions in [1_000, 100_000] {
            let x = vec![R::of(0.36); directions];
            let y = vec![R::of(0.48); directions];
            let z = vec![R::of(0.8); directions];
            group.throughput(Throughput::Elements(directions as u64));
            let mut values = vec![R::zero(); values_length::<R>(l_max + 1, directions)];
            group.bench_function(format!("values/{l_max}/{directions}"), |bencher| {
                bencher.iter(|| basis.evaluate_batch([&x, &y, &z], black_box(&mut values)));
            });
            let mut output = vec![R::zero(); gradients_length::<R>(l_max + 1, directions)];
            group.bench_function(format!("gradients/{l_max}/{directions}"), |bencher| {
                bencher.iter(|| {
                    basis.evaluate_batch_with_gradients([&x, &y, &z], black_box(&mut output));
                });
            });
        }
    }
}

criterion_group!(evaluation, single, batch::<f32>, batch::<f64>);
criterion_main!(evaluation);
