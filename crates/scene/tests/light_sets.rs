//! Lights with a surface in scene files: where they stand, what they send, and how wrong ones are
//! refused.

use std::f32::consts::PI;

use glam::{Vec3, vec3};
use image::{Rgb, RgbImage};
use manylights_scene::AreaLight::{self, Sphere, Triangle};
use manylights_scene::load;
use manylights_scene::material::srgb_to_linear;

use crate::common;

const HEAD: &str = "about = \"a test\"\nsource = \"builtin:cornell\"\n\n";

/// The area lights of a scene file with these lines.
fn lights(text: &str) -> Vec<AreaLight> {
    let scene =
        common::load_text(&format!("{HEAD}{text}")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.lights.len(), 1, "that of the box");
    scene.area_lights
}

const RING: &str = "arrangement = \"ring\"\ncount = 6\ncenter = [1, 2, 3]\nradius = 2\n\
                    normal = [0, 0, -3]\nsize = 0.1\npower = [1, 2, 3]\n";
const CLOUD: &str = "arrangement = \"cloud\"\ncount = 300\ncenter = [1, 2, 3]\nextent = [4, 2, 1]\n\
                     size = 0.1\npower = [1, 2, 3]\n";
const SHELL: &str = "arrangement = \"shell\"\ncount = 242\ncenter = [1, 2, 3]\nradius = 4\n\
                     size = 0.1\npower = [1, 2, 3]\n";
const PANEL: &str = "arrangement = \"panel\"\ncenter = [1, 2, 3]\nextent = [4, 2]\n\
                     normal = [0, 0, 1]\npower = [1, 2, 3]\n";

fn set(keys: &str, shape: &str) -> String {
    format!("[[lights]]\nof = \"{shape}\"\n{keys}")
}

