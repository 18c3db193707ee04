//! Radiance images and the errors between them.
//!
//! [`RadianceImage`] holds linear Rec. 709 radiance; it is read from and written to OpenEXR and shown
//! as PNG. [`compare_linear`] and [`compare_display`] measure how far one picture is from another,
//! [`METRICS`] names what they measure, [`false_color()`] shows where. Nothing skips a pixel: one that
//! is infinite or not a number is an error that names it.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod compare;
mod error;
mod exr_file;
mod exr_layers;
mod exr_window;
mod false_color;
mod file;
mod flip;
mod image;
mod metric_list;
mod png_file;
mod srgb;
mod ssim;

/// Of the metrics: raised whenever the same pictures give other errors.
pub const METRICS_VERSION: u32 = 1;

pub use compare::{Errors, compare, compare_display, compare_linear, display_rmse};
pub use error::Error;
pub use exr_file::read_exr_pair;
pub use exr_layers::write_exr_layers;
pub use exr_window::Window;
pub use false_color::false_color;
pub use image::RadianceImage;
pub use metric_list::{METRICS, MetricInfo};
