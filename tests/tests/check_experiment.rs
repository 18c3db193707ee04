//! What `manylights check` guards.

use std::collections::BTreeSet;
use std::path::Path;

use manylights_harness::registry::METHODS;
use manylights_method::{Error, Method};
use manylights_scene::{Transport, Visibility};
use manylights_tests::Stage;

/// Methods and visibilities that the experiment lists, by name.
fn listed(experiment: &toml::Table) -> BTreeSet<[String; 2]> {
    let own = |id: &str| METHODS.iter().find(|method| method.id() == id).map(|m| m.visibility());
    let mut listed = BTreeSet::new();
    for entry in experiment["methods"].as_array().expect("methods") {
        let id = entry["id"].as_str().expect("an id");
        let visibilities = match entry.get("visibility") {
            None => vec![own(id).expect("registered").to_string()],
            Some(toml::Value::String(one)) => vec![one.clone()],
            Some(list) => list.clone().try_into().expect("names"),
        };
        listed.extend(visibilities.into_iter().map(|visibility| [id.to_owned(), visibility]));
    }
    listed
}

/// The words that a method is listed with, where all its entries agree on one: what a scene needs so that
/// the method takes it.
fn words(experiment: &toml::Table, id: &str) -> Vec<(String, String)> {
    let entries = experiment["methods"].as_array().expect("methods").iter();
    let mut entries = entries.filter(|entry| entry["id"].as_str() == Some(id));
    let of = |entry: &toml::Value, name: &str| {
        let value = entry.get("parameters")?.get(name)?;
        value.as_str().map(str::to_owned)
    };
    let Some(first) = entries.next() else { return Vec::new() };
    let rest: Vec<_> = entries.collect();
    let names = first.get("parameters").and_then(toml::Value::as_table).into_iter().flatten();
    names
        .filter_map(|(name, _)| Some((name.clone(), of(first, name)?)))
        .filter(|(name, word)| rest.iter().all(|entry| of(entry, name).as_ref() == Some(word)))
        .collect()
}

/// Whether a method renders one of the scenes.
fn renders(
    method: &dyn Method,
    stages: &[Stage],
    transport: Transport,
    words: &[(String, String)],
) -> bool {
    let words: Vec<_> = words.iter().map(|(name, word)| (&**name, &**word)).collect();
    stages.iter().any(|stage| match stage.prepare(method, &words, transport, 0) {
        Ok(_) => true,
        Err(Error::Declined(_)) => false,
        Err(error) => panic!("{}: {error}", method.id()),
    })
}

/// Of a built-in scene or of one of the repository's.
fn stage(name: &str) -> Stage {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    let scene = if file.is_file() { file.to_str().expect("UTF-8") } else { name };
    Stage::new(manylights_scene::load(scene, None).expect("a scene"), [8, 8])
}

/// Fails where a method renders the transport of a baseline's experiment and is not listed there. Returns
/// the methods that it guards.
fn guarded(folder: &str) -> BTreeSet<&'static str> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../results").join(folder);
    let text = std::fs::read_to_string(path.join("experiment.toml")).expect("an experiment");
    let experiment: toml::Table = text.parse().expect("TOML");
    let transport: Transport = experiment["transport"]
        .as_str()
        .and_then(|name| name.parse().ok())
        .filter(|transport: &Transport| transport.visibility().is_some())
        .expect("a transport whose visibility is a choice");
    let scenes = experiment["scenes"].as_array().expect("scenes").iter();
    let stages: Vec<_> = scenes.map(|name| stage(name.as_str().expect("a name"))).collect();
    let listed = listed(&experiment);
    let mut guarded = BTreeSet::new();
    for method in METHODS {
        let words = words(&experiment, method.id());
        for visibility in [Visibility::Traced, Visibility::Ignored] {
            if renders(*method, &stages, transport.with_visibility(visibility), &words) {
                let asked = [method.id().to_owned(), visibility.to_string()];
                assert!(listed.contains(&asked), "results/{folder} does not run {asked:?}");
                guarded.insert(method.id());
            }
        }
    }
    guarded
}

#[test]
fn every_method_and_visibility_is_guarded() {
    let guarded: BTreeSet<_> = ["check", "check-direct"].into_iter().flat_map(guarded).collect();
    for method in METHODS {
        assert!(guarded.contains(method.id()), "no baseline suits {}", method.id());
    }
}
