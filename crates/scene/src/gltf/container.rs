//! From bytes to parsed JSON and the binary chunk.

use std::borrow::Cow;

use ::gltf as gltf_crate;
use gltf_crate::binary;
use gltf_crate::json::Root;
use serde::Deserialize;
use serde_json::Value;

use super::extensions::UNDERSTOOD;
use super::fault::broken;
use super::mentions::Mentions;
use crate::LoadError;

/// Bytes of a GLB's header.
const GLB_HEADER: usize = 12;

/// The two parts of a file, and what the first mentions.
pub(super) struct Parts<'a> {
    pub(super) root: Root,
    /// The binary chunk of a `.glb`.
    pub(super) binary: Option<Cow<'a, [u8]>>,
    pub(super) mentions: Mentions,
}

/// What has to be known before the rest of the JSON is worth reading.
#[derive(Deserialize)]
struct Head {
    asset: Asset,
    #[serde(default, rename = "extensionsRequired")]
    extensions_required: Vec<String>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
    #[serde(rename = "minVersion")]
    min_version: Option<String>,
}

/// Splits a file and parses its JSON.
///
/// # Errors
/// Malformed container or JSON, another version than 2, a required extension that is not understood.
pub(super) fn open(bytes: &[u8]) -> Result<Parts<'_>, LoadError> {
    let (json, binary) =
        if bytes.starts_with(b"glTF") { split(bytes)? } else { (bytes.into(), None) };
    let parse_error = |error: serde_json::Error| broken("JSON", error);
    check_head(&serde_json::from_slice(&json).map_err(parse_error)?)?;
    let mut value = serde_json::from_slice(&json).map_err(parse_error)?;
    check_integers(&value, &mut Vec::new())?;
    let mentions = Mentions::of(&value);
    // Only where it must: what is parsed from the text itself has line numbers in its errors.
    let root = if add_empty_scenes(&mut value) {
        serde_json::from_str(&value.to_string())
    } else {
        serde_json::from_slice(&json)
    };
    Ok(Parts { root: root.map_err(parse_error)?, binary, mentions })
}

/// A scene without `nodes` is an empty one; the crate insists on the member. Returns whether there
/// was such a scene.
fn add_empty_scenes(root: &mut Value) -> bool {
    let mut added = false;
    for scene in root.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(scene) = scene.as_object_mut().filter(|scene| !scene.contains_key("nodes")) {
            scene.insert("nodes".to_owned(), Value::Array(Vec::new()));
            added = true;
        }
    }
    added
}

type Chunks<'a> = (Cow<'a, [u8]>, Option<Cow<'a, [u8]>>);

fn split(bytes: &[u8]) -> Result<Chunks<'_>, LoadError> {
    // The crate subtracts the header from the length that the header states.
    let stated = bytes.get(8..GLB_HEADER).and_then(|field| field.try_into().ok());
    let stated = stated.map_or(0, u32::from_le_bytes) as usize;
    if stated < GLB_HEADER || stated > bytes.len() {
        let problem = format!("states {stated} bytes, the file has {}", bytes.len());
        return Err(broken("GLB header", problem));
    }
    match binary::Glb::from_slice(&bytes[..stated]) {
        Ok(glb) => Ok((glb.json, glb.bin)),
        Err(gltf_crate::Error::Binary(binary::Error::Version(version))) => {
            Err(version_error(version))
        }
        Err(error) => Err(broken("GLB chunks", error)),
    }
}

fn version_error(version: impl std::fmt::Display) -> LoadError {
    let problem = format!("glTF version {version} is not supported");
    LoadError::new("asset.version", problem, "export it as glTF 2.0")
}

fn check_head(head: &Head) -> Result<(), LoadError> {
    let version = head.asset.min_version.as_ref().unwrap_or(&head.asset.version);
    let supported = match &head.asset.min_version {
        Some(version) => version == "2.0",
        None => version.starts_with("2."),
    };
    if !supported {
        return Err(version_error(version));
    }
    let required = head.extensions_required.iter();
    match required.clone().find(|name| !UNDERSTOOD.contains(&name.as_str())) {
        Some(name) => {
            let problem = format!("requires the extension {name}, which is not supported");
            Err(LoadError::new("extensionsRequired", problem, "export it without that extension"))
        }
        None => Ok(()),
    }
}

/// The crate cuts indices to 32 bits: 2³² would become 0. Lengths are 64-bit and checked later; what
/// `extras` and the extensions of vendors hold is nobody's business.
fn check_integers<'a>(value: &'a Value, path: &mut Vec<&'a str>) -> Result<(), LoadError> {
    match value {
        Value::Number(number) if number.as_u64().is_some_and(|n| n > u32::MAX.into()) => {
            Err(broken(path.join("."), format!("the integer {number} is out of range")))
        }
        Value::Array(values) => values.iter().try_for_each(|value| check_integers(value, path)),
        Value::Object(members) => members.iter().try_for_each(|(key, value)| {
            let vendor = path.last() == Some(&"extensions") && !key.starts_with("KHR_");
            if vendor || matches!(key.as_str(), "extras" | "byteLength" | "byteOffset" | "count") {
                return Ok(());
            }
            path.push(key);
            check_integers(value, path)?;
            path.pop();
            Ok(())
        }),
        _ => Ok(()),
    }
}
