use manylights_method::{ParameterInfo, ParameterKind, Parameters};
use manylights_virtual_lights::LIGHTS;

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo { kind: ParameterKind::Count { default: 1024, min: 1, max: 1 << 24 }, ..LIGHTS },
    ParameterInfo {
        name: "clamp",
        formerly: None,
        help: "largest geometry term cos·cos/d², m⁻²; 0 = unbounded",
        kind: ParameterKind::Real { default: 0.0, min: 0.0, max: 1e30 },
    },
    ParameterInfo {
        name: "attenuation_radius",
        formerly: Some("radius"),
        help: "radius of Yuksel's attenuation (thesis 5.18), metres; 0 = 1/d²",
        kind: ParameterKind::Real { default: 0.0, min: 0.0, max: 1e15 },
    },
];

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells asked for.
    pub lights: u64,
    /// Bound of the geometry term, m⁻².
    pub clamp: Option<f32>,
    /// Radius of Yuksel's attenuation, metres.
    pub attenuation_radius: Option<f32>,
}

/// What `list methods` shows.
impl Default for Settings {
    fn default() -> Self {
        Self::new(&Parameters::defaults(PARAMETERS))
    }
}

impl Settings {
    pub(crate) fn new(parameters: &Parameters) -> Self {
        let positive = |name| Some(parameters.real(name) as f32).filter(|&value| value > 0.0);
        Self {
            lights: parameters.count("lights"),
            clamp: positive("clamp"),
            attenuation_radius: positive("attenuation_radius"),
        }
    }
}
