//! Lights projected at the vertices of a grid, on the adapter.

mod loops;
mod projector;
mod shader;

pub use loops::Loops;
pub use projector::{GridCoefficients, project};
pub use shader::{ProjectionShader, SourceShader};
