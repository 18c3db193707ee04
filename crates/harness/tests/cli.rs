//! The command line as a user meets it: bad input ends in exit status 2 and one line, never in a
//! panic; good input gives the promised files.

use std::path::Path;

use crate::common::{json, manylights, manylights_within, refused, succeeded, write_image};
use manylights_metrics::RadianceImage;

#[test]
fn lists_are_json_where_asked() {
    let methods = json(&["list", "methods", "--json"]);
    let ids: Vec<_> = methods.as_array().expect("a list").iter().map(|m| &m["id"]).collect();
    assert!(ids.contains(&&"reference".into()), "{ids:?}");
    let parameters = methods[0]["parameters"].as_array().expect("a list");
    assert!(parameters.iter().all(|p| p["help"].is_string() && p["default"].is_number()));
    for method in methods.as_array().expect("a list") {
        let counters = method["counters"].as_array().expect("a list");
        assert!(!counters.is_empty(), "{method}");
        assert!(counters.iter().all(|c| c["name"].is_string() && c["help"].is_string()));
    }
    let hvl = methods.as_array().expect("a list").iter().find(|method| method["id"] == "hvl");
    let parameters = hvl.expect("registered")["parameters"].as_array().expect("a list");
    let form = parameters.iter().find(|p| p["name"] == "form").expect("a parameter of hvl");
    assert_eq!((&form["kind"], &form["default"]), (&"choice".into(), &"full".into()));
    let words = form["words"].as_array().expect("a list");
    assert_eq!(words.iter().map(|w| &w["word"]).collect::<Vec<_>>(), ["full", "zonal"]);
    assert!(words.iter().all(|word| word["help"].is_string()));
    let scenes = json(&["list", "scenes", "--json"]);
    for scene in ["integrating-sphere", "cornell", "cornell-glossy", "atrium", "trio", "receivers"]
    {
        assert!(scenes.as_array().expect("a list").iter().any(|s| s["name"] == scene), "{scene}");
    }
    let experiments = json(&["list", "experiments", "--json"]);
    let files: Vec<_> =
        experiments.as_array().expect("a list").iter().map(|e| &e["file"]).collect();
    assert!(files.contains(&&"results/first-light/experiment.toml".into()), "{files:?}");
}

