//! Coefficients at the vertices of a grid against f64.

use glam::Vec3;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::{Grid, Loops, ProjectionSettings};
use manylights_polygonal_light::{
    Approximation, Edges, Narrow, Settings, TriangleForm, oracle, project,
};
use manylights_scene::AreaLight;

use crate::common::GPU;

/// Off all axes, each spacing another.
fn grid() -> Grid<f32> {
    Grid::over([[-0.4, 0.1, -0.2], [0.5, 0.8, 1.3]], [3, 4, 5])
}

/// Of this size at this distance from the grid's middle, both sides and one; more than a batch holds.
fn lights(size: f32, distance: f32) -> Vec<AreaLight> {
    let light = |i: u32| {
        let turn = |k: f32| (1.7 * i as f32 + k).sin();
        let toward = Vec3::new(turn(0.3), turn(2.0), turn(4.4)).normalize();
        let corner = Vec3::new(0.05, 0.45, 0.5) + distance * toward;
        let along = Vec3::new(turn(1.0), turn(3.1), turn(5.2));
        let across = Vec3::new(turn(2.2), turn(0.7), turn(1.4));
        AreaLight::Triangle {
            corners: [corner, corner + size * along, corner + size * across],
            radiance: Vec3::new(1.0, 0.3 + (i % 7) as f32, 2.0),
            two_sided: i.is_multiple_of(2),
        }
    };
    (0..600).map(light).collect()
}

fn how(gradients: bool) -> ProjectionSettings {
    ProjectionSettings { gradients, loops: Loops::Reverse, evaluation: Evaluation::Recurrence }
}

/// The largest error beside the largest value or derivative, of all with gradients and of values alone.
fn errors(approximation: Approximation, bands: usize, lights: &[AreaLight]) -> [f64; 2] {
    let settings = Settings { bands, approximation, narrow: Narrow::Decline };
    let truth = oracle::coefficients(&grid(), lights, &settings);
    let largest = truth.as_flattened().as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    [true, false].map(|gradients| {
        let (found, _) =
            project(&GPU, grid(), &settings, how(gradients), lights).expect("a projection");
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

#[test]
fn lobes_are_the_sums_of_f64() {
    for bands in [1, 2, 5, 9] {
        for (size, distance) in [(1.0, 2.0), (0.3, 2.0), (0.1, 3.0), (1.0, 30.0)] {
            let [both, values] =
                errors(Approximation::Exact(Edges::Own), bands, &lights(size, distance));
            println!("{bands} bands, size {size} at {distance}: {both:.1e}, {values:.1e}");
            assert!(both < 1e-5 && values < 1e-5, "{bands} bands, size {size} at {distance}");
        }
    }
}

#[test]
fn spheres_in_the_stead_of_triangles_are_the_sums_of_f64() {
    for form in TriangleForm::ALL {
        let [both, values] = errors(Approximation::Sphere(form), 4, &lights(0.7, 3.0));
        println!("{form:?}: {both:.1e}, {values:.1e}");
        assert!(both < 1e-5 && values < 1e-5, "{form:?}");
    }
}

/// Vertices at corners, on edges, in planes, at centroids, and lights that are larger than the grid or hardly there.
#[test]
fn vertices_on_lights_see_what_is_finite() {
    let grid = Grid::over([[-1.0; 3], [1.0; 3]], [3; 3]);
    let (o, x, y) = (Vec3::ZERO, Vec3::X, Vec3::Y);
    let outlines = [
        [o, x, y],
        [x - y, -x - y, y],
        [-x - 0.5 * y, x - 0.5 * y, y],
        [50.0 * x, -50.0 * x, 90.0 * y],
        [o, 1e-10 * x, 1e-10 * y],
        [-1e10 * x, 1e10 * x, 1e10 * y],
        [o, x, 1e-7 * y],
    ];
    let forms = TriangleForm::ALL.map(Approximation::Sphere);
    for approximation in forms.into_iter().chain([Approximation::Exact(Edges::Own)]) {
        let settings = Settings { bands: 4, approximation, narrow: Narrow::Decline };
        for corners in outlines {
            for two_sided in [false, true] {
                let lights = [AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided }];
                for gradients in [false, true] {
                    let how = how(gradients);
                    let (found, _) =
                        project(&GPU, grid, &settings, how, &lights).expect("a projection");
                    let found: Vec<[f32; 4]> = GPU.read(&found.buffer).expect("coefficients");
                    let finite = found.as_flattened().iter().all(|value| value.is_finite());
                    assert!(finite, "{approximation:?}, {corners:?}, {two_sided}, {gradients}");
                }
            }
        }
    }
}