fn with(keys: &str, shape: &str, more: &str) -> String {
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

#[test]
fn wrong_lights_are_refused_with_their_line() {
    let sphere = |center: &str, radius: &str, radiance: &str| {
        format!(
            "[[light]]\nkind = \"sphere\"\ncenter = {center}\nradius = {radius}\nradiance = {radiance}"
        )
    };
    let ring = |from: &str, to: &str| {
        assert!(RING.contains(from), "{from}");
        set(&RING.replace(from, to), "triangles")
    };
    let panel = |more: &str| with(PANEL, "triangles", more);
    let origin = "[0, 0, 0]";
    let cases = [
        // Spheres.
        ("radius = 0 is out of range", "use a number from", sphere(origin, "0", "[1, 1, 1]")),
        ("radius = -1 is out of range", "use a number from", sphere(origin, "-1", "[1, 1, 1]")),
        ("radius = NaN is out of range", "use a number from", sphere(origin, "nan", "[1, 1, 1]")),
        ("radius = inf is out of range", "use a number from", sphere(origin, "inf", "[1, 1, 1]")),
        ("radiance is negative", "from 0", sphere(origin, "1", "[1, -1, 1]")),
        ("radiance is not finite", "finite", sphere(origin, "1", "[1, inf, 1]")),
        ("radiance is not finite", "finite", sphere(origin, "1", "[1, 1, nan]")),
        ("too bright", "lower", sphere(origin, "1e9", "[1e30, 1, 1]")),
        ("center is not finite", "finite", sphere("[0, nan, 0]", "1", "[1, 1, 1]")),
        ("center = 2000000000 is out", "from -1000000000", sphere("[2e9, 0, 0]", "1", "[1, 1, 1]")),
        ("unknown field `size`", "did you mean `center`?", {
            sphere(origin, "1", "[1, 1, 1]") + "\nsize = 1"
        }),
        (
            "missing field `radius`",
            "correct",
            sphere(origin, "1", "[1, 1, 1]").replace("radius", "#"),
        ),
        (
            "unknown variant `spher`",
            "did you mean `sphere`?",
            "[[light]]\nkind = \"spher\"".to_owned(),
        ),
        // Counts.
        (
            "count = 0 is out of range",
            "use a number from 1; a scene has at most 1048576",
            ring("count = 6", "count = 0"),
        ),
        ("count = 1048577 is out", "use a number from 1;", ring("count = 6", "count = 1048577")),
        ("invalid value: integer `-1`", "correct", ring("count = 6", "count = -1")),
        ("count = 3 is not 2 k², as a panel's is", "use 2 or 8", panel("count = 3")),
        ("count = 1 is not 2 k²", "use 2 or 8", panel("count = 1")),
        ("count = 24 is not k²", "use 16 or 25", with(PANEL, "spheres", "count = 24")),
        ("count = 1048559 is out of range", "at most 1048576 such lights", {
            with(PANEL, "triangles", "count = 18")
                + &set(&CLOUD.replace("300", "1048559"), "spheres")
        }),
        // Extent, size, directions.
        ("size = 0 is out of range", "use a number from", ring("size = 0.1", "size = 0")),
        ("radius = -2 is out of range", "use a number from", ring("radius = 2", "radius = -2")),
        ("normal has no length", "give it a direction", ring("[0, 0, -3]", "[0, 0, 0]")),
        ("normal is not finite", "finite", ring("[0, 0, -3]", "[0, 0, inf]")),
        ("extent = 0 is out of range", "use a number from", {
            set(&CLOUD.replace("[4, 2, 1]", "[4, 0, 1]"), "spheres")
        }),
        ("extent has 2 sides", "give it 3", {
            set(&CLOUD.replace("[4, 2, 1]", "[4, 2]"), "spheres")
        }),
        ("extent has 3 sides", "give it 2", { panel("count = 8").replace("[4, 2]", "[4, 2, 1]") }),
        ("up is parallel to normal", "give the direction", panel("count = 8\nup = [0, 0, 1]")),
        ("up has no length", "give it a direction", panel("count = 8\nup = [0, 0, 0]")),
        ("a triangle is too small to have an area", "larger", {
            ring("size = 0.1", "size = 1e-9")
        }),
        // Power.
        (
            "power is negative",
            "from 0",
            ring("[1, 2, 3]\n", "[1, 2, 3]\n#").replace("power = [1", "power = [-1"),
        ),
        ("power is not finite", "finite", ring("power = [1", "power = [inf")),
        (
            "too bright",
            "lower",
            ring("size = 0.1", "size = 1e-6").replace("power = [1", "power = [1e38"),
        ),
        // Keys.
        ("a ring has no `extent`", "remove `extent`", ring("size", "extent = [1, 1]\nsize")),
        ("a ring has no `picture`", "remove `picture`", ring("size", "picture = \"a.png\"\nsize")),
        ("a panel has no `size`", "remove `size`", panel("count = 8\nsize = 1")),
        ("a panel has no `seed`", "remove `seed`", panel("count = 8\nseed = 1")),
        ("a ring needs `normal`", "add `normal`", ring("normal", "#")),
        ("a ring needs `radius`", "add `radius`", ring("radius", "#")),
        ("a ring needs `size`", "add `size`", ring("size", "#")),
        ("a cloud needs `extent`", "add", set(&CLOUD.replace("extent", "#"), "spheres")),
        ("unknown field `sed`", "did you mean `seed`?", ring("size", "sed = 1\nsize")),
        ("missing field `power`", "correct", ring("power", "#")),
        ("unknown variant `rng`", "did you mean `ring`?", ring("\"ring\"", "\"rng\"")),
        ("unknown variant `cubes`", "did you mean `spheres`?", set(RING, "cubes")),
        // Pictures.
        ("nowhere.png: ", "check the path", panel("count = 8\npicture = \"nowhere.png\"")),
        (
            "hall.toml: data: ",
            "convert it to PNG or JPEG",
            panel("count = 8\npicture = \"hall.toml\""),
        ),
    ];
    for (problem, remedy, text) in cases {
        // Behind lines that shift all numbers, so that they are those of the table or of what is in it.
        let error = common::load_text(&format!("{HEAD}{text}")).expect_err(&text);
        let line = common::check_line(&error);
        assert!(
            line.contains(problem) && line.contains(remedy),
            "{line}: not `{problem}`, `{remedy}`"
        );
        let number = line.split("hall.toml:").nth(1).and_then(|rest| rest.split(':').next());
        let number: usize = number.and_then(|number| number.parse().ok()).expect(&line);
        let lines = (HEAD.to_owned() + &text).lines().count();
        assert!((4..=lines).contains(&number), "{line}");
        // What is wrong with the meaning stands with the head of its table.
        if line.contains(": light: ") {
            assert_eq!(number, 4, "{line}");
        }
    }
}

#[test]
fn black_and_hostile_pictures_are_refused() {
    let text = format!("{HEAD}{}", with(PANEL, "spheres", "count = 4\npicture = \"p.png\""));
    let (folder, path) = common::write(&text);
    let refused = || {
        let error = load(path.to_str().expect("UTF-8"), None).expect_err("no picture");
        let line = common::check_line(&error);
        assert!(line.contains("hall.toml:4: lights: "), "{line}");
        line
    };
    RgbImage::new(3, 3).save(folder.path().join("p.png")).expect("can write");
    assert!(refused().contains("the picture `p.png` is black"));
    std::fs::write(folder.path().join("p.png"), b"\x89PNG\r\n\x1a\n\0\0").expect("can write");
    assert!(refused().contains("p.png: data: "));
    std::fs::write(folder.path().join("p.png"), "").expect("can write");
    assert!(refused().contains("p.png: data: "));
}

/// The keys of the second table are told by its line.
#[test]
fn the_line_is_that_of_the_table() {
    let text =
        format!("{HEAD}{}\n{}", set(RING, "spheres"), set(&RING.replace("0.1", "0"), "spheres"));
    let line = common::check_line(&common::load_text(&text).expect_err("no size"));
    let expected = text[..text.rfind("[[lights]]").expect("is there")].matches('\n').count() + 1;
    assert!(line.contains(&format!("hall.toml:{expected}: lights: size = 0")), "{line}");
}
