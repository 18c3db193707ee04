//! Derivatives in (θ, φ), thesis section 3.2.2, and their conversion to Cartesian ones.

use crate::recurrence::{diagonal, three_term};
use crate::{Real, count, even_index, index};

/// Factors of X_l^m (3.24) and of the derivatives (3.18), for l ≥ m at `even_index(l, m)`.
#[derive(Clone, Copy, Debug)]
struct Factors<R> {
    /// X_l = `ahead` z X_{l−1} − `behind` X_{l−2}, the normalisation included.
    ahead: R,
    behind: R,
    /// ∂θ P_l^m = `lower` P_l^{m−1} − `raise` P_l^{m+1}, normalised.
    lower: R,
    raise: R,
}

/// Tables for the *Direct* and the *Sloan's-like* method.
#[derive(Clone, Debug)]
pub struct SphericalGradients<R> {
    bands: usize,
    diagonal: Vec<R>,
    factors: Vec<Factors<R>>,
}

impl<R: Real> SphericalGradients<R> {
    /// Tables for `bands` ≥ 1 bands.
    pub fn new(bands: usize) -> Self {
        assert!(bands >= 1, "an expansion has at least one band");
        let factors = (0..bands).flat_map(|l| (0..=l).map(move |m| factors(l, m))).collect();
        Self { bands, diagonal: (0..bands).map(|m| R::of(diagonal(m))).collect(), factors }
    }

    /// *Direct*: values, ∂θ by 3.17 and 3.18 from the associated Legendre functions, ∂φ by 3.16. Each
    /// slice holds bands² numbers. Not finite on the z axis.
    pub fn direct(&self, [x, y, z]: [R; 3], values: &mut [R], theta: &mut [R], phi: &mut [R]) {
        self.check(values, theta, phi);
        let sine = (x * x + y * y).sqrt();
        let (cosine_phi, sine_phi) = (x / sine, y / sine);
        // `theta` holds P_l^m first: column m + 1 is still there when column m becomes ∂θ.
        let mut power = R::one();
        for m in 0..self.bands {
            self.column(m, z, |l, x| theta[index(l, m as isize)] = x * power);
            power *= sine;
        }
        for l in 0..self.bands {
            let (mut c, mut s, mut below) = (R::one(), R::zero(), R::zero());
            for m in 0..=l {
                let at = index(l, m as isize);
                let Factors { lower, raise, .. } = self.factors[even_index(l, m)];
                let here = theta[at];
                let raised = if m < l { raise * theta[at + 1] } else { R::zero() };
                let slope = lower * below - raised;
                below = here;
                (values[at], theta[at]) = (here * c, slope * c);
                if m > 0 {
                    let mirror = index(l, -(m as isize));
                    (values[mirror], theta[mirror]) = (here * s, slope * s);
                }
                (c, s) = (c * cosine_phi - s * sine_phi, s * cosine_phi + c * sine_phi);
            }
        }
        self.azimuthal(values, phi);
    }

    /// *Sloan's-like*: values, ∂θ by 3.20 with the recurrences 3.24 and 3.25, ∂φ by 3.16. Each slice
    /// holds bands² numbers. Not finite on the z axis.
    pub fn sloans_like(&self, [x, y, z]: [R; 3], values: &mut [R], theta: &mut [R], phi: &mut [R]) {
        self.check(values, theta, phi);
        let sine = (x * x + y * y).sqrt();
        let cotangent = z / sine;
        let (mut u, mut v) = (R::one(), R::zero());
        for m in 0..self.bands {
            let turn = R::of(m as f64) * cotangent;
            let (mut q_before, mut q) = (R::zero(), self.diagonal[m]);
            let (mut t_before, mut t) = (R::zero(), R::zero());
            for l in m..self.bands {
                if l > m {
                    let Factors { ahead, behind, .. } = self.factors[even_index(l, m)];
                    (t_before, t) = (t, ahead * (z * t - sine * q) - behind * t_before);
                    (q_before, q) = (q, ahead * z * q - behind * q_before);
                }
                let slope = q * turn + t;
                let at = index(l, m as isize);
                (values[at], theta[at]) = (q * u, slope * u);
                if m > 0 {
                    let at = index(l, -(m as isize));
                    (values[at], theta[at]) = (q * v, slope * v);
                }
            }
            (u, v) = (x * u - y * v, x * v + y * u);
        }
        self.azimuthal(values, phi);
    }

    /// X_l^m of all l ≥ m.
    fn column(&self, m: usize, z: R, mut each: impl FnMut(usize, R)) {
        let (mut before, mut q) = (R::zero(), self.diagonal[m]);
        each(m, q);
        for l in m + 1..self.bands {
            let Factors { ahead, behind, .. } = self.factors[even_index(l, m)];
            (before, q) = (q, ahead * z * q - behind * before);
            each(l, q);
        }
    }

    /// ∂φ Y_lm = −m Y_l,−m (3.16).
    fn azimuthal(&self, values: &[R], phi: &mut [R]) {
        for l in 0..self.bands {
            for m in -(l as isize)..=l as isize {
                phi[index(l, m)] = -R::of(m as f64) * values[index(l, -m)];
            }
        }
    }

    fn check(&self, values: &[R], theta: &[R], phi: &[R]) {
        for slice in [values, theta, phi] {
            assert_eq!(slice.len(), count(self.bands), "bands² numbers");
        }
    }
}

fn factors<R: Real>(l: usize, m: usize) -> Factors<R> {
    let [ahead, behind] = if l > m { three_term(l, m) } else { [0.0; 2] };
    // √2 stands in P_l^m for m > 0 only.
    let (down, up) = match m {
        0 => (0.0, std::f64::consts::FRAC_1_SQRT_2),
        1 => (std::f64::consts::FRAC_1_SQRT_2, 0.5),
        _ => (0.5, 0.5),
    };
    let (l, m) = (l as f64, m as f64);
    Factors {
        ahead: R::of(ahead),
        behind: R::of(behind),
        lower: R::of(down * ((l + m) * (l - m + 1.0)).sqrt()),
        raise: R::of(up * ((l - m) * (l + m + 1.0)).sqrt()),
    }
}

/// Thesis 3.15 at a point ≠ 0: turns (∂θ, ∂φ) of each coefficient into Cartesian derivatives per
/// displacement of the point. Slices of equal length; not finite on the z axis.
pub fn to_cartesian<R: Real>([x, y, z]: [R; 3], theta: &[R], phi: &[R], gradients: [&mut [R]; 3]) {
    let radius_squared = x * x + y * y;
    let psi = (radius_squared + z * z) * radius_squared.sqrt();
    let (along_x, along_y, along_z) = (x * z / psi, y * z / psi, -radius_squared / psi);
    let (turn_x, turn_y) = (-y / radius_squared, x / radius_squared);
    let [gx, gy, gz] = gradients;
    for (i, (&theta, &phi)) in theta.iter().zip(phi).enumerate() {
        gx[i] = along_x * theta + turn_x * phi;
        gy[i] = along_y * theta + turn_y * phi;
        gz[i] = along_z * theta;
    }
}
