//! All tests of the crate in one executable: each of its own links everything anew.

mod closed_form;
mod common;
mod exact;
mod gather;
mod hard_cases;
mod operations;
mod shared;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
