//! Direct light from lights with a surface against closed forms and quadrature.

mod few_samples;
mod hard_cases;

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3};
use manylights_method::{Error as MethodError, Frame, Method, Parameters};
use manylights_path_tracer::{Error, PathTracer, Reference, Settings, render};
use manylights_paths::closed_form::{polygon_irradiance, sphere_irradiance};
use manylights_scene::bvh::{Bvh, Ray};
use manylights_scene::{
    AreaLight, Camera, DBrdf, Material, Scene, Transport, Triangle, Vertex, Visibility,
};

const RESOLUTION: [u32; 2] = [12, 12];
const RADIANCE: Vec3 = Vec3::new(3.0, 2.0, 0.5);
const ALBEDO: Vec3 = Vec3::new(0.8, 0.5, 0.3);
const VISIBILITIES: [Visibility; 2] = [Visibility::Traced, Visibility::Ignored];

/// A square floor of half side 1 at height 0, seen from above at a slant.
fn floor(material: Material, lights: &[AreaLight]) -> Scene {
    let mut scene = Scene { area_lights: lights.to_vec(), ..Scene::default() };
    scene.materials = vec![material];
    add_square(&mut scene, 1.0, 0.0, 0);
    let eye = Vec3::new(0.3, 1.8, 2.0);
    scene.cameras.push(Camera::look_at("eye", eye, Vec3::ZERO, Vec3::Y, 0.6));
    scene
}

fn add_square(scene: &mut Scene, half: f32, height: f32, material: u32) {
    let first = scene.vertices.len() as u32;
    scene.vertices.extend([(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| {
        let position = Vec3::new(half * x, height, half * z);
        Vertex { position, normal: Vec3::Y, uv: Vec2::ZERO }
    }));
    for vertices in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        scene.triangles.push(Triangle { vertices, material });
    }
}

fn lambert() -> Material {
    Material::lambert("floor", ALBEDO)
}

fn sphere(center: [f32; 3], radius: f32) -> AreaLight {
    AreaLight::Sphere { center: center.into(), radius, radiance: RADIANCE }
}

fn triangle(corners: [[f32; 3]; 3]) -> AreaLight {
    let corners = corners.map(Vec3::from);
    AreaLight::Triangle { corners, radiance: RADIANCE, two_sided: false }
}

fn direct(scene: &Scene, visibility: Visibility, samples: u32) -> Result<Reference, Error> {
    let transport = Transport::Direct { visibility };
    let settings = Settings { transport, resolution: RESOLUTION, seed: 7, samples };
    render(scene, &scene.cameras[0], &settings, None, &mut |_| {})
}

/// What each pixel's centre sees of the floor: point, direction to the viewer.
fn seen(scene: &Scene) -> Vec<Option<(Vec3, Vec3)>> {
    let (bvh, camera) = (Bvh::build(scene), &scene.cameras[0]);
    let pixels = (0..RESOLUTION[0] * RESOLUTION[1]).map(|index| {
        let direction = camera.direction(index % RESOLUTION[0], index / RESOLUTION[0], RESOLUTION);
        let hit = bvh.closest(&Ray::new(camera.position, direction))?;
        Some((scene.surface(hit.triangle, hit.u, hit.v, direction).position, -direction))
    });
    pixels.collect()
}

