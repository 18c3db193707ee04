//! Checks of buffer views and accessors against the bytes that are there.
//!
//! All arithmetic is on 128 bits: sums and products of 64-bit members of a hostile file cannot
//! overflow.

use ::gltf as gltf_crate;
use gltf_crate::json::accessor::sparse::Sparse;
use gltf_crate::json::validation::{Checked, USize64};
use gltf_crate::json::{Accessor, Index, Root, buffer};

use super::buffers::Buffers;
use super::fault::broken;
use crate::LoadError;

/// Checks every buffer view and accessor. References have been checked before.
pub(super) fn check(root: &Root, buffers: &Buffers) -> Result<(), LoadError> {
    for (i, view) in root.buffer_views.iter().enumerate() {
        let end = u128::from(offset(view.byte_offset)) + u128::from(view.byte_length.0);
        let length = buffers.get(view.buffer.value()).len();
        if end > length as u128 {
            let problem = format!("ends at byte {end} of a buffer of {length} bytes");
            return Err(broken(format!("bufferViews[{i}]"), problem));
        }
    }
    for (i, accessor) in root.accessors.iter().enumerate() {
        check_accessor(root, buffers, accessor)
            .map_err(|error| error.within(format!("accessors[{i}]")))?;
    }
    Ok(())
}

fn offset(offset: Option<USize64>) -> u64 {
    offset.map_or(0, |offset| offset.0)
}

fn check_accessor(root: &Root, buffers: &Buffers, accessor: &Accessor) -> Result<(), LoadError> {
    let (Checked::Valid(component), Checked::Valid(shape)) =
        (&accessor.component_type, &accessor.type_)
    else {
        return Err(broken("type", "is unknown"));
    };
    let count = accessor.count.0;
    let size = component.0.size() * shape.multiplicity();
    match accessor.buffer_view {
        Some(view) => fits(root, view, offset(accessor.byte_offset), count, size)?,
        // Zeros that nothing stands for: bounded by what the file could hold.
        None if count > buffers.total() => return Err(broken("count", "is beyond the file")),
        None => {}
    }
    match &accessor.sparse {
        Some(sparse) => {
            check_sparse(root, buffers, sparse, count, size).map_err(|error| error.within("sparse"))
        }
        None => Ok(()),
    }
}

/// Checks that `count` elements of `size` bytes lie within the view.
fn fits(
    root: &Root,
    view: Index<buffer::View>,
    offset: u64,
    count: u64,
    size: usize,
) -> Result<(), LoadError> {
    let view = &root.buffer_views[view.value()];
    let stride = view.byte_stride.map_or(size, |stride| stride.0);
    if count == 0 {
        return Err(broken("count", "is zero"));
    }
    if stride < size {
        let problem = format!("is {stride} bytes for elements of {size}");
        return Err(broken("byteStride of its buffer view", problem));
    }
    let end = u128::from(offset) + stride as u128 * u128::from(count - 1) + size as u128;
    let length = view.byte_length.0;
    if end > u128::from(length) {
        let problem = format!("{count} elements end at byte {end} of a view of {length} bytes");
        return Err(broken("count", problem));
    }
    Ok(())
}

fn check_sparse(
    root: &Root,
    buffers: &Buffers,
    sparse: &Sparse,
    count: u64,
    size: usize,
) -> Result<(), LoadError> {
    let Checked::Valid(component) = &sparse.indices.component_type else {
        return Err(broken("indices", "have an unknown type"));
    };
    let width = component.0.size();
    let (indices, values) = (&sparse.indices, &sparse.values);
    fits(root, indices.buffer_view, indices.byte_offset.0, sparse.count.0, width)?;
    fits(root, values.buffer_view, values.byte_offset.0, sparse.count.0, size)?;

    // The crate's iterator skips indices in silence unless they rise.
    let view = &root.buffer_views[indices.buffer_view.value()];
    let start = (offset(view.byte_offset) + indices.byte_offset.0) as usize;
    let stride = view.byte_stride.map_or(width, |stride| stride.0);
    let bytes = &buffers.get(view.buffer.value())[start..];
    let mut next = 0;
    for element in bytes.chunks(stride).take(sparse.count.0 as usize) {
        let mut index = [0; 8];
        index[..width].copy_from_slice(&element[..width]);
        let index = u64::from_le_bytes(index);
        if index < next || index >= count {
            let problem = format!("must rise and stay below {count}; one is {index}");
            return Err(broken("indices", problem));
        }
        next = index + 1;
    }
    Ok(())
}
