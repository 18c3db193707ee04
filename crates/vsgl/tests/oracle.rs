//! The adapter's filter and gather against the f64 oracle.

use crate::common::{
    GPU, Picture, SETTINGS, VARIANTS, fitted, glossy, lobe, render, render_scene, surface, texel,
};
use glam::Vec3;
use manylights_gpu::{GpuFrame, SurfaceRecord};
use manylights_scene::{Brdf, Scene};
use manylights_virtual_lights::{LitTexel, lit_texels, scene_maps};
use manylights_vsgl::{
    Approximation, GaussianLight, GaussianLobe, Settings, filter_group, gather, gaussian_lights,
    oracle,
};

/// Largest difference of a pixel, relative to the picture's largest component.
fn worst(picture: &Picture) -> f64 {
    let peak = picture.oracle.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
    assert!(peak > 0.0, "black");
    let pixels = picture.image.pixels.iter().zip(&picture.oracle);
    pixels
        .map(|(pixel, truth)| (Vec3::from(*pixel).as_dvec3() - truth).abs().max_element() / peak)
        .fold(0.0, f64::max)
}

#[test]
fn pictures() {
    for scene in ["cornell", "cornell-glossy", "atrium", "trio"] {
        for settings in VARIANTS {
            let worst = worst(&render(scene, [48, 36], &settings, 0));
            println!("{scene} {settings:?}: {worst:.1e}");
            assert!(worst < 2e-5, "{scene} {settings:?}: {worst:e}");
        }
    }
}

#[test]
fn pictures_of_fitted_materials() {
    for settings in VARIANTS {
        let worst = worst(&render_scene(&fitted("trio"), [48, 36], &settings, 0));
        println!("trio, fitted, {settings:?}: {worst:.1e}");
        assert!(worst < 2e-5, "{settings:?}: {worst:e}");
    }
}

/// Broad lobes about the sharpness where the integrals change from series to closed forms. The series
/// leave out 3e-6 and differences of near equals lose some 5e-6 to rounding; a series that reaches up to
/// λ = 0.5 is 1e-4 off there.
#[test]
fn broad_lobes() {
    let axis = Vec3::new(0.3, -0.9, -0.1).normalize();
    let side = axis.any_orthonormal_vector();
    let turned = |angle: f32| angle.sin() * side - angle.cos() * axis;
    // In sight of all receivers, which turn away from the light by up to 154°.
    let camera = turned(1.34);
    let receivers: Vec<_> = (-9..=10)
        .flat_map(|step| {
            let normal = turned((0.1 * step as f32).acos());
            [Brdf::lambert(Vec3::ONE), glossy(0.6)].map(|brdf| surface(Vec3::ZERO, normal, brdf))
        })
        .collect();
    for sharpness in [0.01, 0.1, 0.249, 0.251, 0.499, 0.501] {
        // The cloud is so wide that it adds 1e-6 to the sharpness.
        let diffuse = lobe(-axis, axis, sharpness, 1e6);
        let specular = GaussianLobe { power: Vec3::ZERO, ..diffuse };
        let (center, geometric_normal) = (diffuse.position, axis);
        let lights = [GaussianLight { diffuse, specular, center, geometric_normal }];
        let found = gather(&GPU, &receivers, camera, &lights, &SETTINGS).expect("a gather");
        let mut worst: f64 = 0.0;
        for (surface, found) in receivers.iter().zip(found) {
            let truth = oracle::radiance(surface, camera.as_dvec3(), &lights, &SETTINGS);
            worst = worst.max((f64::from(found[0]) / truth.x - 1.0).abs());
        }
        println!("λ = {sharpness}: {worst:.1e}");
        assert!(worst < 1e-5, "{sharpness}: {worst:e}");
    }
}

#[test]
fn same_seed_same_image_and_other_seed_other_image() {
    let first = render("trio", [32, 24], &SETTINGS, 0).image;
    assert_eq!(first, render("trio", [32, 24], &SETTINGS, 0).image);
    assert_ne!(first, render("trio", [32, 24], &SETTINGS, 1).image);
}

/// How a lobe of the adapter differs from the oracle's.
fn difference(found: &GaussianLobe, truth: &oracle::DGaussianLobe) -> f64 {
    let found = oracle::DGaussianLobe::from(found);
    let extent = (truth.variance.sqrt()).max(1e-7 * truth.position.length());
    let relative = |a: f64, b: f64| if b == 0.0 { a.abs() } else { (a / b - 1.0).abs() };
    [
        (found.power - truth.power).length() / truth.power.length(),
        (found.position - truth.position).length() / extent,
        relative(found.variance, truth.variance),
        relative(found.sharpness, truth.sharpness),
        // In units of the lobe's width.
        (found.axis - truth.axis).length() * truth.sharpness.sqrt().min(1e3),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

/// All groups of all maps, from the texels that the adapter filtered.
fn filtered_texels_of(scene: &Scene, count: u64, side: u32, lobe: Approximation) {
    let name = &scene.name;
    let frame = GpuFrame::new(&GPU, scene, &scene.cameras[0], [4, 4]).expect("fits");
    let settings = Settings { lights: count, texels: side, lobe, ..SETTINGS };
    let maps = scene_maps(&frame, scene, count, 3).expect("maps");
    let (lights, _) = gaussian_lights(&frame, scene, &maps, &settings).expect("lights");
    let mut lights = lights.into_iter();
    let mut worst: f64 = 0.0;
    for map in maps {
        let (texels, _) = lit_texels(&frame, &map.refined(side)).expect("texels");
        let surfaces: Vec<SurfaceRecord> = GPU.read(&texels.surfaces).expect("read-back");
        let texels: Vec<LitTexel> = GPU.read(&texels.texels).expect("read-back");
        let [columns, rows] = map.projection.resolution;
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |c| (row, c))) {
            let inside = (0..side * side).map(|i| {
                let (x, y) = (column * side + i % side, row * side + i / side);
                (y * columns * side + x) as usize
            });
            let group: Vec<_> = inside.map(|i| (surfaces[i], texels[i])).collect();
            let truth = oracle::filter(&group, lobe);
            if truth.iter().all(|lobe| lobe.power.max_element() == 0.0) {
                continue;
            }
            let light = lights.next().expect("as many lights");
            for (found, truth) in [light.diffuse, light.specular].iter().zip(&truth) {
                if truth.power.max_element() == 0.0 {
                    assert_eq!(found.power, Vec3::ZERO, "{name}");
                    continue;
                }
                worst = worst.max(difference(found, truth));
            }
        }
    }
    assert!(lights.next().is_none(), "{name}: more lights than groups");
    println!("{name}, {side}² texels, {lobe:?}: {worst:.1e}");
    assert!(worst < 1e-4, "{name}, {side}² texels, {lobe:?}: {worst:e}");
}

