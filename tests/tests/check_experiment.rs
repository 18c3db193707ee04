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

/// Whether a method renders one of the scenes.
fn renders(method: &dyn Method, stages: &[Stage], transport: Transport) -> bool {
    stages.iter().any(|stage| match stage.prepare(method, &[], transport, 0) {
        Ok(_) => true,
        Err(Error::Declined(_)) => false,
        Err(error) => panic!("{}: {error}", method.id()),
    })
}

#[test]
fn every_method_and_visibility_is_guarded() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../results/check/experiment.toml");
    let text = std::fs::read_to_string(path).expect("the experiment of the check");
    let experiment: toml::Table = text.parse().expect("TOML");
    let transport = experiment["transport"].as_str().expect("a transport");
    assert_eq!(transport, "indirect-1", "both visibilities need a last segment");
    let scenes = experiment["scenes"].as_array().expect("scenes").iter();
    let stages: Vec<_> =
        scenes.map(|name| Stage::builtin(name.as_str().expect("a name"), [8, 8])).collect();
    let listed = listed(&experiment);
    for method in METHODS {
        let mut guarded = false;
        for visibility in [Visibility::Traced, Visibility::Ignored] {
            let transport = Transport::Indirect { bounces: 1, visibility };
            if renders(*method, &stages, transport) {
                let asked = [method.id().to_owned(), visibility.to_string()];
                assert!(listed.contains(&asked), "results/check does not run {asked:?}");
                guarded = true;
            }
        }
        assert!(guarded, "no scene of results/check suits {}", method.id());
    }
}
