//! Radiance along light paths on the CPU.
//!
//! Walks from the camera and from the lights over one ray caster: what the path tracer makes its
//! references of, and what methods that sample incoming radiance share.
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]

mod area_lights;
mod beams;
pub mod closed_form;
mod emitters;
mod illumination;
mod lobe;
mod sampler;
mod tracer;

pub use sampler::{SLICE, Sampler};
pub use tracer::{Tracer, Walk};