/// Each pixel within six of its own estimated standard deviations (of 63 degrees of freedom), the sum of
/// all within four; and the noise is below `noise` of the sum, so that it hides nothing.
fn assert_agrees(what: &str, reference: &Reference, expected: &[DVec3], noise: f64) {
    let (mut total, mut expected_total, mut variance) = (0.0, 0.0, 0.0);
    let mut worst = 0.0_f64;
    for (index, expected) in expected.iter().enumerate() {
        for channel in 0..3 {
            let value = f64::from(reference.image.pixels[index][channel]);
            let pixel_variance = f64::from(reference.variance.pixels[index][channel]);
            // What f32 leaves of sums without noise: 2⁻²⁴ of each slice.
            let rounding = 2e-6 * expected[channel];
            let error = (value - expected[channel]).abs();
            let limit = 6.0 * pixel_variance.sqrt() + rounding;
            worst = worst.max(error / limit);
            assert!(error <= limit, "{what}, pixel {index}: {value}, expected {expected}: {limit}");
            total += value;
            expected_total += expected[channel];
            variance += pixel_variance;
        }
    }
    // The channels of a pixel share their noise.
    let deviation = (3.0 * variance).sqrt();
    println!("{what}: {total} ± {deviation}, expected {expected_total}; worst pixel {worst}");
    assert!(deviation < noise * expected_total, "{what}: {deviation} of {expected_total}");
    let error = (total - expected_total).abs();
    assert!(error <= 4.0 * deviation + 2e-6 * expected_total, "{what}: {total} {expected_total}");
}

fn irradiance(light: &AreaLight, point: Vec3) -> f64 {
    let point = point.as_dvec3();
    match *light {
        AreaLight::Sphere { center, radius, .. } => {
            let offset = center.as_dvec3() - point;
            let distance = offset.length();
            let cosine = if distance == 0.0 { 1.0 } else { offset.y / distance };
            sphere_irradiance(cosine, f64::from(radius) / distance)
        }
        AreaLight::Triangle { corners, .. } => {
            let corners = corners.map(|corner| (corner.as_dvec3() - point).to_array());
            polygon_irradiance([0.0, 1.0, 0.0], &corners)
        }
    }
}

/// Faces the floor, above it.
const ABOVE: [[f32; 3]; 3] = [[-0.4, 0.6, -0.3], [0.7, 0.8, -0.2], [0.1, 0.5, 0.6]];
/// Crosses the floor's plane.
const CROSSING: [[f32; 3]; 3] = [[-0.9, -0.5, -0.9], [0.9, -0.2, -0.8], [0.1, 0.9, -1.0]];

#[test]
fn lambertian_floors_have_the_irradiance_of_closed_forms() {
    let cases = [
        ("sphere", sphere([0.2, 0.7, -0.1], 0.3)),
        ("tiny sphere", sphere([0.2, 0.7, -0.1], 1e-4)),
        ("far sphere", sphere([2e3, 7e3, -1e3], 900.0)),
        ("sphere through the floor", sphere([0.2, 0.05, -0.1], 0.4)),
        ("sphere that stands on the horizon", sphere([0.0, -0.1, -1.6], 0.5)),
        ("sphere around all", sphere([0.3, 0.5, 0.2], 30.0)),
        ("triangle", triangle(ABOVE)),
        ("tiny triangle", triangle(ABOVE.map(|corner| [0, 1, 2].map(|k| 0.7 + 1e-3 * corner[k])))),
        ("triangle through the floor's plane", triangle(CROSSING)),
        (
            "huge triangle",
            triangle([[-300.0, 0.3, -300.0], [300.0, 0.3, -200.0], [0.0, 0.4, 400.0]]),
        ),
    ];
    for (what, light) in cases {
        let scene = floor(lambert(), &[light]);
        let pixels = seen(&scene);
        let color = (ALBEDO * RADIANCE).as_dvec3() / PI;
        let expected: Vec<_> = pixels
            .iter()
            .map(|pixel| pixel.map_or(DVec3::ZERO, |(point, _)| color * irradiance(&light, point)))
            .collect();
        for visibility in VISIBILITIES {
            let reference = direct(&scene, visibility, 1024).expect("a picture");
            assert_agrees(&format!("{what}, {visibility}"), &reference, &expected, 0.01);
        }
    }
}

