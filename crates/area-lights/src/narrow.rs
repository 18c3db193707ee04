//! Surfaces that bands cannot see.

use manylights_method::Error;
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
