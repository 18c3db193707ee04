use manylights_harmonics::window::Window;
use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_reflectance::{Damping, Form};
use manylights_virtual_lights::{LIGHTS, RADIUS, RadiusRule, SCALE};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    LIGHTS,
    ParameterInfo {
        name: "bands",
        formerly: None,
        help: "bands of the shaded point's reflectance, l = 0 … bands − 1",
        kind: ParameterKind::Count { default: 5, min: 1, max: MAX_BANDS as u64 },
    },
    ParameterInfo {
        name: "form",
        formerly: None,
        help: "of the shaded point's reflectance",
        kind: ParameterKind::Choice {
            default: "full",
            words: &[
                ChoiceWord { word: "full", help: "any lobe, bands² coefficients" },
                ChoiceWord { word: "zonal", help: "a circular lobe, bands of them (thesis 5.2.7)" },
            ],
        },
    },
    ParameterInfo {
        name: "emission_bands",
        formerly: None,
        help: "bands of a glossy light's emission (thesis 5.6); 1 = isotropic, 0 = not expanded",
        kind: ParameterKind::Count { default: 0, min: 0, max: MAX_BANDS as u64 },
    },
    ParameterInfo {
        name: "window",
        formerly: None,
        help: "on the bands of the reflectance (thesis 2.45)",
        kind: ParameterKind::Choice {
            default: "none",
            words: &[
                ChoiceWord { word: "none", help: "all bands as they are" },
                ChoiceWord { word: "hann", help: "Hann's" },
                ChoiceWord { word: "lanczos", help: "Lanczos'" },
                ChoiceWord { word: "hamming", help: "Hamming's" },
                ChoiceWord {
                    word: "weakest",
                    help: "the weakest sinc⁴ that leaves no negative lobe",
                },
            ],
        },
    },
    RADIUS,
    SCALE,
    ParameterInfo {
        name: "horizon",
        formerly: None,
        help: "share of a sphere above the horizon",
        kind: ParameterKind::Choice {
            default: "smooth",
            words: &[
                ChoiceWord { word: "smooth", help: "a smoothstep of the angle (thesis 5.8)" },
                ChoiceWord { word: "exact", help: "of its solid angle (Oat and Sander 2007)" },
            ],
        },
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
    /// Form of the reflectance.
    pub form: Form,
    /// Bands of the emission of lights on glossy surfaces; 0 where it is not expanded.
    pub emission_bands: usize,
    /// Window on the reflectance.
    pub damping: Damping,
    /// Where radii come from.
    pub radius: RadiusRule,
    /// Factor on all radii.
    pub scale: f32,
    /// Form of the horizon.
    pub horizon: Horizon,
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
            bands: parameters.count("bands") as usize,
            form: parameters.choice("form", &[("full", Form::Full), ("zonal", Form::Zonal)]),
            emission_bands: parameters.count("emission_bands") as usize,
            damping: parameters.choice(
                "window",
                &[
                    ("none", Damping::None),
                    ("hann", Damping::Window(Window::Hann)),
                    ("lanczos", Damping::Window(Window::Lanczos)),
                    ("hamming", Damping::Window(Window::Hamming)),
                    ("weakest", Damping::Weakest),
                ],
            ),
            radius: RadiusRule::chosen(parameters),
            scale: parameters.real("scale") as f32,
            horizon: parameters
                .choice("horizon", &[("smooth", Horizon::Smooth), ("exact", Horizon::Exact)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(name: &str, word: &str) -> Settings {
        Settings::new(&Parameters::new(PARAMETERS, [(name, word)]).expect("a word"))
    }

    #[test]
    fn every_word_means_what_it_says() {
        let plain = Settings::default();
        let windows = [
            ("none", Damping::None),
            ("hann", Damping::Window(Window::Hann)),
            ("lanczos", Damping::Window(Window::Lanczos)),
            ("hamming", Damping::Window(Window::Hamming)),
            ("weakest", Damping::Weakest),
        ];
        for (word, damping) in windows {
            assert_eq!(set("window", word), Settings { damping, ..plain });
        }
        for (word, form) in [("full", Form::Full), ("zonal", Form::Zonal)] {
            assert_eq!(set("form", word), Settings { form, ..plain });
        }
        for (word, horizon) in [("smooth", Horizon::Smooth), ("exact", Horizon::Exact)] {
            assert_eq!(set("horizon", word), Settings { horizon, ..plain });
        }
    }

    #[test]
    fn no_word_is_without_a_meaning() {
        for info in PARAMETERS {
            let ParameterKind::Choice { words, .. } = info.kind else { continue };
            let settings: Vec<_> = words.iter().map(|known| set(info.name, known.word)).collect();
            for (index, one) in settings.iter().enumerate() {
                assert!(!settings[..index].contains(one), "{}: {one:?} twice", info.name);
            }
        }
    }
}
