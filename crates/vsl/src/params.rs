use manylights_method::{ParameterInfo, ParameterKind, Parameters};
use manylights_virtual_lights::RadiusRule;

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo::LIGHTS,
    ParameterInfo {
        name: "samples",
        help: "directions for each light and pixel, of each sampling strategy",
        kind: ParameterKind::Count { default: 9, min: 1, max: 1 << 16 },
        introduced: None,
    },
    ParameterInfo {
        name: "sampling",
        help: "0 = BRDF of the shaded point (the thesis), 1 = cone, 2 = both, balanced",
        kind: ParameterKind::Count { default: 2, min: 0, max: 2 },
        introduced: None,
    },
    ParameterInfo::RADIUS,
    ParameterInfo::SCALE,
];

/// How directions in the cone of a light are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// By the lobes of the shaded point; those that miss the cone count nothing.
    Brdf,
    /// Uniformly over the cone.
    Cone,
    /// Both, weighted by the balance heuristic.
    Both,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells asked for.
    pub lights: u64,
    /// Directions for each pair of light and pixel, of each strategy.
    pub samples: u32,
    /// Strategies in use.
    pub sampling: Sampling,
    /// Where radii come from.
    pub radius: RadiusRule,
    /// Factor on all radii.
    pub scale: f32,
}

/// What `list methods` shows.
impl Default for Settings {
    fn default() -> Self {
        Self::new(&Parameters::defaults(PARAMETERS))
    }
}

impl Settings {
    pub(crate) fn new(parameters: &Parameters) -> Self {
        Self {
            lights: parameters.count("lights"),
            samples: parameters.count("samples") as u32,
            sampling: match parameters.count("sampling") {
                0 => Sampling::Brdf,
                1 => Sampling::Cone,
                _ => Sampling::Both,
            },
            radius: RadiusRule::ALL[parameters.count("radius") as usize],
            scale: parameters.real("scale") as f32,
        }
    }
}

impl Settings {
    /// Of all strategies together.
    pub(crate) fn directions_a_pair(&self) -> u64 {
        let strategies = if self.sampling == Sampling::Both { 2 } else { 1 };
        strategies * u64::from(self.samples)
    }
}

impl Sampling {
    pub(crate) fn has_brdf(self) -> bool {
        self != Self::Cone
    }

    pub(crate) fn has_cone(self) -> bool {
        self != Self::Brdf
    }
}
