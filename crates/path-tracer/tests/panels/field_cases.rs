//! What others met with lights of some extent, in closed form: panels through surfaces, of any orientation,
//! and meshes with bad vertex normals.

use std::f32::consts::TAU;

use super::*;

fn lambert() -> Material {
    Material::lambert("floor", Vec3::splat(ALBEDO))
}

/// Half above and half below a floor: points next to the cut see the panel under half of their hemisphere,
/// however near they are, and points drawn on it have unbounded weights.
#[test]
fn a_panel_through_the_floor_does_not_speckle() {
    let upright =
        [(-0.4, -0.5), (0.4, -0.5), (0.4, 0.5), (-0.4, 0.5)].map(|(x, y)| Vec3::new(x, y, -0.13));
    let slanted = upright.map(|corner| corner + Vec3::new(0.0, 0.0, 0.8 * corner.y));
    for panel in [Panel::Light, Panel::Mesh] {
        for (name, corners) in [("upright", upright), ("slanted", slanted)] {
            let mut scene = floors(lambert());
            add_panel(&mut scene, panel, corners, true);
            let expected = closed_form(&scene, 0, &[corners], true);
            for transport in DIRECT {
                let reference = picture(&scene, 0, transport, 4096);
                let what = format!("{panel:?}, {name}, {transport}");
                assert_agrees(&what, &reference, &expected, 0.05);
            }
        }
    }
}

/// Uniform numbers without a crate.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// A rectangle between the floors, turned in any way.
    fn panel(&mut self) -> [Vec3; 4] {
        let center = Vec3::new(self.next() - 0.5, 0.8 + 0.4 * self.next(), self.next() - 0.5);
        let (z, angle) = (2.0 * self.next() - 1.0, TAU * self.next());
        let across = (1.0 - z * z).sqrt();
        let normal = Vec3::new(across * angle.cos(), z, across * angle.sin());
        let (x, y) = normal.any_orthonormal_pair();
        let (width, height) = (0.1 + 0.4 * self.next(), 0.1 + 0.4 * self.next());
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(right, up)| center + right * width * x + up * height * y)
    }
}

#[test]
fn panels_of_any_orientation_shine_from_their_sides_alone() {
    let mut numbers = Numbers(3);
    for number in 0..12 {
        let corners = numbers.panel();
        for (panel, both) in
            [(Panel::Light, false), (Panel::Light, true), (Panel::Mesh, false), (Panel::Mesh, true)]
        {
            let mut scene = floors(lambert());
            add_panel(&mut scene, panel, corners, both);
            let mut lit = 0.0;
            for camera in 0..2 {
                let expected = closed_form(&scene, camera, &[corners], both);
                for (index, transport) in DIRECT.into_iter().enumerate() {
                    let reference = picture(&scene, camera, transport, 1024);
                    let mean = mean(&reference).0;
                    let all = expected.iter().flatten().sum::<f64>() * f64::from(RADIANCE);
                    let all = all / expected.len() as f64;
                    let what = format!("{number} {panel:?} {both} {camera} {index}");
                    assert!((mean - all).abs() <= 0.01 * all + 1e-9, "{what}: {mean} {all}");
                    assert_eq!(mean == 0.0, all < 1e-12, "{what}");
                    lit += all;
                }
            }
            assert!(lit > 0.0, "{number} lights no floor: {corners:?}");
        }
    }
}

/// Vertex normals of zero, against the winding, and both in one triangle: the plane's own takes their place, on
/// what is lit and on what shines.
#[test]
fn bad_vertex_normals_change_no_picture() {
    for material in [lambert(), Material::metal("floor", Vec3::splat(0.8), 0.3)] {
        for both in [false, true] {
            let mut good = floors(material.clone());
            let mut corners = square(0.4, HEIGHT);
            corners.reverse();
            add_panel(&mut good, Panel::Mesh, corners, both);
            for transport in DIRECT.into_iter().chain([Transport::All]) {
                let expected = picture(&good, 0, transport, 64).image;
                let with = |normal: &dyn Fn(usize, Vec3) -> Vec3| {
                    let mut bad = good.clone();
                    for (index, vertex) in bad.vertices.iter_mut().enumerate() {
                        vertex.normal = normal(index, vertex.normal);
                    }
                    picture(&bad, 0, transport, 64).image
                };
                assert_eq!(with(&|_, _| Vec3::ZERO), expected, "zero, {transport}");
                assert_eq!(with(&|_, normal| -normal), expected, "flipped, {transport}");
                // Along the line where they cancel the plane's own remains.
                let mixed = with(&|index, normal| if index % 3 == 0 { -normal } else { normal });
                for (found, expected) in mixed.pixels.iter().zip(&expected.pixels) {
                    let error = (found[0] - expected[0]).abs();
                    assert!(error <= 1e-3 * expected[0], "{found:?} {expected:?}, {transport}");
                }
            }
        }
    }
}
