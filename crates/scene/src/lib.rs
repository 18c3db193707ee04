//! Scenes as every method here sees them: indexed triangles with Lambert + isotropic GGX materials,
//! point-like primary lights, lights with a surface, cameras.
//!
//! Units: lengths in metres, radiance in W·m⁻²·sr⁻¹ (linear Rec. 709), point lights by radiant
//! intensity in W·sr⁻¹, directional lights by irradiance on a facing plane in W·m⁻². The photometric
//! numbers of `KHR_lights_punctual` (candela, lux) are taken as these radiometric ones unchanged.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod area_light;
pub mod brdf;
pub mod builtin;
pub mod bvh;
pub mod camera;
mod content;
mod error;
mod gltf;
mod image_file;
pub mod light;
mod load;
mod lobe;
pub mod material;
pub mod measured;
mod mesh;
pub mod presets;
mod scene;
mod scene_file;
pub mod surface;
mod transport;

pub use area_light::AreaLight;
pub use brdf::{Brdf, DBrdf};
pub use camera::Camera;
pub use content::{content_digest, content_hash};
pub use error::LoadError;
pub use light::Light;
pub use load::{SceneEntry, SceneKind, list, load};
pub use lobe::Lobe;
pub use material::{Material, Texture};
pub use measured::Measured;
pub use scene::{Scene, Triangle, Vertex};
pub use surface::SurfacePoint;
pub use transport::{Transport, Visibility};
