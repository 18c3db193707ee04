//! All tests of the crate in one executable: each of its own links everything anew.

mod bake;
mod common;
mod diffuse;
mod floors;
mod gather;
mod hard_cases;
mod interpolated;
mod narrow;
mod products;
mod projection;
mod scenes;
mod shaders;
mod smoothed;
mod tables;
mod truth;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
