//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod exact;
mod forms;
mod gather;
mod hard_cases;
mod scenes;
mod shaders;
mod truth;

#[path = "../../../tests/examples/polygon_approximations/study.rs"]
mod study;
