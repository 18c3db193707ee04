//! Panels cut into triangles: the fewest that shine as they do, and all.

use crate::common::{GPU, glossy, metal, oblique, receivers};
use glam::Vec3;
use manylights_area_lights::Edges;
use manylights_ltc::{LightRecord, gather};
use manylights_scene::{AreaLight, Brdf};

/// A square of side 1 about the origin, of so many cells a side, two triangles each, bent along the middle or flat.
fn square(
    cells: u32,
    two_sided: bool,
    bend: f32,
    radiance: impl Fn(u32, u32) -> Vec3,
) -> Vec<AreaLight> {
    let place = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|i| i as f32 / cells as f32 - 0.5);
        oblique(Vec3::new(x, y, 0.1 + bend * x.abs()))
    };
    let cell = |(x, y)| {
        let [a, b, c, d] =
            [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| place(x, y));
        [[a, b, c], [a, c, d]].map(|corners| AreaLight::Triangle {
            corners,
            radiance: radiance(x, y),
            two_sided,
        })
    };
    (0..cells).flat_map(|y| (0..cells).map(move |x| (x, y))).flat_map(cell).collect()
}

fn equal(_: u32, _: u32) -> Vec3 {
    Vec3::new(1.0, 0.7, 0.3)
}

fn halves(x: u32, _: u32) -> Vec3 {
    if x < 2 { Vec3::ONE } else { Vec3::new(0.2, 1.0, 3.0) }
}

fn checks(x: u32, y: u32) -> Vec3 {
    Vec3::splat(if (x + y).is_multiple_of(2) { 1.0 } else { 2.5 })
}

/// Largest difference between all and the fewest over all receivers, relative to the largest radiance.
fn difference(brdf: Brdf, lights: &[AreaLight]) -> f32 {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(brdf, camera);
    let [own, shared] = [Edges::Own, Edges::Shared].map(|edges| {
        gather(&GPU, &surfaces, camera, &LightRecord::all(lights, edges)).expect("a gather")
    });
    let peak = own.as_flattened().iter().copied().fold(0.0, f32::max);
    assert!(peak > 0.0, "nothing arrives");
    let pairs = own.as_flattened().iter().zip(shared.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) / peak
}

#[test]
fn panels_are_their_triangles() {
    for (what, radiance, bend, records) in [
        ("equal", equal as fn(u32, u32) -> Vec3, 0.0, 2),
        ("halves", halves, 0.0, 4),
        ("checks", checks, 0.0, 32),
        ("a roof", equal, 0.3, 4),
    ] {
        for two_sided in [false, true] {
            let lights = square(4, two_sided, bend, radiance);
            assert_eq!(LightRecord::all(&lights, Edges::Own).len(), 32);
            assert_eq!(LightRecord::all(&lights, Edges::Shared).len(), records, "{what}");
            for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3)] {
                let worst = difference(brdf, &lights);
                println!("{what}, {two_sided}, {:?}: {worst:.1e}", brdf.alpha);
                assert!(worst < 1e-5, "{what}, {two_sided}, {brdf:?}: {worst:e}");
            }
        }
    }
}

#[test]
fn a_square_of_648_triangles_is_two() {
    let lights = square(18, false, 0.0, equal);
    assert_eq!(lights.len(), 648);
    let merged = LightRecord::all(&lights, Edges::Shared);
    assert_eq!(merged.len(), 2);
    let area = |light: &LightRecord| 0.5 * light.first.cross(light.second).length();
    assert!((merged.iter().map(area).sum::<f32>() - 1.0).abs() < 1e-6);
    let worst = difference(metal(0.4), &lights);
    assert!(worst < 2e-5, "{worst:e}");
}

/// Of lights of which none shines nothing is left to sum.
#[test]
fn black_panels_and_spheres_among_them() {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(glossy(0.4), camera);
    let mut lights = square(1, false, 0.0, |_, _| Vec3::ZERO);
    let of = |lights: &[AreaLight]| {
        let records = LightRecord::all(lights, Edges::Shared);
        (records.len(), gather(&GPU, &surfaces, camera, &records).expect("a gather"))
    };
    let (count, dark) = of(&lights);
    assert_eq!(count, 0);
    assert!(dark.as_flattened().iter().all(|value| *value == 0.0));
    let sphere = AreaLight::Sphere { center: Vec3::ZERO, radius: 0.1, radiance: Vec3::ONE };
    lights.push(sphere);
    assert_eq!(of(&lights), of(&[sphere]));
}