#[test]
fn filtered_texels() {
    for (name, count, side) in
        [("cornell", 150, 5), ("trio", 100, 8), ("atrium", 64, 14), ("trio", 400, 1)]
    {
        let scene = manylights_scene::load(name, None).expect("built in");
        for lobe in [Approximation::Thesis, Approximation::Filtered] {
            filtered_texels_of(&scene, count, side, lobe);
        }
    }
}

#[test]
fn filtered_texels_of_fitted_materials() {
    filtered_texels_of(&fitted("trio"), 49, 4, Approximation::Filtered);
}

/// The diffuse lobe leaves about the geometric normal, whatever shading makes of it.
#[test]
fn diffuse_lobes_leave_about_the_geometric_normal() {
    let normal = Vec3::new(0.2, 1.0, -0.1).normalize();
    let (mut surface, lit) = texel(Vec3::ZERO, normal, Vec3::Y, glossy(0.5));
    surface.normal = Vec3::new(-0.4, 1.0, 0.3).normalize();
    let texels = [(surface, lit)];
    let adapter = filter_group(&GPU, &texels, Approximation::Filtered).expect("a filter");
    let adapter = adapter.expect("a light");
    let [diffuse, _] = oracle::filter(&texels, Approximation::Filtered);
    for axis in [adapter.diffuse.axis, diffuse.axis.as_vec3()] {
        assert!(axis.distance(normal) < 1e-6, "{axis}, expected {normal}");
    }
}

/// Interpolated normals may turn away from the camera: both sides then see the surface along its
/// horizon, and neither makes light negative.
#[test]
fn views_below_the_shading_normal() {
    let camera = Vec3::new(0.0, 0.0, 1.0);
    let axis = Vec3::new(0.2, -1.0, 0.4).normalize();
    let diffuse = lobe(-2.0 * axis, axis, 2.2925, 0.04);
    let specular = GaussianLobe { sharpness: 40.0, ..diffuse };
    let (center, geometric_normal) = (diffuse.position, axis);
    let lights = [GaussianLight { diffuse, specular, center, geometric_normal }];
    let receivers: Vec<_> = (0..=8)
        .flat_map(|step| {
            let below = 0.05 * step as f32;
            let normal = Vec3::new(0.0, below.cos(), -below.sin());
            // A lobe alone: nothing else hides its sign.
            [0.1, 0.4, 0.8].map(|roughness| {
                let brdf = Brdf { diffuse: Vec3::ZERO, ..glossy(roughness) };
                surface(Vec3::ZERO, normal, brdf)
            })
        })
        .collect();
    for settings in VARIANTS {
        let found = gather(&GPU, &receivers, camera, &lights, &settings).expect("a gather");
        let truths: Vec<_> = receivers
            .iter()
            .map(|surface| oracle::radiance(surface, camera.as_dvec3(), &lights, &settings).x)
            .collect();
        let peak = truths.iter().copied().fold(0.0, f64::max);
        assert!(peak > 0.0, "{settings:?}: black");
        for (found, truth) in found.iter().zip(&truths) {
            let error = (f64::from(found[0]) - truth).abs();
            assert!(*truth >= 0.0 && error < 1e-5 * peak, "{settings:?}: {found:?} {truth}");
        }
    }
}

/// The thesis' variant sends light about the mirrored direction, with the sharpness of the distribution
/// of normals over 4 n·v, and Lambertian light in a lobe of mean length 0.5293.
#[test]
fn lobes_of_the_thesis() {
    let incoming = Vec3::new(0.8, 0.6, 0.0);
    let texels = [texel(Vec3::ZERO, Vec3::Y, incoming, glossy(0.5))];
    let light = filter_group(&GPU, &texels, Approximation::Thesis).expect("a filter");
    let light = light.expect("a light");
    let mirrored = Vec3::new(-0.8, 0.6, 0.0);
    assert!(light.specular.axis.distance(mirrored) < 1e-6, "{:?}", light.specular);
    let sharpness = (2.0 / 0.0625 - 2.0) / (4.0 * 0.6);
    assert!((light.specular.sharpness / sharpness - 1.0).abs() < 1e-5, "{:?}", light.specular);
    let blur = oracle::gaussian::blur(light.diffuse.sharpness.into());
    assert!((1.0 - blur - 0.5293165801288394).abs() < 1e-6, "{blur}");
}