#[test]
fn lists_for_people_leave_standard_output_to_json() {
    let output = manylights(&["list", "methods"]);
    succeeded(&output);
    assert!(output.stdout.is_empty());
    let text = String::from_utf8_lossy(&output.stderr);
    for part in ["--set samples=N", "--set form=WORD", "(default full)\n      full: any lobe"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn help_and_version_succeed() {
    for argument in ["--help", "--version"] {
        let output = manylights(&[argument]);
        succeeded(&output);
        assert!(String::from_utf8_lossy(&output.stdout).contains("manylights"));
    }
}

#[test]
fn a_malformed_command_line_is_refused_in_one_line() {
    for (arguments, said) in [
        (&[][..], "a command is missing"),
        (&["rendr"], "'render'"),
        (&["render"], "--scene"),
        (&["list", "methds"], "'methods'"),
        (&["list", "methods", "--jsn"], "'--json'"),
        (&["metrics", "one.exr"], "<REFERENCE>"),
        (&["run", "e.toml", "--profile", "quik"], "'quick'"),
    ] {
        refused(arguments, said);
    }
}

/// A `render` that succeeds, with `change` put in place of the option of that name or added.
fn render_with(change: &[&str], said: &str) {
    let folder = tempfile::tempdir().expect("temporary folder");
    let out = folder.path().join("out.exr");
    let out = out.to_str().expect("UTF-8");
    let mut arguments = vec!["render"];
    let defaults = [
        ("--scene", "cornell"),
        ("--method", "reference"),
        ("--resolution", "16x16"),
        ("--set", "samples=16"),
        ("-o", out),
    ];
    for (option, value) in defaults {
        if option != change[0] {
            arguments.extend([option, value]);
        }
    }
    arguments.extend(change);
    refused(&arguments, said);
    assert!(!Path::new(out).exists(), "{change:?} rendered all the same");
}

#[test]
fn bad_settings_are_refused_before_rendering() {
    for (change, said) in [
        (&["--method", "referense"], "did you mean `reference`?"),
        (&["--scene", "cornel"], "cornell"),
        (&["--scene", "missing.glb"], "missing.glb"),
        (&["--scene", "missing.toml"], "missing.toml"),
        (&["--set", "sample=4"], "did you mean `samples`?"),
        (&["--set", "samples"], "KEY=VALUE"),
        (&["--set", "samples=0"], "from 1"),
        (&["--set", "samples=-1"], "from 1"),
        (&["--set", "samples=many"], "a whole number"),
        (&["--set", "samples=99999999999999999999"], "a whole number"),
        (&["--resolution", "0x16"], "sides must be 1"),
        (&["--resolution", "16x0"], "sides must be 1"),
        (&["--resolution", "16385x1"], "sides must be 1"),
        (&["--resolution", "16384x16384"], "pixels"),
        (&["--resolution", "99999999999x1"], "WIDTHxHEIGHT"),
        (&["--resolution", "16"], "WIDTHxHEIGHT"),
        (&["--transport", "everything"], "use direct, indirect-1"),
        (&["--transport", "indirect-0"], "from 1 to 64"),
        (&["--visibility", "guessed"], "use traced or ignored"),
        (&["--camera", "nobody"], "nobody"),
        (&["--seed", "-1"], "--seed"),
    ] {
        render_with(change, said);
    }
    for transport in ["all", "indirect-2"] {
        let said = "is a choice of direct, indirect-1 and direct+indirect-1, not of ";
        render_with(&["--visibility", "ignored", "--transport", transport], said);
    }
}

/// Every transport that has a choice takes it, and only exact direct light is added to pictures.
#[test]
fn transports_are_rendered_or_refused_with_a_reason() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let render = |transport: &str, visibility: &str| {
        let out = path(&format!("{transport}-{visibility}.exr"));
        let arguments = ["render", "--scene", "trio", "--method", "reference", "-o", &out];
        let more = ["--resolution", "16x16", "--set", "samples=16", "--visibility", visibility];
        let arguments = [&arguments[..], &more, &["--transport", transport]].concat();
        succeeded(&manylights(&arguments));
        RadianceImage::read_exr(Path::new(&out)).expect("a picture")
    };
    let sum = |image: &RadianceImage| image.pixels.iter().map(|pixel| pixel[1]).sum::<f32>();
    for transport in ["direct", "indirect-1", "direct+indirect-1"] {
        let [traced, ignored] = ["traced", "ignored"].map(|choice| render(transport, choice));
        assert!(sum(&ignored) > sum(&traced), "{transport}");
    }
    let parts = ["direct", "indirect-1"].map(|transport| render(transport, "traced"));
    let whole = render("direct+indirect-1", "traced");
    for (index, pixel) in whole.pixels.iter().enumerate() {
        let [direct, indirect] = parts.each_ref().map(|part| part.pixels[index]);
        assert_eq!(*pixel, [0, 1, 2].map(|channel| indirect[channel] + direct[channel]));
    }
    let lamp = path("lamp.toml");
    let text = "about = \"a lamp\"\nsource = \"builtin:cornell\"\n[material.white]\n\
                emission = [1.0, 1.0, 1.0]\n";
    std::fs::write(&lamp, text).expect("writable");
    let change = ["--scene", lamp.as_str(), "--transport", "direct+indirect-1"];
    render_with(&change, "scene has emissive triangles");
}

/// What was a number once, or had another name, is answered with the word of today.
#[test]
fn words_are_said_as_words() {
    for (method, set, said) in [
        ("hvl", "form=1", "parameter `form` = `1`: say form=zonal (words: full, zonal)"),
        ("hvl", "window=4", "say window=weakest"),
        ("hvl", "horizon=1", "say horizon=exact"),
        ("hvl", "radius=0", "say radius=neighbours"),
        ("vsl", "sampling=0", "say sampling=brdf"),
        ("vsgl", "lobe=0", "say lobe=thesis"),
        ("hvl", "form=2", "must be one of the words full, zonal"),
        ("hvl", "form=zonl", "did you mean `zonal`?"),
        ("vpl", "radius=0.5", "is now called `attenuation_radius`"),
        ("vsl", "samples=9", "is now called `directions`"),
        ("vsl", "lights=few", "a whole number"),
    ] {
        let arguments = ["render", "--scene", "cornell", "--method", method, "--set", set];
        refused(&[&arguments[..], &["-o", "never-written.exr"]].concat(), said);
    }
}

#[test]
fn words_are_swept_like_numbers() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let file = folder.path().join("experiment.toml");
    let path = file.to_str().expect("UTF-8");
    let write = |forms: &str| {
        let text = format!(
            "title = \"t\"\nquestion = \"q\"\nscenes = [\"cornell\"]\n\
             transport = \"indirect-1\"\nreferences = [\"traced\"]\n\
             [[methods]]\nid = \"hvl\"\nparameters = {{ form = {forms}, lights = 100 }}\n\
             [profiles.quick]\nresolution = [16, 16]\nreference_samples = 16\n\
             repetitions = 1\nseeds = [1]\n"
        );
        std::fs::write(&file, text).expect("writable");
    };
    write(r#"["zonal", "full"]"#);
    let jobs = json(&["plan", path, "--profile", "quick", "--json"]);
    let labels: Vec<_> =
        jobs.as_array().expect("a list").iter().map(|job| job["label"].as_str()).collect();
    let expected = ["zonal", "full"].map(|form| format!("cornell hvl form={form} lights=100"));
    assert_eq!(labels, expected.each_ref().map(|label| Some(label.as_str())));
    for (forms, said) in [
        ("[0, 1]", "parameter `form` = `0`: say form=full (words: full, zonal)"),
        ("1.0", "say form=zonal"),
        ("\"zone\"", "did you mean `zonal`?"),
        ("[\"full\", true]", "must be a number, a word or a list"),
    ] {
        write(forms);
        refused(&["plan", path, "--profile", "quick"], said);
    }
}

#[test]
fn an_unwritable_output_is_refused_before_rendering() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "in the way").expect("writable");
    let taken = folder.path().join("taken.exr");
    std::fs::create_dir(&taken).expect("writable");
    for (path, said) in [
        (folder.path().join("missing").join("out.exr"), "choose another -o"),
        (file.join("out.exr"), "choose another -o"),
        (taken, ".exr file"),
        (folder.path().join("out.png"), ".exr file"),
        (folder.path().join("out"), ".exr file"),
    ] {
        render_with(&["-o", path.to_str().expect("UTF-8")], said);
    }
}

