//! All tests of the crate in one executable: each of its own links everything anew.

mod brdf;
mod common;
mod oracle;
mod shaders;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
