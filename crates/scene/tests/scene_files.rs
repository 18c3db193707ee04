//! Scene files: what they add, and how wrong ones are refused.

use crate::common::{self, load_text, write};
use crate::tensor;
use glam::{Vec3, vec3};
use manylights_scene::presets::PRESETS;
use manylights_scene::{Light, Lobe, load};

const HEAD: &str = "about = \"a test\"\nsource = \"builtin:cornell\"\n";

#[test]
fn a_scene_file_adds_and_overrides() {
    let scene = load_text(&format!(
        "{HEAD}
        exposure = 2.5
        keep_lights = false
        camera = [
            {{ name = \"top\", position = [0, 1.9, 0], target = [0, 0, 0], up = [0, 0, -1], vertical_fov = 90 }},
        ]
        light = [
            {{ kind = \"point\", position = [0, 1, 0], intensity = [1, 2, 3] }},
            {{ kind = \"spot\", position = [0, 1, 0], target = [0, 1, -5], intensity = [4, 4, 4], inner = 0, outer = 45 }},
            {{ kind = \"directional\", direction = [0, -2, 0], irradiance = [5, 5, 5] }},
        ]
        [material.white]
        base_color = [0.1, 0.2, 0.3]
        roughness = 0.25
        metallic = 0.5
        specular = 1
        ior = 1.33
        emission = [7, 8, 9]
        "
    ))
    .expect("valid");
    common::check_invariants(&scene, "scene file");
    assert_eq!((scene.name.as_str(), scene.exposure), ("hall", 2.5));

    let names: Vec<_> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!(names, ["top", "front"]);
    assert_eq!(scene.cameras[0].forward, Vec3::NEG_Y);
    assert!(scene.cameras[0].up.abs_diff_eq(Vec3::NEG_Z, 1e-6));

    let [Light::Point { intensity, .. }, Light::Spot { direction, outer, .. }, directional] =
        scene.lights[..]
    else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!((intensity, direction), (vec3(1.0, 2.0, 3.0), Vec3::NEG_Z));
    assert!((outer - std::f32::consts::FRAC_PI_4).abs() < 1e-6);
    let irradiance = Vec3::splat(5.0);
    assert_eq!(directional, Light::Directional { direction: Vec3::NEG_Y, irradiance });

    let white = scene.materials.iter().find(|material| material.name == "white").expect("is one");
    assert_eq!(white.base_color, vec3(0.1, 0.2, 0.3));
    assert_eq!(
        (white.roughness, white.metallic, white.specular, white.ior),
        (0.25, 0.5, 1.0, 1.33)
    );
    assert_eq!(white.emission, vec3(7.0, 8.0, 9.0));
}

#[test]
fn presets_replace_the_factors_but_not_the_emission() {
    let text = format!("{HEAD}[material.white]\npreset = \"teflon\"\nemission = [1, 2, 3]");
    let scene = load_text(&text).expect("valid");
    let white = scene.materials.iter().find(|material| material.name == "white").expect("is one");
    let teflon = PRESETS.iter().find(|preset| preset.name == "teflon").expect("is one").brdf();
    assert_eq!(white.brdf(Vec3::ONE), teflon);
    assert_eq!(white.emission, vec3(1.0, 2.0, 3.0));
    assert!(scene.has_specular());
}

#[test]
fn measurements_lie_beside_the_scene_file_or_among_the_assets() {
    let text = |file: &str| format!("{HEAD}[material.white]\nmeasured = \"{file}\"");
    let (folder, path) = write(&text("satin.bsdf"));
    std::fs::write(folder.path().join("satin.bsdf"), tensor::satin()).expect("can write");
    let scene = load(path.to_str().expect("UTF-8"), None).expect("valid");
    let white = scene.materials.iter().find(|material| material.name == "white").expect("is one");
    let brdf = white.brdf(Vec3::ONE);
    assert!(matches!(brdf.lobe, Lobe::Measured(_)) && scene.has_specular());

    assert_eq!(scene.sources, [path, folder.path().join("satin.bsdf")]);

    let (_folder, path) = write(&text("asset:satin.bsdf"));
    let scene = load(path.to_str().expect("UTF-8"), Some(folder.path())).expect("valid");
    assert_eq!(scene.sources, [path, folder.path().join("satin.bsdf")]);
    assert!(scene.materials.iter().any(|material| material.brdf(Vec3::ONE) == brdf));
}

#[test]
fn lights_of_the_source_stay_unless_told_otherwise() {
    let light = "light = [{ kind = \"point\", position = [0, 1, 0], intensity = [1, 1, 1] }]";
    assert_eq!(load_text(&format!("{HEAD}{light}")).expect("valid").lights.len(), 2);
    let alone = format!("{HEAD}keep_lights = false\n{light}");
    assert_eq!(load_text(&alone).expect("valid").lights.len(), 1);
}

#[test]
fn wrong_files_are_refused_with_a_line() {
    let spot = |rest: &str| {
        format!(
            "light = [{{ kind = \"spot\", position = [0, 0, 0], intensity = [1, 1, 1], {rest} }}]"
        )
    };
    let camera =
        |rest: &str| format!("camera = [{{ name = \"a\", position = [0, 0, 0], {rest} }}]");
    let cases = [
        (
            "hall.toml:3: unknown field `exposur`",
            "did you mean `exposure`?",
            "exposur = 1".to_owned(),
        ),
        ("unknown field `targt`", "did you mean `target`?", camera("targt = [0, 0, 1]")),
        ("unknown field `outr`", "did you mean `outer`?", spot("outr = 30")),
        (
            "unknown variant `spott`",
            "did you mean `spot`?",
            "light = [{ kind = \"spott\" }]".to_owned(),
        ),
        (
            "unknown field `rough`",
            "did you mean `roughness`?",
            "[material.white]\nrough = 1".to_owned(),
        ),
        ("unknown material `wite`", "did you mean `white`?", "[material.wite]".to_owned()),
        ("exposure = 0 is out of range", "use a number from", "exposure = 0".to_owned()),
        ("exposure = NaN is out of range", "use a number from", "exposure = nan".to_owned()),
        ("missing field `vertical_fov`", "correct", camera("target = [0, 0, 1]")),
        ("vertical_fov = 180", "to 175", camera("target = [0, 0, 1], vertical_fov = 180")),
        (
            "camera `a`: target − position has no",
            "direction",
            camera("target = [0, 0, 0], vertical_fov = 50"),
        ),
        ("target is not finite", "finite", camera("target = [0, 0, inf], vertical_fov = 50")),
        ("inner = 31", "to 30", spot("target = [0, 0, 1], inner = 31, outer = 30")),
        ("outer = 90", "to 89", spot("target = [0, 0, 1], inner = 3, outer = 90")),
        ("roughness = 1.5", "to 1", "[material.white]\nroughness = 1.5".to_owned()),
        ("emission is negative", "from 0", "[material.white]\nemission = [1, -1, 0]".to_owned()),
        (
            "unknown preset `gold-pant`",
            "did you mean `gold-paint`?",
            "[material.white]\npreset = \"gold-pant\"".to_owned(),
        ),
        (
            "nowhere.bsdf: cannot be read",
            "check the path",
            "[material.white]\nmeasured = \"nowhere.bsdf\"".to_owned(),
        ),
        (
            "preset and measured exclude",
            "keep one of them",
            "[material.white]\npreset = \"teflon\"\nmeasured = \"a.bsdf\"".to_owned(),
        ),
        (
            "preset and ior exclude each other",
            "keep one of them",
            "[material.white]\npreset = \"teflon\"\nior = 1.3".to_owned(),
        ),
        ("hall.toml:4: ", "correct", "\nexposure = = 2".to_owned()),
    ];
    for (problem, remedy, text) in cases {
        let error = load_text(&format!("{HEAD}{text}")).expect_err(&text);
        let line = common::check_line(&error);
        assert!(
            line.contains(problem) && line.contains(remedy),
            "{line}: not `{problem}`, `{remedy}`"
        );
    }
}

#[test]
fn wrong_sources_are_refused_with_a_line() {
    let cases = [
        ("builtin:trios", "unknown built-in scene `trios`; did you mean `trio`?"),
        (
            "asset:scenes/SponzaCrytek.glb",
            "no assets folder is set; set MANYLIGHTS_ASSETS or --assets",
        ),
        ("nowhere.glb", "nowhere.glb: cannot be read"),
        ("other.toml", "other.toml"),
    ];
    for (source, expected) in cases {
        let text = format!("about = \"a test\"\nsource = \"{source}\"");
        let line = common::check_line(&load_text(&text).expect_err("no such source"));
        assert!(line.contains(expected), "{line}: not `{expected}`");
    }
    let (folder, path) = write("about = \"a test\"\nsource = \"asset:a.glb\"");
    let error = load(path.to_str().expect("UTF-8"), Some(folder.path())).expect_err("lacks it");
    assert!(common::check_line(&error).contains("needs the asset `a.glb`"));
    let line = common::check_line(&load("nowhere.toml", None).expect_err("no file"));
    assert!(line.contains("nowhere.toml"), "{line}");
    let line = common::check_line(&load("Cargo.toml.orig", None).expect_err("no such name"));
    assert!(line.contains("unknown name `Cargo.toml.orig`"), "{line}");
    let line = common::check_line(&load("src/lib.rs", None).expect_err("no scene"));
    assert!(line.contains("src/lib.rs: is not a scene file"), "{line}");
    let line = common::check_line(&load_text("source = \"builtin:trio\"").expect_err("no about"));
    assert!(line.contains("missing field `about`"), "{line}");
}
