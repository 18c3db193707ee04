//! Triangles of light that lie in one plane.

mod face;
mod group;
mod outline;

use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_scene::AreaLight;

pub use face::Face;
pub use group::{Group, groups};
pub use outline::Edge;

/// Whose edges are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edges {
    /// Those of every triangle.
    Own,
    /// None between triangles of one plane and equal radiance.
    Shared,
}

impl Edges {
    /// The choice of them.
    pub const PARAMETER: ParameterInfo = ParameterInfo {
        name: "edges",
        formerly: None,
        introduced: None,
        help: "of triangles that are integrated without approximation, not from a grid",
        kind: ParameterKind::Choice {
            default: "shared",
            words: &[
                ChoiceWord { word: "own", help: "those of every triangle" },
                ChoiceWord { word: "shared", help: "none between equal triangles of one plane" },
            ],
        },
    };

    /// What [`PARAMETER`](Self::PARAMETER) says.
    pub fn new(parameters: &Parameters) -> Self {
        parameters.choice(Self::PARAMETER.name, &[("own", Self::Own), ("shared", Self::Shared)])
    }
}

/// The fewest triangles that shine as these lights do: of those of one plane, equal neighbours with a convex
/// outline become the triangles between its corners. None is black or without an area. Other lights come first.
pub fn merged(lights: &[AreaLight]) -> Vec<AreaLight> {
    let is_triangle = |light: &&AreaLight| matches!(light, AreaLight::Triangle { .. });
    let (triangles, others): (Vec<&AreaLight>, Vec<_>) = lights.iter().partition(is_triangle);
    let faces: Vec<_> = triangles.into_iter().filter_map(Face::new).collect();
    let merged = groups(&faces);
    let merged = merged.iter().flat_map(Group::triangles).map(AreaLight::from);
    others.into_iter().copied().chain(merged).collect()
}