#[test]
fn a_malformed_scene_file_is_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    for (name, contents) in [
        ("empty.glb", &b""[..]),
        ("short.glb", b"glTF\x02\0\0\0\xff\xff\xff\x7f"),
        ("broken.gltf", b"{"),
        ("key.toml", b"sourse = \"cornell\"\n"),
        ("syntax.toml", b"source = \n"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, contents).expect("writable");
        render_with(&["--scene", path.to_str().expect("UTF-8")], name);
    }
}

#[test]
fn render_writes_an_exr_and_a_png_of_the_size_asked_for() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let render = |name: &str, seed: &str| {
        let path = folder.path().join(name);
        let arguments = ["render", "--scene", "cornell", "--method", "reference", "--seed", seed];
        let more = ["--set", "samples=16", "--resolution", "24x16", "-o"];
        let output =
            manylights(&[&arguments[..], &more, &[path.to_str().expect("UTF-8")]].concat());
        succeeded(&output);
        assert!(output.stdout.is_empty(), "JSON only");
        let png = image::open(path.with_extension("png")).expect("a PNG");
        assert_eq!((png.width(), png.height()), (24, 16));
        RadianceImage::read_exr(&path).expect("an EXR")
    };
    let [first, again, other] =
        [("a.exr", "1"), ("b.exr", "1"), ("c.exr", "2")].map(|(n, s)| render(n, s));
    assert_eq!((first.width, first.height, first.non_finite()), (24, 16, 0));
    assert!(first.pixels.iter().flatten().any(|&c| c > 0.0), "black");
    assert_eq!(first, again, "same seed, same bits");
    assert_ne!(first, other, "another seed, another picture");
}

#[test]
fn radiance_beyond_single_precision_fails_the_picture() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let scene = folder.path().join("bright.toml");
    let text = "about = \"too bright\"\nsource = \"builtin:cornell\"\n[[light]]\nkind = \"point\"\n\
                position = [0.0, 0.01, 0.0]\nintensity = [3e38, 3e38, 3e38]\n";
    std::fs::write(&scene, text).expect("writable");
    let out = folder.path().join("out.exr");
    let [scene, exr] = [&scene, &out].map(|path| path.to_str().expect("UTF-8"));
    for transport in ["direct", "indirect-1"] {
        let arguments = ["render", "--scene", scene, "--method", "reference", "-o", exr];
        let more = ["--resolution", "16x16", "--transport", transport];
        let output = manylights(&[&arguments[..], &more].concat());
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert_eq!(errors.lines().count(), 1, "{errors}");
    }
}

