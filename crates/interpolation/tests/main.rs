//! All tests of this crate in one executable.

mod common;
mod grid;
mod near;
mod packing;
mod reading;
mod schemes;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
