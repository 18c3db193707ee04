use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_virtual_lights::LIGHTS;

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    LIGHTS,
    ParameterInfo {
        name: "texels",
        formerly: None,
        introduced: None,
        help: "texels a side of a light's cell; the thesis takes 14",
        kind: ParameterKind::Count { default: 14, min: 1, max: 1 << 10 },
    },
    ParameterInfo {
        name: "lobe",
        formerly: None,
        introduced: None,
        help: "what stands for specular lobes and for cosines",
        kind: ParameterKind::Choice {
            default: "filtered",
            words: &[
                ChoiceWord {
                    word: "thesis",
                    help: "products of Gaussians about mirrored directions (its source, 2020)",
                },
                ChoiceWord {
                    word: "filtered",
                    help: "filtered normals and a closed form (Tokuyoshi et al. 2024)",
                },
            ],
        },
    },
    ParameterInfo {
        name: "behind",
        formerly: None,
        introduced: Some("sent"),
        help: "what becomes of a Lambertian lobe behind the surface it leaves",
        kind: ParameterKind::Choice {
            default: "sent",
            words: &[
                ChoiceWord { word: "sent", help: "it is sent there (Tokuyoshi 2015)" },
                ChoiceWord { word: "cut", help: "it is cut off, and the rest scaled to its power" },
            ],
        },
    },
];

/// Whose closed forms stand for cosines and GGX lobes, of texels and of the shaded point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// As in the source that the thesis took (2020): cosines are Gaussians, GGX lobes lie about mirrored
    /// directions, that of the shaded point as an anisotropic Gaussian (Xu et al. 2013).
    Thesis,
    /// What came later: a fitted cosine and a closed form of its integral, dominant visible normals,
    /// and a distribution of normals widened by the light (Tokuyoshi et al. 2024).
    Filtered,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells asked for.
    pub lights: u64,
    /// Texels a side of a cell.
    pub texels: u32,
    /// Closed forms of cosines and specular lobes.
    pub lobe: Approximation,
    /// Whether a Lambertian lobe ends at the surface that it leaves.
    pub cut_behind: bool,
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
                &[("thesis", Approximation::Thesis), ("filtered", Approximation::Filtered)],
            ),
            cut_behind: parameters.choice("behind", &[("sent", false), ("cut", true)]),
        }
    }
}
