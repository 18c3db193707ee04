//! `report.html` as a reader meets it: in a browser, from a file.
//!
//! The page is opened in headless Chromium: `scripts/test` installs it where it is missing and names it
//! in `MANYLIGHTS_BROWSER`, without which the test that needs it only says so. Where the variable is
//! set, a browser that does not start fails the test.

use std::path::Path;
use std::process::Command;

use crate::common::{json, manylights, refused, succeeded};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use half::f16;
use manylights_metrics::RadianceImage;
use serde_json::Value;

/// A title that would break a careless page.
const TITLE: &str = "A < B & \\\"C\\\" </script><script>alert(1)</script> {{data}}";
const VARIANTS: usize = 3;
const REFERENCES: usize = 2;

fn run(folder: &Path) {
    let experiment = format!(
        r#"
title = "{TITLE}"
question = "Does the page work?"
scenes = ["cornell", "trio"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = {{ samples = [64, 16, 32] }}
[[crops]]
scene = "cornell"
rectangle = [0.25, 0.5, 0.25, 0.25]
[profiles.quick]
resolution = [32, 24]
reference_samples = 64
repetitions = 2
seeds = [1, 2]
"#
    );
    std::fs::write(folder.join("question.toml"), experiment).expect("writable");
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let (file, out, cache) = (path("question.toml"), path("out"), path("cache"));
    let output =
        manylights(&["run", &file, "--profile", "quick", "--out", &out, "--cache", &cache]);
    succeeded(&output);
}

fn page(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("out/report.html")).expect("a page")
}

/// What stands in the `<script>` element of this id.
fn script<'p>(page: &'p str, id: &str) -> &'p str {
    let (_, rest) = page.split_once(&format!("id=\"{id}\">")).expect("such an element");
    rest.split_once("</script>").expect("its end").0
}

#[test]
fn the_page_holds_the_numbers_of_the_pictures() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    run(folder);
    let page = page(folder);
    check_self_contained(&page);
    let data: Value = serde_json::from_str(script(&page, "data")).expect("JSON");
    assert_eq!(data["cells"].as_array().expect("cells").len(), 2 * VARIANTS * 2 * 2);
    for (index, scene) in data["scenes"].as_array().expect("scenes").iter().enumerate() {
        assert_eq!(scene["rows"].as_array().expect("rows").len(), VARIANTS);
        check_errors(folder, scene);
        check_pixels(folder, &page, scene, index);
        check_layers(folder, scene);
    }
    let csv = std::fs::read_to_string(folder.join("out/table.csv")).expect("a table");
    assert_eq!(data["csv"], csv, "what the page gives away is the table");

    // From the files alone: the same page, but for the command line.
    std::fs::remove_file(folder.join("out/report.html")).expect("removable");
    let out = folder.join("out");
    succeeded(&manylights(&["report", out.to_str().expect("UTF-8")]));
    let mut again: Value = serde_json::from_str(script(&self::page(folder), "data")).expect("JSON");
    assert!(again["command"].as_str().expect("text").contains("experiment.toml"));
    again["command"] = data["command"].clone();
    assert_eq!(again, data);
}

/// Nothing that a browser would fetch, and nothing that a title can break.
fn check_self_contained(page: &str) {
    for address in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!page.contains(address), "{address}");
    }
    assert!(page.contains("default-src 'none'"));
    let title = "A &lt; B &amp; &quot;C&quot; &lt;/script&gt;";
    assert!(page.contains(&format!("<title>{title}")) && page.contains(&format!("<h1>{title}")));
    assert!(!page.contains("<script>alert"));
}

