//! Lights with a surface in scene files: how wrong ones are refused.

use image::RgbImage;
use manylights_scene::load;

use crate::common;
use crate::light_sets::{CLOUD, HEAD, PANEL, RING, set, with};

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
    let polygon = |corners: &str| {
        format!("[[light]]\nkind = \"polygon\"\ncorners = {corners}\nradiance = [1, 1, 1]")
    };
    let triangle = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]";
    let many = vec!["[0, 0, 0]"; 1025].join(", ");
    let cases = [
        // Polygons.
        ("a polygon has 2 corners", "give it 3 to 1024", polygon("[[0, 0, 0], [1, 0, 0]]")),
        ("a polygon has 1025 corners", "give it 3 to 1024", polygon(&format!("[{many}]"))),
        ("a polygon has no area", "order", polygon("[[0, 0, 0], [1, 0, 0], [3, 0, 0]]")),
        ("a polygon has no area", "order", polygon("[[1, 2, 3], [1, 2, 3], [1, 2, 3]]")),
        // As much of it turns one way as the other.
        ("a polygon has no area", "order", polygon("[[0, 0, 0], [1, 1, 0], [1, 0, 0], [0, 1, 0]]")),
        ("out of its plane", "planar", polygon("[[0, 0, 0], [1, 0, 0], [1, 1, 0.01], [0, 1, 0]]")),
        ("crosses or touches itself", "order its corners", {
            polygon("[[0, 0, 0], [3, 0, 0], [3, 2, 0], [1, -1, 0]]")
        }),
        // An edge there and back, a corner twice, a corner on an edge.
        ("crosses or touches itself", "order its corners", {
            polygon("[[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0], [1, 1, 0], [0, 1, 0]]")
        }),
        ("crosses or touches itself", "order its corners", {
            polygon("[[0, 0, 0], [1, 0, 0], [1, 0, 0], [1, 1, 0]]")
        }),
        ("crosses or touches itself", "order its corners", {
            polygon("[[0, 0, 0], [2, 0, 0], [2, 2, 0], [1, 0, 0], [0, 2, 0]]")
        }),
        ("corners is not finite", "finite", polygon("[[0, 0, nan], [1, 0, 0], [0, 1, 0]]")),
        ("corners = 2000000000 is out", "from", polygon("[[0, 0, 2e9], [1, 0, 0], [0, 1, 0]]")),
        ("radiance is negative", "from 0", polygon(triangle).replace("[1, 1, 1]", "[1, 1, -1]")),
        ("too bright", "lower", {
            polygon("[[0, 0, 0], [1e9, 0, 0], [0, 1e9, 0]]").replace("[1, 1, 1]", "[1e30, 1, 1]")
        }),
        ("unknown field `two-sided`", "did you mean `two_sided`?", {
            polygon(triangle) + "\ntwo-sided = true"
        }),
        ("missing field `corners`", "correct", polygon(triangle).replace("corners", "#")),
        (
            "spheres have no `two_sided`",
            "remove",
            with(PANEL, "spheres", "count = 4\ntwo_sided = true"),
        ),
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
