//! No two files of a crate import each other, be it through others.

mod uses;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use uses::{Use, uses};

/// Modules of a crate by path (`a::b`; the root is empty), with what their files import and re-export.
type Modules = BTreeMap<String, Vec<Use>>;

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

fn modules(src: &Path) -> Modules {
    let module = |file: PathBuf| {
        let relative = file.strip_prefix(src).expect("below src").with_extension("");
        let mut parts: Vec<_> =
            relative.iter().map(|part| part.to_str().expect("UTF-8").to_owned()).collect();
        if parts.last().is_some_and(|last| ["mod", "lib"].contains(&last.as_str())) {
            parts.pop();
        }
        let text = std::fs::read_to_string(&file).expect("readable");
        let name = parts.join("::");
        let found = uses(&text, &name);
        (name, found)
    };
    sources(src).into_iter().filter(|file| !file.ends_with("main.rs")).map(module).collect()
}

/// The module whose file declares what a path from the root names.
fn declared_in(modules: &Modules, path: &[String], depth: usize) -> Option<String> {
    let prefix = (0..=path.len()).rev().find(|&n| modules.contains_key(&path[..n].join("::")))?;
    let module = path[..prefix].join("::");
    let Some(name) = path.get(prefix) else { return Some(module) };
    let source = modules[&module].iter().find(|used| used.public && used.name == *name);
    match source {
        // Two files that re-export a name from each other declare nothing.
        Some(used) if depth < 8 => declared_in(modules, used.path.as_ref()?, depth + 1),
        _ => Some(module),
    }
}

fn imports(modules: &Modules) -> BTreeMap<&str, BTreeSet<String>> {
    modules
        .iter()
        .map(|(name, found)| {
            let targets = found
                .iter()
                .filter(|used| !used.public)
                .filter_map(|used| declared_in(modules, used.path.as_ref()?, 0))
                .filter(|target| target != name);
            (name.as_str(), targets.collect())
        })
        .collect()
}

/// A way from a module back to itself, where there is one.
fn circle(graph: &BTreeMap<&str, BTreeSet<String>>, start: &str) -> Option<Vec<String>> {
    let mut ways = vec![vec![start.to_owned()]];
    let mut seen = BTreeSet::new();
    while let Some(way) = ways.pop() {
        for next in &graph[way.last().expect("starts somewhere").as_str()] {
            if next == start {
                return Some(way);
            }
            if seen.insert(next.clone()) {
                ways.push([&way[..], std::slice::from_ref(next)].concat());
            }
        }
    }
    None
}

fn circles(modules: &Modules) -> Vec<String> {
    let graph = imports(modules);
    let found = graph.keys().filter_map(|start| circle(&graph, start));
    found.map(|way| way.join(" -> ")).collect()
}

#[test]
fn no_crate_has_one() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut files = 0;
    for folder in crates.read_dir().expect("crates").flatten() {
        let modules = modules(&folder.path().join("src"));
        files += modules.len();
        let found = circles(&modules);
        assert!(found.is_empty(), "{}: {}", folder.path().display(), found.join("; "));
    }
    assert!(files > 200, "only {files} files found");
}

#[test]
fn circles_are_found_through_re_exports_and_plain_paths() {
    let module = |name: &str, text: &str| (name.to_owned(), uses(text, name));
    let root = module("", "mod a;\nmod b;\npub use a::{A, Other};\npub(crate) use b::B;\n");
    let through_root = [
        root.clone(),
        module("a", "use crate::{B,\n    Elsewhere};\npub struct A;"),
        module("b", "pub struct B(crate::A);"),
    ];
    assert_eq!(circles(&Modules::from(through_root)), ["a -> b", "b -> a"]);
    let one_way = [
        root,
        module("a", "use crate::B;\npub struct A;"),
        module(
            "b",
            "// crate::A\npub struct B;\n#[cfg(test)]\nmod tests {\n    use crate::A;\n}\n",
        ),
    ];
    assert_eq!(circles(&Modules::from(one_way)), [""; 0]);
    let parent_and_child = [
        module("", ""),
        module("a", "mod child;\nuse child::Child;\nstruct Parent;"),
        module("a::child", "use super::Parent;\npub struct Child;"),
    ];
    assert_eq!(circles(&Modules::from(parent_and_child)).len(), 2);
}
