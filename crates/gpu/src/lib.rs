//! The wgpu layer: device, timed passes, uniform batches, shader linking, the G-buffer, shadow rays,
//! passes over pixels or any points.
//!
//! The only crate that names wgpu, which breaks several times a year: what leaves this crate are
//! buffers, kernels and numbers.
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod batches;
mod buffer;
mod device;
mod error;
mod frame;
mod kernel;
mod link;
mod occluders;
mod operations;
mod pipeline;
mod pixel_pass;
mod projection;
mod raster;
mod reflectances;
mod report;
mod scene_buffers;
mod shadows;
mod surface;

/// Of what the shared shaders and passes of this crate compute (G-buffer, reflectance, shadow rays):
/// raised whenever the same scene gives other numbers.
pub const SHADERS_VERSION: u32 = 1;

pub use batches::UniformBatches;
pub use buffer::Buffer;
pub use device::Gpu;
pub use error::Error;
pub use frame::GpuFrame;
pub use kernel::{Dispatch, PassTime, Resource};
pub use link::{Feature, Module, link};
pub use operations::{Operations, operations};
pub use pipeline::{Binding, Kernel};
pub use pixel_pass::workgroups;
pub use projection::Projection;
pub use reflectances::Reflectances;
pub use report::AdapterReport;
pub use shadows::{Center, Shadows};
pub use surface::SurfaceRecord;
