//! Coefficients at the vertices of a grid against f64.

use glam::Vec3;
use manylights_harmonics::zonal::{Sighting, cap_rate_stable, cap_stable, light_gradient};
use manylights_harmonics::{Basis, count};
use manylights_interpolation::{Grid, Loops, project};
use manylights_spherical_light::{Extent, Settings, SphereLight, linked_projection};

use crate::common::{GPU, SETTINGS, spiral};

/// Off all axes, each spacing another.
fn grid() -> Grid<f32> {
    Grid::over([[-0.4, 0.1, -0.2], [0.5, 0.8, 1.3]], [3, 4, 5])
}

fn lights(count: u32) -> Vec<SphereLight> {
    let light = |i: u32| {
        let center = Vec3::new(0.05, 0.45, 0.5) + 2.5 * spiral(i, count, -1.0).as_vec3();
        let shade = (i % 7) as f32;
        SphereLight::new(center, 0.02 + 0.2 * shade, Vec3::new(1.0, 0.3 + shade, 2.0))
    };
    (0..count).map(light).collect()
}

/// Values of all channels and their derivatives by a cell, of each coefficient of each vertex.
fn truth(grid: Grid<f32>, lights: &[SphereLight], settings: &Settings) -> Vec<[[f64; 4]; 3]> {
    let bands = settings.bands;
    let basis = Basis::<f64>::new(bands);
    let at = |position: [f32; 3]| {
        let mut sums = vec![[[0.0; 4]; 3]; count(bands)];
        for light in lights {
            let center = light.center.to_array();
            let offset = [0, 1, 2].map(|i| f64::from(center[i]) - f64::from(position[i]));
            let radius = f64::from(light.radius);
            let seen = match settings.extent {
                Extent::Sphere => Sighting::of_sphere(offset, radius),
                Extent::Disc => Sighting::of_disk(offset, radius),
            }
            .expect("a distance");
            let (mut scales, mut rates) = (vec![0.0; bands], vec![0.0; bands]);
            cap_stable(seen.cap, &mut scales);
            cap_rate_stable(seen.cap, seen.cosine_rate, &mut rates);
            let mut values = vec![0.0; count(bands)];
            let mut axes = [0; 3].map(|_| values.clone());
            let slices = axes.each_mut().map(|axis| &mut axis[..]);
            basis.evaluate_with_gradient(seen.direction, &mut values, slices);
            let slices = axes.each_mut().map(|axis| &mut axis[..]);
            light_gradient(&seen, &scales, &rates, &values, slices);
            for (i, sum) in sums.iter_mut().enumerate() {
                let value = scales[i.isqrt()] * values[i];
                let by_cell = [0, 1, 2].map(|k| axes[k][i] * f64::from(grid.spacing[k]));
                for (channel, radiance) in light.radiance.to_array().into_iter().enumerate() {
                    let all = [value, by_cell[0], by_cell[1], by_cell[2]];
                    for (sum, value) in sum[channel].iter_mut().zip(all) {
                        *sum += f64::from(radiance) * value;
                    }
                }
            }
        }
        sums
    };
    grid.positions().flat_map(at).collect()
}

/// The largest error beside the largest value or derivative, of all with gradients and of values alone.
fn errors(settings: &Settings, lights: &[SphereLight], loops: Loops) -> [f64; 2] {
    let truth = truth(grid(), lights, settings);
    let largest = truth.as_flattened().as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    [true, false].map(|gradients| {
        let shader = linked_projection(settings, gradients, loops).expect("links");
        let (found, _) = project(&GPU, grid(), &shader, lights).expect("a projection");
        let found: Vec<[f32; 4]> = GPU.read(&found.buffer).expect("coefficients");
        let mut worst = 0.0_f64;
        for (i, truth) in truth.iter().enumerate() {
            for channel in 0..3 {
                for part in 0..if gradients { 4 } else { 1 } {
                    let found =
                        if gradients { found[3 * i + channel][part] } else { found[i][channel] };
                    worst = worst.max((f64::from(found) - truth[channel][part]).abs());
                }
            }
        }
        worst / largest
    })
}

/// More lights than a batch holds.
#[test]
fn both_loops_are_the_sums_of_f64() {
    let lights = lights(600);
    let few = [1, 2, 5].into_iter().flat_map(|bands| {
        let extents = [Extent::Sphere, Extent::Disc].into_iter();
        let both = |extent| [(bands, extent, Loops::Forward), (bands, extent, Loops::Reverse)];
        extents.flat_map(both)
    });
    // Of so many bands software adapters compile for many seconds.
    for (bands, extent, loops) in few.chain([(9, Extent::Sphere, Loops::Reverse)]) {
        let settings = Settings { bands, extent, ..SETTINGS };
        let [both, values] = errors(&settings, &lights, loops);
        println!("{bands} bands, {extent:?}, {loops:?}: {both:.1e}, {values:.1e}");
        assert!(both < 1e-5 && values < 1e-5, "{bands}, {extent:?}, {loops:?}");
    }
}
