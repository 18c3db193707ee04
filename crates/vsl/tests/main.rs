//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod hard_cases;
mod oracle;
mod shaders;
mod truth;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