/// The errors of the first seed, measured again on the pictures that lie beside the page.
fn check_errors(folder: &Path, scene: &Value) {
    let cells = folder.join("out/cells");
    let name = scene["name"].as_str().expect("a name");
    let journal = std::fs::read_to_string(folder.join("out/cells.jsonl")).expect("a journal");
    for row in scene["rows"].as_array().expect("rows") {
        let key = row["cell"].as_str().expect("a key");
        let cell = journal.lines().find(|line| line.contains(key)).expect("its cell");
        let cell: Value = serde_json::from_str(cell).expect("JSON");
        let picture = cells.join(format!("{name}-{}.exr", &key[..16]));
        for reference in ["traced", "ignored"] {
            let truth = cells.join(format!("{name}-reference-{reference}.exr"));
            let paths = [&picture, &truth].map(|path| path.to_str().expect("UTF-8").to_owned());
            let again = json(&["metrics", &paths[0], &paths[1], "--json"]);
            assert_eq!(scene["exposure"], 1.0, "as `metrics` takes it");
            for space in ["linear", "display"] {
                assert_eq!(cell["errors"][reference][space], again[space], "{name} {reference}");
                for metric in ["rmse", "psnr", "ssim"] {
                    check_median(&journal, row, [name, reference, space, metric]);
                }
            }
        }
    }
}

/// What the page shows is the median over the seeds, of RMSE and PSNR those of the mean squared
/// error.
fn check_median(journal: &str, row: &Value, [scene, reference, space, metric]: [&str; 4]) {
    let samples = &row["counters"]["samples"];
    let value = |errors: &Value| errors[space][metric].as_f64().expect("a number");
    let mut seeds: Vec<f64> = journal
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON"))
        .filter(|cell| cell["scene"] == scene && cell["counters"]["samples"] == *samples)
        .filter(|cell| cell["repetition"] == 0)
        .map(|cell| value(&cell["errors"][reference]))
        .collect();
    seeds.sort_by(f64::total_cmp);
    let [low, high] = seeds[..] else { panic!("two seeds: {seeds:?}") };
    let shown = value(&row["errors"][reference]);
    let expected = match metric {
        "rmse" => ((low * low + high * high) / 2.0).sqrt(),
        "psnr" => {
            let error = |decibels: f64| 10_f64.powf(-0.1 * decibels);
            -10.0 * ((error(low) + error(high)) / 2.0).log10()
        }
        // Of two numbers the median is their mean.
        _ => (low + high) / 2.0,
    };
    assert!((shown - expected).abs() <= 1e-12 * shown.abs(), "{shown}: {seeds:?}");
}

/// The pictures of the page are those of the files, to the 11 bits of a half.
fn check_pixels(folder: &Path, page: &str, scene: &Value, index: usize) {
    let cells = folder.join("out/cells");
    let name = scene["name"].as_str().expect("a name");
    let factor = scene["factor"].as_f64().expect("a factor") as f32;
    let pictures = scene["pictures"].as_array().expect("pictures");
    assert_eq!(pictures.len(), REFERENCES + VARIANTS);
    for (nth, picture) in pictures.iter().enumerate() {
        let file = match picture["reference"].as_str() {
            Some(reference) => format!("{name}-reference-{reference}.exr"),
            None => {
                let row = &scene["rows"][picture["row"].as_u64().expect("an index") as usize];
                format!("{name}-{}.exr", &row["cell"].as_str().expect("a key")[..16])
            }
        };
        let image = RadianceImage::read_exr(&cells.join(file)).expect("a picture");
        let text = script(page, &format!("picture-{index}-{nth}"));
        let bytes = BASE64_STANDARD.decode(text).expect("base64");
        let halves = bytes.chunks_exact(2).map(|b| f16::from_le_bytes([b[0], b[1]]).to_f32());
        assert_eq!(bytes.len(), 6 * image.pixels.len());
        for (half, value) in halves.zip(image.pixels.iter().flatten()) {
            let expected = value * factor;
            let bound = expected.abs() / 2048.0 + 2.0_f32.powi(-25);
            assert!((half - expected).abs() <= bound, "{half} for {expected}");
        }
    }
}

