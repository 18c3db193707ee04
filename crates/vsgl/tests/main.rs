//! All tests of the crate in one executable: each of its own links everything anew.

mod biases;
mod common;
mod hard_cases;
mod lobes;
mod oracle;
mod point_lights;
mod shaders;
mod truth;
