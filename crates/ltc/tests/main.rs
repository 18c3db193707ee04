//! All tests of the crate in one executable: each of its own links everything anew.

mod common;
mod gather;
mod hard_cases;
mod operations;
mod scenes;
mod shared;
mod truth;

#[path = "../../reflectance/examples/fit_transformed_cosines/triangles.rs"]
mod triangles;
