//! Narrow lobes by transformed cosines.

use crate::common::{
    DIRECT, SETTINGS, by_quadrature, dielectric, glossy, metal, mirror_like, render, scene,
    spheres, spiral, surface, view,
};
use crate::gather::{sphere, worst};
use glam::Vec3;
use manylights_method::Error;
use manylights_reflectance::ReceiverKinds;
use manylights_scene::Scene;
use manylights_spherical_light::{Extent, Narrow, Settings, SphereLight, linked_shader, oracle};

const TRANSFORMED: Settings = Settings { narrow: Narrow::Transformed, ..SETTINGS };

#[test]
fn on_the_adapter() {
    for brdf in [glossy(0.2), metal(0.2), glossy(0.29), metal(0.4)] {
        for extent in [Extent::Sphere, Extent::Disc] {
            let settings = Settings { extent, ..TRANSFORMED };
            for lights in [&[sphere(0.15), sphere(0.6)][..], &[sphere(3.0)]] {
                let worst = worst(brdf, lights, &settings);
                println!("{} {extent:?}: {worst:.1e}", brdf.alpha);
                assert!(worst < 2e-5, "{brdf:?} {settings:?}: {worst:e}");
            }
        }
    }
}

/// What nine bands do not see: lamps in a lobe of roughness 0.1.
#[test]
fn lamps_in_narrow_lobes() {
    for degrees in [0.0, 30.0, 60.0] {
        let (brdf, view) = (mirror_like(0.1), view(degrees));
        let receiver = surface(Vec3::ZERO, Vec3::Z, brdf);
        let (mut errors, mut truths) = ([0.0; 2], 0.0);
        for i in 0..1200 {
            let toward = spiral(i, 1200, 0.0);
            let truth = by_quadrature(brdf, view, toward, 0.05, 32).x;
            truths += truth * truth;
            let light = SphereLight::new(toward.as_vec3(), 0.05_f32.sin(), Vec3::ONE);
            for (error, settings) in errors.iter_mut().zip([SETTINGS, TRANSFORMED]) {
                *error +=
                    (oracle::radiance(&receiver, view, &[light], &settings).x - truth).powi(2);
            }
        }
        let [bands, transformed] = errors.map(|error: f64| (error / truths).sqrt());
        println!("{degrees}°: {bands:.3} {transformed:.4}");
        assert!(bands > 0.9 && transformed < 0.036, "{degrees}°: {bands} {transformed}");
    }
}

#[test]
fn kernels_know_them_where_there_are_some() {
    let wide = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let narrow = ReceiverKinds { narrow: true, ..wide };
    for (kinds, settings, known) in
        [(wide, TRANSFORMED, false), (narrow, TRANSFORMED, true), (narrow, SETTINGS, false)]
    {
        let wgsl = linked_shader(kinds, &settings).expect("links").wgsl;
        assert_eq!(wgsl.contains("transformed"), known, "{kinds:?}");
    }
}

#[test]
fn pictures_and_what_is_declined() {
    let mut scene = scene(5);
    let narrow = scene.materials.iter().position(|material| material.roughness == 0.3);
    let narrow = narrow.expect("the lacquer of trio");
    scene.materials[narrow].roughness = 0.15;
    let texts = [("narrow", "ltc")];
    let (image, surfaces) = render(&scene, [24, 18], &texts, DIRECT).expect("a picture");
    let (lights, eye) = (spheres(&scene), scene.cameras[0].position.as_dvec3());
    let truth =
        |surface| oracle::radiance(surface, eye, &lights, &TRANSFORMED).max(glam::DVec3::ZERO);
    let truths: Vec<_> = surfaces.iter().map(truth).collect();
    let peak = truths.iter().map(|truth| truth.max_element()).fold(0.0, f64::max);
    for (&pixel, truth) in image.pixels.iter().zip(&truths) {
        let error = (Vec3::from(pixel).as_dvec3() - truth).abs().max_element() / peak;
        assert!(error < 2e-5, "{pixel:?} for {truth}: {error:e}");
    }
    declined(&scene, &[("narrow", "ltc"), ("product", "4.6")], "product=full");
    scene.materials[narrow].given = Some(dielectric(0.15));
    declined(&scene, &texts, "other than GGX with Schlick's Fresnel term");
}

fn declined(scene: &Scene, texts: &[(&str, &str)], words: &str) {
    match render(scene, [16, 12], texts, DIRECT) {
        Err(Error::Declined(reason)) => assert!(reason.contains(words), "{reason}"),
        other => panic!("{:?}", other.map(|_| "rendered")),
    }
}
