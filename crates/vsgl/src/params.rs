use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_virtual_lights::LIGHTS;

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    LIGHTS,
    ParameterInfo {
        name: "texels",
        formerly: None,
        help: "texels a side of a light's cell; the thesis takes 14",
        kind: ParameterKind::Count { default: 14, min: 1, max: 1 << 10 },
    },
    ParameterInfo {
        name: "lobe",
        formerly: None,
        help: "what stands for the specular lobe of the shaded point",
        kind: ParameterKind::Choice {
            default: "filtered",
            words: &[
                ChoiceWord { word: "anisotropic", help: "an anisotropic Gaussian (the thesis)" },
                ChoiceWord { word: "filtered", help: "a filtered distribution of normals" },
            ],
        },
    },
];

/// How a GGX lobe is integrated against a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecularLobe {
    /// Replaced by an anisotropic spherical Gaussian (Xu et al. 2013), as the thesis' source did.
    Anisotropic,
    /// Its distribution of normals widened by the light (Tokuyoshi et al. 2024).
    Filtered,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells asked for.
    pub lights: u64,
    /// Texels a side of a cell.
    pub texels: u32,
    /// The shaded point's specular lobe.
    pub lobe: SpecularLobe,
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
            texels: parameters.count("texels") as u32,
            lobe: parameters.choice(
                "lobe",
                &[("anisotropic", SpecularLobe::Anisotropic), ("filtered", SpecularLobe::Filtered)],
            ),
        }
    }
}
