use manylights_area_lights::{BANDS, Edges, Narrow};
use manylights_harmonics::zonal::TriangleForm;
use manylights_interpolation::Interpolation;
use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo {
        name: BANDS,
        formerly: None,
        introduced: None,
        help: "bands of the shaded point's reflectance, l = 0 … bands − 1",
        kind: ParameterKind::Count { default: 9, min: 1, max: MAX_BANDS as u64 },
    },
    ParameterInfo {
        name: "approximation",
        formerly: None,
        introduced: None,
        help: "of a triangle's coefficients",
        kind: ParameterKind::Choice {
            default: "exact",
            words: &[
                ChoiceWord {
                    word: "exact",
                    help: "none: by integrals over its edges (Wang & Ramamoorthi 2018)",
                },
                ChoiceWord {
                    word: "sphere",
                    help: "a sphere at its centroid, of the disk of its area (thesis 4.7, 4.8)",
                },
                ChoiceWord {
                    word: "main",
                    help: "the same times the cosine at the light (thesis 4.9)",
                },
                ChoiceWord {
                    word: "solid-angle",
                    help: "a cap of the triangle's solid angle (thesis 4.14)",
                },
                ChoiceWord {
                    word: "compromise",
                    help: "a sphere whose sine is scaled by the cosine at the light (thesis 4.17)",
                },
                ChoiceWord {
                    word: "compromise-root",
                    help: "by the root of that cosine, which is right for far triangles",
                },
                ChoiceWord {
                    word: "scaled",
                    help: "the sphere's coefficients, scaled to the triangle's solid angle",
                },
                ChoiceWord { word: "point", help: "a point of the triangle's solid angle" },
            ],
        },
    },
    Edges::PARAMETER,
    ParameterInfo {
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
    },
    Interpolation::SCHEME,
    Interpolation::GRID,
    Interpolation::BOUNDS,
    Interpolation::LOOPS,
    Interpolation::READING,
    Interpolation::NEAR,
    Interpolation::STORAGE,
];

const NARROW: [(&str, Narrow); 3] =
    [("decline", Narrow::Decline), ("keep", Narrow::Keep), ("ltc", Narrow::Transformed)];

/// All but `exact`.
const SPHERES: [(&str, Approximation); 7] = [
    ("sphere", Approximation::Sphere(TriangleForm::Sphere)),
    ("main", Approximation::Sphere(TriangleForm::Main)),
    ("solid-angle", Approximation::Sphere(TriangleForm::SolidAngle)),
    ("compromise", Approximation::Sphere(TriangleForm::Compromise)),
    ("compromise-root", Approximation::Sphere(TriangleForm::CompromiseRoot)),
    ("scaled", Approximation::Sphere(TriangleForm::Scaled)),
    ("point", Approximation::Sphere(TriangleForm::Point)),
];

/// Of a lane's registers: a lobe has bands (bands + 1)/2 coefficients, of colours and measurements two and
/// three times as many.
pub const MAX_BANDS: usize = 15;

/// Where the coefficients of a triangle come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// Its edges.
    Exact(Edges),
    /// A sphere in its stead.
    Sphere(TriangleForm),
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Of light and reflectance, 1 to [`MAX_BANDS`].
    pub bands: usize,
    /// Where the coefficients come from.
    pub approximation: Approximation,
    /// What becomes of scenes with narrow lobes.
    pub narrow: Narrow,
}

/// What `list methods` shows.
impl Default for Settings {
    fn default() -> Self {
        Self::new(&Parameters::defaults(PARAMETERS))
    }
}

impl Settings {
    pub(crate) fn new(parameters: &Parameters) -> Self {
        let exact = ("exact", Approximation::Exact(Edges::new(parameters)));
        let approximations = [&[exact][..], &SPHERES].concat();
        Self {
            bands: parameters.count(BANDS) as usize,
            approximation: parameters.choice("approximation", &approximations),
            narrow: parameters.choice("narrow", &NARROW),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_means_what_it_says() {
        let set = |name, word| {
            Settings::new(&Parameters::new(PARAMETERS, [(name, word)]).expect("a word"))
        };
        let plain = Settings {
            bands: 9,
            approximation: Approximation::Exact(Edges::Shared),
            narrow: Narrow::Decline,
        };
        assert_eq!(Settings::default(), plain);
        assert_eq!(set("bands", "15").bands, 15);
        let own = Approximation::Exact(Edges::Own);
        assert_eq!(set("edges", "own"), Settings { approximation: own, ..plain });
        for (word, approximation) in SPHERES {
            assert_eq!(set("approximation", word), Settings { approximation, ..plain });
        }
        for (word, narrow) in NARROW {
            assert_eq!(set("narrow", word), Settings { narrow, ..plain });
        }
    }
}