/// The layered picture of a row: image = direct + indirect, and the error is that of `indirect`.
fn check_layers(folder: &Path, scene: &Value) {
    let cells = folder.join("out/cells");
    let name = scene["name"].as_str().expect("a name");
    for row in scene["rows"].as_array().expect("rows") {
        let stem = format!("{name}-{}", &row["cell"].as_str().expect("a key")[..16]);
        let path = cells.join(format!("{stem}.layers.exr"));
        let file = exr::prelude::read_all_flat_layers_from_file(&path).expect("layers");
        let channel = |name: &str| -> Vec<f32> {
            let list = &file.layer_data[0].channel_data.list;
            let channel = list.iter().find(|channel| channel.name.eq(name)).expect(name);
            channel.sample_data.values_as_f32().collect()
        };
        let green = |path: &Path| -> Vec<f32> {
            let image = RadianceImage::read_exr(path).expect("a picture");
            image.pixels.iter().map(|pixel| pixel[1]).collect()
        };
        let picture = green(&cells.join(format!("{stem}.exr")));
        let truth = green(&cells.join(format!("{name}-reference-traced.exr")));
        let [image, direct] = ["image.G", "direct.G"].map(channel);
        assert_eq!(channel("indirect.G"), picture);
        assert!(direct.iter().any(|&value| value > 0.0), "the lamp lights something");
        for i in 0..picture.len() {
            assert_eq!(image[i], picture[i] + direct[i]);
            assert_eq!(channel("error.G")[i], picture[i] - truth[i]);
        }
    }
}

#[test]
fn a_folder_without_results_is_refused() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let name = folder.path().to_str().expect("UTF-8");
    refused(&["report", name], "manylights run");
    std::fs::write(folder.path().join("cells.jsonl"), "").expect("writable");
    refused(&["report", name], "no cells in cells.jsonl");
}

/// Put at the end of a copy of the page: uses it as a reader would, and says what it saw.
const READER: &str = r#"<script>
const { state, change, show, sortBy, pixel, paint } = window.manylights;
const text = (selector) => [...document.querySelectorAll(selector)].map((e) => e.textContent);
const eye = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
const color = (index) => {
  eye.drawImage(paint(index), 0, 0);
  return [...eye.getImageData(5, 7, 1, 1).data];
};
const key = (name) => document.body.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
const columns = text('#table thead tr:last-child th');
const seen = { ready: document.documentElement.dataset.ready, columns };
seen.ranks = text('#table tbody td:first-child');
sortBy('time');
seen.byTime = [...document.querySelectorAll('#table tbody tr')].map((row) => Number(row.dataset.row));
sortBy('time');
seen.byTimeDescending = [...document.querySelectorAll('#table tbody tr')].map((row) => Number(row.dataset.row));
seen.rows = text('#table tbody tr').length;
key('4');
seen.flipped = state.picture;
seen.pressed = text('#chips [aria-pressed="true"]');
seen.pixel = pixel(3, 5, 7);
seen.color = color(3);
key('s');
seen.mode = state.mode;
seen.truthError = color(0);
change({ mode: 'image', stops: 1 });
seen.brighter = color(3);
const stage = document.querySelector('#stage canvas');
const box = stage.getBoundingClientRect();
stage.dispatchEvent(new WheelEvent('wheel', { deltaY: -100, clientX: box.left + 1, clientY: box.top + 1, bubbles: true, cancelable: true }));
seen.zoomed = { ...state.view };
change({ tiles: true });
seen.tiles = document.querySelectorAll('#stage canvas').length;
seen.crops = document.querySelectorAll('.crop canvas').length;
change({ scene: 1 });
seen.cropsHidden = document.getElementById('crops').hidden;
seen.overflow = document.documentElement.scrollWidth - document.documentElement.clientWidth;
seen.failures = window.failures;
const report = document.createElement('pre');
report.id = 'seen';
report.textContent = JSON.stringify(seen);
document.body.append(report);
</script>
"#;
const LISTENER: &str = "<script>window.failures = []; \
    window.addEventListener('error', (event) => window.failures.push(String(event.message))); \
    console.error = console.warn = (...words) => window.failures.push(words.join(' '));</script>";

#[test]
fn a_browser_shows_flips_and_sorts() {
    let Some(browser) = std::env::var_os("MANYLIGHTS_BROWSER") else {
        eprintln!("not run: MANYLIGHTS_BROWSER names no browser (scripts/test does)");
        return;
    };
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    run(folder);
    let page = page(folder);
    let data: Value = serde_json::from_str(script(&page, "data")).expect("JSON");
    let page = page.replacen("<head>", &format!("<head>{LISTENER}"), 1);
    std::fs::write(folder.join("read.html"), page.replace("</body>", &format!("{READER}</body>")))
        .expect("writable");
    for width in [1400, 500] {
        let seen = seen(&browser, folder, width);
        check_seen(&seen, &data, width);
    }
}

