use manylights_gpu::RadiusRule;
use manylights_method::{ParameterInfo, ParameterKind, Parameters};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo {
        name: "lights",
        help: "cells of the reflective shadow maps, rounded up to whole square maps",
        kind: ParameterKind::Count { default: 400, min: 1, max: 1 << 24 },
    },
    ParameterInfo {
        name: "bands",
        help: "bands of the shaded point's reflectance, l = 0 … bands − 1",
        kind: ParameterKind::Count { default: 5, min: 1, max: MAX_BANDS as u64 },
    },
    ParameterInfo {
        name: "radius",
        help: "0 = ten nearest lights, 1 = r₁ (thesis 5.9), 2 = r₂ (thesis 5.12), 3 = one metre",
        kind: ParameterKind::Count { default: 2, min: 0, max: 3 },
    },
    ParameterInfo {
        name: "scale",
        help: "factor on all radii; the thesis advises 1 to 2; 0 = point lights",
        kind: ParameterKind::Real { default: 1.0, min: 0.0, max: 1e6 },
    },
    ParameterInfo {
        name: "horizon",
        help: "share of a sphere above the horizon: 0 = smoothstep (thesis 5.8); 1 = exact",
        kind: ParameterKind::Count { default: 0, min: 0, max: 1 },
    },
];

/// The most bands that the thesis uses, and that the tests cover.
pub const MAX_BANDS: usize = 20;

/// How the share of a sphere above the receiver's horizon is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// A smoothstep of the angle (thesis 5.8).
    Smooth,
    /// The intersection of cap and hemisphere (Oat and Sander 2007).
    Exact,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells asked for.
    pub lights: u64,
    /// Bands of the reflectance, 1 to [`MAX_BANDS`].
    pub bands: usize,
    /// Rule of the radius.
    pub radius: RadiusRule,
    /// The user's factor on the radius.
    pub scale: f32,
    /// Form of the horizon.
    pub horizon: Horizon,
}

impl Settings {
    pub(crate) fn new(parameters: &Parameters) -> Self {
        Self {
            lights: parameters.count("lights"),
            bands: parameters.count("bands") as usize,
            radius: RadiusRule::ALL[parameters.count("radius") as usize],
            scale: parameters.real("scale") as f32,
            horizon: match parameters.count("horizon") {
                0 => Horizon::Smooth,
                _ => Horizon::Exact,
            },
        }
    }
}
