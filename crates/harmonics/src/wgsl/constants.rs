//! The constants of the recurrence in f64; names as in [`crate::basis`].

/// Q_m^m, √2 of m > 0 included.
pub(super) fn diagonal(m: usize) -> f64 {
    let product: f64 = (1..=m).map(|k| 1.0 + 0.5 / k as f64).product();
    let factor = if m > 0 { 2.0 } else { 1.0 };
    (factor * product * 0.25 / std::f64::consts::PI).sqrt()
}

/// a and b of Q_l^m = a z Q_{l−1}^m − b Q_{l−2}^m, l > m.
pub(super) fn recurrence(l: usize, m: usize) -> [f64; 2] {
    let (degree, order) = (l as f64, m as f64);
    let a = |l: f64| ((4.0 * l * l - 1.0) / (l * l - order * order)).sqrt();
    let b = if l > m + 1 { a(degree) / a(degree - 1.0) } else { 0.0 };
    [a(degree), b]
}

/// c of ∂_z R_lm = c R_{l−1,m}.
pub(super) fn rise(l: usize, m: usize) -> f64 {
    let (l, m) = (l as f64, m as f64);
    ((2.0 * l + 1.0) * (l * l - m * m) / (2.0 * l - 1.0)).sqrt()
}

/// Q_l^m(z) on the unit sphere.
pub(super) fn z_part(l: usize, m: usize, z: f64) -> f64 {
    let (mut before, mut q) = (0.0, diagonal(m));
    for degree in m + 1..=l {
        let [a, b] = recurrence(degree, m);
        (before, q) = (q, a * z * q - b * before);
    }
    q
}
