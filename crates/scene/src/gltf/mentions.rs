//! What a file mentions anywhere in its JSON, also where the crate's types have no member for it.

use std::collections::BTreeMap;

use serde_json::Value;

use super::extensions::UNDERSTOOD;

/// Extensions that are not understood, and files beside the scene.
#[derive(Default)]
pub(super) struct Mentions {
    /// By name: how many objects carry it, declared or not; 1 where it is declared alone.
    pub(super) extensions: BTreeMap<String, u64>,
    /// URIs of files, whether import reads them or not.
    pub(super) uris: Vec<String>,
}

impl Mentions {
    /// Those of a parsed file.
    pub(super) fn of(root: &Value) -> Self {
        let mut mentions = Self::default();
        mentions.walk(root);
        let declared = root.get("extensionsUsed").and_then(Value::as_array).into_iter().flatten();
        for name in declared.filter_map(Value::as_str).filter(|name| !UNDERSTOOD.contains(name)) {
            mentions.extensions.entry(name.to_owned()).or_insert(1);
        }
        mentions
    }

    /// The parser has bounded the depth.
    fn walk(&mut self, value: &Value) {
        match value {
            Value::Array(values) => values.iter().for_each(|value| self.walk(value)),
            Value::Object(members) => {
                for (key, value) in members {
                    match (key.as_str(), value) {
                        // Nobody's business.
                        ("extras", _) => {}
                        ("uri", Value::String(uri)) if !uri.starts_with("data:") => {
                            self.uris.push(uri.clone());
                        }
                        ("extensions", Value::Object(extensions)) => self.carried(extensions),
                        _ => self.walk(value),
                    }
                }
            }
            _ => {}
        }
    }

    fn carried(&mut self, extensions: &serde_json::Map<String, Value>) {
        for (name, value) in extensions {
            if !UNDERSTOOD.contains(&name.as_str()) {
                *self.extensions.entry(name.clone()).or_default() += 1;
            }
            self.walk(value);
        }
    }
}
