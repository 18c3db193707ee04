use std::path::Path;

use ::gltf as gltf_crate;
use gltf_crate::Document;

use super::buffers::Buffers;

/// A checked file and the bytes behind it.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    /// Where its URIs start.
    pub(super) folder: &'a Path,
}
