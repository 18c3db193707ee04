//! The wgpu layer: device, timed passes, uniform batches, shader linking, the G-buffer, shadow rays,
//! passes over pixels or any points.
//!
//! The only crate that names wgpu, which breaks several times a year: what leaves this crate are
//! buffers, kernels and numbers.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod batches;
mod buffer;
mod clock;
mod device;
mod error;
mod frame;
mod kernel;
mod limits;
mod link;
mod occluders;
mod operations;
mod pass;
mod pipeline;
mod point_bindings;
mod point_pass;
mod projection;
mod raster;
mod reflectances;
mod report;
mod scene_buffers;
mod shadows;
mod surface;
mod timestamps;

/// Of what the shared shaders and passes of this crate compute (G-buffer, reflectance, shadow rays):
/// raised whenever the same scene gives other numbers.
pub const SHADERS_VERSION: u32 = 1;

pub use batches::UniformBatches;
pub use buffer::Buffer;
pub use device::Gpu;
pub use error::Error;
pub use frame::GpuFrame;
pub use limits::Limits;
pub use link::{Feature, Module, link};
pub use operations::{Operations, operations};
pub use pass::{Dispatch, Pass, PassTime, Resource};
pub use pipeline::{Binding, Kernel};
pub use point_bindings::{PointBindings, Table};
pub use point_pass::{PointPass, workgroups};
pub use projection::Projection;
pub use reflectances::Reflectances;
pub use report::AdapterReport;
pub use shadows::{Center, Shadows};
pub use surface::SurfaceRecord;
