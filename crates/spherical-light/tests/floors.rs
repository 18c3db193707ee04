//! What a number of bands leaves of a glossy surface: the error floors of the cosine-weighted lobe, against
//! those that other code found (600 directions of a light down to 20° below the horizon, F = 1).

use crate::common::{SETTINGS, by_quadrature, mirror_like, spiral, surface, view};
use glam::Vec3;
use manylights_spherical_light::{Settings, SphereLight, oracle};

const BANDS: [usize; 4] = [5, 7, 9, 15];
const HALF_ANGLES: [f64; 4] = [0.05, 0.15, 0.4, 0.8];

/// Roughness, degrees of the view, then for each number of bands the rms error over the rms truth at each
/// half-angle. That other code has 0.05 0.02 for 0.044 0.015, 0.05 0.04 0.02 for 0.045 0.031 0.014, and 0.05 0.03 for
/// 0.040 0.018: of the smallest light on the roughest surfaces, where the horizon alone errs. Five times the
/// directions and four times the nodes of the truth leave these digits as they are.
const FLOORS: [(f32, f64, [[f64; 4]; 4]); 7] = [
    (
        0.3,
        30.0,
        [
            [0.79, 0.72, 0.38, 0.18],
            [0.67, 0.56, 0.15, 0.10],
            [0.55, 0.41, 0.09, 0.07],
            [0.27, 0.12, 0.03, 0.02],
        ],
    ),
    (
        0.3,
        60.0,
        [
            [0.87, 0.78, 0.42, 0.21],
            [0.78, 0.64, 0.19, 0.13],
            [0.69, 0.50, 0.13, 0.10],
            [0.45, 0.18, 0.05, 0.03],
        ],
    ),
    (
        0.5,
        30.0,
        [
            [0.31, 0.28, 0.14, 0.05],
            [0.15, 0.13, 0.03, 0.02],
            [0.07, 0.06, 0.006, 0.006],
            [0.01, 0.003, 0.0, 0.0],
        ],
    ),
    (
        0.5,
        80.0,
        [
            [0.70, 0.61, 0.29, 0.12],
            [0.58, 0.46, 0.11, 0.06],
            [0.48, 0.33, 0.07, 0.04],
            [0.28, 0.11, 0.02, 0.01],
        ],
    ),
    (
        0.7,
        60.0,
        [
            [0.17, 0.15, 0.07, 0.02],
            [0.08, 0.07, 0.01, 0.006],
            [0.044, 0.03, 0.004, 0.002],
            [0.015, 0.006, 0.001, 0.0],
        ],
    ),
    (
        1.0,
        30.0,
        [
            [0.08, 0.06, 0.02, 0.007],
            [0.045, 0.03, 0.005, 0.002],
            [0.031, 0.02, 0.003, 0.001],
            [0.014, 0.006, 0.001, 0.0],
        ],
    ),
    (
        1.0,
        60.0,
        [
            [0.09, 0.08, 0.03, 0.009],
            [0.06, 0.04, 0.007, 0.003],
            [0.040, 0.03, 0.005, 0.002],
            [0.018, 0.007, 0.001, 0.0],
        ],
    ),
];

#[test]
fn floors_of_the_cosine_weighted_lobe() {
    let lowest = -20.0_f64.to_radians().sin();
    for (roughness, degrees, floors) in FLOORS {
        let (brdf, view) = (mirror_like(roughness), view(degrees));
        let receiver = surface(Vec3::ZERO, Vec3::Z, brdf);
        for (size, half_angle) in HALF_ANGLES.into_iter().enumerate() {
            let (mut errors, mut truths) = ([0.0; 4], 0.0);
            for i in 0..600 {
                let toward = spiral(i, 600, lowest);
                let truth = by_quadrature(brdf, view, toward, half_angle, 32).x;
                truths += truth * truth;
                let radius = half_angle.sin() as f32;
                let light = SphereLight::new(toward.as_vec3(), radius, Vec3::ONE);
                for (error, bands) in errors.iter_mut().zip(BANDS) {
                    let settings = Settings { bands, ..SETTINGS };
                    let value = oracle::radiance(&receiver, view, &[light], &settings).x;
                    *error += (value - truth).powi(2);
                }
            }
            let found = errors.map(|error: f64| (error / truths).sqrt());
            println!("{roughness}, {degrees}°, {half_angle}: {found:.3?}");
            for (number, (found, floor)) in
                found.iter().zip(floors.map(|row| row[size])).enumerate()
            {
                let bound = (0.1 * floor).max(0.005);
                let what = format!("{roughness}, {degrees}°, {half_angle}, {}", BANDS[number]);
                assert!((found - floor).abs() <= bound, "{what} bands: {found} for {floor}");
            }
        }
    }
}
