//! Lights that are seen from where estimators divide by zero, if they do not take care.

use super::*;

const PIXEL: usize = 6 * 12 + 6;

/// What the pixel sees of a floor under one light: the same for the same seed.
fn pixel(material: &Material, light: AreaLight, visibility: Visibility, what: &str) -> [f32; 3] {
    let scene = floor(material.clone(), &[light]);
    let [reference, again] = [(); 2].map(|()| direct(&scene, visibility, 64).expect(what));
    assert_eq!(reference.image, again.image, "{what}: same seed, same picture");
    reference.image.pixels[PIXEL]
}

/// On a Lambertian floor and on metal, in both visibilities.
fn in_all_ways(check: impl Fn(&Material, Visibility)) {
    for material in [lambert(), Material::metal("floor", ALBEDO, 0.1)] {
        for visibility in VISIBILITIES {
            check(&material, visibility);
        }
    }
}

fn point() -> [f32; 3] {
    let (point, _) = seen(&floor(lambert(), &[]))[PIXEL].expect("the floor is seen");
    assert_eq!(point.y, 0.0);
    point.to_array()
}

/// Inside, at the very centre and on the surface; through the receiver; far.
#[test]
fn spheres_around_the_receiver_shine() {
    let [x, y, z] = point();
    let cases = [
        ("centre", sphere([x, y, z], 0.5)),
        ("inside", sphere([x, 0.1, z], 0.5)),
        ("just inside", sphere([x, 0.499_999_97, z], 0.5)),
        ("surface", sphere([x, 0.5, z], 0.5)),
        ("through", sphere([x + 0.3, 0.0, z], 0.2)),
        ("far", sphere([x, 1e18, z], 1e10)),
    ];
    in_all_ways(|material, visibility| {
        for (what, light) in cases {
            let pixel = pixel(material, light, visibility, what);
            let shines = |value: &f32| value.is_finite() && *value > 0.0;
            assert!(pixel.iter().all(shines), "{what}, {visibility}: {pixel:?}");
        }
    });
}

/// Below the horizon, from behind, and wherever the receiver lies in the plane of a triangle.
#[test]
fn what_shows_no_front_above_the_horizon_is_dark() {
    let [x, y, z] = point();
    let at = |offsets: [[f32; 3]; 3]| triangle(offsets.map(|[a, b, c]| [x + a, y + b, z + c]));
    let cases = [
        ("sphere below", sphere([x, -0.5, z], 0.4)),
        ("sphere whose light f32 does not hold", sphere([x, 0.5, z], 1e-30)),
        ("triangle below", at([[-0.3, -0.5, -0.3], [0.4, -0.4, -0.2], [0.1, -0.6, 0.5]])),
        ("on the floor, around", at([[-0.1, 0.0, -0.1], [0.3, 0.0, 0.0], [0.0, 0.0, 0.2]])),
        ("on the floor, beside", at([[0.1, 0.0, 0.1], [0.3, 0.0, 0.0], [0.2, 0.0, 0.4]])),
        ("corner", at([[0.0; 3], [0.3, 0.2, 0.0], [0.0, 0.3, 0.2]])),
        ("edge", at([[-0.2, 0.0, 0.0], [0.3, 0.0, 0.0], [0.1, 0.4, 0.2]])),
        ("edge-on, across", at([[-0.4, -0.3, 0.0], [0.5, -0.2, 0.0], [0.1, 0.6, 0.0]])),
        ("edge-on, beside", at([[0.2, 0.1, 0.0], [0.5, 0.2, 0.0], [0.3, 0.6, 0.0]])),
    ];
    let both_sides = cases.iter().flat_map(|&(what, light)| [(what, light), (what, turned(light))]);
    let all: Vec<_> = both_sides.chain([("back", turned(triangle(ABOVE)))]).collect();
    in_all_ways(|material, visibility| {
        for &(what, light) in &all {
            let pixel = pixel(material, light, visibility, what);
            assert_eq!(pixel, [0.0; 3], "{what}, {visibility}");
        }
    });
}

/// Shows its other side.
fn turned(light: AreaLight) -> AreaLight {
    match light {
        AreaLight::Triangle { corners: [a, b, c], radiance, two_sided } => {
            AreaLight::Triangle { corners: [a, c, b], radiance, two_sided }
        }
        sphere => sphere,
    }
}
