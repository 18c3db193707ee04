//! Measured reflectances: their tables against quadrature, the adapter against the oracle.

use crate::common::{GPU, SETTINGS, dielectric, glossy, light, oblique, surface, worst};
use crate::tensor;
use glam::{DVec3, Vec3};
use manylights_gpu::{GpuFrame, SurfaceRecord};
use manylights_harmonics::quadrature::sphere;
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use manylights_hvl::emission::reflectance;
use manylights_hvl::{Hvl, Settings, oracle, virtual_spheres};
use manylights_method::{Error, Frame, Method, Parameters};
use manylights_reflectance::lobes::{LobeTable, NODES};
use manylights_reflectance::{Damping, LobeShape};
use manylights_scene::{Brdf, DBrdf, Lobe, Measured, Scene};
use manylights_scene::{Transport, Visibility};
use manylights_virtual_lights::{VirtualLight, VirtualLights, scene_maps};

fn load(file: &[u8]) -> Brdf {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("synthetic.bsdf");
    std::fs::write(&path, file).expect("can write");
    Measured::load(&path).expect("valid").brdf()
}

fn satin() -> Brdf {
    load(&tensor::satin())
}

/// Another one, whose blue is black.
fn yellow() -> Brdf {
    let fields = tensor::material(
        |x, _, theta| 1.5 - x + 0.2 * theta,
        |x| 0.1 + (-9.0 * x * x).exp(),
        |x| 1.0 - 0.5 * x,
        |x, y, _, c| [0.5 + 0.1 * x, 0.4 - 0.1 * y, 0.0][c as usize],
    );
    load(&tensor::file(&fields))
}

fn of_rgl(name: &str) -> Brdf {
    let folder = std::env::var_os("MANYLIGHTS_ASSETS").expect("MANYLIGHTS_ASSETS is set");
    let path = std::path::Path::new(&folder).join(format!("brdf/rgl/{name}_rgb.bsdf"));
    Measured::load(&path).expect("a measurement").brdf()
}

/// Largest difference of a coefficient to a quadrature of other nodes, relative to the first one.
fn off_quadrature(brdf: Brdf, bands: usize) -> f64 {
    let (basis, truth) = (Basis::<f64>::new(bands), DBrdf::from(brdf));
    let mut worst: f64 = 0.0;
    let tables = LobeShape::from(brdf).of_measurement();
    let tables = tables.map(|shape| LobeTable::of(shape, bands, Damping::None));
    for (channel, (table, k)) in [(0, 0), (0, 1), (1, 0)].into_iter().enumerate() {
        let table = &tables[table];
        for degrees in [0_usize, 40, 80] {
            let (sin, cos) = (degrees as f64).to_radians().sin_cos();
            let row = &table.values()[degrees * even_count(bands)..];
            for (l, m) in [(0, 0), (1, 1), (bands - 1, 0), (bands - 1, bands - 1)] {
                let mut values = vec![0.0; count(bands)];
                let expected = sphere(301, [0.0, 1.0], |w| {
                    basis.evaluate(w, &mut values);
                    let value = truth.eval(DVec3::Z, DVec3::new(sin, 0.0, cos), w.into());
                    value[channel] * w[2] * values[index(l, m as isize)]
                });
                let error = (row[even_index(l, m)][k] - expected).abs() / row[0][k];
                println!("{channel} {degrees}° ({l}, {m}): off by {error:.1e}");
                worst = worst.max(error);
            }
        }
    }
    worst
}

/// Of the adapter to the oracle, for every part that a measurement may take.
fn off_oracle(brdf: Brdf) -> f64 {
    let lambert = Brdf::lambert(Vec3::splat(0.7));
    let (other, dielectric) = (yellow(), dielectric(0.4));
    let pairs = [
        (brdf, lambert),
        (glossy(0.5), brdf),
        (brdf, other),
        (other, brdf),
        (dielectric, brdf),
        (brdf, dielectric),
    ];
    let mut largest: f64 = 0.0;
    for (index, (receiver, emitter)) in pairs.into_iter().enumerate() {
        let sphere = light(Vec3::ZERO, oblique(Vec3::Y), emitter, 0.4);
        for (bands, emission_bands) in [(5, 1), (5, 3)] {
            let settings = Settings { bands, emission_bands, ..SETTINGS };
            let worst = worst(receiver, &sphere, &settings);
            println!("pair {index}, {bands}, {emission_bands}: {worst:.1e}");
            largest = largest.max(worst);
        }
    }
    largest
}

