//! Real spherical harmonics (SH), zonal and hemispherical harmonics, and the WGSL generated from
//! them.
//!
//! # Conventions
//! - Real SH without the Condon–Shortley phase: Y₁₋₁, Y₁₀, Y₁₁ are √(3/4π) times y, z, x.
//! - `bands = n` means l = 0 … n − 1, n² coefficients; see [`index`].
//! - Directions are unit vectors `[x, y, z]`; z is the axis of zonal functions.
//! - Angles are in radians. Everything is generic over f32 and f64 through [`Real`].
//! - No evaluation allocates: tables are made once by `new`.
//!
//! Papers are cited as in ARCHITECTURE.md (thesis, JFIG, RC, HVL).
#![cfg_attr(not(test), warn(clippy::print_stderr, clippy::print_stdout))]
#![forbid(unsafe_code)]

pub mod basis;
pub mod batch;
pub mod clamped_cosine;
mod column;
pub mod convolution;
pub mod dering;
pub mod hemispherical;
mod lanes;
pub mod polygon;
pub mod product;
pub mod projection;
pub mod quadrature;
mod real;
mod recurrence;
pub mod rotation;
pub mod thesis;
pub mod wgsl;
pub mod window;
pub mod zonal;

pub use basis::Basis;
pub use lanes::Vectors;
pub use real::Real;

/// The largest number of bands that this crate is tested for.
pub const MAX_BANDS: usize = 30;

/// Number of coefficients of an expansion in `bands` bands.
pub const fn count(bands: usize) -> usize {
    bands * bands
}

/// Position of coefficient (l, m), |m| ≤ l: l(l + 1) + m.
pub const fn index(l: usize, m: isize) -> usize {
    (l * (l + 1)).wrapping_add_signed(m)
}

/// Number of coefficients with m ≥ 0 in `bands` bands: all that a function even in y has.
pub const fn even_count(bands: usize) -> usize {
    bands * (bands + 1) / 2
}

/// Position of coefficient (l, m), 0 ≤ m ≤ l, among those with m ≥ 0: l(l + 1)/2 + m.
pub const fn even_index(l: usize, m: usize) -> usize {
    l * (l + 1) / 2 + m
}
