//! Polygons cut into triangles: shared edges, own edges and the whole.

use crate::common::{GPU, exact, glossy, metal, oblique};
use crate::exact::{CAMERA, receivers, worst};
use glam::Vec3;
use manylights_polygonal_light::{Edges, gather};
use manylights_scene::{AreaLight, Brdf};

/// A square of diameter 1 about the origin, of so many cells a side, two triangles each.
fn square(cells: u32, two_sided: bool, radiance: impl Fn(u32, u32) -> Vec3) -> Vec<AreaLight> {
    let place = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|i| (i as f32 / cells as f32 - 0.5) * 0.5_f32.sqrt());
        oblique(Vec3::new(x, y, 0.1))
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

/// A texture with all frequencies.
fn texture(x: u32, y: u32) -> Vec3 {
    let any = |k: u32| {
        (0.1 + ((x * 7 + y * 13 + k).wrapping_mul(2_654_435_761) >> 8) as f32 / (1 << 24) as f32)
            * 2.0
    };
    Vec3::new(any(0), any(1), any(2))
}

#[test]
fn a_square_cut_into_triangles_is_the_square() {
    let whole = square(1, true, |_, _| Vec3::ONE);
    let cut = square(18, true, |_, _| Vec3::ONE);
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), metal(0.4)] {
        for distance in [0.3, 1.0, 3.0, 7.8, 8.2, 30.0, 300.0] {
            let surfaces = receivers(brdf, distance, 60);
            let of = |lights: &[AreaLight], edges| {
                gather(&GPU, &surfaces, CAMERA, lights, &exact(edges)).expect("a gather")
            };
            let truth = of(&whole, Edges::Shared);
            let peak = truth.as_flattened().iter().copied().fold(0.0, f32::max);
            for (found, bound) in [
                (of(&cut, Edges::Shared), 1e-5),
                (of(&whole, Edges::Own), 2e-5),
                (of(&cut, Edges::Own), 1e-4),
            ] {
                let pairs = found.as_flattened().iter().zip(truth.as_flattened());
                let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) / peak;
                println!("{distance}: {worst:.1e}");
                assert!(worst < bound, "{distance}: {worst:e}");
            }
            let error = worst(&surfaces, &whole, &exact(Edges::Shared));
            assert!(error < 2e-5, "{distance}: {error:e}");
        }
    }
}

#[test]
fn textured_groups_are_their_triangles() {
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.4)] {
        for two_sided in [false, true] {
            let lights = square(6, two_sided, texture);
            for distance in [0.3, 1.0, 7.8, 8.2, 40.0, 300.0] {
                let surfaces = receivers(brdf, distance, 40);
                for edges in [Edges::Own, Edges::Shared] {
                    let error = worst(&surfaces, &lights, &exact(edges));
                    println!("{distance}, {edges:?}: {error:.1e}");
                    assert!(error < 1e-4, "{distance}, {edges:?}: {error:e}");
                }
            }
        }
    }
}

/// A panel as figure 3.13 has it: 5 000 triangles, within what every device offers.
#[test]
fn a_panel_of_fifty_by_fifty_texels() {
    let lights = square(50, false, texture);
    assert_eq!(lights.len(), 5000);
    for distance in [0.5, 3.0, 7.9, 8.1, 20.0] {
        let surfaces = receivers(glossy(0.5), distance, 8);
        let error = worst(&surfaces, &lights, &exact(Edges::Shared));
        println!("{distance}: {error:.1e}");
        assert!(error < 1e-4, "{distance}: {error:e}");
    }
}
