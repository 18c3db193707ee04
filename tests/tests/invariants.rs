//! The invariants of ARCHITECTURE.md that a test can see.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use manylights_harness::registry::METHODS;
use manylights_method::Method;

/// Crates that no method may be named in, with their floors. All other crates are methods, but for the
/// path tracer, which is a method and makes the references.
const FLOORS: [(&str, u32); 11] = [
    ("harmonics", 0),
    ("scene", 0),
    ("metrics", 0),
    ("gpu", 1),
    ("reflectance", 1),
    ("method", 2),
    ("paths", 2),
    ("virtual-lights", 3),
    ("interpolation", 3),
    ("area-lights", 4),
    ("harness", 6),
];
const METHOD_FLOOR: u32 = 5;
const PATH_TRACER: &str = "path-tracer";
/// The only list of methods.
const REGISTRY: &str = "crates/harness/src/registry.rs";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Manifests of all crates, by folder name.
fn manifests() -> BTreeMap<String, toml::Table> {
    let folders = root().join("crates").read_dir().expect("crates");
    folders
        .map(|folder| folder.expect("readable").path())
        .map(|folder| {
            let name = folder.file_name().and_then(|name| name.to_str()).expect("UTF-8");
            (name.to_owned(), read(&folder.join("Cargo.toml")).parse().expect("a manifest"))
        })
        .collect()
}

/// Names of what a crate depends on, development included where `development`.
fn dependencies(manifest: &toml::Table, development: bool) -> Vec<&str> {
    let mut tables = vec![manifest];
    if let Some(targets) = manifest.get("target").and_then(toml::Value::as_table) {
        tables.extend(targets.values().filter_map(toml::Value::as_table));
    }
    let mut kinds = vec!["dependencies", "build-dependencies"];
    if development {
        kinds.push("dev-dependencies");
    }
    let sections = tables.iter().flat_map(|table| kinds.iter().filter_map(|kind| table.get(*kind)));
    sections
        .filter_map(toml::Value::as_table)
        .flat_map(toml::Table::keys)
        .map(String::as_str)
        .collect()
}

fn floor(krate: &str) -> u32 {
    FLOORS.iter().find(|(name, _)| *name == krate).map_or(METHOD_FLOOR, |(_, floor)| *floor)
}

/// Text files below `folder`, with their contents.
fn texts(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in folder.read_dir().into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(texts(&path));
        } else if let Ok(text) = std::fs::read_to_string(&path) {
            found.push((path, text));
        }
    }
    found
}

#[test]
fn only_gpu_depends_on_wgpu() {
    for (krate, manifest) in manifests() {
        let names_wgpu = dependencies(&manifest, true).iter().any(|name| {
            name.starts_with("wgpu") || name.starts_with("naga") || name.starts_with("wesl")
        });
        assert_eq!(names_wgpu, krate == "gpu", "{krate}");
    }
}

#[test]
fn crates_depend_on_lower_floors_alone() {
    for (krate, manifest) in manifests() {
        for dependency in dependencies(&manifest, false) {
            let Some(dependency) = dependency.strip_prefix("manylights-") else { continue };
            let lower = floor(dependency) < floor(&krate);
            // Both of floor 0 and 1 hold what the other floors are made of: gpu draws scenes.
            assert!(lower, "{krate} (floor {}) depends on {dependency}", floor(&krate));
        }
    }
}

#[test]
fn infrastructure_never_names_a_method() {
    let crates = manifests();
    let methods: Vec<&str> = crates
        .keys()
        .map(String::as_str)
        .filter(|name| floor(name) == METHOD_FLOOR && *name != PATH_TRACER)
        .collect();
    let truth = manylights_path_tracer::PathTracer.id();
    let ids = METHODS.iter().map(|method| method.id()).filter(|id| *id != truth);
    let mut names: Vec<String> =
        methods.iter().copied().chain(ids).map(|n| format!("\"{n}\"")).collect();
    names.extend(methods.iter().map(|method| format!("manylights_{}", method.replace('-', "_"))));
    for (krate, _) in FLOORS {
        for (path, text) in texts(&root().join("crates").join(krate).join("src")) {
            if path.ends_with(REGISTRY) {
                continue;
            }
            for name in &names {
                assert!(!text.contains(name), "{} names {name}", path.display());
            }
        }
    }
}

#[test]
fn every_method_crate_is_registered() {
    let registry = read(&root().join(REGISTRY));
    let crates = manifests();
    let methods: Vec<_> = crates.keys().filter(|name| floor(name) == METHOD_FLOOR).collect();
    for method in &methods {
        let module = format!("manylights_{}", method.replace('-', "_"));
        assert!(registry.contains(&module), "{method} is not in {REGISTRY}");
    }
    assert!(METHODS.len() >= methods.len());
}

/// Where an oracle in double precision says what a method's pictures should be: `src/oracle.rs`, or a
/// folder of that name, and a test that asks it; of the path tracer a sum over lit points, which is the
/// limit of them all.
#[test]
fn every_method_has_an_oracle_and_tests_that_ask_it() {
    for (krate, _) in manifests() {
        if floor(&krate) != METHOD_FLOOR {
            continue;
        }
        let folder = root().join("crates").join(&krate);
        let asks = if krate == PATH_TRACER {
            "oracle.radiance("
        } else {
            let places = ["src/oracle.rs", "src/oracle/mod.rs"].map(|place| folder.join(place));
            let oracle = places.iter().find(|place| place.is_file());
            let oracle = oracle.unwrap_or_else(|| panic!("{krate} has no src/oracle.rs"));
            assert!(read(oracle).contains("f64") || read(oracle).contains("DVec3"), "{krate}");
            "oracle::radiance("
        };
        let asked = texts(&folder.join("tests")).iter().any(|(_, text)| text.contains(asks));
        assert!(asked, "no test of {krate} asks its oracle");
    }
}

#[test]
fn every_crate_obeys_the_workspace_lints_and_says_what_it_is() {
    for (krate, manifest) in manifests() {
        let lints = manifest.get("lints").and_then(|lints| lints.get("workspace"));
        assert_eq!(lints.and_then(toml::Value::as_bool), Some(true), "{krate}");
        let package = manifest["package"].as_table().expect("a table");
        assert_eq!(package["name"].as_str(), Some(format!("manylights-{krate}").as_str()));
        assert!(package["description"].as_str().is_some_and(|text| text.len() > 10), "{krate}");
    }
}

#[test]
fn no_file_names_a_place_of_one_machine() {
    // In pieces, so that this file passes.
    let places = ["ho", "Use", "ro"].map(|start| format!("/{start}"));
    let ends = ["me/", "rs/", "ot/"];
    let mut places: Vec<String> = places.iter().zip(ends).map(|(a, b)| format!("{a}{b}")).collect();
    places.push(["/wo", "rk/"].concat());
    let root = root();
    let mut files: Vec<_> = ["crates", "tests", "scenes", "results", "scripts", ".ci"]
        .iter()
        .flat_map(|folder| texts(&root.join(folder)))
        .collect();
    let top = root.read_dir().expect("readable").flatten().map(|entry| entry.path());
    files.extend(
        // In a worktree `.git` is a file.
        top.filter(|p| p.is_file() && !p.ends_with(".git"))
            .filter_map(|p| Some((p.clone(), std::fs::read_to_string(p).ok()?))),
    );
    assert!(files.len() > 50, "only {} files found", files.len());
    for (path, text) in files {
        for place in &places {
            assert!(!text.contains(place), "{} names {place}", path.display());
        }
    }
}
