//! Lights projected at the vertices of a grid, on the adapter.

mod loops;
mod projector;
mod shader;

pub use loops::{Loops, ProjectionSettings};
pub use projector::{GridCoefficients, Projector, project};
pub use shader::{ProjectionShader, SourceShader};
