//! The adapter's filter and gather against the f64 oracle.

mod common;

use common::{GPU, LOBES, Picture, SETTINGS, render};
use glam::Vec3;
use manylights_gpu::{GpuFrame, LitTexel, SurfaceRecord, lit_texels, scene_maps};
use manylights_vsgl::{Lobe, Settings, gaussian_lights, oracle};

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
        for lobe in LOBES {
            let settings = Settings { lobe, ..SETTINGS };
            let worst = worst(&render(scene, [48, 36], &settings, 0));
            println!("{scene} {lobe:?}: {worst:.1e}");
            assert!(worst < 2e-5, "{scene} {lobe:?}: {worst:e}");
        }
    }
}

#[test]
fn same_seed_same_image_and_other_seed_other_image() {
    let first = render("trio", [32, 24], &SETTINGS, 0).image;
    assert_eq!(first, render("trio", [32, 24], &SETTINGS, 0).image);
    assert_ne!(first, render("trio", [32, 24], &SETTINGS, 1).image);
}

/// How a lobe of the adapter differs from the oracle's.
fn difference(found: &Lobe, truth: &oracle::Lobe) -> f64 {
    let found = oracle::Lobe::from(found);
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
#[test]
fn filtered_texels() {
    for (name, count, side) in
        [("cornell", 150, 5), ("trio", 100, 8), ("atrium", 64, 14), ("trio", 400, 1)]
    {
        let scene = manylights_scene::load(name, None).expect("built in");
        let frame = GpuFrame::new(&GPU, &scene, &scene.cameras[0], [4, 4]).expect("fits");
        let settings = Settings { lights: count, texels: side, ..SETTINGS };
        let (lights, _) = gaussian_lights(&frame, &scene, &settings, 3).expect("lights");
        let mut lights = lights.into_iter();
        let mut worst: f64 = 0.0;
        for map in scene_maps(&scene, count, 3) {
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
                let truth = oracle::filter(&group);
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
        println!("{name}, {side}² texels: {worst:.1e}");
        assert!(worst < 1e-4, "{name}, {side}² texels: {worst:e}");
    }
}
