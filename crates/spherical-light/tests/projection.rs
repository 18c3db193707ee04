//! Coefficients at the vertices of a grid against f64.

use glam::Vec3;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::{Grid, Loops, ProjectionSettings, Projector, project};
use manylights_spherical_light::{Extent, Settings, SphereLight, linked_projection, oracle};

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

/// The largest error beside the largest value or derivative, of all with gradients and of values alone.
fn errors(
    settings: &Settings,
    lights: &[SphereLight],
    (loops, evaluation): (Loops, Evaluation),
) -> [f64; 2] {
    let truth = oracle::coefficients(&grid(), lights, settings);
    let largest = truth.as_flattened().as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    [true, false].map(|gradients| {
        let how = ProjectionSettings { gradients, loops, evaluation };
        let shader = linked_projection(settings, how).expect("links");
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
fn both_loops_and_evaluations_are_the_sums_of_f64() {
    let lights = lights(600);
    let hows = [
        (Loops::Forward, Evaluation::Recurrence),
        (Loops::Reverse, Evaluation::Recurrence),
        (Loops::Forward, Evaluation::Polynomial),
        (Loops::Reverse, Evaluation::Polynomial),
    ];
    let few = [1, 2, 5].into_iter().flat_map(|bands| {
        let extents = [Extent::Sphere, Extent::Disc].into_iter();
        extents.flat_map(move |extent| hows.map(|how| (bands, extent, how)))
    });
    // Of so many bands software adapters compile for many seconds.
    let many = [hows[1], hows[3]].map(|how| (9, Extent::Sphere, how));
    for (bands, extent, how) in few.chain(many) {
        let settings = Settings { bands, extent, ..SETTINGS };
        let [both, values] = errors(&settings, &lights, how);
        println!("{bands} bands, {extent:?}, {how:?}: {both:.1e}, {values:.1e}");
        assert!(both < 1e-5 && values < 1e-5, "{bands}, {extent:?}, {how:?}");
    }
}

/// Lights that move: other ones leave nothing behind, and the same ones give the same bits.
#[test]
fn a_kept_projector_replaces_what_it_held() {
    let settings = Settings { bands: 3, ..SETTINGS };
    let how = ProjectionSettings {
        gradients: true,
        loops: Loops::Reverse,
        evaluation: Evaluation::Recurrence,
    };
    let shader = linked_projection(&settings, how).expect("links");
    let projector = Projector::new(&GPU, grid(), &shader).expect("it fits");
    let bits = |lights: &[SphereLight]| {
        projector.project(lights).expect("a projection");
        GPU.read::<u32>(&projector.coefficients().buffer).expect("coefficients")
    };
    let (first, other, none) = (bits(&lights(600)), bits(&lights(5)), bits(&[]));
    assert!(none.iter().all(|&bits| bits == 0));
    assert!(first != other);
    assert!(first == bits(&lights(600)));
}

/// Vertices at the centre, inside, on the surface and in the plane of a light, and one larger than the grid.
#[test]
fn vertices_in_lights_see_what_is_finite() {
    let grid = Grid::over([[-1.0; 3], [1.0; 3]], [3; 3]);
    for extent in [Extent::Sphere, Extent::Disc] {
        let settings = Settings { bands: 5, extent, ..SETTINGS };
        for (radius, gradients) in [0.5, 1.0, 1e-6, 1e6].map(|r| [(r, true), (r, false)]).concat() {
            let lights = [SphereLight::new(Vec3::ZERO, radius, Vec3::ONE)];
            let (loops, evaluation) = (Loops::Reverse, Evaluation::Recurrence);
            let how = ProjectionSettings { gradients, loops, evaluation };
            let shader = linked_projection(&settings, how).expect("links");
            let (found, _) = project(&GPU, grid, &shader, &lights).expect("a projection");
            let found: Vec<[f32; 4]> = GPU.read(&found.buffer).expect("coefficients");
            // Of a hemisphere 2π Y_00.
            let most = if gradients { 1e8 } else { 2.0 };
            let fine = found.as_flattened().iter().all(|value| value.abs() <= most);
            assert!(fine, "{extent:?}, {radius}, {gradients}");
        }
    }
}
