//! Primary lights against what `KHR_lights_punctual` and the inverse square say, in numbers.

use glam::Vec3;
use manylights_scene::light::spot_falloff;
use manylights_scene::{AreaLight, Light, content_hash, load};

fn assert_close(found: f32, expected: f32) {
    assert!((found - expected).abs() <= 2e-6 * expected, "{found}, expected {expected}");
}

/// The square of a linear ramp in the cosine, from 0 at `outer` to 1 at `inner`.
#[test]
fn edges_of_spot_lights() {
    let [inner, outer] = [0.9_f32, 0.5].map(f32::acos);
    let edge = [(0.6, 0.0625), (0.7, 0.25), (0.8, 0.5625)];
    for (cosine, expected) in edge {
        assert_close(spot_falloff(cosine, inner, outer), expected);
    }
    for (cosine, expected) in [(-1.0, 0.0), (0.49, 0.0), (0.91, 1.0), (1.0, 1.0)] {
        assert_eq!(spot_falloff(cosine, inner, outer), expected);
    }
}

/// W·sr⁻¹ over the square of the distance, times the edge of a spot; parallel light is alike everywhere.
#[test]
fn illumination_of_a_point() {
    let (position, intensity) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(8.0, 4.0, 2.0));
    let point = Vec3::new(1.0, -2.0, 3.0);
    let at = Light::Point { position, intensity }.illuminate(point);
    assert_eq!((at.to_light, at.distance), (Vec3::Y, 4.0));
    assert_eq!(at.irradiance, intensity / 16.0);

    // The axis is tilted against the point by the cosine 0.7: a quarter is left.
    let direction = Vec3::new(0.51_f32.sqrt(), -0.7, 0.0);
    let [inner, outer] = [0.9_f32, 0.5].map(f32::acos);
    let spot = Light::Spot { position, direction, intensity, inner, outer };
    assert_close(spot.illuminate(point).irradiance.x, 8.0 / 64.0);
    assert_close(spot.intensity(direction).x, 8.0);

    let parallel = Light::Directional { direction, irradiance: intensity };
    let at = parallel.illuminate(point);
    assert_eq!((at.to_light, at.irradiance), (-direction, intensity));
    assert!(at.distance.is_infinite());
}

fn triangle(corners: [Vec3; 3], radiance: Vec3, two_sided: bool) -> AreaLight {
    AreaLight::Triangle { corners, radiance, two_sided }
}

/// A picture depends on every number of a light with a surface, and on which light has it.
#[test]
fn the_content_hash_has_every_field_of_area_lights() {
    let scene = load("receivers", None).expect("built in");
    let corners = [Vec3::X, Vec3::Y, Vec3::Z];
    let lights = [
        AreaLight::Sphere { center: Vec3::ZERO, radius: 1.0, radiance: Vec3::ONE },
        AreaLight::Sphere { center: Vec3::Z, radius: 1.0, radiance: Vec3::ONE },
        AreaLight::Sphere { center: Vec3::ZERO, radius: 1.0_f32.next_up(), radiance: Vec3::ONE },
        AreaLight::Sphere { center: Vec3::ZERO, radius: 1.0, radiance: Vec3::X },
        triangle(corners, Vec3::ONE, false),
        triangle(corners, Vec3::ONE, true),
        triangle(corners, Vec3::X, false),
        triangle([Vec3::X, Vec3::Z, Vec3::Y], Vec3::ONE, false),
        triangle([Vec3::X, Vec3::Y, 2.0 * Vec3::Z], Vec3::ONE, false),
    ];
    let hash = |area_lights: &[AreaLight]| {
        let scene = manylights_scene::Scene { area_lights: area_lights.to_vec(), ..scene.clone() };
        content_hash(&scene, &scene.cameras[0])
    };
    let mut hashes: Vec<String> = lights.iter().map(|light| hash(&[*light])).collect();
    hashes.extend([hash(&[]), hash(&lights[..2]), hash(&[lights[1], lights[0]])]);
    assert_eq!(hashes[0], hash(&lights[..1]));
    let different: std::collections::HashSet<_> = hashes.iter().collect();
    assert_eq!(different.len(), hashes.len());
}
