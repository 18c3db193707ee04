//! Pictures from a grid against f64: projection, scheme and lobes.

use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_interpolation::{self as interpolation, Grid, Order, Reach, Scheme, Storage};
use manylights_metrics::RadianceImage;
use manylights_polygonal_light::{Edges, Settings, TriangleForm, oracle};
use manylights_reflectance::Materials;
use manylights_scene::{AreaLight, Scene};

use crate::common::{DIRECT, exact, render, scene, settings};

const RESOLUTION: [u32; 2] = [24, 18];

const SCHEMES: [(&str, Scheme); 2] =
    [("trilinear", Scheme::Trilinear), ("hermite", Scheme::Hermite)];

/// Of all that is seen, as many vertices as a cube with so many a side.
fn grid_of(surfaces: &[SurfaceRecord], vertices: usize) -> Grid<f32> {
    let seen = surfaces.iter().filter(|s| s.triangle != SurfaceRecord::NO_TRIANGLE);
    let positions: Vec<Vec3> = seen.map(|surface| surface.position).collect();
    let least = positions.iter().copied().reduce(Vec3::min).expect("something is seen");
    let most = positions.iter().copied().reduce(Vec3::max).expect("something is seen");
    Grid::of_cubes([least.to_array(), most.to_array()], vertices)
}

/// The largest error of a pixel over the largest radiance.
fn error(
    scene: &Scene,
    (image, surfaces): &(RadianceImage, Vec<SurfaceRecord>),
    vertices: usize,
    scheme: Scheme,
    settings: &Settings,
) -> f64 {
    let grid = grid_of(surfaces, vertices);
    let reach = Reach::new(&grid);
    let [near, far] = [true, false].map(|is_near| -> Vec<AreaLight> {
        let lights = scene.area_lights.iter().copied();
        lights.filter(|light| reach.meets(light) == is_near).collect()
    });
    let bands = settings.bands;
    let kinds = Materials::new(surfaces.iter().map(|surface| surface.brdf())).kinds();
    let read = interpolation::Settings {
        grid,
        scheme,
        bands,
        kinds,
        order: Order::Plain,
        storage: Storage::F32,
    };
    let all = oracle::coefficients(&grid, &far, settings);
    let stored: Vec<[f32; 4]> = match scheme.reads_gradients() {
        true => all.as_flattened().iter().map(|parts| parts.map(|value| value as f32)).collect(),
        false => {
            let values = all.iter().map(|channels| channels.map(|parts| parts[0] as f32));
            values.map(|[r, g, b]| [r, g, b, 0.0]).collect()
        }
    };
    let camera = scene.cameras[0].position.as_dvec3();
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (surface, pixel) in surfaces.iter().zip(&image.pixels) {
        let truth = interpolation::oracle::radiance(surface, camera, &read, &stored)
            + oracle::radiance(surface, camera, &near, settings);
        for (truth, &value) in truth.to_array().into_iter().zip(pixel) {
            worst = worst.max((truth.max(0.0) - f64::from(value)).abs());
            largest = largest.max(truth);
        }
    }
    worst / largest
}

/// Triangles around the scene, one of them in it.
fn lit() -> Scene {
    let mut scene = scene(20);
    for light in &mut scene.area_lights {
        let AreaLight::Triangle { corners, .. } = light else { unreachable!("triangles alone") };
        *corners = corners.map(|corner| 6.0 * corner);
    }
    let corners = [Vec3::new(0.3, 1.5, 0.2), Vec3::new(0.5, 1.5, 0.2), Vec3::new(0.3, 1.6, 0.5)];
    scene.area_lights.push(AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true });
    scene
}

#[test]
fn pictures_are_those_of_f64() {
    let scene = lit();
    let ways = [
        ("exact", exact(Edges::Shared)),
        ("main", settings(TriangleForm::Main)),
        ("scaled", settings(TriangleForm::Scaled)),
    ];
    for (approximation, settings) in ways {
        for (word, scheme) in SCHEMES {
            let texts = [
                ("bands", "4"),
                ("approximation", approximation),
                ("interpolation", word),
                ("grid", "4"),
            ];
            let picture = render(&scene, RESOLUTION, &texts, DIRECT).expect("a picture");
            let settings = Settings { bands: 4, ..settings };
            let error = error(&scene, &picture, 4, scheme, &settings);
            println!("{approximation}, {word}: {error:.1e}");
            assert!(error < 1e-5, "{approximation}, {word}: {error:e}");
        }
    }
}

/// Nearly the same pictures, and not from what f32 keeps.
#[test]
fn pictures_of_packed_coefficients_are_near() {
    let scene = lit();
    for (word, scheme) in SCHEMES {
        let texts = [("bands", "4"), ("interpolation", word), ("grid", "4"), ("storage", "packed")];
        let picture = render(&scene, RESOLUTION, &texts, DIRECT).expect("a picture");
        let settings = Settings { bands: 4, ..exact(Edges::Shared) };
        let error = error(&scene, &picture, 4, scheme, &settings);
        println!("{word}: {error:.1e}");
        assert!((1e-5..2e-3).contains(&error), "{word}: {error:e}");
    }
}

#[test]
fn what_a_grid_cannot_hold_is_declined() {
    for (name, word, mend) in
        [("narrow", "ltc", "narrow=decline"), ("near", "smoothed", "near=apart")]
    {
        let texts = [("interpolation", "trilinear"), (name, word)];
        let refused = render(&lit(), RESOLUTION, &texts, DIRECT).expect_err("declined");
        let said = refused.to_string();
        assert!(said.contains(mend), "{said}");
    }
}
