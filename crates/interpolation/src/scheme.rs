//! How a point between eight corners reads their values and gradients.

use manylights_harmonics::Real;

/// Of a cell. Bit i of a corner's number is set where it is the upper one along axis i.
pub const CORNERS: usize = 8;

/// Of the value and of the three derivatives at each corner, where derivatives are per cell: a gradient times
/// the spacing. Every scheme is linear in them.
pub type Weights<R> = [[R; 4]; CORNERS];

/// Between the corners of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Of values alone: second order.
    Trilinear,
    /// Trilinear weights of the first-order expansions about the corners (Annen et al. 2004): second order.
    Taylor,
    /// Hermite polynomials along each axis, the mixed derivatives zero (Wu et al. 2020 as the thesis has it):
    /// second order with a small constant. Once continuously differentiable.
    HermiteFlat,
    /// The same, each mixed second derivative the mean of two differences of first ones within the cell: third
    /// order.
    Hermite,
}

impl Scheme {
    /// Whether it reads gradients.
    pub fn reads_gradients(self) -> bool {
        self != Self::Trilinear
    }

    /// Of the corners at a point of the cell, each coordinate 0 to 1.
    pub fn weights<R: Real>(self, local: [R; 3]) -> Weights<R> {
        match self {
            Self::Trilinear => trilinear(local),
            Self::Taylor => taylor(local),
            Self::HermiteFlat => tensor(local.map(Cubic::new)),
            Self::Hermite => {
                let cubics = local.map(Cubic::new);
                let mut weights = tensor(cubics);
                add_mixed(cubics, &mut weights);
                weights
            }
        }
    }
}

/// Along one axis.
#[derive(Clone, Copy)]
struct Cubic<R> {
    /// Of the values at both ends.
    value: [R; 2],
    /// Of the derivatives at both ends.
    slope: [R; 2],
}

impl<R: Real> Cubic<R> {
    fn new(t: R) -> Self {
        let (two, three) = (R::of(2.0), R::of(3.0));
        let back = R::one() - t;
        let upper = t * t * (three - two * t);
        Self { value: [R::one() - upper, upper], slope: [t * back * back, -t * t * back] }
    }
}

/// The end of an axis at which a corner lies.
fn end(corner: usize, axis: usize) -> usize {
    corner >> axis & 1
}

fn trilinear<R: Real>(local: [R; 3]) -> Weights<R> {
    let weight = |corner: usize| {
        let along = |axis: usize| match end(corner, axis) {
            0 => R::one() - local[axis],
            _ => local[axis],
        };
        along(0) * along(1) * along(2)
    };
    [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| [weight(corner), R::zero(), R::zero(), R::zero()])
}

fn taylor<R: Real>(local: [R; 3]) -> Weights<R> {
    let mut weights = trilinear(local);
    for (corner, weights) in weights.iter_mut().enumerate() {
        for axis in 0..3 {
            weights[axis + 1] = weights[0] * (local[axis] - R::of(end(corner, axis) as f64));
        }
    }
    weights
}

fn tensor<R: Real>(cubics: [Cubic<R>; 3]) -> Weights<R> {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| {
        let value = |axis: usize| cubics[axis].value[end(corner, axis)];
        let slope = |axis: usize| cubics[axis].slope[end(corner, axis)];
        let [x, y, z] = [0, 1, 2].map(value);
        [x * y * z, slope(0) * y * z, x * slope(1) * z, x * y * slope(2)]
    })
}

/// The tensor's terms with two slopes. The mixed derivative of a corner is half of the difference of the first
/// axis' derivative along the second, and half of that of the second along the first.
fn add_mixed<R: Real>(cubics: [Cubic<R>; 3], weights: &mut Weights<R>) {
    for [first, second, third] in [[0, 1, 2], [0, 2, 1], [1, 2, 0]] {
        for corner in 0..CORNERS {
            let slope = |axis: usize| cubics[axis].slope[end(corner, axis)];
            let value = cubics[third].value[end(corner, third)];
            let half = R::of(0.5) * slope(first) * slope(second) * value;
            for (along, across) in [(first, second), (second, first)] {
                let (upper, lower) = (corner | 1 << across, corner & !(1 << across));
                weights[upper][along + 1] += half;
                weights[lower][along + 1] -= half;
            }
        }
    }
}
