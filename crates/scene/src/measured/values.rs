//! The numbers of either kind of file.

use super::merl::Merl;
use super::real::Real;
use super::rgl::Rgl;

/// What a file holds.
#[derive(PartialEq)]
pub(super) enum Values {
    Rgl(Rgl),
    Merl(Merl),
}

impl Values {
    pub(super) fn eval<T: Real>(&self, v: [T; 3], l: [T; 3]) -> [T; 3] {
        match self {
            Self::Rgl(rgl) => rgl.eval(v, l),
            Self::Merl(merl) => merl.eval(v, l).map(|value| value * l[2]),
        }
    }

    pub(super) fn words(&self) -> Vec<u32> {
        match self {
            Self::Rgl(rgl) => rgl.words(),
            Self::Merl(merl) => merl.words(),
        }
    }
}
