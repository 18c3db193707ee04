//! Pictures from a grid against f64: projection, scheme and lobes.

use glam::Vec3;
use manylights_area_lights::AreaLights;
use manylights_gpu::{GpuFrame, SurfaceRecord};
use manylights_interpolation::{self as interpolation, Grid, Near, Order, Reach, Scheme, Storage};
use manylights_method::{Dependencies, Frame, Method, Parameters, Processor, Run};
use manylights_metrics::RadianceImage;
use manylights_reflectance::Materials;
use manylights_scene::{AreaLight, Scene};
use manylights_spherical_light::{Extent, Settings, SphereLight, SphericalLights, oracle};

use crate::common::{DIRECT, GPU, SETTINGS, render, scene};

const RESOLUTION: [u32; 2] = [24, 18];

const SCHEMES: [(&str, Scheme); 4] = [
    ("trilinear", Scheme::Trilinear),
    ("taylor", Scheme::Taylor),
    ("hermite-flat", Scheme::HermiteFlat),
    ("hermite", Scheme::Hermite),
];

/// Of all that is seen, as many vertices as a cube with so many a side.
fn grid_of(surfaces: &[SurfaceRecord], vertices: usize) -> Grid<f32> {
    let seen = surfaces.iter().filter(|s| s.triangle != SurfaceRecord::NO_TRIANGLE);
    let positions: Vec<Vec3> = seen.map(|surface| surface.position).collect();
    let least = positions.iter().copied().reduce(Vec3::min).expect("something is seen");
    let most = positions.iter().copied().reduce(Vec3::max).expect("something is seen");
    Grid::of_cubes([least.to_array(), most.to_array()], vertices)
}

/// Of at least half of the largest spacing, with the same power.
fn smoothed(light: &SphereLight, grid: &Grid<f32>) -> SphereLight {
    let [x, y, z] = grid.spacing;
    let radius = light.radius.max(x.max(y).max(z) / 2.0);
    let power = light.radius * light.radius * light.radiance;
    SphereLight::new(light.center, radius, power / (radius * radius))
}

