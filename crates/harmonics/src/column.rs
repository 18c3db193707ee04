//! What the recurrence computes with, and what the bands of one order share.

use std::ops::Mul;

use crate::Real;

/// What the recurrence computes with: R itself, or a vector of R, one lane per direction.
pub(crate) trait Number<R>: Copy + Mul<Output = Self> {
    /// `value` in each lane.
    fn constant(self, value: R) -> Self;

    /// self · factor.
    fn times(self, factor: R) -> Self;

    /// self · factor + term, fused where that is fast.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// self · factor − term.
    fn mul_sub(self, factor: Self, term: Self) -> Self;

    /// term − self · factor.
    fn negative_mul_add(self, factor: Self, term: Self) -> Self;

    /// −(self · factor + term).
    fn negative_mul_sub(self, factor: Self, term: Self) -> Self;
}

impl<R: Real> Number<R> for R {
    #[inline(always)]
    fn constant(self, value: R) -> Self {
        value
    }

    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self * factor
    }

    /// Not `f32::mul_add`, which is a library call where the target has no such instruction.
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        self * factor - term
    }

    #[inline(always)]
    fn negative_mul_add(self, factor: Self, term: Self) -> Self {
        term - self * factor
    }

    #[inline(always)]
    fn negative_mul_sub(self, factor: Self, term: Self) -> Self {
        -(self * factor + term)
    }
}

/// What all bands of one order ±m share, gradients' `scale` included.
#[derive(Clone, Copy)]
pub(crate) struct Column<R, N> {
    m: usize,
    order: R,
    /// (U_m, V_m).
    power: [N; 2],
    /// m (U_{m−1}, V_{m−1}).
    turn: [N; 2],
    /// x, y and 1 times (U_m, V_m).
    along_x: [N; 2],
    along_y: [N; 2],
    along_z: [N; 2],
}

impl<R: Real, N: Number<R>> Column<R, N> {
    /// From the powers (x + iy)^(m − 1) and (x + iy)^m and from (x, y, 1) times the scale.
    #[inline(always)]
    pub(crate) fn new(m: usize, before: [N; 2], power: [N; 2], [x, y, one]: [N; 3]) -> Self {
        let order = R::of(m as f64);
        let [u, v] = power;
        Self {
            m,
            order,
            power,
            turn: [(before[0] * one).times(order), (before[1] * one).times(order)],
            along_x: [u * x, v * x],
            along_y: [u * y, v * y],
            along_z: [u * one, v * one],
        }
    }

    /// Writes Y_lm and Y_l,−m from Q and `slope` = dQ/dz.
    #[inline(always)]
    pub(crate) fn emit<const GRADIENT: bool>(
        &self,
        l: usize,
        z: N,
        q: N,
        slope: N,
        write: &mut impl FnMut(usize, [N; 4]),
    ) {
        let gradient = if GRADIENT { self.gradient(z, q, slope) } else { [[q; 3]; 2] };
        let [[ax, ay, az], [bx, by, bz]] = gradient;
        write(l * (l + 1) + self.m, [q * self.power[0], ax, ay, az]);
        if self.m > 0 {
            write(l * (l + 1) - self.m, [q * self.power[1], bx, by, bz]);
        }
    }

    /// Gradients of Y_lm and Y_l,−m from Q and `slope` = dQ/dz (see [`crate::basis`]).
    #[inline(always)]
    fn gradient(&self, z: N, q: N, slope: N) -> [[N; 3]; 2] {
        let [u_turn, v_turn] = self.turn;
        let inward = z.mul_add(slope, q.times(self.order)); // −E
        let polar = z.negative_mul_add(inward, slope);
        let (turned_u, turned_v) = (q * u_turn, q * v_turn);
        [
            [
                inward.negative_mul_add(self.along_x[0], turned_u),
                inward.negative_mul_sub(self.along_y[0], turned_v),
                polar * self.along_z[0],
            ],
            [
                inward.negative_mul_add(self.along_x[1], turned_v),
                inward.negative_mul_add(self.along_y[1], turned_u),
                polar * self.along_z[1],
            ],
        ]
    }
}
