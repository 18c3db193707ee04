//! What methods on lights with a surface share: the frames that they take, the gather of their lights over all
//! pixels, and the grid that may hold those that are not near.
//!
//! [`AreaLights`] makes a [`Method`](manylights_method::Method) of an [`Estimator`].
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod area_lights;
mod cone;
mod estimator;
mod frame;
mod gather;
mod gather_shader;
mod irradiance;
mod narrow;
mod planar;
mod run;
mod transformed_cap;
mod transformed_segment;
mod transformed_triangle;
mod triangle_mean;

/// Of how the lights of a scene reach the estimators and how their sums are shown: raised whenever the same
/// estimator gives another picture.
pub const AREA_LIGHTS_VERSION: u32 = 1;

pub use area_lights::AreaLights;
pub use estimator::{BANDS, Estimator, Gathering, Project, SceneTables};
pub use gather::{AreaGather, LightBatches, LightRecords};
pub use gather_shader::{EstimatorShader, GatherShader};
pub use irradiance::IRRADIANCE;
pub use narrow::Narrow;
pub use planar::{Edge, Edges, Face, Group, groups, merged};
pub use run::{TRANSFORMED_OPERATIONS, cap_operations};
pub use transformed_cap::transformed_cap;
pub use transformed_triangle::transformed_triangle;
pub use triangle_mean::triangle_mean;
