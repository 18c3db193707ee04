//! Same seed, same picture, bit for bit; loud ends.

use crate::tensor;
use glam::Vec3;
use manylights_method::{Frame, Method, Parameters, Processor};
use manylights_path_tracer::{Error, PathTracer, Reference, SLICE, Settings, render};
use manylights_scene::content_hash;
use manylights_scene::presets::PRESETS;
use manylights_scene::{Brdf, Light, Measured, Scene, load};
use manylights_scene::{Transport, Visibility};

fn settings(transport: &str, seed: u64) -> Settings {
    let transport = transport.parse().expect("a transport");
    Settings { transport, resolution: [31, 17], seed, samples: 2 * SLICE }
}

fn rendered(scene: &Scene, settings: &Settings, threads: usize) -> Result<Reference, Error> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| render(scene, &scene.cameras[0], settings, None, &mut |_| {}))
}

#[test]
fn the_number_of_threads_does_not_matter() {
    for (name, transport) in [("trio", "all"), ("cornell-glossy", "indirect-1")] {
        let scene = load(name, None).expect("a built-in scene");
        let settings = settings(transport, 5);
        let one = rendered(&scene, &settings, 1).expect("a picture");
        for threads in [2, 5] {
            let many = rendered(&scene, &settings, threads).expect("a picture");
            assert_eq!(one.image, many.image, "{name}, {threads} threads");
            assert_eq!(one.variance, many.variance);
            assert_eq!((one.noise_floor, one.rays), (many.noise_floor, many.rays));
        }
    }
}

#[test]
fn seeds_make_independent_pictures() {
    let scene = load("cornell", None).expect("a built-in scene");
    let sixteen =
        Settings { samples: 16 * SLICE, resolution: [64, 48], ..settings("indirect-1", 0) };
    let render = |seed| rendered(&scene, &Settings { seed, ..sixteen }, 2).expect("a picture");
    let (a, b) = (render(1), render(1 << 32));
    assert_ne!(a.image, b.image);
    // Independent pictures of the same mean differ by √2 of their noise; eight pairs of seeds did by
    // 0.93 to 1.04 of it.
    let squares: f64 = std::iter::zip(a.image.pixels.as_flattened(), b.image.pixels.as_flattened())
        .map(|(a, b)| f64::from(a - b).powi(2))
        .sum();
    let difference = (squares / (3.0 * a.image.pixels.len() as f64)).sqrt();
    let expected = a.noise_floor.hypot(b.noise_floor);
    assert!((difference / expected - 1.0).abs() < 0.12, "{difference} {expected}");
}

/// The method and the reference are one algorithm.
#[test]
fn the_method_makes_the_reference() {
    let scene = load("trio", None).expect("a built-in scene");
    let settings = settings("all", 3);
    let reference = rendered(&scene, &settings, 2).expect("a picture");
    let frame = Frame {
        scene: &scene,
        camera: &scene.cameras[0],
        resolution: settings.resolution,
        transport: settings.transport,
        seed: settings.seed,
        gpu: None,
    };
    assert_eq!(PathTracer.processor(), Processor::Cpu);
    let parameters = Parameters::new(PathTracer.parameters(), [("samples", "32")]).expect("valid");
    let mut run = PathTracer.prepare(&frame, &parameters).expect("a run");
    assert!(!run.step().expect("a step").finished());
    assert!(run.step().expect("a step").finished());
    assert_eq!(run.resolve().expect("a picture"), reference.image);
    assert_eq!(run.counters(), [("samples", 32), ("rays", reference.rays)]);
    assert!(run.pass_times().iter().all(|pass| pass.seconds > 0.0));
}

#[test]
fn nothing_is_seen_where_there_is_nothing() {
    let mut scene = load("cornell", None).expect("a built-in scene");
    scene.triangles.clear();
    for transport in ["direct", "indirect-1", "all"] {
        let reference = rendered(&scene, &settings(transport, 1), 1).expect("a picture");
        assert!(reference.image.pixels.iter().all(|&pixel| pixel == [0.0; 3]));
    }
}

#[test]
fn radiance_that_is_not_finite_is_an_error() {
    let mut scene = load("integrating-sphere", None).expect("a built-in scene");
    for (intensity, transport) in
        [(f32::INFINITY, "direct"), (f32::MAX, "all"), (f32::NAN, "indirect-1")]
    {
        scene.lights =
            vec![Light::Point { position: Vec3::ZERO, intensity: Vec3::splat(intensity) }];
        let error = rendered(&scene, &settings(transport, 1), 2).expect_err("no picture");
        assert!(matches!(error, Error::NonFinite { .. }), "{error}");
    }
}

