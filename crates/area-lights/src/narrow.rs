//! Surfaces that bands cannot see.

use manylights_method::{ChoiceWord, Error, ParameterInfo, ParameterKind, Parameters};
use manylights_scene::Scene;

/// Lobes of a smaller roughness are narrow.
const ROUGHNESS: f32 = 0.3;

/// What becomes of scenes with narrow lobes, of which no affordable number of bands sees a lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Narrow {
    /// They are declined.
    Decline,
    /// They are rendered.
    Keep,
}

impl Narrow {
    /// The parameter of that name.
    pub const PARAMETER: ParameterInfo = ParameterInfo {
        name: "narrow",
        formerly: None,
        introduced: None,
        help: "scenes with specular lobes that no affordable number of bands shows",
        kind: ParameterKind::Choice {
            default: "decline",
            words: &[
                ChoiceWord { word: "decline", help: "those of roughness below 0.3" },
                ChoiceWord { word: "keep", help: "render them, with the error that they have" },
            ],
        },
    };

    /// What the parameter says.
    pub fn new(parameters: &Parameters) -> Self {
        parameters.choice("narrow", &[("decline", Self::Decline), ("keep", Self::Keep)])
    }

    /// Refuses a scene that this is to decline.
    ///
    /// # Errors
    /// [`Error::Declined`] with the material whose lobe is narrow.
    pub fn check(self, scene: &Scene) -> Result<(), Error> {
        let narrow = scene.materials.iter().find(|material| {
            let brdf = material.brdf(material.base_color);
            // α is the square; a number that is as it was written must not fail by its rounding.
            brdf.has_specular() && brdf.alpha < ROUGHNESS * ROUGHNESS * (1.0 - 1e-6)
        });
        match narrow {
            Some(material) if self == Self::Decline => Err(Error::Declined(format!(
                "sees no lamp in lobes of roughness below {ROUGHNESS}, as material `{}` has one: --set \
                 narrow=keep",
                material.name
            ))),
            _ => Ok(()),
        }
    }
}