/// Directions and weights, sr: cells of a light's own area, or of a sphere's cap, in f64.
fn quadrature(light: &AreaLight, point: DVec3) -> Vec<(DVec3, f64)> {
    const CELLS: u32 = 300;
    let cells = (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j)));
    let cells = cells.map(|(i, j)| [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(CELLS)));
    let cell = 1.0 / f64::from(CELLS * CELLS);
    match *light {
        AreaLight::Sphere { center, radius, .. } => {
            let offset = center.as_dvec3() - point;
            let (axis, sine) = (offset.normalize(), f64::from(radius) / offset.length());
            let height = 1.0 - (1.0 - sine * sine).sqrt();
            let (x, y) = axis.any_orthonormal_pair();
            let direction = |[u, v]: [f64; 2]| {
                let z = 1.0 - height * v;
                let (sin, cos) = (TAU * u).sin_cos();
                ((1.0 - z * z).sqrt() * (cos * x + sin * y) + z * axis, TAU * height * cell)
            };
            cells.map(direction).collect()
        }
        AreaLight::Triangle { corners, .. } => {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3() - point);
            let front = (b - a).cross(c - a);
            let direction = |[u, v]: [f64; 2]| {
                let at = a + u * ((1.0 - v) * (b - a) + v * (c - a));
                let weight = u * cell * (-front.dot(at)).max(0.0) / at.length().powi(3);
                (at.normalize(), weight)
            };
            cells.map(direction).collect()
        }
    }
}

/// Of the pixels of a floor under one light.
fn by_quadrature(scene: &Scene, light: &AreaLight) -> Vec<DVec3> {
    let brdf: DBrdf = scene.materials[0].brdf(ALBEDO).into();
    let radiance = |pixel: Option<(Vec3, Vec3)>| {
        let Some((point, viewer)) = pixel else { return DVec3::ZERO };
        let term = |(direction, weight): (DVec3, f64)| {
            brdf.eval(DVec3::Y, viewer.as_dvec3(), direction) * direction.y.max(0.0) * weight
        };
        let cells = quadrature(light, point.as_dvec3());
        RADIANCE.as_dvec3() * cells.into_iter().map(term).sum::<DVec3>()
    };
    seen(scene).into_iter().map(radiance).collect()
}

/// No light is so near that midpoint cells of 1/300 of it do not suffice.
#[test]
fn glossy_floors_agree_with_quadrature() {
    let lights = [
        ("sphere", sphere([0.2, 0.5, -0.9], 0.25)),
        ("small sphere", sphere([-0.2, 0.7, -1.0], 0.02)),
        ("sphere on the horizon", sphere([0.2, 0.1, -1.5], 0.4)),
        ("triangle", triangle(ABOVE)),
        ("triangle through the floor's plane", triangle(CROSSING.map(|[x, y, z]| [x, y, z - 0.4]))),
    ];
    let materials = [
        Material::metal("floor", ALBEDO, 0.3),
        Material::glossy("floor", ALBEDO, 0.5),
        Material::metal("floor", ALBEDO, 1.0),
    ];
    for ((what, light), material) in
        lights.iter().flat_map(|light| materials.iter().map(move |material| (light, material)))
    {
        let scene = floor(material.clone(), &[*light]);
        let expected = by_quadrature(&scene, light);
        for visibility in VISIBILITIES {
            let what = format!("{what}, roughness {}, {visibility}", material.roughness);
            let reference = direct(&scene, visibility, 1024).expect("a picture");
            assert_agrees(&what, &reference, &expected, 0.01);
        }
    }
}

