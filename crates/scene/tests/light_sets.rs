//! Lights with a surface in scene files: where they stand, and what they send.

use std::f32::consts::PI;

use glam::{Vec3, vec3};
use image::{Rgb, RgbImage};
use manylights_scene::AreaLight::{self, Sphere, Triangle};
use manylights_scene::load;
use manylights_scene::material::srgb_to_linear;

use crate::common;

pub(crate) const HEAD: &str = "about = \"a test\"\nsource = \"builtin:cornell\"\n\n";

/// The area lights of a scene file with these lines.
fn lights(text: &str) -> Vec<AreaLight> {
    let scene =
        common::load_text(&format!("{HEAD}{text}")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.lights.len(), 1, "that of the box");
    scene.area_lights
}

pub(crate) const RING: &str = "arrangement = \"ring\"\ncount = 6\ncenter = [1, 2, 3]\nradius = 2\n\
                    normal = [0, 0, -3]\nsize = 0.1\npower = [1, 2, 3]\n";
pub(crate) const CLOUD: &str = "arrangement = \"cloud\"\ncount = 300\ncenter = [1, 2, 3]\nextent = [4, 2, 1]\n\
                     size = 0.1\npower = [1, 2, 3]\n";
const SHELL: &str = "arrangement = \"shell\"\ncount = 242\ncenter = [1, 2, 3]\nradius = 4\n\
                     size = 0.1\npower = [1, 2, 3]\n";
pub(crate) const PANEL: &str = "arrangement = \"panel\"\ncenter = [1, 2, 3]\nextent = [4, 2]\n\
                     normal = [0, 0, 1]\npower = [1, 2, 3]\n";

pub(crate) fn set(keys: &str, shape: &str) -> String {
    format!("[[lights]]\nof = \"{shape}\"\n{keys}")
}

pub(crate) fn with(keys: &str, shape: &str, more: &str) -> String {
    format!("{}{more}\n", set(keys, shape))
}

fn center(light: &AreaLight) -> Vec3 {
    match *light {
        Sphere { center, .. } => center,
        Triangle { corners: [a, b, c], .. } => (a + b + c) / 3.0,
    }
}

/// Unit; of the side that shines.
fn front(light: &AreaLight) -> Vec3 {
    let Triangle { corners: [a, b, c], .. } = *light else { panic!("{light:?}") };
    (b - a).cross(c - a).normalize()
}

/// All alike, in sum the power of the keys above.
fn check_power(lights: &[AreaLight]) {
    assert!(lights.iter().all(|light| light.radiance() == lights[0].radiance()));
    check_sum(lights);
}

fn check_sum(lights: &[AreaLight]) {
    let sum: glam::DVec3 = lights.iter().map(|light| light.power().as_dvec3()).sum();
    assert!((sum - glam::dvec3(1.0, 2.0, 3.0)).abs().max_element() < 3e-6, "{sum}");
}

/// Spheres have the radius 0.1; triangles are equilateral, with their corners 0.1 from the centre.
fn check_size(lights: &[AreaLight]) {
    for light in lights {
        match *light {
            Sphere { radius, .. } => assert_eq!(radius, 0.1),
            Triangle { corners, .. } => {
                for (i, corner) in corners.iter().enumerate() {
                    // Of coordinates up to 8 m half a unit in the last place is 2.4e-7.
                    let to_center = corner.distance(center(light));
                    assert!((to_center - 0.1).abs() < 1e-6, "{to_center}");
                    let side = corner.distance(corners[(i + 1) % 3]);
                    assert!((side - 0.1 * 3_f32.sqrt()).abs() < 2e-6, "{side}");
                }
            }
        }
    }
}

#[test]
fn a_sphere_alone() {
    let text =
        "[[light]]\nkind = \"sphere\"\ncenter = [1, 2, 3]\nradius = 0.5\nradiance = [4, 5, 6]";
    let expected =
        Sphere { center: vec3(1.0, 2.0, 3.0), radius: 0.5, radiance: vec3(4.0, 5.0, 6.0) };
    assert_eq!(lights(text), [expected]);
    // 4 π² r² L.
    assert!((expected.power() - PI * PI * vec3(4.0, 5.0, 6.0)).length() < 1e-4);
}

