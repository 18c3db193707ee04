//! Coefficients and gradients of one spherical light in every form; see results/sh-speed.

#[path = "../examples/spherical_light/forms.rs"]
mod forms;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use forms::{Angular, Light};
use manylights_harmonics::thesis::SphericalGradients;

fn spherical_light(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("spherical light with gradient");
    let (offset, radius) = black_box(([0.72_f32, 0.96, 1.6], 1.0));
    for bands in 5..=9 {
        let mut light = Light::new(bands);
        group.bench_function(BenchmarkId::new("stable", bands), |bencher| {
            bencher.iter(|| {
                light.stable(offset, radius);
                black_box((&light.coefficients, &light.gradients));
            });
        });
        let forms: [(&str, Angular<f32>); 2] = [
            ("thesis, Sloan's-like", SphericalGradients::sloans_like),
            ("thesis, Direct", SphericalGradients::direct),
        ];
        for (name, form) in forms {
            group.bench_function(BenchmarkId::new(name, bands), |bencher| {
                bencher.iter(|| {
                    light.thesis(form, offset, radius);
                    black_box((&light.coefficients, &light.gradients));
                });
            });
        }
    }
}

criterion_group!(lights, spherical_light);
criterion_main!(lights);
