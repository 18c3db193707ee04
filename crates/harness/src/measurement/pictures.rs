//! Where the pictures of cells are.

use std::path::{Path, PathBuf};

/// The picture of a cell, without extension. The name is the key's: settings may be many.
pub(crate) fn image_path(out: &Path, scene: &str, key: &str) -> PathBuf {
    out.join("cells").join(format!("{scene}-{}", &key[..16]))
}
