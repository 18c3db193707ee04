//! Irradiance of lights of unit radiance in closed form, horizon included: the truth of references and
//! methods on Lambertian receivers, in f32 and f64.

use manylights_harmonics::Real;

/// Irradiance of a sphere of unit radiance, sr: `cosine` of the angle between the receiver's normal and
/// the direction to the centre, `sine` = radius/distance of its half angle; from 1 on, that is from the
/// surface and the inside, the hemisphere around that direction.
///
/// Without inverse cosines, which leave no digits of small spheres in f32. With s and c for sine and
/// cosine, cos a = √(1 − s²), y = √(s² − c²) and q = y/cos a, a sphere on the horizon sends
/// (atan q − q) + s² (q + B c) with B = atan2(y, −c cos a).
pub fn sphere_irradiance<T: Real>(cosine: T, sine: T) -> T {
    let (zero, one) = (T::zero(), T::one());
    if sine >= one {
        return T::FRAC_PI_2() * (one + cosine);
    }
    if cosine.abs() >= sine {
        return T::PI() * sine * sine * cosine.max(zero);
    }
    let cos_a = ((one - sine) * (one + sine)).sqrt();
    let y = ((sine - cosine) * (sine + cosine)).sqrt();
    let q = y / cos_a;
    let above = y.atan2(-cosine * cos_a) * cosine;
    if q < T::of(0.35) {
        atan_less_argument(q) + sine * sine * (q + above)
    } else {
        // −q + s² q = −y cos a, which stays finite for s → 1.
        q.atan() - y * cos_a + sine * sine * above
    }
}

/// atan q − q = −q³/3 + q⁵/5 − …, which cancels for small q.
fn atan_less_argument<T: Real>(q: T) -> T {
    let square = q * q;
    let (mut sum, mut power, mut degree) = (T::zero(), -q, T::one());
    loop {
        power = -power * square;
        degree += T::of(2.0);
        let next = sum - power / degree;
        if next == sum {
            return sum;
        }
        sum = next;
    }
}

/// Irradiance of a planar polygon of unit radiance, sr (Lambert 1760): what of it lies above the plane
/// through the origin with the unit `normal`, on which the receiver lies. The corners are relative to the
/// receiver, counter-clockwise seen from the front, in any unit of length, with coordinates up to a quarter
/// of the largest number; zero from behind. Where the receiver lies on the polygon itself there is a jump:
/// if parallel to it, the limit from the front, else any value from 0 to π.
pub fn polygon_irradiance<T: Real>(normal: [T; 3], corners: &[[T; 3]]) -> T {
    // Directions alone count from here on; of their lengths no product over- or underflows.
    let corners: Vec<_> = above_horizon(normal, corners).into_iter().map(near_unit).collect();
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    // The front turns clockwise where its normal points to the receiver.
    let edge = |(a, b): (&[T; 3], &[T; 3])| {
        let across = cross(*a, *b);
        let length = dot(across, across).sqrt();
        if length == T::zero() {
            return T::zero();
        }
        length.atan2(dot(*a, *b)) * dot(across, normal) / length
    };
    (-T::of(0.5) * edges.map(edge).sum::<T>()).max(T::zero())
}

/// The same direction with a largest coordinate from 1 to 2, by a power of two, which rounds nothing; 0
/// stays 0.
fn near_unit<T: Real>(vector: [T; 3]) -> [T; 3] {
    let largest = vector.iter().fold(T::min_positive_value(), |most, c| most.max(c.abs()));
    let exponent = largest.log2().floor().to_i32().expect("of a finite number");
    vector.map(|coordinate| coordinate * T::of(2.0).powi(-exponent))
}

/// The part of a polygon above a plane through the origin (Sutherland and Hodgman 1974).
fn above_horizon<T: Real>(normal: [T; 3], corners: &[[T; 3]]) -> Vec<[T; 3]> {
    let mut above = Vec::with_capacity(corners.len() + 1);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let [from, to] = [a, b].map(|corner| dot(normal, *corner));
        if from >= T::zero() {
            above.push(*a);
        }
        if (from > T::zero()) != (to > T::zero()) && from != T::zero() && to != T::zero() {
            let share = from / (from - to);
            above.push([0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis])));
        }
    }
    above
}

fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests;
