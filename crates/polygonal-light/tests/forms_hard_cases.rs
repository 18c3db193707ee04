//! Nothing non-finite, no digits lost: where points touch, meet, leave or lie behind triangles.

use std::f64::consts::PI;

use crate::common::{GPU, glossy, metal, oblique, settings, spiral, surface};
use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_polygonal_light::{Settings, TriangleForm, gather, oracle};
use manylights_scene::{AreaLight, Brdf};

const CAMERA: Vec3 = Vec3::new(0.6, 1.0, -0.2);

/// A triangle about the origin of about this size; its front is y.
fn triangle(size: f32, two_sided: bool) -> AreaLight {
    let corners = [[-0.4, 0.05, -0.3], [0.02, 0.07, 0.6], [0.5, -0.02, -0.2]];
    with(corners.map(|corner| size * oblique(Vec3::from(corner))), two_sided)
}

fn with(corners: [Vec3; 3], two_sided: bool) -> AreaLight {
    AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided }
}

fn center(light: &AreaLight) -> Vec3 {
    let AreaLight::Triangle { corners: [a, b, c], .. } = *light else { panic!("no triangle") };
    ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3()
}

/// Of receivers at these places with a normal, seen from one direction.
fn radiance(
    (places, normal): (&[Vec3], Vec3),
    brdf: Brdf,
    lights: &[AreaLight],
    settings: &Settings,
) -> (Vec<SurfaceRecord>, Vec<Vec3>) {
    let surfaces: Vec<_> = places.iter().map(|&place| surface(place, normal, brdf)).collect();
    let pixels = gather(&GPU, &surfaces, 1e8 * CAMERA, lights, settings).expect("a gather");
    (surfaces, pixels.into_iter().map(Vec3::from).collect())
}

/// Largest difference to the oracle over the largest value of it.
fn worst(
    (places, normal): (&[Vec3], Vec3),
    brdf: Brdf,
    lights: &[AreaLight],
    settings: &Settings,
) -> f64 {
    let (surfaces, pixels) = radiance((places, normal), brdf, lights, settings);
    let camera = 1e8 * CAMERA.as_dvec3();
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    for (surface, pixel) in surfaces.iter().zip(pixels) {
        let truth = oracle::radiance(surface, camera, lights, settings);
        assert!(pixel.is_finite(), "{settings:?} at {}: {pixel}", surface.position);
        largest = largest.max(truth.abs().max_element());
        worst = worst.max((pixel.as_dvec3() - truth).abs().max_element());
    }
    assert!(largest > 0.0, "{settings:?}: nothing arrives");
    worst / largest
}

/// From a tenth to ten thousand sizes in all directions, those within a degree of the triangle's plane
/// left out, where forms have a step or a kink.
#[test]
fn every_distance_and_orientation() {
    for form in TriangleForm::ALL {
        for two_sided in [false, true] {
            let light = triangle(1.0, two_sided);
            let AreaLight::Triangle { corners: [a, b, c], .. } = light else { unreachable!() };
            let normal = (b - a).cross(c - a).normalize();
            for distance in [0.1, 0.4, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4_f32] {
                let toward = (0..300).map(|i| spiral(i, 300, -1.0).as_vec3());
                let toward = toward.filter(|toward| toward.dot(normal).abs() > 0.02);
                let places: Vec<_> =
                    toward.map(|toward| center(&light) + distance * toward).collect();
                for brdf in [Brdf::lambert(Vec3::ONE), metal(0.5)] {
                    for receiver in [Vec3::Y, Vec3::new(0.6, 0.64, 0.48)] {
                        let settings = settings(form);
                        let worst = worst((&places, receiver), brdf, &[light], &settings);
                        println!("{form:?} {two_sided} {distance}: {worst:.1e}");
                        assert!(worst < 1e-5, "{form:?} {two_sided} {distance}: {worst:e}");
                    }
                }
            }
        }
    }
}

