//! What pictures are compared with: path-traced pictures, or those of another method.

use manylights_scene::{Transport, Visibility};
use serde::Deserialize;

use crate::names;
use crate::question::plan::{Variant, no_choice};
use crate::question::sweep;
use crate::registry::Methods;

/// A reference of an experiment.
#[derive(Debug)]
pub(crate) struct Reference {
    /// In tables, files and cells: lower case, digits and hyphens.
    pub(crate) name: String,
    /// Who makes it.
    pub(crate) source: Source,
}

/// Who makes a reference.
#[derive(Debug)]
pub(crate) enum Source {
    /// The path tracer, with this visibility of the last segment, which names it.
    Paths(Visibility),
    /// Another method: a picture for each seed, compared with the pictures of that seed.
    Method(Box<Variant>),
}

impl Reference {
    /// For headings: who makes it, and how.
    pub(crate) fn description(&self, transport: Transport, samples: u32) -> String {
        match &self.source {
            Source::Paths(visibility) => {
                let chosen = transport.visibility().map(|_| format!(", visibility {visibility}"));
                format!("path traced{}, {samples} samples a pixel", chosen.unwrap_or_default())
            }
            Source::Method(variant) => format!("{}, of the same seed", variant.label()),
        }
    }

    /// Whether it is a picture of the path tracer, whose noise is known.
    pub(crate) fn is_path_traced(&self) -> bool {
        matches!(self.source, Source::Paths(_))
    }
}

/// A reference in an experiment file that is more than a visibility.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceEntry {
    name: String,
    method: Option<sweep::MethodEntry>,
}

/// The references of an experiment file: the names of path-traced ones, or tables of a name and, of
/// others, a method.
///
/// # Errors
/// One line: a name that is taken or malformed, a method that is no single variant, a visibility that
/// the transport lacks.
pub(crate) fn parse(
    written: &[toml::Value],
    transport: Transport,
    methods: Methods,
) -> Result<Vec<Reference>, String> {
    let mut references: Vec<Reference> = Vec::new();
    for value in written {
        let reference =
            reference(value, transport, methods).map_err(|r| format!("references: {r}"))?;
        if references.iter().any(|other| other.name == reference.name) {
            return Err(format!("references: `{}` is listed twice", reference.name));
        }
        references.push(reference);
    }
    Ok(references)
}

fn reference(
    value: &toml::Value,
    transport: Transport,
    methods: Methods,
) -> Result<Reference, String> {
    let ReferenceEntry { name, method } = match value {
        toml::Value::String(name) => ReferenceEntry { name: name.clone(), method: None },
        toml::Value::Table(table) => {
            table.clone().try_into().map_err(|e: toml::de::Error| names::mended(e.message()))?
        }
        other => return Err(format!("`{other}` is neither a name nor a table")),
    };
    let traced: Result<Visibility, _> = name.parse();
    let source = match (traced, method) {
        (Ok(Visibility::Ignored), None) if transport.visibility().is_none() => {
            return Err(format!("`{name}`: {}", no_choice(transport)));
        }
        (Ok(visibility), None) => Source::Paths(visibility),
        (Ok(_), Some(_)) => {
            return Err(format!("`{name}` names a path-traced reference: choose another name"));
        }
        (Err(unknown), None) => {
            return Err(format!("{unknown} (path traced), or add a `method` that makes `{name}`"));
        }
        (Err(_), Some(method)) => {
            let at = |reason| format!("`{name}`: {reason}");
            let variant = method.single(methods).map_err(at)?;
            variant.check_visibility(transport).map_err(at)?;
            Source::Method(Box::new(variant))
        }
    };
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if name.is_empty() || !name.chars().all(plain) {
        return Err(format!("name `{name}`: use lower-case letters, digits and hyphens"));
    }
    Ok(Reference { name, source })
}
