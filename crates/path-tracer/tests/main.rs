//! All tests of the crate in one executable: each of its own links everything anew.

mod area_lights;
mod area_oracle;
mod cache;
mod determinism;
mod emitters;
mod integrating_sphere;
mod panels;
mod shading_normals;
mod transports;

#[path = "../../scene/tests/common/tensor.rs"]
mod tensor;