/// A light is the same whoever else shines, and where lights overlap they add.
#[test]
fn overlapping_lights_add() {
    let [a, b] = [sphere([0.2, 0.5, -0.1], 0.3), sphere([0.1, 0.6, -0.2], 0.25)];
    let c = triangle(ABOVE);
    for material in [lambert(), Material::glossy("floor", ALBEDO, 0.3)] {
        for visibility in VISIBILITIES {
            let picture = |lights: &[AreaLight]| {
                direct(&floor(material.clone(), lights), visibility, 1024).expect("a picture")
            };
            let all = picture(&[a, b, c, a]);
            let parts = [a, a, b, c].map(|light| picture(&[light]));
            for (index, pixel) in all.image.pixels.iter().enumerate() {
                let sum: f32 = parts.iter().map(|part| part.image.pixels[index][1]).sum();
                let pictures = parts.iter().chain([&all]);
                let deviations = pictures.map(|part| part.variance.pixels[index][1].sqrt());
                // Pictures of one seed share sample points: their deviations add at worst.
                let limit = 4.0 * deviations.sum::<f32>() + 1e-5 * sum;
                assert!(
                    (pixel[1] - sum).abs() <= limit,
                    "pixel {index}: {pixel:?} {sum} ± {limit}"
                );
            }
            let total = |reference: &Reference| {
                reference.image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>()
            };
            let sum: f64 = parts.iter().map(total).sum();
            assert!((total(&all) / sum - 1.0).abs() < 0.01, "{} {sum}", total(&all));
        }
    }
}