/// From below an atom's to beyond a planet's.
#[test]
fn the_unit_of_length_does_not_matter() {
    let places: Vec<_> = (0..50).map(|i| 1.3 * spiral(i, 50, -1.0).as_vec3()).collect();
    for form in TriangleForm::ALL {
        let at = |size: f32| {
            let places: Vec<_> = places.iter().map(|&place| size * place).collect();
            let light = triangle(size, true);
            let receivers = (&places[..], Vec3::Y);
            radiance(receivers, Brdf::lambert(Vec3::ONE), &[light], &settings(form)).1
        };
        let metre = at(1.0);
        let largest = metre.iter().map(|pixel| pixel.x).fold(0.0, f32::max);
        assert!(largest > 0.0);
        for size in [1e-10, 1e-3, 1e6, 1e11] {
            for (pixel, metre) in at(size).into_iter().zip(&metre) {
                let error = (pixel.x - metre.x).abs() / largest;
                assert!(error < 2e-6, "{form:?} {size}: {error:e}");
            }
        }
    }
}

/// At corners, on edges, inside and outside in the plane, at the centroid, and a last place beside each of
/// them; small triangles and needles as well.
#[test]
fn nothing_is_ever_non_finite() {
    let needle = |length: f32| {
        let corners = [Vec3::ZERO, Vec3::new(length, 0.0, 0.0), Vec3::new(0.3, 0.0, -1e-6)];
        corners.map(oblique)
    };
    let whole = |size: f32| {
        let AreaLight::Triangle { corners, .. } = triangle(size, true) else { unreachable!() };
        corners
    };
    for corners in [whole(1.0), whole(1e-10), whole(1e9), needle(1.0), needle(1e4)] {
        let [a, b, c] = corners;
        let middle = center(&with(corners, true));
        let inside = [a, b, c, (a + b) / 2.0, b.lerp(c, 0.3), middle, a.lerp(middle, 0.5)];
        let places: Vec<_> = inside
            .into_iter()
            .chain([2.0 * b - a, 3.0 * c - 2.0 * b])
            .flat_map(|place| [0.0, 1e-7, -1e-7, 1e-3].map(|up| place * (1.0 + up) + up * Vec3::Y))
            .collect();
        for form in TriangleForm::ALL {
            for two_sided in [false, true] {
                let lights = [with(corners, two_sided)];
                for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.4)] {
                    let pixels = radiance((&places, Vec3::Y), brdf, &lights, &settings(form)).1;
                    for (place, pixel) in places.iter().zip(pixels) {
                        assert!(pixel.is_finite(), "{form:?} {corners:?} at {place}: {pixel}");
                        // Nothing is brighter than a sky of that radiance but by what bands ring.
                        let bright = pixel.abs().max_element();
                        let most = if form == TriangleForm::Point { 15.0 } else { 2.0 };
                        assert!(bright < most, "{form:?} {corners:?} at {place}: {pixel}");
                    }
                }
            }
        }
    }
}

/// Not a bit of light behind a one-sided triangle, nor of one without an area.
#[test]
fn no_light_from_behind_or_of_nothing() {
    let behind: Vec<_> =
        (0..64).map(|i| oblique(spiral(i, 64, 0.1).as_vec3() - 1.2 * Vec3::Z)).collect();
    let flat = [
        with([Vec3::Y; 3], true),
        with([Vec3::Y, 2.0 * Vec3::Y, 4.0 * Vec3::Y], true),
        with([Vec3::X, Vec3::X + Vec3::Y, Vec3::X], true),
    ];
    let turned = |corners: [Vec3; 3]| with(corners.map(oblique), false);
    // Its front is z.
    let light = turned([Vec3::X, Vec3::Y, -Vec3::X - Vec3::Y]);
    for form in TriangleForm::ALL {
        for lights in [&[light][..], &flat] {
            let brdf = Brdf::lambert(Vec3::ONE);
            let pixels = radiance((&behind, oblique(Vec3::Z)), brdf, lights, &settings(form)).1;
            assert!(pixels.iter().all(|&pixel| pixel == Vec3::ZERO), "{form:?}: {pixels:?}");
        }
    }
}

