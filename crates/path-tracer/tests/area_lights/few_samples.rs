//! Estimates from few samples are wrong by chance alone, not on the average.

use manylights_paths::{Sampler, Tracer};

use super::*;

const SEEDS: u32 = 2000;

/// Mean over the seeds, summed over the pixels, with its variance; of the green channel.
fn mean_over_seeds(scene: &Scene, visibility: Visibility, samples: u32) -> (f64, f64) {
    let tracer = Tracer::new(scene, Transport::Direct { visibility });
    let camera = &scene.cameras[0];
    let (mut total, mut variance) = (0.0, 0.0);
    for pixel in 0..RESOLUTION[0] * RESOLUTION[1] {
        let [x, y] = [pixel % RESOLUTION[0], pixel / RESOLUTION[0]];
        let direction = camera.direction(x, y, RESOLUTION);
        let Some(hit) = tracer.closest(&Ray::new(camera.position, direction)) else { continue };
        let point = tracer.primary(hit, direction);
        let (mut sum, mut squares) = (0.0, 0.0);
        for seed in 0..SEEDS {
            let mut walk = tracer.walk(Sampler::new(seed.into(), pixel, 0));
            let estimate = walk.samples(&point, -direction, samples).y / samples as f32;
            sum += f64::from(estimate);
            squares += f64::from(estimate).powi(2);
        }
        let count = f64::from(SEEDS);
        total += sum / count;
        variance += (squares / count - (sum / count).powi(2)) / (count - 1.0);
    }
    (total, variance)
}

/// Directions drawn from rough metal are often lost below its horizon: those drawn from the light must
/// count with the same weight where the others come to nothing.
#[test]
fn few_samples_have_the_mean_of_many() {
    let light = sphere([0.2, 1.2, -0.3], 1.0);
    for roughness in [0.9, 0.7] {
        let scene = floor(Material::metal("floor", ALBEDO, roughness), &[light]);
        let expected: f64 = by_quadrature(&scene, &light).iter().map(|pixel| pixel.y).sum();
        for (visibility, samples) in VISIBILITIES.into_iter().flat_map(|v| [(v, 1), (v, 2)]) {
            let (mean, variance) = mean_over_seeds(&scene, visibility, samples);
            let deviation = variance.sqrt();
            let ratio = mean / expected - 1.0;
            let what = format!("roughness {roughness}, {visibility}, {samples} samples");
            println!("{what}: {ratio:+.5} ± {:.5}", deviation / expected);
            assert!(deviation < 1e-3 * expected, "{what}: {deviation} of {expected}");
            assert!((mean - expected).abs() < 4.0 * deviation, "{what}: {ratio} of it beside");
        }
    }
}
