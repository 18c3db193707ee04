use std::f64::consts::{FRAC_PI_2, PI, TAU};

use manylights_harmonics::quadrature::gauss_legendre;

use super::*;

mod hard_polygons;

/// ∫ max(0, n·ω) dω over the cap by quadrature. The azimuth is done: over a circle at θ around an axis
/// of cosine c the clamped cosine p + r cos φ, p = c cos θ, r = sin θ √(1 − c²), has the integral
/// 2 (p φ₀ + r sin φ₀), φ₀ = arccos(−p/r). It has square-root kinks at θ = ½π ± ∠(n, w), where the
/// interval is cut; θ = middle + half sin t removes them.
fn quadrature(cosine: f64, half_angle: f64) -> f64 {
    let angle = cosine.acos();
    let kink = (FRAC_PI_2 - angle).abs();
    let cuts = [0.0, kink.min(half_angle), half_angle];
    let sine = angle.sin();
    let circle = |theta: f64| {
        let (p, r) = (cosine * theta.cos(), theta.sin() * sine);
        let end = if r == 0.0 {
            if p > 0.0 { PI } else { 0.0 }
        } else {
            (-p / r).clamp(-1.0, 1.0).acos()
        };
        2.0 * (p * end + r * end.sin()) * theta.sin()
    };
    cuts.windows(2)
        .map(|cut| {
            let (middle, half) = (0.5 * (cut[0] + cut[1]), 0.5 * (cut[1] - cut[0]));
            let node = |(x, weight): (f64, f64)| {
                let t = FRAC_PI_2 * x;
                weight * FRAC_PI_2 * half * t.cos() * circle(middle + half * t.sin())
            };
            gauss_legendre(400).into_iter().map(node).sum::<f64>()
        })
        .sum()
}

/// Cosines over the whole sphere, and many around the horizon of a light of this sine.
fn cosines(sine: f64) -> Vec<f64> {
    let everywhere = (0..=40).map(|i| (PI * f64::from(i) / 40.0).cos());
    let crossing = (0..=60).map(|i| (f64::from(i) / 30.0 - 1.0) * sine);
    everywhere.chain(crossing).collect()
}

const HALF_ANGLES: [f64; 11] = [1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.33, 0.5, 0.8, 1.2, 1.5];

#[test]
fn spheres_have_the_irradiance_of_quadrature() {
    let mut worst = 0.0_f64;
    for half_angle in HALF_ANGLES {
        let sine = half_angle.sin();
        for cosine in cosines(sine) {
            let exact = quadrature(cosine, half_angle);
            let error = (sphere_irradiance(cosine, sine) - exact).abs() / (PI * sine * sine);
            worst = worst.max(error);
            assert!(error < 1e-10, "{error:e} of the maximum: {half_angle}, cosine {cosine}");
        }
    }
    println!("sphere, f64: {worst:e} of the maximum");
}

#[test]
fn spheres_keep_the_digits_of_single_precision() {
    let mut worst = (0.0_f64, 0.0, 0.0);
    let half_angles = (0..=400).map(|i| 1e-4 * 15_000_f64.powf(f64::from(i) / 400.0));
    for half_angle in half_angles.chain([FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-6]) {
        let sine = half_angle.sin() as f32;
        for cosine in cosines(sine.into()).into_iter().map(|cosine| cosine as f32) {
            let exact = sphere_irradiance(f64::from(cosine), f64::from(sine));
            let error = (f64::from(sphere_irradiance(cosine, sine)) - exact).abs();
            let error = error / (PI * f64::from(sine * sine));
            if error > worst.0 || error.is_nan() {
                worst = (error, half_angle, cosine.into());
            }
        }
    }
    let (error, half_angle, cosine) = worst;
    println!("sphere, f32: {error:e} of the maximum at half angle {half_angle}, cosine {cosine}");
    assert!(error <= 1e-6, "{error:e} of the maximum: half angle {half_angle}, cosine {cosine}");
}

/// From the inside a hemisphere, without a jump on the surface.
#[test]
fn the_inside_of_a_sphere_is_a_hemisphere() {
    for i in 0..=20 {
        let cosine = f64::from(i) / 10.0 - 1.0;
        let expected = FRAC_PI_2 * (1.0 + cosine);
        for sine in [1.0, 7.0, f64::INFINITY, 1.0 - 1e-14] {
            let error = (sphere_irradiance(cosine, sine) - expected).abs();
            assert!(error < 1e-6, "cosine {cosine}, sine {sine}: {error}");
        }
        let error = sphere_irradiance(cosine as f32, 1.0 - f32::EPSILON) - expected as f32;
        assert!(error.abs() < 2e-3, "cosine {cosine}: {error}");
    }
}

