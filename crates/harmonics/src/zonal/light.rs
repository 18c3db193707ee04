//! What a point sees of a spherical light or of a disk that faces it, and how that changes as the
//! point moves.

use super::Cap;
use crate::{Real, count};

/// A light of radiance one as a point sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting<R> {
    /// Unit vector ω from the point to the light's centre.
    pub direction: [R; 3],
    /// Distance d of the centre.
    pub distance: R,
    /// What the light covers.
    pub cap: Cap<R>,
    /// dα/dd, change of the cap's cosine with the distance (thesis 3.28: −∇a sin a).
    ///
    /// Of a sphere it grows without bound as the point nears the surface, and is 0 on it and inside,
    /// where the cap stays the hemisphere.
    pub cosine_rate: R,
}

impl<R: Real> Sighting<R> {
    /// A sphere of this radius whose centre lies at `offset` = y − x from the point.
    ///
    /// `None` if the centre is the point (no direction is right), if the square of its distance over-
    /// or underflows (distances of 1e-18 to 1e18 are safe, in f64 of 1e-150 to 1e150) or if a number is
    /// not finite.
    pub fn of_sphere(offset: [R; 3], radius: R) -> Option<Self> {
        let (direction, distance) = polar(offset)?;
        let cap = Cap::of_sphere(radius, distance);
        let square = cap.sine * cap.sine;
        let outside = cap.cosine > R::zero();
        let cosine_rate = if outside { square / (distance * cap.cosine) } else { R::zero() };
        radius.is_finite().then_some(Self { direction, distance, cap, cosine_rate })
    }

    /// A disk of this radius that always faces the point (thesis 3.29), its centre at `offset`.
    ///
    /// `None` as for a sphere.
    pub fn of_disk(offset: [R; 3], radius: R) -> Option<Self> {
        let (direction, distance) = polar(offset)?;
        let cap = Cap::of_disk(radius, distance);
        let cosine_rate = cap.sine * cap.sine * cap.cosine / distance;
        radius.is_finite().then_some(Self { direction, distance, cap, cosine_rate })
    }
}

/// Direction and length, `None` without either.
fn polar<R: Real>([x, y, z]: [R; 3]) -> Option<([R; 3], R)> {
    let square = x * x + y * y + z * z;
    let distance = square.sqrt();
    // A subnormal square has lost digits of the distance.
    square.is_normal().then(|| ([x / distance, y / distance, z / distance], distance))
}

/// ∇_x of the coefficients of a light at a point x (thesis 3.26):
/// −(c_l ∇_y Y_lm + Y_lm (dc_l/dd) ω), in coefficient per unit of length.
///
/// `scales` and `rates` hold c_l and dc_l/dd, one a band; `values` the Y_lm(ω), bands² of them;
/// `gradients`, one slice of bands² an axis, goes in as the tangential gradients of Y_lm on the unit
/// sphere (∇_y Y_lm times d) and comes out as the gradients of the coefficients.
pub fn light_gradient<R: Real>(
    sighting: &Sighting<R>,
    scales: &[R],
    rates: &[R],
    values: &[R],
    gradients: [&mut [R]; 3],
) {
    let bands = scales.len();
    assert_eq!(rates.len(), bands, "one rate a band");
    assert_eq!(values.len(), count(bands), "bands² values");
    let [gx, gy, gz] = gradients;
    for gradient in [&*gx, gy, gz] {
        assert_eq!(gradient.len(), count(bands), "bands² gradients");
    }
    let inverse = -R::one() / sighting.distance;
    let [x, y, z] = sighting.direction;
    for (l, (&scale, &rate)) in scales.iter().zip(rates).enumerate() {
        let (tangential, radial) = (scale * inverse, [rate * x, rate * y, rate * z]);
        let band = count(l)..count(l + 1);
        let rows = gx[band.clone()].iter_mut().zip(&mut gy[band.clone()]);
        for (((x, y), z), &value) in rows.zip(&mut gz[band.clone()]).zip(&values[band]) {
            *x = tangential * *x - value * radial[0];
            *y = tangential * *y - value * radial[1];
            *z = tangential * *z - value * radial[2];
        }
    }
}
