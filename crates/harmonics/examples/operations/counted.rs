//! A scalar that counts what is done to it, to run the library's own code through.
//!
//! Subtractions count as additions; negations, comparisons and constants are free.

use std::cell::Cell;
use std::cmp::Ordering;
use std::fmt;
use std::iter::Sum;
use std::num::FpCategory;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, Sub, SubAssign};

use manylights_harmonics::Real;
use num_traits::{Float, FloatConst, Num, NumCast, One, ToPrimitive, Zero};

/// Operations since the last [`count`] began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Operations {
    /// Additions and subtractions.
    pub(crate) additions: usize,
    /// Multiplications.
    pub(crate) multiplications: usize,
    /// Divisions.
    pub(crate) divisions: usize,
    /// Square roots.
    pub(crate) roots: usize,
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.additions, self.multiplications)?;
        if self.divisions > 0 {
            write!(f, " + {} div", self.divisions)?;
        }
        if self.roots > 0 {
            write!(f, " + {} root", self.roots)?;
        }
        Ok(())
    }
}

thread_local! {
    static DONE: Cell<Operations> = const {
        Cell::new(Operations { additions: 0, multiplications: 0, divisions: 0, roots: 0 })
    };
}

/// What `work` does.
pub(crate) fn count(work: impl FnOnce()) -> Operations {
    DONE.set(Operations::default());
    work();
    DONE.get()
}

fn note(change: impl FnOnce(&mut Operations)) {
    let mut done = DONE.get();
    change(&mut done);
    DONE.set(done);
}

/// An f64 that counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Counted(pub(crate) f64);

macro_rules! counted {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident $field:ident;)*) => { $(
        impl $trait for Counted {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                note(|done| done.$field += 1);
                Self(self.0.$method(other.0))
            }
        }
        impl $assign for Counted {
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )* };
}

counted! {
    Add add AddAssign add_assign additions;
    Sub sub SubAssign sub_assign additions;
    Mul mul MulAssign mul_assign multiplications;
    Div div DivAssign div_assign divisions;
}

impl Rem for Counted {
    type Output = Self;
    fn rem(self, other: Self) -> Self {
        Self(self.0 % other.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Sum for Counted {
    fn sum<I: Iterator<Item = Self>>(values: I) -> Self {
        values.reduce(|a, b| a + b).unwrap_or(Self(0.0))
    }
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Zero for Counted {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Counted {
    fn one() -> Self {
        Self(1.0)
    }
}

impl Num for Counted {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self)
    }
}

impl ToPrimitive for Counted {
    fn to_i64(&self) -> Option<i64> {
        self.0.to_i64()
    }
    fn to_u64(&self) -> Option<u64> {
        self.0.to_u64()
    }
    fn to_f64(&self) -> Option<f64> {
        Some(self.0)
    }
}

impl NumCast for Counted {
    fn from<T: ToPrimitive>(value: T) -> Option<Self> {
        value.to_f64().map(Self)
    }
}

impl Real for Counted {
    fn of(value: f64) -> Self {
        Self(value)
    }
    fn to_f64(self) -> f64 {
        self.0
    }
}

macro_rules! constants {
    ($($name:ident)*) => {
        impl FloatConst for Counted {
            $( fn $name() -> Self { Self(<f64 as FloatConst>::$name()) } )*
        }
    };
}

constants! {
    E FRAC_1_PI FRAC_1_SQRT_2 FRAC_2_PI FRAC_2_SQRT_PI FRAC_PI_2 FRAC_PI_3 FRAC_PI_4 FRAC_PI_6
    FRAC_PI_8 LN_10 LN_2 LOG10_E LOG2_E PI SQRT_2 TAU LOG10_2 LOG2_10
}

macro_rules! float {
    (
        values $($value:ident)*; tests $($test:ident)*; unary $($unary:ident)*;
        binary $($binary:ident)*;
    ) => {
        impl Float for Counted {
            $( fn $value() -> Self { Self(<f64 as Float>::$value()) } )*
            $( fn $test(self) -> bool { Float::$test(self.0) } )*
            $( fn $unary(self) -> Self { Self(Float::$unary(self.0)) } )*
            $( fn $binary(self, other: Self) -> Self { Self(Float::$binary(self.0, other.0)) } )*

            fn sqrt(self) -> Self {
                note(|done| done.roots += 1);
                Self(self.0.sqrt())
            }
            fn recip(self) -> Self {
                note(|done| done.divisions += 1);
                Self(self.0.recip())
            }
            fn mul_add(self, a: Self, b: Self) -> Self {
                self * a + b
            }
            fn classify(self) -> FpCategory {
                self.0.classify()
            }
            fn powi(self, n: i32) -> Self {
                Self(self.0.powi(n))
            }
            fn sin_cos(self) -> (Self, Self) {
                let (sine, cosine) = self.0.sin_cos();
                (Self(sine), Self(cosine))
            }
            fn integer_decode(self) -> (u64, i16, i8) {
                self.0.integer_decode()
            }
        }
    };
}

float! {
    values nan infinity neg_infinity neg_zero min_value min_positive_value max_value epsilon;
    tests is_nan is_infinite is_finite is_normal is_sign_positive is_sign_negative;
    unary floor ceil round trunc fract abs signum exp exp2 ln log2 log10 cbrt sin cos tan asin acos
        atan exp_m1 ln_1p sinh cosh tanh asinh acosh atanh;
    binary powf log max min abs_sub hypot atan2;
}
