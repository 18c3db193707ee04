//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod forms;
mod gather;

#[path = "../../../tests/examples/polygon_approximations/study.rs"]
mod study;