fn seen(browser: &std::ffi::OsStr, folder: &Path, width: u32) -> Value {
    let output = Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args(["--virtual-time-budget=5000", "--enable-logging=stderr"])
        .arg(format!("--window-size={width},900"))
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(format!("file://{}", folder.join("read.html").display()))
        .env("XDG_RUNTIME_DIR", std::env::temp_dir())
        .output()
        .expect("the browser starts");
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(!log.contains("CONSOLE"), "the page complains: {log}");
    let dom = String::from_utf8_lossy(&output.stdout);
    let (_, rest) = dom.split_once("<pre id=\"seen\">").unwrap_or_else(|| panic!("{log}"));
    let text = rest.split_once("</pre>").expect("its end").0;
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&text).expect("JSON")
}

fn check_seen(seen: &Value, data: &Value, width: u32) {
    assert_eq!(seen["failures"], serde_json::json!([]), "{seen}");
    assert_eq!(seen["ready"], "true");
    assert_eq!(seen["rows"], VARIANTS);
    for column in ["rank", "PSNR dB", "SSIM", "RMSE", "÷ base", "bias"] {
        assert!(seen["columns"].as_array().expect("columns").contains(&column.into()), "{column}");
    }
    // The most samples come first in the file, take longest and are the best.
    assert!(seen["ranks"][0].as_str().expect("a rank").starts_with('1'), "{seen}");
    let rows = data["scenes"][0]["rows"].as_array().expect("rows");
    let mut by_time: Vec<usize> = (0..VARIANTS).collect();
    by_time.sort_by(|&a, &b| {
        let seconds = |row: usize| rows[row]["seconds"].as_f64().expect("a time");
        seconds(a).total_cmp(&seconds(b))
    });
    assert_eq!(seen["byTime"], serde_json::json!(by_time));
    by_time.reverse();
    assert_eq!(seen["byTimeDescending"], serde_json::json!(by_time));
    // Key 4: two references, then the second variant.
    assert_eq!(seen["flipped"], 3);
    assert_eq!(seen["pressed"], serde_json::json!(["4reference samples=16"]));
    check_color(seen);
    assert_eq!(seen["mode"], "signed");
    assert_eq!(seen["truthError"], serde_json::json!([0, 0, 0, 255]), "a reference is right");
    let view = &seen["zoomed"];
    let number = |name: &str| view[name].as_f64().expect("a number");
    assert!(number("zoom") > 1.3 && number("x") < 0.5 && number("y") < 0.5, "{view}");
    assert_eq!(seen["tiles"], REFERENCES + VARIANTS);
    assert_eq!(seen["crops"], REFERENCES + VARIANTS);
    assert_eq!(seen["cropsHidden"], true, "the second scene has none");
    assert_eq!(seen["overflow"], 0, "at {width} pixels the page scrolls sideways");
}

/// The canvas shows the sRGB values of the radiance that the page reads out.
fn check_color(seen: &Value) {
    for (component, (shown, brighter)) in seen["color"]
        .as_array()
        .expect("RGBA")
        .iter()
        .zip(seen["brighter"].as_array().expect("RGBA"))
        .take(3)
        .enumerate()
    {
        let radiance = seen["pixel"]["values"][component].as_f64().expect("a number") as f32;
        let image = RadianceImage { width: 1, height: 1, pixels: vec![[radiance; 3]] };
        for (exposure, shown) in [(1.0, shown), (2.0, brighter)] {
            let expected = f64::from(255.0 * image.display(exposure).pixels[0][0]);
            // Rounded to 8 bits, from a table of 8192 levels whose first step is 0.4 of 255.
            let shown = shown.as_f64().expect("a number");
            assert!((shown - expected).abs() <= 0.75, "{shown} for {expected}");
        }
    }
}
