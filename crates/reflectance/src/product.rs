//! The ways of thesis 4.1 from a light's coefficients to radiance: the light times the clamped cosine, whose
//! coefficient 0 is the irradiance (4.4) and whose double product with the lobe about the mirror direction is
//! what the lobe reflects. The full lobe holds its cosine already and needs none of them.
//!
//! All are straight lines of WGSL, none a loop over a table: an index that is not known while compiling would
//! keep the coefficients of light and product, three channels each, out of registers and caches of constants,
//! and turn every integral (12 057 of 9 bands) into reads and writes of a lane's memory. The price is the
//! compiler's: 5 to 25 s for the general product of 9 bands on lavapipe, once for a kernel. The general product
//! and 4.5 make the matrix first that the cosine is for this normal: it is symmetric and serves three channels
//! ([`Function::Product`]). So each rival gets what serves it best, and all have the same order: light times
//! cosine, then the lobe, as the thesis has it. (Cosine times lobe first would be one channel instead of three,
//! for every rival alike; but then the cosine may as well be in the lobe's table.)

use manylights_harmonics::wgsl::{CUT, Function, Operations};

/// How a light's coefficients are multiplied with the clamped cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CosineProduct {
    /// With its expansion turned to the normal, by the general product (thesis 2.47, 2.48).
    General,
    /// With the turn folded into the integrals (4.5).
    Folded,
    /// The same with three bands of the cosine.
    FoldedCut,
    /// With the cosine itself, of a light that is summed in the surface's frame (4.6).
    Local,
    /// The same of a light that is summed in the world's frame and then turned.
    Turned,
}

/// Where the irradiance comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diffuse {
    /// Coefficient 0 of the product (4.4).
    Product,
    /// A product of the light's first three bands with those of the cosine.
    ThreeBands,
}

impl CosineProduct {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::General, Self::Folded, Self::FoldedCut, Self::Local, Self::Turned];

    /// Whether the light is summed in the surface's frame, its half even in y alone: else in the world's.
    pub fn is_local(self) -> bool {
        self == Self::Local
    }

    /// Whether the product is made in the surface's frame.
    pub(crate) fn is_in_frame(self) -> bool {
        matches!(self, Self::Local | Self::Turned)
    }

    /// Bands that it is made for: the lines of the general product grow as n⁵.
    pub fn most_bands(self) -> usize {
        match self {
            Self::General | Self::Folded | Self::FoldedCut => 9,
            Self::Local | Self::Turned => manylights_harmonics::MAX_BANDS,
        }
    }

    /// Switches of the modules `product` and `receiver` ([`crate::MODULES`]) for a linker.
    pub fn features(self, diffuse: Diffuse) -> [(&'static str, bool); 6] {
        [
            ("general", self == Self::General),
            ("folded", self == Self::Folded),
            ("folded_cut", self == Self::FoldedCut),
            ("in_frame", self.is_in_frame()),
            ("local", self.is_local()),
            ("three_bands", diffuse == Diffuse::ThreeBands),
        ]
    }

    /// What makes the product of a light's coefficients.
    pub(crate) fn steps(self) -> &'static [Function] {
        match self {
            Self::General => &[Function::Product],
            Self::Folded => &[Function::CosineProduct],
            Self::FoldedCut => &[Function::CosineProductCut],
            Self::Local => &[Function::ClampedCosineEven],
            Self::Turned => &[Function::TurnEven, Function::ClampedCosineEven],
        }
    }

    /// Arithmetic of the product for one channel (figure 4.2), with the Y_lm of the normal where it needs
    /// them, as the generator writes it: what serves several channels counts once for the one.
    pub fn operations(self, bands: usize) -> Operations {
        let of = |function: Function, bands| function.generate(bands).operations;
        let steps = self.steps().iter().map(|&step| of(step, bands));
        let normal = match self {
            // The scales of the cosine: a multiplication a coefficient.
            Self::General => vec![
                of(Function::Evaluate, bands),
                Operations { additions: 0, multiplications: bands * bands },
            ],
            Self::Folded => vec![of(Function::Evaluate, bands)],
            Self::FoldedCut => vec![of(Function::Evaluate, bands.min(CUT))],
            Self::Local | Self::Turned => Vec::new(),
        };
        steps.chain(normal).fold(Operations::default(), |sum, more| Operations {
            additions: sum.additions + more.additions,
            multiplications: sum.multiplications + more.multiplications,
        })
    }
}
