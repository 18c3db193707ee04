use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_virtual_lights::{LIGHTS, RADIUS, RadiusRule, SCALE};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    LIGHTS,
    ParameterInfo {
        name: "directions",
        formerly: Some("samples"),
        help: "directions for each light and pixel, of each sampling strategy",
        kind: ParameterKind::Count { default: 9, min: 1, max: 1 << 16 },
    },
    ParameterInfo {
        name: "sampling",
        formerly: None,
        help: "how directions to a light are drawn",
        kind: ParameterKind::Choice {
            default: "both",
            words: &[
                ChoiceWord { word: "brdf", help: "by the shaded point's reflectance (the thesis)" },
                ChoiceWord { word: "cone", help: "uniformly over the light's cone" },
                ChoiceWord { word: "both", help: "both, balanced" },
            ],
        },
    },
    RADIUS,
    SCALE,
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
    pub directions: u32,
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
            directions: parameters.count("directions") as u32,
            sampling: parameters.choice(
                "sampling",
                &[("brdf", Sampling::Brdf), ("cone", Sampling::Cone), ("both", Sampling::Both)],
            ),
            radius: RadiusRule::chosen(parameters),
            scale: parameters.real("scale") as f32,
        }
    }
}

impl Settings {
    /// Of all strategies together.
    pub(crate) fn directions_a_pair(&self) -> u64 {
        let strategies = if self.sampling == Sampling::Both { 2 } else { 1 };
        strategies * u64::from(self.directions)
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
