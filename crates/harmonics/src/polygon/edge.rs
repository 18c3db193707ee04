//! What one edge of a polygon adds to the zonal integrals about a direction.

use super::directions::MAX_BANDS;
use crate::Real;

/// An edge as a point sees it: an arc of a great circle.
pub(super) struct Edge<R> {
    /// Unit vector to its first corner.
    start: [R; 3],
    /// Unit, at the first corner towards the second.
    tangent: [R; 3],
    /// μ, unit: of the plane through the point and the edge.
    normal: [R; 3],
    /// γ of the arc.
    angle: R,
    sine: R,
    cosine: R,
    /// One over the distance of the edge's point at the angle g is A cos g + B sin g.
    inverse_distance: [R; 2],
}

impl<R: Real> Edge<R> {
    /// From corner to corner, seen from the point; `None` where its line passes through the point, whose
    /// plane is any.
    pub(super) fn new(from: [R; 3], to: [R; 3]) -> Option<Self> {
        let along = difference(to, from);
        // From the difference, which keeps the digits of short edges.
        let across = cross(from, along);
        let length = |v: [R; 3]| dot(v, v).sqrt();
        let [area, near, far] = [across, from, to].map(length);
        if area <= R::of(8.0) * R::epsilon() * near * length(along) {
            return None;
        }
        let [normal, start] = [across.map(|c| c / area), from.map(|c| c / near)];
        let (sine, cosine) = (area / (near * far), dot(from, to) / (near * far));
        let rate = -dot(from, along) / (near * area);
        Some(Self {
            start,
            tangent: cross(normal, start),
            normal,
            angle: sine.atan2(cosine),
            sine,
            cosine,
            inverse_distance: [R::one() / near, rate],
        })
    }

    /// Adds (axis·μ) B_{l−1} to the value of each band l ≥ 1 and μ G_l to the gradient of each, where B_l is
    /// ∫ P_l(axis·ω) dg along the arc and G_l the same over the distance.
    pub(super) fn add(
        &self,
        axis: [R; 3],
        radiance: R,
        values: &mut [R],
        gradients: &mut [[R; 3]],
    ) {
        let bands = values.len();
        let [a, b, c] = [self.start, self.tangent, self.normal].map(|v| dot(axis, v));
        let clamp = |cosine: R| cosine.max(-R::one()).min(R::one());
        let (from, to) = (clamp(a), clamp(a * self.cosine + b * self.sine));
        // −dz/dg at the second corner.
        let slope = a * self.sine - b * self.cosine;
        let integrals = self.integrals([from, to], [b, slope, c], bands);
        let over_distance = self.over_distance([a, b], &integrals, bands);
        for (value, integral) in values.iter_mut().skip(1).zip(integrals.of_legendre) {
            *value += radiance * c * integral;
        }
        for (gradient, integral) in gradients.iter_mut().zip(over_distance) {
            let weight = radiance * integral;
            *gradient = [0, 1, 2].map(|i| gradient[i] + weight * self.normal[i]);
        }
    }

    /// B_l and D_l, ∫ P_l and ∫ P_l' along the arc.
    fn integrals(&self, ends: [R; 2], [b, slope, c]: [R; 3], bands: usize) -> Integrals<R> {
        let legendre = ends.map(|cosine| legendre(cosine, bands));
        let mut of_legendre = [R::zero(); MAX_BANDS];
        let mut of_derivative = [R::zero(); MAX_BANDS];
        of_legendre[0] = self.angle;
        if bands > 1 {
            (of_legendre[1], of_derivative[1]) = (slope + b, self.angle);
        }
        for l in 2..bands {
            let [n, previous] = [l, l - 1].map(|n| R::of(n as f64));
            let product = (slope * legendre[1][l - 1] + b * legendre[0][l - 1]
                - c * c * of_derivative[l - 1]
                + previous * of_legendre[l - 2])
                / n;
            let odd = R::of((2 * l - 1) as f64);
            of_legendre[l] = (odd * product - previous * of_legendre[l - 2]) / n;
            of_derivative[l] = odd * of_legendre[l - 1] + of_derivative[l - 2];
        }
        Integrals { legendre, of_legendre, of_derivative }
    }

    /// G_l, ∫ P_l over the distance along the arc, without the division by 1 − c² of the published form,
    /// which loses its digits where the axis is normal to the edge's plane.
    fn over_distance(
        &self,
        [a, b]: [R; 2],
        integrals: &Integrals<R>,
        bands: usize,
    ) -> [R; MAX_BANDS] {
        let [near, rate] = self.inverse_distance;
        let versine = match self.cosine > R::zero() {
            true => self.sine * self.sine / (R::one() + self.cosine),
            false => R::one() - self.cosine,
        };
        let rates = [rate, rate * self.cosine - near * self.sine];
        let both = a * near + b * rate;
        let mut integral = [R::zero(); MAX_BANDS];
        integral[0] = near * self.sine + rate * versine;
        // ∫ P_n' over the distance, of the last two n.
        let (mut lower, mut upper) = (R::zero(), integral[0]);
        for (n, integral) in integral.iter_mut().enumerate().take(bands).skip(1) {
            let ends = rates[0] * integrals.legendre[0][n] - rates[1] * integrals.legendre[1][n];
            let inner = both * integrals.of_derivative[n];
            *integral = (ends + inner - lower) / R::of((n + 1) as f64);
            (lower, upper) = (upper, R::of((2 * n + 1) as f64) * *integral + lower);
        }
        integral
    }
}

/// Along an arc.
struct Integrals<R> {
    /// P_l at both ends.
    legendre: [[R; MAX_BANDS]; 2],
    of_legendre: [R; MAX_BANDS],
    of_derivative: [R; MAX_BANDS],
}

/// P_l by Bonnet's recurrence.
fn legendre<R: Real>(cosine: R, bands: usize) -> [R; MAX_BANDS] {
    let mut values = [R::one(); MAX_BANDS];
    if bands > 1 {
        values[1] = cosine;
    }
    for l in 2..bands {
        let (odd, previous) = (R::of((2 * l - 1) as f64), R::of((l - 1) as f64));
        values[l] = (odd * cosine * values[l - 1] - previous * values[l - 2]) / R::of(l as f64);
    }
    values
}

pub(crate) fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross<R: Real>([a, b, c]: [R; 3], [x, y, z]: [R; 3]) -> [R; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

pub(crate) fn difference<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
