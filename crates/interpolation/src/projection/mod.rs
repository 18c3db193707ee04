//! Lights projected at the vertices of a grid, on the adapter.

mod loops;
mod projector;
mod shader;

pub use loops::{Loops, ProjectionSettings};
pub use projector::{GridCoefficients, Projector, project, run_in_steps, vectors_of_grid};
pub use shader::{ProjectionShader, SourceShader};
