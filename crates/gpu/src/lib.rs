//! The wgpu layer: device, timed passes, uniform batches, shader linking, the G-buffer, reflective
//! shadow maps and the virtual lights that every many-light method shares.
//!
//! The only crate that names wgpu, which breaks several times a year: what leaves this crate are
//! buffers, kernels and numbers.

mod batches;
mod buffer;
mod device;
mod error;
mod frame;
mod kernel;
mod light_gather;
mod link;
mod lit_texels;
mod operations;
mod projection;
mod radius;
mod raster;
mod reflectances;
mod report;
mod rsm;
mod scene_buffers;
mod shadows;
mod solid_angle;
mod spherical_light;
mod virtual_light;

pub use batches::UniformBatches;
pub use buffer::Buffer;
pub use device::Gpu;
pub use error::Error;
pub use frame::{GpuFrame, SurfaceRecord};
pub use kernel::{Binding, Dispatch, Kernel, PassTime, Resource};
pub use light_gather::{LightBatches, LightGather, Lights};
pub use link::{Feature, Module, link};
pub use lit_texels::{LitTexel, LitTexels, lit_texels};
pub use operations::{Operations, operations};
pub use projection::Projection;
pub use radius::{RadiusRule, radii};
pub use reflectances::Reflectances;
pub use report::AdapterReport;
pub use rsm::{Cell, Map, maps, scene_maps};
pub use shadows::{Center, Shadows};
pub use solid_angle::rectangle_solid_angle;
pub use spherical_light::{SphericalLight, spherical_lights};
pub use virtual_light::{LitMap, VirtualLight, distribute, lit_maps};
