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

/// The words of each entry of a method, or none where it is not listed: what a scene may need so that the
/// method takes it.
fn words(experiment: &toml::Table, id: &str) -> Vec<Vec<(String, String)>> {
    let entries = experiment["methods"].as_array().expect("methods").iter();
    let of = |entry: &toml::Value| {
        let table = entry.get("parameters").and_then(toml::Value::as_table);
        let word =
            |(name, value): (&String, &toml::Value)| Some((name.clone(), value.as_str()?.into()));
        table.into_iter().flatten().filter_map(word).collect()
    };
    let listed: Vec<_> = entries.filter(|entry| entry["id"].as_str() == Some(id)).map(of).collect();
    if listed.is_empty() { vec![Vec::new()] } else { listed }
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
            let transport = transport.with_visibility(visibility);
            if words.iter().any(|words| renders(*method, &stages, transport, words)) {
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