#[test]
fn settings_without_a_picture_are_refused() {
    let scene = load("cornell", None).expect("a built-in scene");
    let good = settings("indirect-1", 1);
    let ignored = |bounces| Transport::Indirect { bounces, visibility: Visibility::Ignored };
    for bad in [
        Settings { resolution: [0, 4], ..good },
        Settings { resolution: [4, 0], ..good },
        Settings { resolution: [1 << 16, 1 << 16], ..good },
        Settings { transport: ignored(2), ..good },
        Settings { transport: ignored(0), ..good },
    ] {
        let error = rendered(&scene, &bad, 1).expect_err("no picture");
        assert!(matches!(error, Error::Settings(_)), "{error}");
        assert!(!error.to_string().contains('\n'));
    }
}

/// Whatever a picture depends on changes the hash; names and exposure do not.
#[test]
fn the_content_hash_sees_what_matters() {
    let scene = load("cornell", None).expect("a built-in scene");
    let hash = |scene: &Scene| content_hash(scene, &scene.cameras[0]);
    let original = hash(&scene);
    assert_eq!(original.len(), 64);
    type Change = fn(&mut Scene);
    let changes: [Change; 7] = [
        |scene| scene.vertices[0].position.x += 1e-6,
        |scene| scene.vertices[0].normal.x += 1e-6,
        |scene| scene.triangles.swap(0, 1),
        |scene| scene.materials[0].roughness *= 0.999,
        |scene| scene.lights.clear(),
        |scene| scene.cameras[0].vertical_fov += 1e-6,
        |scene| scene.cameras[0].position.y += 1e-6,
    ];
    for (index, change) in changes.into_iter().enumerate() {
        let mut changed = scene.clone();
        change(&mut changed);
        assert_ne!(hash(&changed), original, "change {index}");
    }
    let given = |brdf: Brdf| {
        let mut changed = scene.clone();
        changed.materials[0].given = Some(brdf);
        hash(&changed)
    };
    let other = tensor::material(|_, _, _| 1.0, |_| 1.0, |_| 1.0, |_, _, _, _| 0.25);
    // As many numbers as the first measurement, others.
    let measured = [tensor::satin(), tensor::file(&other)].map(|bytes| {
        let path = tempfile::tempdir().expect("a temporary folder").keep().join("a.bsdf");
        std::fs::write(&path, bytes).expect("can write");
        let brdf = Measured::load(&path).expect("valid").brdf();
        std::fs::remove_dir_all(path.parent().expect("has one")).expect("can be removed");
        brdf
    });
    // The samplers' lobes follow the table; here the table alone differs.
    let lobes_of_first = Brdf { lobe: measured[1].lobe, ..measured[0] };
    let preset = PRESETS[0].brdf();
    let hashes = [original.clone(), given(preset), given(measured[0]), given(lobes_of_first)];
    let distinct: std::collections::HashSet<_> = hashes.iter().collect();
    assert_eq!(distinct.len(), hashes.len());

    let mut renamed = scene.clone();
    renamed.name.push('x');
    renamed.exposure *= 2.0;
    renamed.notes.push("x".into());
    renamed.sources.push("x".into());
    assert_eq!(hash(&renamed), original);
}

/// Numbers of samples that are no multiple of a slice are met within one sample a slice, and are as
/// unbiased as others.
#[test]
fn the_method_takes_any_number_of_samples() {
    let scene = load("cornell", None).expect("a built-in scene");
    let render = |samples: &str, seed| {
        let frame = Frame {
            scene: &scene,
            camera: &scene.cameras[0],
            resolution: [6, 4],
            transport: "indirect-1".parse().expect("a transport"),
            seed,
            gpu: None,
        };
        let parameters = Parameters::new(PathTracer.parameters(), [("samples", samples)]);
        let mut run = PathTracer.prepare(&frame, &parameters.expect("valid")).expect("accepted");
        while !run.step().expect("a step").finished() {}
        (run.counters()[0], run.resolve().expect("a picture").pixels)
    };
    for (asked, taken) in [("1", 1), ("5", 5), ("16", 16), ("17", 18), ("40", 42), ("48", 48)] {
        assert_eq!(render(asked, 1).0, ("samples", taken));
    }
    let mean = |samples: &str, seeds: u64| {
        let green = |seed| render(samples, seed).1.iter().map(|p| f64::from(p[1])).sum::<f64>();
        let values: Vec<f64> = (0..seeds).map(green).collect();
        let mean = values.iter().sum::<f64>() / seeds as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (mean, squares / (seeds * (seeds - 1)) as f64)
    };
    let ((few, a), (many, b)) = (mean("5", 400), mean("48", 100));
    assert!((few - many).abs() < 4.0 * (a + b).sqrt(), "{few} {many}, {}", (a + b).sqrt());
}