#[test]
fn rings_are_even_and_face_their_centre() {
    for shape in ["spheres", "triangles"] {
        let lights = lights(&set(RING, shape));
        assert_eq!(lights.len(), 6);
        check_power(&lights);
        check_size(&lights);
        let middle = vec3(1.0, 2.0, 3.0);
        for (i, light) in lights.iter().enumerate() {
            let outward = center(light) - middle;
            assert!((outward.length() - 2.0).abs() < 1e-5 && outward.z.abs() < 1e-6, "{outward}");
            // Six on a circle are as far apart as from its centre.
            let next = center(&lights[(i + 1) % 6]);
            assert!((center(light).distance(next) - 2.0).abs() < 1e-5);
            if shape == "triangles" {
                assert!((front(light) + 0.5 * outward).length() < 1e-5, "{light:?}");
                let Triangle { corners: [top, ..], .. } = *light else { panic!("{light:?}") };
                assert!((top.z - 2.9).abs() < 1e-6, "points along the normal");
            }
        }
    }
}

#[test]
fn clouds_fill_their_box_in_all_directions() {
    let spheres = lights(&set(CLOUD, "spheres"));
    let triangles = lights(&set(CLOUD, "triangles"));
    assert_eq!((spheres.len(), triangles.len()), (300, 300));
    for lights in [&spheres, &triangles] {
        check_power(lights);
        check_size(lights);
    }
    let (middle, half) = (vec3(1.0, 2.0, 3.0), vec3(2.0, 1.0, 0.5));
    let places: Vec<Vec3> = spheres.iter().map(|light| (center(light) - middle) / half).collect();
    assert!(places.iter().all(|place| place.abs().max_element() <= 1.0));
    // Uniform in [-1, 1]: the mean of 300 has the deviation 1/30, their square that of 0.017 about 1/3.
    let mean = places.iter().sum::<Vec3>() / 300.0;
    let square = places.iter().map(|place| place * place).sum::<Vec3>() / 300.0;
    assert!(mean.abs().max_element() < 0.13, "{mean}");
    assert!((square - 1.0 / 3.0).abs().max_element() < 0.07, "{square}");
    let facing = triangles.iter().map(front).sum::<Vec3>() / 300.0;
    let square = triangles.iter().map(|light| front(light) * front(light)).sum::<Vec3>() / 300.0;
    assert!(facing.abs().max_element() < 0.13, "{facing}");
    assert!((square - 1.0 / 3.0).abs().max_element() < 0.07, "{square}");
    for (sphere, triangle) in spheres.iter().zip(&triangles) {
        assert!(center(sphere).distance(center(triangle)) < 1e-6, "the same centres");
    }
}

#[test]
fn shells_are_even_and_face_their_centre() {
    for shape in ["spheres", "triangles"] {
        let lights = lights(&set(SHELL, shape));
        assert_eq!(lights.len(), 242);
        check_power(&lights);
        check_size(&lights);
        let outward: Vec<Vec3> =
            lights.iter().map(|light| (center(light) - vec3(1.0, 2.0, 3.0)) / 4.0).collect();
        for (light, out) in lights.iter().zip(&outward) {
            assert!((out.length() - 1.0).abs() < 1e-6, "{out}");
            assert!(shape == "spheres" || (front(light) + out).length() < 1e-4, "{light:?}");
        }
        // Alone on 4π/242 each: on a hexagonal lattice neighbours would be 0.245 apart.
        let nearest = |i: usize| {
            let others = outward.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, other)| other.distance(outward[i])).fold(f32::INFINITY, f32::min)
        };
        let closest = (0..242).map(nearest).fold(f32::INFINITY, f32::min);
        assert!(closest > 0.19, "{closest}");
    }
}

#[test]
fn panels_are_grids_seen_from_their_front() {
    let spheres = lights(&with(PANEL, "spheres", "count = 16"));
    assert_eq!(spheres.len(), 16);
    check_power(&spheres);
    // Texels of 1 m by 0.5 m; the normal is +z, so that the right is +x.
    assert!((center(&spheres[0]) - vec3(-0.5, 2.75, 3.0)).length() < 1e-6);
    assert!((center(&spheres[1]) - vec3(0.5, 2.75, 3.0)).length() < 1e-6);
    assert!((center(&spheres[15]) - vec3(2.5, 1.25, 3.0)).length() < 1e-6);
    for light in &spheres {
        let Sphere { radius, .. } = *light else { panic!("{light:?}") };
        assert!((PI * radius * radius - 0.5).abs() < 1e-6, "{radius}");
    }

    let triangles = lights(&with(PANEL, "triangles", "count = 32"));
    assert_eq!(triangles.len(), 32);
    check_power(&triangles);
    for (i, light) in triangles.iter().enumerate() {
        assert_eq!(front(light), Vec3::Z, "{light:?}");
        assert!((light.area() - 0.25).abs() < 1e-6);
        let Triangle { corners, .. } = *light else { panic!("{light:?}") };
        // Within its texel.
        let texel = center(&spheres[i / 2]);
        let offsets = corners.map(|corner| (corner - texel).abs());
        assert!(offsets.iter().all(|offset| (*offset - vec3(0.5, 0.25, 0.0)).length() < 1e-6));
    }

    // A ceiling, whose top is told.
    let ceiling = PANEL.replace("[0, 0, 1]", "[0, -1, 0]");
    let ceiling = lights(&with(&ceiling, "spheres", "count = 4\nup = [0, 0, -1]"));
    assert!((center(&ceiling[0]) - vec3(2.0, 2.0, 2.5)).length() < 1e-6, "{ceiling:?}");
}

