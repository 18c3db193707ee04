//! Lights at the vertices of a grid.

use glam::{DVec3, Vec3};
use manylights_harmonics::polygon::PolygonProjection;
use manylights_harmonics::zonal::TriangleSighting;
use manylights_harmonics::{Basis, count};
use manylights_interpolation::Grid;
use manylights_scene::AreaLight;

use crate::{Approximation, Settings};

/// Values and their derivatives by a cell of all channels, of each coefficient of each vertex of a grid.
pub fn coefficients(
    grid: &Grid<f32>,
    lights: &[AreaLight],
    settings: &Settings,
) -> Vec<[[f64; 4]; 3]> {
    let bands = settings.bands;
    let (projection, basis) = (PolygonProjection::new(bands), Basis::new(bands));
    let at = |position: [f32; 3]| {
        let position = Vec3::from(position).as_dvec3();
        let mut sums = vec![[[0.0; 4]; 3]; count(bands)];
        for light in lights {
            let seen = match settings.approximation {
                Approximation::Exact(_) => exact(&projection, light, position),
                Approximation::Sphere(form) => {
                    let AreaLight::Triangle { corners, two_sided, .. } = *light else { continue };
                    let seen = corners.map(|c| (c.as_dvec3() - position).to_array());
                    let axis = [0.0, 0.0, 1.0];
                    TriangleSighting::<f64>::new(seen, two_sided, axis).map(|sighting| {
                        let (mut values, mut scales) = (vec![0.0; count(bands)], vec![0.0; bands]);
                        let mut axes = [0; 3].map(|_| values.clone());
                        let slices = axes.each_mut().map(|axis| &mut axis[..]);
                        basis.evaluate_with_gradient(sighting.direction, &mut values, slices);
                        let [x, y, z] = axes;
                        let mut gradients: Vec<_> =
                            (0..count(bands)).map(|i| [x[i], y[i], z[i]]).collect();
                        sighting.coefficient_gradients(form, &values, &mut gradients);
                        sighting.scales(form, &mut scales);
                        let scaled = values.iter().enumerate();
                        let values = scaled.map(|(i, value)| scales[i.isqrt()] * value).collect();
                        (values, gradients)
                    })
                }
            };
            let Some((values, gradients)) = seen else { continue };
            for (i, sum) in sums.iter_mut().enumerate() {
                let by_cell = [0, 1, 2].map(|k| gradients[i][k] * f64::from(grid.spacing[k]));
                let all = [values[i], by_cell[0], by_cell[1], by_cell[2]];
                for (channel, radiance) in light.radiance().to_array().into_iter().enumerate() {
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

/// Values and gradients of a triangle of radiance one; `None` where it sends nothing.
fn exact(
    projection: &PolygonProjection<f64>,
    light: &AreaLight,
    position: DVec3,
) -> Option<(Vec<f64>, Vec<[f64; 3]>)> {
    let AreaLight::Triangle { corners, two_sided, .. } = *light else { return None };
    let seen = corners.map(|corner| corner.as_dvec3() - position);
    let [a, b, c] = seen;
    // Positive as seen from behind.
    let volume = a.dot((b - a).cross(c - a));
    if volume == 0.0 || (volume > 0.0 && !two_sided) {
        return None;
    }
    let mut sums = projection.zero();
    projection.add(&seen.map(|corner| corner.to_array()), volume.signum(), &mut sums);
    let size = count(projection.bands());
    let (mut values, mut gradients) = (vec![0.0; size], vec![[0.0; 3]; size]);
    projection.coefficients(&sums, &mut values, &mut gradients);
    Some((values, gradients))
}