/// Uniform numbers without a crate.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> [f64; 3] {
        let (z, angle) = (2.0 * self.next() - 1.0, TAU * self.next());
        let sine = (1.0 - z * z).sqrt();
        [sine * angle.cos(), sine * angle.sin(), z]
    }

    /// A triangle of about this size at this distance, its front towards the origin.
    fn triangle(&mut self, size: f64, distance: f64) -> [[f64; 3]; 3] {
        let center = self.direction().map(|c| distance * c);
        let mut corners = [(); 3].map(|()| {
            let offset = self.direction();
            [0, 1, 2].map(|axis| center[axis] + size * offset[axis])
        });
        if dot(corners[0], cross(corners[1], corners[2])) > 0.0 {
            corners.swap(1, 2);
        }
        corners
    }
}

/// ∫ cos cos′/d² dA over the part of a triangle above the horizon by quadrature: collapsed squares over
/// the triangles that it is cut into.
fn over_area(normal: [f64; 3], corners: &[[f64; 3]]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|axis| a[axis] - b[axis]);
    let nodes = gauss_legendre(96);
    let fan = 1..corners.len().saturating_sub(1);
    fan.map(|i| {
        let [a, b, c] = [corners[0], corners[i], corners[i + 1]];
        let back = cross(minus(c, a), minus(b, a));
        let mut sum = 0.0;
        for (x, along) in &nodes {
            for (y, across) in &nodes {
                let (u, v) = (0.5 + 0.5 * x, 0.5 + 0.5 * y);
                let (u, v) = (u * (1.0 - v), u * v);
                let p = [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
                let weight = 0.25 * along * across * (u + v);
                sum += weight * dot(p, normal) * dot(p, back) / dot(p, p).powi(2);
            }
        }
        sum
    })
    .sum()
}

#[test]
fn polygons_have_the_irradiance_of_quadrature() {
    let (mut numbers, mut worst, mut clipped) = (Numbers(1), 0.0_f64, 0);
    for _ in 0..400 {
        let size = 0.05 + 0.5 * numbers.next();
        let (normal, corners) = (numbers.direction(), numbers.triangle(size, 1.0));
        let above = above_horizon(normal, &corners);
        clipped += u32::from(!above.is_empty() && corners.iter().any(|c| dot(*c, normal) < 0.0));
        let error = (polygon_irradiance(normal, &corners) - over_area(normal, &above)).abs();
        worst = worst.max(error);
        assert!(error < 1e-10, "{error:e}: {normal:?} {corners:?}");
        let [a, b, c] = corners;
        assert_eq!(polygon_irradiance(normal, &[a, c, b]), 0.0, "the back is dark");
    }
    println!("polygon, f64: {worst:e}, {clipped} clipped");
    assert!(clipped > 40, "{clipped}");
}

/// Below 10 sizes. The error of all in sr and, slivers among them, relative to the maximum over normals,
/// where the receiver faces the triangle; of 99 % the latter.
#[test]
fn polygons_keep_the_digits_of_single_precision() {
    let mut numbers = Numbers(2);
    let (mut errors, mut worst) = (Vec::new(), (0.0, [[0.0; 3]; 3]));
    for _ in 0..20_000 {
        let distance = 1.0 + 9.0 * numbers.next();
        let (normal, corners) = (numbers.direction(), numbers.triangle(1.0, distance));
        let single = |v: [f64; 3]| v.map(|c| c as f32);
        // The same numbers in both precisions.
        let double = |v: [f64; 3]| v.map(|c| f64::from(c as f32));
        let irradiance = |normal| polygon_irradiance(double(normal), &corners.map(double));
        let center = [0, 1, 2].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>());
        let facing = center.map(|c| c / dot(center, center).sqrt());
        let found = polygon_irradiance(single(normal), &corners.map(single));
        let error = (f64::from(found) - irradiance(normal)).abs();
        errors.push(error / irradiance(facing));
        if error > worst.0 || error.is_nan() {
            worst = (error, corners);
        }
    }
    errors.sort_by(f64::total_cmp);
    let [median, high] = [0.5, 0.99].map(|share| errors[(share * errors.len() as f64) as usize]);
    let (absolute, corners) = worst;
    let highest = errors[errors.len() - 1];
    println!("polygon, f32: median {median:e}, 99 % {high:e}, all {highest:e}; {absolute:e} sr");
    assert!(high <= 1e-4, "99 %: {high:e}, median {median:e}");
    assert!(highest <= 1e-2, "a sliver: {highest:e}");
    assert!(absolute <= 5e-7, "{absolute:e} sr: {corners:?}");
}
