use manylights_method::{ParameterInfo, ParameterKind, Parameters};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo {
        help: "groups of texels of the reflective shadow maps, rounded up to whole square maps",
        ..ParameterInfo::LIGHTS
    },
    ParameterInfo {
        name: "texels",
        help: "texels a side of a group; the thesis takes 14",
        kind: ParameterKind::Count { default: 14, min: 1, max: 1 << 10 },
        introduced: None,
    },
    ParameterInfo {
        name: "lobe",
        help: "specular of the shaded point: 0 = anisotropic Gaussian (the thesis), 1 = filtered \
               distribution of normals",
        kind: ParameterKind::Count { default: 1, min: 0, max: 1 },
        introduced: None,
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
    /// Groups asked for.
    pub lights: u64,
    /// Texels a side of a group.
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
            lobe: match parameters.count("lobe") {
                0 => SpecularLobe::Anisotropic,
                _ => SpecularLobe::Filtered,
            },
        }
    }
}
