//! The CPU path tracer that makes the references.
//!
//! Radiance through pixel centres, for the transports of
//! [`Transport`](manylights_scene::Transport): direct light of point-like lights is summed exactly;
//! lights with a surface and all bounces are sampled. [`direct_light`] and
//! [`seen_emission`] are exact parts on their own.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod cache;
mod error;
mod exact;
mod method;
mod picture;
mod reference;
mod settings;
mod sums;

pub use cache::REFERENCE_VERSION;
pub use error::Error;
pub use exact::{direct_light, seen_emission};
pub use manylights_paths::SLICE;
pub use method::PathTracer;
pub use reference::{Reference, render};
pub use settings::Settings;