/// From inside a sphere the hemisphere about the direction to its centre; at the centre about the normal.
#[test]
fn the_inside_of_a_sphere_is_a_hemisphere() {
    let point = seen(&floor(lambert(), &[]))[6 * 12 + 6].expect("the floor is seen").0;
    for (offset, cosine) in [(Vec3::ZERO, 1.0), (Vec3::new(0.3, 0.4, 0.0), 0.8), (Vec3::X, 0.0)] {
        let light = sphere((point + offset).to_array(), 1.5);
        for visibility in VISIBILITIES {
            let reference = direct(&floor(lambert(), &[light]), visibility, 4096).expect("finite");
            let value = f64::from(reference.image.pixels[6 * 12 + 6][0]);
            let deviation = f64::from(reference.variance.pixels[6 * 12 + 6][0]).sqrt();
            let expected = f64::from(ALBEDO.x * RADIANCE.x) * 0.5 * (1.0 + cosine);
            assert!(deviation < 0.01 * expected, "{deviation} of {expected}");
            assert!((value - expected).abs() < 4.0 * deviation, "{value} {expected} ± {deviation}");
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_an_error() {
    let sphere_of = |center: f32, radius: f32, radiance: f32| AreaLight::Sphere {
        center: Vec3::new(0.0, center, 0.0),
        radius,
        radiance: Vec3::splat(radiance),
    };
    let good = sphere([0.0, 1.0, 0.0], 0.1);
    for bad in [
        sphere_of(f32::NAN, 0.1, 1.0),
        sphere_of(f32::INFINITY, 0.1, 1.0),
        sphere_of(-1.0, f32::NAN, 1.0),
        sphere_of(1.0, f32::INFINITY, 1.0),
        sphere_of(-1.0, 0.1, f32::NAN),
        sphere_of(1.0, 0.1, f32::INFINITY),
        triangle([[f32::NAN, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]),
        triangle([[f32::INFINITY, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]),
    ] {
        for visibility in VISIBILITIES {
            for lights in [[good, bad], [bad, good]] {
                let error =
                    direct(&floor(lambert(), &lights), visibility, 16).expect_err("no picture");
                assert!(matches!(error, Error::NonFinite { .. }), "{bad:?}: {error}");
            }
        }
    }
}

/// A black board between takes the light where visibility is traced; lights take none from each other,
/// nor from what is seen.
#[test]
fn surfaces_hide_lights_and_lights_hide_nothing() {
    let [lamp, around] = [sphere([0.0, 1.0, 0.0], 0.2), sphere([0.0, 0.9, 0.0], 0.05)];
    for material in [lambert(), Material::metal("floor", ALBEDO, 0.4)] {
        let mut scene = floor(material, &[lamp]);
        let open = direct(&scene, Visibility::Traced, 256).expect("a picture");
        let green = |reference: &Reference| {
            reference.image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>()
        };
        // Dark, in front.
        let dark = AreaLight::Sphere { center: Vec3::Y * 0.5, radius: 0.3, radiance: Vec3::ZERO };
        scene.area_lights.push(dark);
        assert_eq!(direct(&scene, Visibility::Traced, 256).expect("a picture").image, open.image);
        scene.area_lights = vec![lamp, around];
        assert!(green(&direct(&scene, Visibility::Traced, 256).expect("a picture")) > green(&open));

        scene.area_lights = vec![lamp];
        scene.materials.push(Material::lambert("board", Vec3::ZERO));
        add_square(&mut scene, 5.0, 0.5, 1);
        // From below the board.
        let eye = Vec3::new(0.0, 0.4, 0.9);
        scene.cameras = vec![Camera::look_at("eye", eye, Vec3::ZERO, Vec3::Y, 0.6)];
        let hidden = direct(&scene, Visibility::Traced, 64).expect("a picture");
        assert!(hidden.image.pixels.iter().all(|&pixel| pixel == [0.0; 3]));
        assert!(green(&direct(&scene, Visibility::Ignored, 64).expect("a picture")) > 0.0);
        // A panel that lies on the board's lower side is in front of it.
        scene.area_lights = vec![triangle([[-0.5, 0.5, -0.5], [0.5, 0.5, -0.5], [0.0, 0.5, 0.5]])];
        let [panel, free] = VISIBILITIES.map(|v| direct(&scene, v, 1024).expect("a picture"));
        let deviation = [&panel, &free].map(|picture| {
            picture.variance.pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>()
        });
        let deviation = deviation.iter().sum::<f64>().sqrt();
        let [panel, free] = [green(&panel), green(&free)];
        assert!((panel - free).abs() < 4.0 * deviation, "{panel} {free} ± {deviation}");
    }
}

/// Other light paths know no lights that are no surfaces: the competitor declines in one line.
#[test]
fn other_transports_are_declined() {
    let scene = floor(lambert(), &[sphere([0.0, 1.0, 0.0], 0.2)]);
    for transport in ["indirect-1", "direct+indirect-1", "all"] {
        let frame = Frame {
            scene: &scene,
            camera: &scene.cameras[0],
            resolution: RESOLUTION,
            transport: transport.parse().expect("a transport"),
            seed: 1,
            gpu: None,
        };
        let parameters = Parameters::new(PathTracer.parameters(), []).expect("valid");
        match PathTracer.prepare(&frame, &parameters).map(drop) {
            Err(MethodError::Declined(reason)) => {
                assert!(reason.contains("transport direct alone"), "{reason}");
                assert!(!reason.contains('\n'), "{reason}");
            }
            other => panic!("{transport}: {other:?}"),
        }
    }
}

/// Points of an emissive triangle are off its plane by rounding, and interpolated normals see what is
/// below it.
#[test]
fn no_triangle_lights_itself() {
    let materials = vec![Material { emission: RADIANCE, ..lambert() }];
    let mut scene = Scene { materials, ..Scene::default() };
    let tilted = Vec3::new(0.6, 0.7, 0.2).normalize();
    let corners = [[-1.1, 0.13, -0.7], [0.2, -0.17, 1.3], [0.9, 0.07, -0.8]];
    scene.vertices.extend(corners.map(|corner| Vertex {
        position: Vec3::from(corner),
        normal: tilted,
        uv: Vec2::ZERO,
    }));
    scene.triangles = vec![Triangle { vertices: [0, 1, 2], material: 0 }];
    let eye = Vec3::new(0.3, 1.8, 1.0);
    scene.cameras = vec![Camera::look_at("eye", eye, Vec3::ZERO, Vec3::Y, 0.6)];
    assert!(seen(&scene).iter().flatten().count() > 30);
    for two_sided in [false, true] {
        scene.materials[0].two_sided = two_sided;
        for visibility in VISIBILITIES {
            let picture = direct(&scene, visibility, 32).expect("a picture").image;
            assert!(picture.pixels.iter().all(|&pixel| pixel == [0.0; 3]), "{visibility}");
        }
    }
}
