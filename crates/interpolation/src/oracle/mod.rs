//! The same reading in f64 on the CPU.

mod packed;

pub use packed::unpacked;

use glam::DVec3;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::count;
use manylights_harmonics::rotation::Zxzxz;
use manylights_reflectance::{Damping, Form, Receiver};

use crate::{Grid, Settings};

/// Radiance from `surface` towards `camera` under the light that is interpolated there, from the same
/// coefficients as the adapter's, in W·m⁻²·sr⁻¹. Negative where the expansion is.
pub fn radiance(
    surface: &SurfaceRecord,
    camera: DVec3,
    settings: &Settings,
    coefficients: &[[f32; 4]],
) -> DVec3 {
    if surface.triangle == SurfaceRecord::NO_TRIANGLE {
        return DVec3::ZERO;
    }
    let position = surface.position.as_dvec3();
    let directions = [surface.normal.as_dvec3().normalize(), (camera - position).normalize()];
    let receiver =
        Receiver::new(surface.brdf(), directions, settings.bands, Form::Full, Damping::None);
    let turn = Zxzxz::new(settings.bands);
    let to_frame = receiver.frame.map(|axis| axis.to_array());
    let reflected = |mut light: Vec<f64>, channel: usize| {
        let mut scratch = light.clone();
        turn.apply(to_frame, &mut light, &mut scratch);
        receiver.product(&light)[channel]
    };
    let [red, green, blue] = light(position.to_array(), settings, coefficients);
    DVec3::new(reflected(red, 0), reflected(green, 1), reflected(blue, 2))
}

/// The coefficients of each channel at a point, in the frame of the world.
pub fn light(position: [f64; 3], settings: &Settings, coefficients: &[[f32; 4]]) -> [Vec<f64>; 3] {
    let grid = Grid {
        origin: settings.grid.origin.map(f64::from),
        spacing: settings.grid.spacing.map(f64::from),
        vertices: settings.grid.vertices,
    };
    let place = grid.place(position);
    let vectors = settings.vectors();
    let mut sums = [(); 3].map(|()| vec![0.0; count(settings.bands)]);
    let corners = grid.corners(place.cell);
    for (vertex, weights) in corners.into_iter().zip(settings.scheme.weights::<f64>(place.local)) {
        let vertex = &coefficients[vertex * vectors..][..vectors];
        for (channel, sums) in sums.iter_mut().enumerate() {
            for (i, sum) in sums.iter_mut().enumerate() {
                *sum += if settings.scheme.reads_gradients() {
                    let stored = vertex[3 * i + channel];
                    weights.into_iter().zip(stored).map(|(w, v)| w * f64::from(v)).sum::<f64>()
                } else {
                    weights[0] * f64::from(vertex[i][channel])
                };
            }
        }
    }
    sums
}