/// Largest change of a coefficient by twice as many nodes, relative to the first one.
fn off_finer(brdf: Brdf, bands: usize) -> f64 {
    let tables = |nodes| LobeTable::integrate(brdf, bands, nodes);
    let pairs = tables(NODES.map(|nodes| 2 * nodes)).into_iter().zip(tables(NODES));
    let size = even_count(bands);
    let change = |(fine, coarse): (&[[f64; 2]], &[[f64; 2]])| {
        let largest = |k: usize| {
            let changes = fine.iter().zip(coarse).map(|(f, c)| (f[k] - c[k]).abs());
            changes.fold(0.0, f64::max) / fine[0][k].max(1e-9)
        };
        largest(0).max(largest(1))
    };
    let mut worst: f64 = 0.0;
    for (fine, coarse) in pairs {
        let rows = fine.values().chunks(size).zip(coarse.values().chunks(size)).map(change);
        for (degrees, change) in rows.enumerate() {
            println!("{degrees}°: {change:.1e} by finer nodes");
            worst = worst.max(change);
        }
    }
    worst
}

#[test]
fn tables_are_projections() {
    // The measurement is linear between a few angles: kinks limit both quadratures.
    let [off, finer] = [off_quadrature(satin(), 5), off_finer(satin(), 5)];
    println!("{off:.1e} off the quadrature, {finer:.1e} off finer nodes");
    assert!(off < 5e-4 && finer < 2e-4, "{off:e} {finer:e}");
}

/// However few the bands, a light emits the albedo of each channel, and an expansion is the projection of
/// what the measurement reflects of its light.
#[test]
fn emission_is_that_of_the_measurement() {
    for brdf in [satin(), yellow()] {
        let truth = DBrdf::from(brdf);
        for degrees in [0_f32, 40.0, 80.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let incoming = Vec3::new(sin, 0.0, cos);
            let light = VirtualLight { incoming, ..light(Vec3::ZERO, Vec3::Z, brdf, 0.0).light };
            let flux = |reflectance: &dyn Fn(DVec3) -> DVec3, channel: usize, nodes| {
                sphere(nodes, [0.0, 1.0], |w| w[2] * reflectance(w.into())[channel])
            };
            for channel in 0..3 {
                let whole = |w| truth.eval(DVec3::Z, w, incoming.as_dvec3());
                let albedo = flux(&whole, channel, 201);
                for bands in [1, 3, 5] {
                    let part = |w| reflectance(&light, w, bands);
                    let error = (flux(&part, channel, 12) - albedo).abs();
                    println!(
                        "{degrees}°, channel {channel}, {bands} bands: {albedo:.3} {error:.1e}"
                    );
                    // 9.5e-6 measured: kinks of the interpolation limit both quadratures.
                    assert!(error < 3e-5, "{degrees}°, {channel}, {bands}: {error:e}");
                }
                // Up to the factor that keeps the flux, bands 0 to 4 of the mirrored lobe.
                let moment = |f: &dyn Fn(DVec3) -> DVec3, power: i32, nodes| {
                    let value = |w: [f64; 3]| (w[0] + 0.3 * w[2] * w[2]).powi(power);
                    sphere(nodes, [0.0, 1.0], |w| f(w.into())[channel] * value(w))
                };
                let part = |w| reflectance(&light, w, 5);
                let ratio = |f: &dyn Fn(DVec3) -> DVec3, nodes| {
                    moment(f, 2, nodes) / moment(f, 0, nodes).max(1e-9)
                };
                let (found, expected) = (ratio(&part, 12), ratio(&whole, 201));
                println!("{degrees}°, channel {channel}: second moment {found:.4}, {expected:.4}");
                assert!((found - expected).abs() < 1e-4, "{degrees}°: {found} {expected}");
            }
        }
    }
}

#[test]
fn the_adapter_agrees_with_the_oracle() {
    // A few roundings of f32.
    assert!(off_oracle(satin()) < 3e-6);
}

