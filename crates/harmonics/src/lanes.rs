//! Vectors of the widest kind that a machine has, as the numbers of [`crate::column`].

use std::marker::PhantomData;
use std::ops::Mul;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdFloatElement};

use crate::Real;
use crate::column::Number;

/// A scalar that has SIMD vectors.
pub trait Vectors: Real + SimdFloatElement {
    /// The widest vector at a SIMD level.
    #[doc(hidden)]
    type Vector<S: Simd>: SimdFloat<S, Element = Self>;
}

impl Vectors for f32 {
    type Vector<S: Simd> = S::f32s;
}

impl Vectors for f64 {
    type Vector<S: Simd> = S::f64s;
}

/// One vector: a lane per direction.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S, V>(V, PhantomData<S>);

impl<S: Simd, V: SimdFloat<S, Element: Real>> Lanes<S, V> {
    #[inline(always)]
    pub(crate) fn new(vector: V) -> Self {
        Self(vector, PhantomData)
    }

    #[inline(always)]
    pub(crate) fn store(self, slice: &mut [V::Element]) {
        self.0.store_slice(slice);
    }

    /// 1/|p|.
    #[inline(always)]
    pub(crate) fn inverse_length([x, y, z]: [Self; 3]) -> Self {
        let square = x.mul_add(x, y.mul_add(y, z * z));
        Self::new(x.constant(num_traits::One::one()).0 / square.0.sqrt())
    }
}

impl<S: Simd, V: SimdFloat<S>> Mul for Lanes<S, V> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: Self) -> Self {
        Self(self.0 * factor.0, PhantomData)
    }
}

impl<S: Simd, V: SimdFloat<S, Element: Real>> Number<V::Element> for Lanes<S, V> {
    #[inline(always)]
    fn constant(self, value: V::Element) -> Self {
        Self(V::simd_from(self.0.token(), value), PhantomData)
    }

    #[inline(always)]
    fn times(self, factor: V::Element) -> Self {
        Self(self.0 * factor, PhantomData)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add(factor.0, term.0), PhantomData)
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_sub(factor.0, term.0), PhantomData)
    }

    #[inline(always)]
    fn negative_mul_add(self, factor: Self, term: Self) -> Self {
        Self((-self.0).mul_add(factor.0, term.0), PhantomData)
    }

    #[inline(always)]
    fn negative_mul_sub(self, factor: Self, term: Self) -> Self {
        Self((-self.0).mul_sub(factor.0, term.0), PhantomData)
    }
}