/// A point at the centroid of a sphere of either side sees the hemisphere about its normal, of which a Lambertian
/// surface reflects all; the main form sees the triangle edge-on.
#[test]
fn at_the_centroid() {
    // Whose centroid is a float.
    let light = with([Vec3::X, Vec3::Z, -Vec3::X - Vec3::Z], true);
    let of = |form| {
        let receiver = (&[Vec3::ZERO][..], Vec3::Y);
        let brdf = Brdf::lambert(Vec3::ONE);
        let (_, pixels) = radiance(receiver, brdf, &[light], &settings(form));
        f64::from(pixels[0].x)
    };
    for form in [TriangleForm::Sphere, TriangleForm::SolidAngle, TriangleForm::Scaled] {
        assert!((of(form) - 1.0).abs() < 1e-6, "{form:?}: {}", of(form));
    }
    for form in [TriangleForm::Main, TriangleForm::Compromise, TriangleForm::CompromiseRoot] {
        assert_eq!(of(form), 0.0, "{form:?}");
    }
    // Σ_l A_l (2l + 1)/4π of nine bands times 2π, over π.
    let mut scales = [0.0; 9];
    manylights_harmonics::clamped_cosine::scales(&mut scales);
    let terms = scales.iter().enumerate().map(|(l, scale)| scale * (2 * l + 1) as f64);
    let truth = terms.sum::<f64>() / (2.0 * PI);
    assert!((of(TriangleForm::Point) - truth).abs() < 1e-5, "{}", of(TriangleForm::Point));
}

/// A two-sided triangle is as bright from behind as its mirror image from the front.
#[test]
fn both_sides_shine_alike() {
    let light = triangle(0.8, true);
    let AreaLight::Triangle { corners: [a, b, c], .. } = light else { unreachable!() };
    let places: Vec<_> = (0..64).map(|i| 1.5 * spiral(i, 64, -1.0).as_vec3()).collect();
    for form in TriangleForm::ALL {
        let of = |light| {
            let brdf = glossy(0.5);
            radiance((&places, Vec3::Y), brdf, &[light], &settings(form)).1
        };
        let turned = of(with([a, c, b], true));
        for (pixel, turned) in of(light).into_iter().zip(turned) {
            let error = (pixel - turned).abs().max_element();
            assert!(error < 1e-6, "{form:?}: {pixel} {turned}");
        }
        // Each side alone, and no place sees both.
        let sides = of(with([a, b, c], false)).into_iter().zip(of(with([a, c, b], false)));
        for (pixel, (front, back)) in of(light).into_iter().zip(sides) {
            assert!((pixel - front - back).abs().max_element() < 1e-6, "{form:?}");
            assert!(front == Vec3::ZERO || back == Vec3::ZERO, "{form:?}: {front} {back}");
        }
    }
}

/// Along paths of steps of half a hundredth of a size: into the sphere about the centroid, across the plane of a
/// two-sided triangle beside it, and where the triangle sinks below the receiver's horizon.
#[test]
fn nothing_jumps() {
    let light = triangle(1.0, true);
    let AreaLight::Triangle { corners: [a, b, c], .. } = light else { unreachable!() };
    let (up, across) = ((b - a).cross(c - a).normalize(), (b - a).normalize());
    let middle = center(&light);
    let toward = (up + 0.4 * across).normalize();
    let path = |of: &dyn Fn(f32) -> Vec3| (0..200).map(|i| of(0.005 * i as f32)).collect();
    let paths: [(&str, Vec<Vec3>, Vec3, f32); 3] = [
        // Outside the sphere its cap shrinks by 0.17 rad in the first step.
        ("into the sphere", path(&|t| middle + (1.01 - t) * toward), Vec3::Y, 0.1),
        ("across the plane", path(&|t| middle + 1.5 * across + (t - 0.5) * up), across, 0.04),
        ("below the horizon", path(&|t| middle + 1.3 * up + (t - 0.5) * across), across, 0.03),
    ];
    for (name, places, normal, most) in &paths {
        for form in TriangleForm::ALL {
            for brdf in [Brdf::lambert(Vec3::ONE), glossy(0.5)] {
                let receivers = (&places[..], -*normal);
                let (_, pixels) = radiance(receivers, brdf, &[light], &settings(form));
                let largest = pixels.iter().map(|pixel| pixel.x).fold(0.0, f32::max);
                assert!(largest > 0.0, "{name}: nothing arrives");
                let steps = pixels.windows(2).map(|pair| (pair[1].x - pair[0].x).abs() / largest);
                let step = steps.fold(0.0, f32::max);
                println!("{name} {form:?}: {step:.4}");
                assert!(step < *most, "{name} {form:?}: {step}");
            }
        }
    }
}