/// A picture of 4 × 2 pixels on 2 × 2 texels: two pixels each.
#[test]
fn panels_shine_as_their_picture() {
    let (folder, path) = common::write(&format!(
        "{HEAD}{}{}",
        with(PANEL, "spheres", "count = 4\npicture = \"picture.png\""),
        with(PANEL, "triangles", "count = 8\npicture = \"asset:picture.png\"")
    ));
    let mut picture = RgbImage::new(4, 2);
    picture.put_pixel(0, 0, Rgb([255, 0, 0]));
    picture.put_pixel(1, 0, Rgb([255, 128, 0]));
    picture.put_pixel(3, 0, Rgb([0, 0, 255]));
    picture.put_pixel(2, 1, Rgb([64, 64, 64]));
    picture.put_pixel(3, 1, Rgb([64, 64, 64]));
    picture.save(folder.path().join("picture.png")).expect("can write");
    let scene = load(path.to_str().expect("UTF-8"), Some(folder.path())).expect("valid");
    assert_eq!(scene.sources[1..], [(); 2].map(|()| folder.path().join("picture.png")));

    let [half, dim] = [128, 64].map(srgb_to_linear);
    let texels = [vec3(1.0, 0.5 * half, 0.0), vec3(0.0, 0.0, 0.5), Vec3::ZERO, Vec3::splat(dim)];
    let mean = texels.iter().map(|texel| texel.element_sum()).sum::<f32>() / 12.0;
    let (spheres, triangles) = scene.area_lights.split_at(4);
    for (lights, of_a_texel) in [(spheres, 1), (triangles, 2)] {
        assert_eq!(lights.len(), 4 * of_a_texel);
        for (i, light) in lights.iter().enumerate() {
            // Of the power a quarter to each texel, times the picture over its mean.
            let power = light.power() * of_a_texel as f32;
            let expected = vec3(0.25, 0.5, 0.75) * texels[i / of_a_texel] / mean;
            assert!((power - expected).length() < 1e-5, "texel {i}: {power}, expected {expected}");
        }
    }
}

/// A grey picture changes no power; texels that pixels straddle get their shares of them.
#[test]
fn pictures_of_any_size_are_box_filtered() {
    let (folder, path) = common::write(&format!(
        "{HEAD}{}",
        with(PANEL, "spheres", "count = 4\npicture = \"p.png\"")
    ));
    let mut picture = RgbImage::new(3, 3);
    for y in 0..3 {
        picture.put_pixel(1, y, Rgb([255; 3]));
        picture.put_pixel(2, y, Rgb([128; 3]));
    }
    picture.save(folder.path().join("p.png")).expect("can write");
    let scene = load(path.to_str().expect("UTF-8"), None).expect("valid");
    check_sum(&scene.area_lights);
    // Left: a black column and half a white one; right: the other half and the grey one.
    let [left, right] = [0.5, 0.5 + srgb_to_linear(128)];
    let expected = right / left;
    for row in scene.area_lights.chunks(2) {
        let ratio = row[1].radiance() / row[0].radiance();
        assert!((ratio - expected).abs().max_element() < 1e-5, "{ratio}, expected {expected}");
    }
}

/// The same file, the same lights, wherever: these bits are those that Python's functions give.
#[test]
fn seeds_decide_alone() {
    for keys in [RING, CLOUD, SHELL] {
        let of = |seed: &str| lights(&with(keys, "triangles", seed));
        assert_eq!(of("seed = 0"), of(""), "the default");
        assert_eq!(of("seed = 7"), of("seed = 7"));
        assert_ne!(of("seed = 7"), of("seed = 8"), "{keys}");
    }
    let first = |keys: &str| center(&lights(&with(keys, "spheres", "seed = 7"))[0]).to_array();
    assert_eq!([RING, CLOUD, SHELL].map(first).map(|p| p.map(f32::to_bits)), EXPECTED);
}

/// Of the first light's centre, for the seed 7.
const EXPECTED: [[u32; 3]; 3] = [
    [1_077_246_798, 1_067_081_533, 1_077_936_128],
    [1_057_959_816, 1_065_634_877, 1_079_617_040],
    [1_080_982_307, 3_207_404_024, 1_072_185_246],
];
