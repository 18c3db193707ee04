//! The bytes behind buffers and images: the binary chunk, `data:` URIs and files beside the scene.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use ::gltf as gltf_crate;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf_crate::json::{Buffer, Root};
use percent_encoding::percent_decode_str;

use super::fault::broken;
use crate::LoadError;

/// The data of all buffers, each cut to its stated length.
pub(super) struct Buffers<'a>(Vec<Cow<'a, [u8]>>);

impl<'a> Buffers<'a> {
    /// Reads them. Nothing is allocated for bytes that are not there.
    ///
    /// # Errors
    /// A URI that is refused or cannot be read, data shorter than stated.
    pub(super) fn read(
        root: &Root,
        folder: &Path,
        mut binary: Option<Cow<'a, [u8]>>,
    ) -> Result<Self, LoadError> {
        let mut buffers = Vec::new();
        for (i, buffer) in root.buffers.iter().enumerate() {
            // Only the first buffer can be the binary chunk.
            let chunk = if i == 0 { binary.take() } else { None };
            let data = read_buffer(buffer, folder, chunk)
                .map_err(|error| error.within(format!("buffers[{i}]")))?;
            buffers.push(data);
        }
        Ok(Self(buffers))
    }

    /// The bytes of a buffer.
    pub(super) fn get(&self, index: usize) -> &[u8] {
        &self.0[index]
    }

    /// Bytes of all buffers together.
    pub(super) fn total(&self) -> u64 {
        self.0.iter().map(|buffer| buffer.len() as u64).sum()
    }
}

fn read_buffer<'a>(
    buffer: &Buffer,
    folder: &Path,
    chunk: Option<Cow<'a, [u8]>>,
) -> Result<Cow<'a, [u8]>, LoadError> {
    let stated = buffer.byte_length.0;
    let mut data = match (&buffer.uri, chunk) {
        (Some(uri), _) => Cow::Owned(resolve(uri, folder, stated)?),
        (None, Some(chunk)) => chunk,
        (None, None) => return Err(broken("uri", "is missing, and there is no binary chunk")),
    };
    if (data.len() as u64) < stated {
        let problem = format!("is {stated}, but only {} bytes are there", data.len());
        return Err(broken("byteLength", problem));
    }
    let stated = stated as usize;
    match &mut data {
        Cow::Borrowed(bytes) => *bytes = &bytes[..stated],
        Cow::Owned(bytes) => bytes.truncate(stated),
    }
    Ok(data)
}

/// The bytes that a URI stands for, at most `limit` of them if it names a file.
///
/// # Errors
/// Schemes other than `data:`, paths that leave `folder`, files that cannot be read.
pub(super) fn resolve(uri: &str, folder: &Path, limit: u64) -> Result<Vec<u8>, LoadError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, encoded)) = data.split_once(";base64,") else {
            return Err(broken("uri", "is a data: URI without base64 data"));
        };
        return STANDARD.decode(encoded).map_err(|error| broken("uri", error));
    }
    let path = folder.join(relative_path(uri)?);
    let failed = |error: std::io::Error| {
        let remedy = "put the file there, or export the scene as one .glb file";
        LoadError::new("uri", format!("{}: {error}", path.display()), remedy)
    };
    if !path.metadata().map_err(failed)?.is_file() {
        return Err(broken("uri", format!("{} is not a file", path.display())));
    }
    let mut bytes = Vec::new();
    File::open(&path).map_err(failed)?.take(limit).read_to_end(&mut bytes).map_err(failed)?;
    Ok(bytes)
}

/// The path that a URI means, whether it may be read or not.
pub(super) fn mentioned(uri: &str, folder: &Path) -> PathBuf {
    folder.join(percent_decode_str(uri).decode_utf8_lossy().as_ref())
}

/// The decoded path of a relative URI, which must not leave the folder that it is relative to.
fn relative_path(uri: &str) -> Result<PathBuf, LoadError> {
    let refuse = |why: &str| {
        let remedy = "put the file beside the scene and name it by a relative path";
        Err(LoadError::new("uri", format!("`{uri}` {why}"), remedy))
    };
    let Ok(decoded) = percent_decode_str(uri).decode_utf8() else {
        return refuse("is not UTF-8");
    };
    // A colon before any slash is a scheme or a drive; a backslash is a separator on some systems.
    let first = decoded.split('/').next().unwrap_or_default();
    if first.contains(':') {
        return refuse("has a scheme; only relative paths and data: are read");
    }
    if decoded.contains(['\\', '\0']) {
        return refuse("is not a path");
    }
    let path = Path::new(decoded.as_ref());
    let mut depth = 0_i32;
    for component in path.components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::CurDir => {}
            Component::ParentDir => depth -= 1,
            Component::RootDir | Component::Prefix(_) => return refuse("is an absolute path"),
        }
        if depth < 0 {
            return refuse("leaves the folder of the scene");
        }
    }
    Ok(path.to_owned())
}