#[test]
fn the_adapter_is_opened_only_where_a_method_needs_it() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let out = folder.path().join("out.exr");
    let out = out.to_str().expect("UTF-8");
    let methods = json(&["list", "methods", "--json"]);
    for method in methods.as_array().expect("a list") {
        let id = method["id"].as_str().expect("a name");
        let arguments = ["render", "--scene", "cornell", "--method", id, "--resolution", "16x16"];
        let arguments = [&arguments[..], &["--adapter", "no such adapter", "-o", out]].concat();
        if method["processor"] == "gpu" {
            refused(&arguments, "adapter");
        } else {
            succeeded(&manylights(&arguments));
        }
    }
}

#[test]
fn the_adapter_is_opened_with_the_limits_asked_for() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let out = folder.path().join("out.exr");
    let out = out.to_str().expect("UTF-8");
    for (limits, resolution, said) in [
        ("webgl", "16x16", "MANYLIGHTS_LIMITS=webgl: set it to `default`"),
        ("default", "8193x1", "under MANYLIGHTS_LIMITS=default allows 8192"),
    ] {
        let arguments = ["render", "--scene", "cornell", "--method", "vpl", "-o", out];
        let arguments = [&arguments[..], &["--resolution", resolution]].concat();
        let output = manylights_within(limits, &arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.lines().count() == 1 && errors.contains(said), "{errors}");
    }
}

#[test]
fn metrics_of_two_pictures() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let dark = write_image(folder.path(), "dark.exr", [16, 12], 0.25);
    let bright = write_image(folder.path(), "bright.exr", [16, 12], 0.5);
    let report = json(&["metrics", &dark, &bright, "--json"]);
    let near = |value: &serde_json::Value, expected: f64| {
        let value = value.as_f64().expect("a number");
        assert!((value - expected).abs() < 1e-12, "{value} is not {expected}");
    };
    // Both are exact in binary.
    near(&report["linear"]["rmse"], 0.25);
    near(&report["linear"]["mse"], 0.0625);
    near(&report["linear"]["rel_mse_trimmed"], 0.0625 / 0.26);
    assert!(report["display"]["flip"].as_f64().is_some_and(|flip| flip > 0.1));
    assert!(report["linear"].get("flip").is_none(), "radiance is not what is seen");
    near(&report["exposure"], 1.0);
    let same = json(&["metrics", &dark, &dark, "--json"]);
    near(&same["display"]["rmse"], 0.0);
    assert!(same["display"]["psnr"].is_null(), "infinite");
    let output = manylights(&["metrics", &dark, &bright]);
    succeeded(&output);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.stdout.is_empty() && said.contains("ssim"), "{said}");
    let flip = said.lines().find(|line| line.starts_with("flip ")).expect("a line");
    assert!(flip.split_whitespace().nth(1) == Some("—"), "{flip}");
}

#[test]
fn metrics_refuse_what_cannot_be_compared() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let good = write_image(folder.path(), "good.exr", [16, 12], 0.25);
    let larger = write_image(folder.path(), "larger.exr", [12, 16], 0.25);
    let broken = write_image(folder.path(), "broken.exr", [16, 12], f32::NAN);
    let tiny = write_image(folder.path(), "tiny.exr", [4, 4], 0.25);
    let text = folder.path().join("text.exr");
    std::fs::write(&text, "not a picture").expect("writable");
    let text = text.to_str().expect("UTF-8");
    refused(&["metrics", &good, "missing.exr"], "missing.exr");
    refused(&["metrics", text, &good], "text.exr");
    refused(&["metrics", &good, &larger], "16×12");
    refused(&["metrics", &broken, &good], "not finite");
    refused(&["metrics", &tiny, &tiny], "11×11");
    let elsewhere = folder.path().join("elsewhere.exr");
    let mut bytes = std::fs::read(&good).expect("readable");
    let window = b"displayWindow\0box2i\0\x10\0\0\0";
    let at = bytes.windows(window.len()).position(|part| part == window).expect("is required");
    // Its right end: a wider frame.
    bytes[at + window.len() + 8] += 1;
    std::fs::write(&elsewhere, bytes).expect("writable");
    let elsewhere = elsewhere.to_str().expect("UTF-8");
    refused(&["metrics", elsewhere, &good], "of a frame of 17×12 pixels");
    refused(&["metrics", &good, &good, "--exposure", "0"], "exposure");
}
