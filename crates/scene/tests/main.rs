//! All tests of the crate in one executable: each of its own links everything anew.

mod assets;
mod brdf;
mod builtins;
mod bvh;
mod common;
mod gltf_import;
mod gltf_notes;
mod gltf_structure;
mod gltf_values;
mod light_refusals;
mod light_sets;
mod lights;
mod measured;
mod parts;
mod polygons;
mod scene_files;
mod texture;
mod watertight;

#[path = "common/tensor.rs"]
mod tensor;
