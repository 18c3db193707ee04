//! What methods with virtual lights share: reflective shadow maps, the lights placed on them, the
//! spheres that stand for lights, lit texels, and the gather over all pixels.
//!
//! [`VirtualLights`] makes a [`Method`](manylights_method::Method) of an [`Estimator`].
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod gather_shader;
mod light_gather;
mod lit_texels;
mod many_lights;
mod parameters;
mod placement;
mod radius;
mod rsm;
mod solid_angle;
mod virtual_light;
mod virtual_sphere;

/// Of where virtual lights lie, what they carry and how far they reach: raised whenever the same scene,
/// seed and count give other ones.
pub const PLACEMENT_VERSION: u32 = 2;

pub use gather_shader::{EstimatorShader, GatherShader, PixelsALane};
pub use light_gather::{LightBatches, LightGather, Lights};
pub use lit_texels::{LIT_TEXEL, LitTexel, LitTexels, lit_texels};
pub use many_lights::{
    Estimator, ManyLightFrame, ManyLightRun, PlacedLights, SceneTables, VirtualLights,
};
pub use parameters::{LIGHTS, RADIUS, SCALE};
pub use placement::scene_maps;
pub use radius::{RadiusRule, radii};
pub use rsm::{Map, MapCell, maps};
pub use solid_angle::rectangle_solid_angle;
pub use virtual_light::{LitMap, VirtualLight, distribute, lit_maps};
pub use virtual_sphere::{VirtualSphere, virtual_spheres};
