//! What methods that interpolate are told.

use manylights_harmonics::wgsl::order::Evaluation;
use manylights_method::{ChoiceWord, Dependencies, ParameterInfo, ParameterKind, Parameters};

use crate::{Loops, Order, ProjectionSettings, Scheme, Storage};

/// Where the grid lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// Over what the camera sees.
    View,
    /// Over all triangles.
    Scene,
}

/// What becomes of lights within reach of the grid ([`Reach`](crate::Reach)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Near {
    /// Each is met at each pixel.
    Apart,
    /// The grid holds them, too, smoothed to what its spacing shows.
    Smoothed,
}

/// The parameters by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interpolation {
    /// Between vertices.
    pub scheme: Scheme,
    /// As [`Grid::of_cubes`](crate::Grid::of_cubes) has it.
    pub vertices: usize,
    /// Where they lie.
    pub bounds: Bounds,
    /// Of the projection.
    pub loops: Loops,
    /// In which pixels are read.
    pub order: Order,
    /// Of lights near the grid.
    pub near: Near,
    /// Of the coefficients.
    pub storage: Storage,
}

const NONE: &str = "none";

const SCHEMES: [(&str, Option<Scheme>); 5] = [
    (NONE, None),
    ("trilinear", Some(Scheme::Trilinear)),
    ("taylor", Some(Scheme::Taylor)),
    ("hermite-flat", Some(Scheme::HermiteFlat)),
    ("hermite", Some(Scheme::Hermite)),
];

impl Interpolation {
    /// Between which values, if any.
    pub const SCHEME: ParameterInfo = ParameterInfo {
        name: "interpolation",
        formerly: None,
        introduced: Some(NONE),
        help: "of the lights' coefficients between the vertices of a grid (thesis 3.3.4)",
        kind: ParameterKind::Choice {
            default: NONE,
            words: &[
                ChoiceWord { word: NONE, help: "every light at every pixel" },
                ChoiceWord { word: "trilinear", help: "of coefficients alone" },
                ChoiceWord {
                    word: "taylor",
                    help: "of first-order expansions about the vertices (Annen et al. 2004)",
                },
                ChoiceWord {
                    word: "hermite-flat",
                    help: "of coefficients and gradients, mixed derivatives zero (Wu et al. 2020)",
                },
                ChoiceWord {
                    word: "hermite",
                    help: "the same, mixed derivatives from differences",
                },
            ],
        },
    };

    /// The grid's size.
    pub const GRID: ParameterInfo = ParameterInfo {
        name: "grid",
        formerly: None,
        introduced: Some("8"),
        help: "vertices along each side of a cube; of another box their cube is the most in all, spread so that \
               cells are near to cubes",
        kind: ParameterKind::Count { default: 8, min: 2, max: 64 },
    };

    /// The grid's place.
    pub const BOUNDS: ParameterInfo = ParameterInfo {
        name: "bounds",
        formerly: None,
        introduced: Some("view"),
        help: "of the grid",
        kind: ParameterKind::Choice {
            default: "view",
            words: &[
                ChoiceWord { word: "view", help: "of what the camera sees" },
                ChoiceWord { word: "scene", help: "of all triangles" },
            ],
        },
    };

    /// The projection's loops. Forward by default: on a software adapter reversed ones were faster in 3 of 10
    /// projections (`results/interpolation-bands`); the thesis reverses them so that a graphics card's registers hold
    /// the sums.
    pub const LOOPS: ParameterInfo = ParameterInfo {
        name: "loops",
        formerly: None,
        introduced: Some("forward"),
        help: "over lights and coefficients at a vertex (thesis 3.3.3)",
        kind: ParameterKind::Choice {
            default: "forward",
            words: &[
                ChoiceWord { word: "forward", help: "a lane sums all coefficients" },
                ChoiceWord { word: "reverse", help: "a lane sums those of an order" },
            ],
        },
    };

    /// The order of reading.
    pub const READING: ParameterInfo = ParameterInfo {
        name: "reading",
        formerly: None,
        introduced: Some("sorted"),
        help: "of the grid at each pixel",
        kind: ParameterKind::Choice {
            default: "sorted",
            words: &[
                ChoiceWord { word: "plain", help: "pixel by pixel" },
                ChoiceWord {
                    word: "sorted",
                    help: "cell by cell, its corners in uniform memory where they fit",
                },
            ],
        },
    };

    /// Lights near the grid.
    pub const NEAR: ParameterInfo = ParameterInfo {
        name: "near",
        formerly: None,
        introduced: Some("apart"),
        help: "lights within two cells of the grid",
        kind: ParameterKind::Choice {
            default: "apart",
            words: &[
                ChoiceWord { word: "apart", help: "are met at each pixel" },
                ChoiceWord {
                    word: "smoothed",
                    help: "are discs of at least half a cell's radius in the grid, of the same power",
                },
            ],
        },
    };

    /// The numbers at vertices.
    pub const STORAGE: ParameterInfo = ParameterInfo {
        name: "storage",
        formerly: None,
        introduced: Some("f32"),
        help: "of the coefficients at the vertices of the grid",
        kind: ParameterKind::Choice {
            default: "f32",
            words: &[
                ChoiceWord { word: "f32", help: "single precision" },
                ChoiceWord {
                    word: "packed",
                    help: "values in half precision, gradients in 8 bits: a third of the bytes",
                },
            ],
        },
    };

    /// `None` where every light is met at every pixel.
    pub fn new(parameters: &Parameters) -> Option<Self> {
        let scheme = parameters.choice(Self::SCHEME.name, &SCHEMES)?;
        let bounds = [("view", Bounds::View), ("scene", Bounds::Scene)];
        let loops = [("forward", Loops::Forward), ("reverse", Loops::Reverse)];
        let near = [("apart", Near::Apart), ("smoothed", Near::Smoothed)];
        let order = [("plain", Order::Plain), ("sorted", Order::Sorted)];
        let storage = [("f32", Storage::F32), ("packed", Storage::Packed)];
        Some(Self {
            scheme,
            vertices: parameters.count(Self::GRID.name) as usize,
            bounds: parameters.choice(Self::BOUNDS.name, &bounds),
            loops: parameters.choice(Self::LOOPS.name, &loops),
            order: parameters.choice(Self::READING.name, &order),
            near: parameters.choice(Self::NEAR.name, &near),
            storage: parameters.choice(Self::STORAGE.name, &storage),
        })
    }

    /// The projection: by the recurrence, which keeps more digits than polynomials.
    pub fn projection(&self) -> ProjectionSettings {
        let gradients = self.scheme.reads_gradients();
        ProjectionSettings { gradients, loops: self.loops, evaluation: Evaluation::Recurrence }
    }

    /// What coefficients at vertices depend on.
    pub fn depends_on(&self) -> Dependencies {
        Dependencies {
            scene: true,
            lights: true,
            camera: self.bounds == Bounds::View,
            amount: true,
            ..Dependencies::default()
        }
    }
}
