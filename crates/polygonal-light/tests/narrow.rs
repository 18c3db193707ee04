//! Narrow lobes by transformed cosines of the triangles' own corners.

use crate::common::{
    DIRECT, dielectric, exact, glossy, metal, mirror_like, oblique, render, scene, settings,
    surface,
};
use crate::exact::{receivers, worst};
use crate::triangles::{around, reflected};
use glam::{DVec3, Vec3};
use manylights_method::Error;
use manylights_polygonal_light::{Edges, Narrow, Settings, TriangleForm, linked_shader, oracle};
use manylights_reflectance::ReceiverKinds;
use manylights_scene::{AreaLight, Brdf, DBrdf, Scene};

/// All forms, exact ones first.
fn all_settings() -> Vec<Settings> {
    let forms = TriangleForm::ALL.map(settings);
    let all = [exact(Edges::Own), exact(Edges::Shared)].into_iter().chain(forms);
    all.map(|settings| Settings { narrow: Narrow::Transformed, ..settings }).collect()
}

/// A square of two triangles of one plane, so that its edges are shared, and a triangle apart from it.
fn lights(two_sided: bool, radiances: [Vec3; 3]) -> [AreaLight; 3] {
    let place = |x: f32, y: f32| oblique(Vec3::new(x, y, 0.1));
    let [a, b, c, d] = [place(-0.3, -0.4), place(0.3, -0.4), place(0.3, 0.3), place(-0.3, 0.3)];
    let apart = [0.1, 0.2, 0.0].map(|x| place(x, 0.1) + Vec3::new(x * x, -0.3, 0.3 * x));
    let corners = [[a, b, c], [a, c, d], apart];
    [0, 1, 2].map(|i| AreaLight::Triangle {
        corners: corners[i],
        radiance: radiances[i],
        two_sided,
    })
}

/// The narrower a lobe, the fewer digits f32 has of a direction in it.
fn bound(brdf: Brdf) -> f64 {
    if brdf.alpha < 0.05 { 2e-4 } else { 1e-5 }
}

#[test]
fn on_the_adapter() {
    let colors = [Vec3::new(1.0, 0.7, 0.3), Vec3::new(0.2, 0.9, 0.5), Vec3::ONE];
    for brdf in [glossy(0.1), glossy(0.29), metal(0.2)] {
        for settings in all_settings() {
            // Bands are not what is tested here.
            let settings = Settings { bands: 3, ..settings };
            for (distance, two_sided) in [(0.5, false), (1.0, true), (12.0, false), (150.0, true)] {
                let lights = lights(two_sided, colors);
                let worst = worst(&receivers(brdf, distance, 200), &lights, &settings);
                println!("{} {distance} {:?}: {worst:.1e}", brdf.alpha, settings.approximation);
                assert!(worst < bound(brdf), "{brdf:?} {distance} {settings:?}: {worst:e}");
            }
        }
    }
}

/// Where all edges between triangles vanish, and where wide lobes beside narrow ones keep theirs.
#[test]
fn one_radiance_and_wide_lobes_beside_narrow_ones() {
    let lights = lights(true, [Vec3::ONE; 3]);
    for distance in [0.5, 12.0] {
        let mut surfaces = receivers(glossy(0.2), distance, 100);
        surfaces.extend(receivers(glossy(0.5), distance, 100));
        surfaces.extend(receivers(Brdf::lambert(Vec3::splat(0.7)), distance, 100));
        for settings in all_settings() {
            let worst = worst(&surfaces, &lights, &settings);
            assert!(worst < 5e-5, "{distance} {settings:?}: {worst:e}");
        }
    }
}

/// What nine bands do not see: lamps in a lobe of roughness 0.1.
#[test]
fn lamps_in_narrow_lobes() {
    for degrees in [0.0_f64, 30.0, 60.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (brdf, view) = (mirror_like(0.1), DVec3::new(sin, 0.0, cos));
        let receiver = surface(Vec3::ZERO, Vec3::Z, brdf);
        let bands = [exact(Edges::Own), settings(TriangleForm::Main)];
        let all =
            bands.map(|settings| [settings, Settings { narrow: Narrow::Transformed, ..settings }]);
        let (mut errors, mut truths) = ([[0.0_f64; 2]; 2], 0.0);
        for corners in around(600, 0.1) {
            let corners = corners.map(|corner| corner.as_vec3());
            let light = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
            let truth =
                reflected(&DBrdf::from(brdf), view, corners.map(|corner| corner.as_dvec3()));
            truths += truth * truth;
            for (errors, settings) in errors.as_flattened_mut().iter_mut().zip(all.as_flattened()) {
                let value = oracle::radiance(&receiver, 10.0 * view, &[light], settings).x;
                *errors += (value - truth).powi(2);
            }
        }
        let errors = errors.map(|pair| pair.map(|error| (error / truths).sqrt()));
        println!("{degrees}°: {errors:.4?}");
        for [bands, transformed] in errors {
            assert!(bands > 0.85 && transformed < 0.01, "{degrees}°: {bands} {transformed}");
        }
    }
}

#[test]
fn kernels_know_them_where_there_are_some() {
    let wide = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let narrow = ReceiverKinds { narrow: true, ..wide };
    for settings in all_settings() {
        let kept = Settings { narrow: Narrow::Keep, ..settings };
        let text = |kinds, settings| linked_shader(kinds, settings).expect("links").wgsl;
        assert_eq!(text(wide, &settings), text(wide, &kept));
        assert_eq!(text(narrow, &kept), text(wide, &kept));
        assert!(!text(wide, &settings).contains("transformed"));
        assert!(text(narrow, &settings).contains("signed_irradiance"));
    }
}

#[test]
fn pictures_and_what_is_declined() {
    let mut scene = scene(5);
    let narrow = scene.materials.iter().position(|material| material.roughness == 0.3);
    let narrow = narrow.expect("the lacquer of trio");
    scene.materials[narrow].roughness = 0.15;
    let (lights, eye) = (&scene.area_lights, scene.cameras[0].position.as_dvec3());
    for (word, approximation) in
        [("exact", exact(Edges::Shared)), ("main", settings(TriangleForm::Main))]
    {
        let texts = [("narrow", "ltc"), ("approximation", word)];
        let (image, surfaces) = render(&scene, [24, 18], &texts, DIRECT).expect("a picture");
        let settings = Settings { narrow: Narrow::Transformed, ..approximation };
        let truth = |surface| oracle::radiance(surface, eye, lights, &settings).max(DVec3::ZERO);
        let truths: Vec<_> = surfaces.iter().map(truth).collect();
        let peak = truths.iter().map(|truth| truth.max_element()).fold(0.0, f64::max);
        for (&pixel, truth) in image.pixels.iter().zip(&truths) {
            let error = (Vec3::from(pixel).as_dvec3() - truth).abs().max_element() / peak;
            assert!(error < 5e-5, "{word}: {pixel:?} for {truth}: {error:e}");
        }
    }
    scene.materials[narrow].given = Some(dielectric(0.15));
    declined(&scene, "other than GGX with Schlick's Fresnel term");
}

fn declined(scene: &Scene, words: &str) {
    match render(scene, [16, 12], &[("narrow", "ltc")], DIRECT) {
        Err(Error::Declined(reason)) => assert!(reason.contains(words), "{reason}"),
        other => panic!("{:?}", other.map(|_| "rendered")),
    }
}