#[test]
fn more_bands_approach_the_integral() {
    let surface = surface(Vec3::ZERO, Vec3::Y, satin());
    let sphere = light(Vec3::new(0.4, 1.0, 0.1), -Vec3::Y, Brdf::lambert(Vec3::ONE), 0.3);
    let camera = DVec3::new(-0.9, 1.0, 0.2);
    let whole = oracle::by_quadrature(&surface, camera, &sphere, |_, _| 1.0, 64);
    let errors = [3, 5, 10].map(|bands| {
        let settings = Settings { bands, ..SETTINGS };
        let value = oracle::radiance(&surface, camera, &[sphere], &settings);
        ((value - whole) / whole).abs().max_element()
    });
    println!("relative error at 3, 5, 10 bands: {errors:?}");
    // 4.9e-2, 1.2e-2, 2.0e-2: with its cosine this measurement ends at the horizon in a step, and rings.
    for (error, bound) in errors.iter().zip([0.055, 0.015, 0.025]) {
        assert!(*error < bound, "{errors:?}");
    }
}

#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn real_measurements() {
    for (name, bound) in [("paper_white", 4e-4), ("vch_golden_yellow", 1.5e-3)] {
        let (brdf, bands) = (of_rgl(name), 10);
        let (quadrature, adapter) = (off_quadrature(brdf, bands), off_oracle(brdf));
        println!("{name}: {quadrature:.1e} off the quadrature, {adapter:.1e} off the oracle");
        assert!(quadrature < bound && adapter < 3e-6, "{name}: {quadrature} {adapter}");
    }
}

/// A frame of `trio` on a floor of satin.
fn on_satin(check: impl FnOnce(&Frame<'_>, &Scene)) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("satin.bsdf"), tensor::satin()).expect("can write");
    let material = "[material.floor]\nmeasured = \"satin.bsdf\"\n";
    let text = format!("about = \"a test\"\nsource = \"builtin:trio\"\n{material}");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).expect("can write");
    let scene = manylights_scene::load(path.to_str().expect("text"), None).expect("valid");
    let (camera, resolution) = (&scene.cameras[0], [24, 18]);
    let on_gpu = GpuFrame::new(&GPU, &scene, camera, resolution).expect("the scene fits");
    let transport = Transport::Indirect { bounces: 1, visibility: Visibility::Ignored };
    let gpu = Some(&on_gpu);
    check(&Frame { scene: &scene, camera, resolution, transport, seed: 0, gpu }, &scene);
}

fn parameters(texts: &[(&'static str, &'static str)]) -> Parameters {
    Parameters::new(VirtualLights(Hvl).parameters(), texts.iter().copied()).expect("in range")
}

#[test]
fn a_picture_agrees_with_the_oracle() {
    on_satin(|frame, scene| {
        let chosen = parameters(&[("emission_bands", "3"), ("lights", "100")]);
        let mut run = VirtualLights(Hvl).prepare(frame, &chosen).expect("hvl renders the scene");
        while !run.step().expect("a step").finished() {}
        let image = run.resolve().expect("a picture");
        let on_gpu = frame.gpu.expect("given");
        let surfaces: Vec<SurfaceRecord> = GPU.read(on_gpu.surfaces()).expect("a G-buffer");
        let settings = Settings { lights: 100, emission_bands: 3, ..Settings::default() };
        let maps = scene_maps(on_gpu, scene, settings.lights, 0).expect("maps");
        let (lights, _) = virtual_spheres(on_gpu, scene, &maps, &settings).expect("lights");
        let measured = |brdf: Brdf| matches!(brdf.lobe, Lobe::Measured(_));
        assert!(surfaces.iter().any(|surface| measured(surface.brdf())), "none in the picture");
        assert!(lights.iter().any(|sphere| measured(sphere.light.brdf)), "none under a light");
        let eye = frame.camera.position.as_dvec3();
        let truth = surfaces.iter().map(|s| oracle::radiance(s, eye, &lights, &settings));
        let truth: Vec<_> = truth.map(|radiance| radiance.max(DVec3::ZERO)).collect();
        let peak = truth.iter().map(|value| value.max_element()).fold(0.0, f64::max);
        for (pixel, truth) in image.pixels.iter().zip(truth) {
            let error = (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element();
            assert!(error < 1e-5 * peak, "{pixel:?}, {truth}");
        }
    });
}

#[test]
fn settings_that_do_not_know_measurements_say_so() {
    on_satin(|frame, _| {
        for (texts, word) in
            [(&[][..], "emission_bands"), (&[("emission_bands", "1"), ("form", "zonal")], "form")]
        {
            match VirtualLights(Hvl).prepare(frame, &parameters(texts)).err() {
                Some(Error::Declined(reason)) => assert!(reason.contains(word), "{reason}"),
                other => panic!("{other:?}"),
            }
        }
    });
}
