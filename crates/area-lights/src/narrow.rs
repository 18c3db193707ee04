//! Surfaces that bands cannot see.

use manylights_method::{ChoiceWord, Error, ParameterInfo, ParameterKind, Parameters};
use manylights_reflectance::{NARROW, is_narrow};
use manylights_scene::{Lobe, Scene};

/// What becomes of scenes with narrow lobes, of which no affordable number of bands sees a lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Narrow {
    /// They are declined.
    Decline,
    /// They are rendered.
    Keep,
    /// They are rendered, narrow lobes by linearly transformed cosines
    /// ([`transformed_cosine`](manylights_reflectance::transformed_cosine)).
    Transformed,
}

impl Narrow {
    /// Of methods that ask.
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
                ChoiceWord {
                    word: "ltc",
                    help: "render those lobes by linearly transformed cosines",
                },
            ],
        },
    };

    /// By name.
    pub fn new(parameters: &Parameters) -> Self {
        let words = [("decline", Self::Decline), ("keep", Self::Keep), ("ltc", Self::Transformed)];
        parameters.choice(Self::PARAMETER.name, &words)
    }

    /// Refuses a scene that this is to decline.
    ///
    /// # Errors
    /// [`Error::Declined`] with the material whose lobe is narrow.
    pub fn check(self, scene: &Scene) -> Result<(), Error> {
        let narrow = scene.materials.iter().find(|material| {
            let brdf = material.brdf(material.base_color);
            let known = self == Self::Transformed && matches!(brdf.lobe, Lobe::Schlick { .. });
            brdf.has_specular() && is_narrow(brdf.alpha) && !known
        });
        match narrow {
            Some(material) if self != Self::Keep => {
                let of = if self == Self::Decline {
                    ""
                } else {
                    " other than GGX with Schlick's Fresnel term"
                };
                Err(Error::Declined(format!(
                    "sees no lamp in lobes of roughness below {NARROW}{of}, as material `{}` has one: --set \
                     narrow=keep",
                    material.name
                )))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_means_what_it_says() {
        const INFOS: &[ParameterInfo] = &[Narrow::PARAMETER];
        let set = |word| Narrow::new(&Parameters::new(INFOS, [("narrow", word)]).expect("a word"));
        assert_eq!(
            ["decline", "keep", "ltc"].map(set),
            [Narrow::Decline, Narrow::Keep, Narrow::Transformed]
        );
        assert_eq!(Narrow::new(&Parameters::defaults(INFOS)), Narrow::Decline);
    }
}
