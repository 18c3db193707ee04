use manylights_area_lights::{BANDS, Narrow};
use manylights_interpolation::Interpolation;
use manylights_method::{ChoiceWord, ParameterInfo, ParameterKind, Parameters};
use manylights_reflectance::{CosineProduct, Diffuse};

pub(crate) const PARAMETERS: &[ParameterInfo] = &[
    ParameterInfo {
        name: BANDS,
        formerly: None,
        introduced: None,
        help: "bands of the shaded point's reflectance, l = 0 … bands − 1",
        kind: ParameterKind::Count { default: 9, min: 1, max: MAX_BANDS as u64 },
    },
    ParameterInfo {
        name: "product",
        formerly: None,
        introduced: None,
        help: "of light and reflectance",
        kind: ParameterKind::Choice {
            default: "full",
            words: &[
                ChoiceWord {
                    word: "full",
                    help: "light by light with the cosine-weighted lobe: exact for so many bands",
                },
                ChoiceWord {
                    word: "general",
                    help: "of all lights with the cosine's expansion (thesis 2.47), then with a \
                           circular lobe about the mirror direction, as all that follow",
                },
                ChoiceWord { word: "4.5", help: "the same, the cosine's turn folded in" },
                ChoiceWord { word: "4.5-cut", help: "the same with 3 bands of the cosine" },
                ChoiceWord { word: "4.6", help: "with the cosine itself in the surface's frame" },
                ChoiceWord {
                    word: "4.6-rotated",
                    help: "the same, the lights summed in the world's frame and then turned",
                },
            ],
        },
    },
    ParameterInfo {
        name: "diffuse",
        formerly: None,
        introduced: None,
        help: "of the Lambertian lobe, where `product` is not full",
        kind: ParameterKind::Choice {
            default: "product",
            words: &[
                ChoiceWord {
                    word: "product",
                    help: "from coefficient 0 of light and cosine (thesis 4.4)",
                },
                ChoiceWord { word: "three-bands", help: "from the lights' first three bands" },
            ],
        },
    },
    ParameterInfo {
        name: "coefficients",
        formerly: None,
        introduced: None,
        help: "of a light, which its angle decides",
        kind: ParameterKind::Choice {
            default: "analytic",
            words: &[
                ChoiceWord { word: "analytic", help: "by recurrence (thesis 3.10)" },
                ChoiceWord { word: "tabulated", help: "interpolated in a table (JFIG 4.2)" },
            ],
        },
    },
    ParameterInfo {
        name: "extent",
        formerly: None,
        introduced: None,
        help: "what of a light a point sees",
        kind: ParameterKind::Choice {
            default: "sphere",
            words: &[
                ChoiceWord { word: "sphere", help: "sin a = r/d (thesis 3.27)" },
                ChoiceWord {
                    word: "disc",
                    help: "a disc that faces it, tan a = r/d (thesis 3.29)",
                },
            ],
        },
    },
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

const PRODUCTS: [(&str, Product); 6] = [
    ("full", Product::Full),
    ("general", Product::Cosine(CosineProduct::General)),
    ("4.5", Product::Cosine(CosineProduct::Folded)),
    ("4.5-cut", Product::Cosine(CosineProduct::FoldedCut)),
    ("4.6", Product::Cosine(CosineProduct::Local)),
    ("4.6-rotated", Product::Cosine(CosineProduct::Turned)),
];

const DIFFUSE: [(&str, Diffuse); 2] =
    [("product", Diffuse::Product), ("three-bands", Diffuse::ThreeBands)];

/// Of a lane's registers: a lobe has bands (bands + 1)/2 coefficients, of colours and measurements two and
/// three times as many.
pub const MAX_BANDS: usize = 15;

/// How light and reflectance meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// The double product of each light's coefficients with the cosine-weighted lobe.
    Full,
    /// The product of all lights' coefficients with the cosine, against a circular lobe.
    Cosine(CosineProduct),
}

/// Where the coefficients of a cap come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coefficients {
    /// The recurrence.
    Analytic,
    /// A table with linear interpolation.
    Tabulated,
}

/// What a point sees of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The sphere.
    Sphere,
    /// A disc of its radius through its centre that faces the point.
    Disc,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Of light and reflectance, 1 to [`MAX_BANDS`].
    pub bands: usize,
    /// How they meet.
    pub product: Product,
    /// Where the irradiance comes from, where a product with the cosine is made.
    pub diffuse: Diffuse,
    /// Where those of a light come from.
    pub coefficients: Coefficients,
    /// What a point sees of a light.
    pub extent: Extent,
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
        Self {
            bands: parameters.count(BANDS) as usize,
            product: parameters.choice("product", &PRODUCTS),
            diffuse: parameters.choice("diffuse", &DIFFUSE),
            coefficients: parameters.choice(
                "coefficients",
                &[("analytic", Coefficients::Analytic), ("tabulated", Coefficients::Tabulated)],
            ),
            extent: parameters
                .choice("extent", &[("sphere", Extent::Sphere), ("disc", Extent::Disc)]),
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
            product: Product::Full,
            diffuse: Diffuse::Product,
            coefficients: Coefficients::Analytic,
            extent: Extent::Sphere,
            narrow: Narrow::Decline,
        };
        assert_eq!(Settings::default(), plain);
        assert_eq!(set("bands", "15").bands, 15);
        for (word, product) in PRODUCTS {
            assert_eq!(set("product", word), Settings { product, ..plain });
        }
        for (word, diffuse) in DIFFUSE {
            assert_eq!(set("diffuse", word), Settings { diffuse, ..plain });
        }
        let tabulated = Settings { coefficients: Coefficients::Tabulated, ..plain };
        assert_eq!(set("coefficients", "tabulated"), tabulated);
        assert_eq!(set("extent", "disc"), Settings { extent: Extent::Disc, ..plain });
        for (word, narrow) in NARROW {
            assert_eq!(set("narrow", word), Settings { narrow, ..plain });
        }
    }
}
