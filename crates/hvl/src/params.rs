use manylights_harmonics::window::Window;
use manylights_method::{ParameterInfo, ParameterKind, Parameters};
use manylights_reflectance::{Damping, Form};
use manylights_virtual_lights::RadiusRule;

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo::LIGHTS,
    ParameterInfo {
        name: "bands",
        help: "bands of the shaded point's reflectance, l = 0 … bands − 1",
        kind: ParameterKind::Count { default: 5, min: 1, max: MAX_BANDS as u64 },
        introduced: None,
    },
    ParameterInfo {
        name: "form",
        help: "0 = any lobe, bands² coefficients; 1 = one circular lobe, bands of them (thesis 5.2.7)",
        kind: ParameterKind::Count { default: 0, min: 0, max: 1 },
        introduced: None,
    },
    ParameterInfo {
        name: "emission_bands",
        help: "bands of a glossy light's emission (thesis 5.6); 1 = isotropic, 0 = not expanded",
        kind: ParameterKind::Count { default: 0, min: 0, max: MAX_BANDS as u64 },
        introduced: None,
    },
    ParameterInfo {
        name: "window",
        help: "on the bands of the reflectance (thesis 2.45): 0 = none, 1 = Hann, 2 = Lanczos, \
               3 = Hamming, 4 = the weakest sinc⁴ under which a lobe is not negative",
        kind: ParameterKind::Count { default: 0, min: 0, max: 4 },
        introduced: None,
    },
    ParameterInfo::RADIUS,
    ParameterInfo::SCALE,
    ParameterInfo {
        name: "horizon",
        help: "share of a sphere above the horizon: 0 = smoothstep (thesis 5.8), 1 = exact",
        kind: ParameterKind::Count { default: 0, min: 0, max: 1 },
        introduced: None,
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
            form: match parameters.count("form") {
                0 => Form::Full,
                _ => Form::Zonal,
            },
            emission_bands: parameters.count("emission_bands") as usize,
            damping: match parameters.count("window") {
                0 => Damping::None,
                1 => Damping::Window(Window::Hann),
                2 => Damping::Window(Window::Lanczos),
                3 => Damping::Window(Window::Hamming),
                _ => Damping::Weakest,
            },
            radius: RadiusRule::ALL[parameters.count("radius") as usize],
            scale: parameters.real("scale") as f32,
            horizon: match parameters.count("horizon") {
                0 => Horizon::Smooth,
                _ => Horizon::Exact,
            },
        }
    }
}
