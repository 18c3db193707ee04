//! Lights in a grid, smoothed to what it can hold.

use glam::Vec3;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::{Grid, Loops, ProjectionSettings, Scheme, project};
use manylights_spherical_light::{Extent, Settings, SphereLight, linked_projection, oracle};

use crate::common::{GPU, SETTINGS, spiral};

const SPHERES: Settings = Settings { bands: 5, ..SETTINGS };
const DISCS: Settings = Settings { extent: Extent::Disc, ..SPHERES };

/// Of spacing 1/4.
fn grid() -> Grid<f32> {
    Grid::over([[-1.0; 3], [1.0; 3]], [9; 3])
}

fn sphere(center: Vec3) -> SphereLight {
    SphereLight::new(center, 0.05, Vec3::ONE)
}

/// Coefficients of one channel at a point.
fn at(point: [f32; 3], light: &SphereLight) -> Vec<f64> {
    let alone = Grid { origin: point, spacing: [1.0; 3], vertices: [1; 3] };
    oracle::coefficients(&alone, &[*light], &SPHERES).iter().map(|c| c[0][0]).collect()
}

/// Of what Hermite reads of a light that the grid holds so, beside the sphere itself, at points throughout.
fn error(held: &SphereLight, settings: &Settings, light: &SphereLight) -> f64 {
    let grid = grid();
    let stored = oracle::coefficients(&grid, &[*held], settings);
    let vertex = |index: usize| &stored[25 * index..][..25];
    let (mut wrong, mut all) = (0.0, 0.0);
    for i in 0..600 {
        let point = (spiral(i, 600, -1.0).as_vec3() * ((i % 19) as f32 + 0.5) / 19.0).to_array();
        let place = grid.place(point);
        let weights = Scheme::Hermite.weights(place.local.map(f64::from));
        let mut read = [0.0; 25];
        for (corner, weights) in grid.corners(place.cell).into_iter().zip(weights) {
            for (sum, parts) in read.iter_mut().zip(vertex(corner)) {
                *sum += (0..4).map(|k| weights[k] * parts[0][k]).sum::<f64>();
            }
        }
        for (read, truth) in read.into_iter().zip(at(point, light)) {
            wrong += (read - truth).powi(2);
            all += truth.powi(2);
        }
    }
    (wrong / all).sqrt()
}

/// Anywhere, and most of all next to a vertex, where a sphere's gradients have no bound; but for the very middle of a
/// cell, where all vertices are as far as can be: there smoothing is 6 % worse.
#[test]
fn hermite_is_nearer_to_a_light_in_the_grid_where_it_is_smoothed() {
    let next_to_a_vertex = Vec3::new(0.251, 0.002, -0.249);
    let centers = (0..4).map(|i| 0.7 * spiral(i, 4, -1.0).as_vec3());
    let errors = |center: Vec3| {
        let light = sphere(center);
        let raw = error(&light, &SPHERES, &light);
        let smoothed = error(&light.smoothed(&grid()), &DISCS, &light);
        println!("{center}: {raw:.3} of the sphere, {smoothed:.3} smoothed");
        (raw, smoothed)
    };
    for center in centers.chain([Vec3::new(0.1, 0.0, 0.0)]) {
        let (raw, smoothed) = errors(center);
        assert!(smoothed < raw, "{center}: {smoothed} for {raw}");
    }
    let (raw, smoothed) = errors(next_to_a_vertex);
    assert!(raw > 10.0 && smoothed < 1.0, "{smoothed} for {raw}");
    let (raw, smoothed) = errors(Vec3::splat(0.125));
    assert!(smoothed < 1.1 * raw, "{smoothed} for {raw}");
}

/// However near the light is to a vertex, on the adapter as in f64.
#[test]
fn gradients_by_a_cell_are_bounded() {
    let grid = grid();
    // Radius half a cell: 2 (2π P_l Y_lm + c_l |∇Y_lm|) at the most, of radiance one.
    let most = 15.0;
    for distance in [1e-6, 1e-4, 1e-2, 0.05, 0.1] {
        let light = sphere(Vec3::new(0.25, 0.6 * distance, -0.25 + 0.8 * distance));
        let smoothed = light.smoothed(&grid);
        let truth = oracle::coefficients(&grid, &[smoothed], &DISCS);
        let truth = truth.as_flattened();
        let largest =
            truth.as_flattened().iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(largest < most * f64::from(smoothed.radiance.x), "{distance}: {largest}");
        for loops in [Loops::Forward, Loops::Reverse] {
            let evaluation = Evaluation::Recurrence;
            let how = ProjectionSettings { gradients: true, loops, evaluation };
            let shader = linked_projection(&DISCS, how).expect("links");
            let (found, _) = project(&GPU, grid, &shader, &[smoothed]).expect("a projection");
            let found: Vec<[f32; 4]> = GPU.read(&found.buffer).expect("coefficients");
            let pairs = truth.as_flattened().iter().zip(found.as_flattened());
            let worst = pairs
                .fold(0.0_f64, |most, (truth, &found)| most.max((truth - f64::from(found)).abs()));
            println!("{distance}, {loops:?}: {:.1e} of {largest:.1e}", worst / largest);
            assert!(worst < 1e-5 * largest, "{distance}, {loops:?}: {worst:e} of {largest:e}");
        }
    }
}
