//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod exact;
mod forms;
mod forms_hard_cases;
mod gather;
mod scenes;
mod shaders;
mod truth;

#[path = "../../../tests/examples/polygon_approximations/study.rs"]
mod study;
