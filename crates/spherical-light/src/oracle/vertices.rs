//! Lights at the vertices of a grid.

use manylights_harmonics::zonal::{Sighting, cap_rate_stable, cap_stable, light_gradient};
use manylights_harmonics::{Basis, count};
use manylights_interpolation::Grid;

use crate::{Extent, Settings, SphereLight};

/// Values and their derivatives by a cell of all channels, of each coefficient of each vertex of a grid. A vertex
/// at the centre of a light, where there is no direction, sees nothing of it.
pub fn coefficients(
    grid: &Grid<f32>,
    lights: &[SphereLight],
    settings: &Settings,
) -> Vec<[[f64; 4]; 3]> {
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
            };
            let Some(mut seen) = seen else { continue };
            if settings.extent == Extent::Disc {
                // Within its radius the turn of a disc is bounded by that of the radius.
                seen.distance = seen.distance.max(radius);
            }
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