/// The largest error of a pixel over the largest radiance.
fn error(
    scene: &Scene,
    (image, surfaces): &(RadianceImage, Vec<SurfaceRecord>),
    (vertices, near_lights): (usize, Near),
    scheme: Scheme,
    settings: &Settings,
) -> f64 {
    let grid = grid_of(surfaces, vertices);
    let reach = Reach::new(&grid);
    let [near, far] = [true, false].map(|is_near| -> Vec<_> {
        let lights = scene.area_lights.iter().filter(|light| reach.meets(light) == is_near);
        lights.filter_map(SphereLight::of).collect()
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
    let mut all = oracle::coefficients(&grid, &far, settings);
    let near = match near_lights {
        Near::Apart => near,
        Near::Smoothed => {
            let discs = Settings { extent: Extent::Disc, ..*settings };
            let smoothed: Vec<_> = near.iter().map(|light| smoothed(light, &grid)).collect();
            let more = oracle::coefficients(&grid, &smoothed, &discs);
            let more = more.as_flattened().as_flattened();
            for (sum, more) in all.as_flattened_mut().as_flattened_mut().iter_mut().zip(more) {
                *sum += more;
            }
            Vec::new()
        }
    };
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

/// Lights around the scene, the first of them where it is.
fn lit(near: bool) -> Scene {
    let mut scene = scene(20);
    for light in &mut scene.area_lights {
        let AreaLight::Sphere { center, .. } = light else { unreachable!("spheres alone") };
        *center *= 6.0;
    }
    if near {
        let center = Vec3::new(0.3, 1.5, 0.2);
        scene.area_lights.push(AreaLight::Sphere { center, radius: 0.2, radiance: Vec3::ONE });
    }
    scene
}

#[test]
fn pictures_are_those_of_f64() {
    for is_near in [false, true] {
        let scene = lit(is_near);
        for (word, scheme) in SCHEMES {
            for reading in ["plain", "sorted"] {
                let texts =
                    [("bands", "4"), ("interpolation", word), ("grid", "4"), ("reading", reading)];
                let picture = render(&scene, RESOLUTION, &texts, DIRECT).expect("a picture");
                let settings = Settings { bands: 4, ..SETTINGS };
                let error = error(&scene, &picture, (4, Near::Apart), scheme, &settings);
                println!("near {is_near}, {word}, {reading}: {error:.1e}");
                assert!(error < 1e-5, "near {is_near}, {word}, {reading}: {error:e}");
            }
        }
    }
}

/// Small ones grow, large ones stay; both are counted.
#[test]
fn pictures_with_smoothed_lights_are_those_of_f64() {
    let mut scene = lit(true);
    let center = Vec3::new(-1.0, 2.0, 1.0);
    scene.area_lights.push(AreaLight::Sphere { center, radius: 1.5, radiance: Vec3::ONE });
    for (word, scheme) in SCHEMES {
        for loops in ["forward", "reverse"] {
            let texts = [
                ("bands", "4"),
                ("interpolation", word),
                ("grid", "4"),
                ("near", "smoothed"),
                ("loops", loops),
            ];
            let picture = render(&scene, RESOLUTION, &texts, DIRECT).expect("a picture");
            let settings = Settings { bands: 4, ..SETTINGS };
            let error = error(&scene, &picture, (4, Near::Smoothed), scheme, &settings);
            println!("{word}, {loops}: {error:.1e}");
            assert!(error < 1e-5, "{word}, {loops}: {error:e}");
        }
    }
    let texts = [("bands", "4"), ("interpolation", "hermite"), ("grid", "4"), ("near", "smoothed")];
    let settings = parameters(&texts);
    with_frames(&scene, &mut |frames| {
        let method = AreaLights(SphericalLights);
        let mut run = method.prepare(&frames[0], &settings).expect("a run");
        assert!(run.step().expect("a step").finished(), "nothing is gathered");
        let all = scene.area_lights.len() as u64;
        assert_eq!(
            run.counters(),
            [("lights", all), ("smoothed_lights", 2), ("pixels_outside", 0)]
        );
    });
}

/// Nearly the same pictures, and not from what f32 keeps.
#[test]
fn pictures_of_packed_coefficients_are_near() {
    let scene = lit(false);
    for (word, scheme) in SCHEMES {
        for reading in ["plain", "sorted"] {
            let texts = [
                ("bands", "4"),
                ("interpolation", word),
                ("grid", "4"),
                ("reading", reading),
                ("storage", "packed"),
            ];
            let picture = render(&scene, RESOLUTION, &texts, DIRECT).expect("a picture");
            let settings = Settings { bands: 4, ..SETTINGS };
            let error = error(&scene, &picture, (4, Near::Apart), scheme, &settings);
            println!("{word}, {reading}: {error:.1e}");
            assert!((1e-5..2e-3).contains(&error), "{word}, {reading}: {error:e}");
        }
    }
}

fn parameters(settings: &[(&'static str, &'static str)]) -> Parameters {
    let infos = AreaLights(SphericalLights).parameters();
    Parameters::new(infos, settings.iter().copied()).expect("in range")
}

/// Calls back with frames of a scene's cameras.
fn with_frames(scene: &Scene, call: &mut dyn FnMut(&[Frame<'_>])) {
    let on_gpu: Vec<_> = scene
        .cameras
        .iter()
        .map(|camera| GpuFrame::new(&GPU, scene, camera, RESOLUTION).expect("it fits"))
        .collect();
    let frame = |(camera, gpu)| {
        let gpu = Some(gpu);
        Frame { scene, camera, resolution: RESOLUTION, transport: DIRECT, seed: 0, gpu }
    };
    call(&scene.cameras.iter().zip(&on_gpu).map(frame).collect::<Vec<_>>());
}

fn finished(mut run: Box<dyn Run + '_>) -> (RadianceImage, Vec<u64>) {
    while !run.step().expect("a step").finished() {}
    let counters = run.counters().iter().map(|(_, count)| *count).collect();
    (run.resolve().expect("a picture"), counters)
}

#[test]
fn near_lights_are_counted_and_bakes_say_what_they_depend_on() {
    let method = AreaLights(SphericalLights);
    let baking = method.baking().expect("a bake");
    for (is_near, counted) in [(false, 0), (true, 1)] {
        let scene = lit(is_near);
        let settings = parameters(&[("bands", "3"), ("interpolation", "hermite"), ("grid", "5")]);
        let depends =
            Dependencies { lights: true, camera: true, scene: true, amount: true, seed: false };
        assert_eq!(baking.depends_on(&settings), depends);
        assert_eq!(baking.processor(&settings), Processor::Gpu);
        let whole = parameters(&[("interpolation", "taylor"), ("bounds", "scene")]);
        assert_eq!(baking.depends_on(&whole), Dependencies { camera: false, ..depends });
        with_frames(&scene, &mut |frames| {
            let bake = baking.bake(&frames[0], &settings).expect("a bake");
            assert!(bake.pass_times().iter().any(|time| time.pass == "project"));
            let run = bake.prepare(&frames[0], &settings).expect("a run");
            let names: Vec<_> = run.counters().iter().map(|(name, _)| *name).collect();
            assert_eq!(names, ["lights", "near_lights", "pixels_outside"]);
            let (_, counters) = finished(run);
            assert_eq!(counters, [scene.area_lights.len() as u64, counted, 0]);
        });
    }
}

/// A grid over what one camera sees, read from another: its nearest points stand for what is outside, and are
/// counted; grown for the other camera it is the grid of that one, bit for bit.
#[test]
fn a_bake_grows_to_the_grid_of_the_next_camera() {
    let mut scene = lit(true);
    let mut other = scene.cameras[0].clone();
    other.position += 0.5 * other.right + 2.0 * other.forward;
    // Further down, where the first sees less.
    (other.forward, other.up) = (-other.up, other.forward);
    scene.cameras.push(other);
    let settings = parameters(&[("bands", "3"), ("interpolation", "hermite"), ("grid", "4")]);
    let method = AreaLights(SphericalLights);
    let baking = method.baking().expect("a bake");
    with_frames(&scene, &mut |frames| {
        let (first, second) = (&frames[0], &frames[1]);
        let mut bake = baking.bake(second, &settings).expect("a bake");
        let strange = finished(bake.prepare(first, &settings).expect("a run"));
        assert!(strange.1[2] > 0, "pixels outside: {:?}", strange.1);
        assert!(strange.0.pixels.as_flattened().iter().all(|value| value.is_finite()));
        bake.grow(first, &settings).expect("it grows");
        let grown = finished(bake.prepare(first, &settings).expect("a run"));
        let anew = baking.bake(first, &settings).expect("a bake");
        let anew = finished(anew.prepare(first, &settings).expect("a run"));
        assert!(grown == anew, "a grown grid gives another picture");
        assert_eq!(grown.1[2], 0);
    });
}

/// Lights that move and come back.
#[test]
fn the_same_lights_give_the_same_bits() {
    let texts = [("bands", "3"), ("interpolation", "hermite"), ("grid", "4")];
    let picture = |scene: &Scene| render(scene, RESOLUTION, &texts, DIRECT).expect("a picture").0;
    let scene = lit(false);
    let mut moved = scene.clone();
    let AreaLight::Sphere { center, .. } = &mut moved.area_lights[3] else { unreachable!() };
    *center *= 0.5;
    let (first, other, again) = (picture(&scene), picture(&moved), picture(&scene));
    assert!(first == again && first != other);
}

/// A grid of two vertices a side; lights at vertices, through the whole grid, and with a cell inside.
#[test]
fn lights_in_the_grid_are_met_at_each_pixel() {
    let mut scene = scene(1);
    let (_, surfaces) = render(&scene, RESOLUTION, &[("bands", "3")], DIRECT).expect("a picture");
    for vertices in ["2", "3"] {
        let grid = grid_of(&surfaces, vertices.parse().expect("a number"));
        let vertex = Vec3::from(grid.positions().last().expect("a vertex"));
        let middle = Vec3::from(grid.origin) + 0.5 * (vertex - Vec3::from(grid.origin));
        for (center, radius) in [(vertex, 0.1), (middle, 0.3), (middle, 50.0), (middle, 1e-3)] {
            let radiance = Vec3::ONE;
            scene.area_lights = vec![AreaLight::Sphere { center, radius, radiance }];
            let texts = [("bands", "3"), ("grid", vertices), ("interpolation", "hermite")];
            let [exact, interpolated] = [&texts[..2], &texts]
                .map(|texts| render(&scene, RESOLUTION, texts, DIRECT).expect("a picture").0);
            assert!(exact == interpolated, "{center} {radius}: nothing is left to the grid");
        }
    }
}

#[test]
fn what_a_grid_cannot_hold_is_declined() {
    let scene = lit(false);
    for (name, word, mend) in [
        ("product", "general", "product=full"),
        ("coefficients", "tabulated", "coefficients=analytic"),
        ("narrow", "ltc", "narrow=decline"),
    ] {
        let texts = [("interpolation", "trilinear"), (name, word)];
        let refused = render(&scene, RESOLUTION, &texts, DIRECT);
        let said = refused.expect_err("declined").to_string();
        assert!(said.contains(mend), "{said}");
    }
}
