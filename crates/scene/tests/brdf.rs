//! The reflectance model over random materials and directions: reciprocity, energy, and agreement of
//! the single- and double-precision forms.

use std::f64::consts::{FRAC_1_PI, TAU};

use glam::{DVec3, Vec3};
use manylights_scene::material::MIN_ROUGHNESS;
use manylights_scene::presets::{MIN_ALPHA, PRESETS};
use manylights_scene::{Brdf, DBrdf, Lobe, Material};
use proptest::prelude::*;

fn material() -> impl Strategy<Value = Brdf> {
    let unit = || 0.0_f32..=1.0;
    let color = || prop::array::uniform3(0.0_f32..=1.0).prop_map(Vec3::from_array);
    (color(), unit(), MIN_ROUGHNESS..=1.0_f32, 1.0_f32..2.5, unit(), color()).prop_map(
        |(base_color, metallic, roughness, ior, specular, specular_color)| {
            let grey = Material::lambert("any", base_color);
            Material { metallic, roughness, ior, specular, specular_color, ..grey }.brdf(base_color)
        },
    )
}

/// glTF's and the presets' kind.
fn any_material() -> impl Strategy<Value = Brdf> {
    let lobe = (1.02_f32..4.1).prop_map(|index| Lobe::Dielectric { index });
    let exact = (material(), lobe).prop_map(|(brdf, lobe)| Brdf { lobe, ..brdf });
    prop_oneof![material(), exact]
}

/// A unit direction above the horizon of +z, down to the cosine `lowest`.
fn direction(lowest: f64) -> impl Strategy<Value = DVec3> {
    (lowest..=1.0, 0.0..TAU).prop_map(|(cos, angle)| polar(cos, angle))
}

fn polar(cos: f64, angle: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    DVec3::new(sin * angle.cos(), sin * angle.sin(), cos)
}

/// Reflected share of the light that arrives from `v`, by midpoint quadrature with so many steps in
/// the angle from the normal and around it.
fn albedo(brdf: &DBrdf, v: DVec3, [rows, columns]: [usize; 2]) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
        let u = (i as f64 + 0.5) / rows as f64;
        let angle = TAU * (j as f64 + 0.5) / columns as f64;
        // The Lambertian part over cos²: its density is constant.
        let l = polar(u.sqrt(), angle);
        let coupling = brdf.transmission(l.z) * brdf.transmission(v.z);
        sum += if brdf.has_specular() { brdf.diffuse * coupling } else { brdf.diffuse };
        // The specular part over micro-normals h with density D(h) n·h: tan²θ = α² u / (1 − u).
        let cos = ((1.0 - u) / (1.0 - u + brdf.alpha * brdf.alpha * u)).sqrt();
        let h = polar(cos, angle);
        let l = 2.0 * v.dot(h) * h - v;
        if l.z > 0.0 && v.dot(h) > 0.0 && brdf.has_specular() {
            let density = brdf.distribution(DVec3::Z, h) * h.z / (4.0 * v.dot(h));
            sum += brdf.specular(DVec3::Z, v, l) * l.z / density;
        }
    }
    sum / (rows * columns) as f64
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Single precision: products of about ten roundings at the condition of the lobe's peak, which
    /// the next test bounds.
    #[test]
    fn reciprocal(brdf in any_material(), v in direction(1e-3), l in direction(1e-3)) {
        let double = DBrdf::from(brdf);
        let (there, back) = (double.eval(DVec3::Z, v, l), double.eval(DVec3::Z, l, v));
        prop_assert!(there.abs_diff_eq(back, 1e-12 * (1.0 + there.max_element())), "{there} {back}");
        let (v, l) = (v.as_vec3(), l.as_vec3());
        let (there, back) = (brdf.eval(Vec3::Z, v, l), brdf.eval(Vec3::Z, l, v));
        prop_assert!(there.abs_diff_eq(back, 1e-5 * (1.0 + there.max_element())), "{there} {back}");
    }

    /// The directions are rounded first: both forms see the same numbers.
    #[test]
    fn single_precision_agrees(brdf in any_material(), v in direction(1e-3), l in direction(1e-3)) {
        let (v, l) = (v.as_vec3(), l.as_vec3());
        let single = brdf.eval(Vec3::Z, v, l).as_dvec3();
        let double = DBrdf::from(brdf).eval(DVec3::Z, v.as_dvec3(), l.as_dvec3());
        prop_assert!(single.min_element() >= 0.0 && single.is_finite());
        let error = (single - double).abs().max_element();
        prop_assert!(error <= 1e-5 * double.max_element() + 1e-9, "{single} {double}");
    }

    /// No more than a fraction of the light comes back. The quadrature of smooth integrands with
    /// 96² points is good to 1e-3 (halving the steps changes it by less).
    #[test]
    fn reflects_no_more_than_it_receives(brdf in material(), v in direction(0.02)) {
        let albedo = albedo(&brdf.into(), v, [96, 96]);
        prop_assert!(albedo.min_element() >= 0.0);
        prop_assert!(albedo.max_element() <= 1.001, "{albedo}");
    }
}

/// f(v, l) as the papers print it: D of Walter et al. 2007, eq. 33; G₂ of Heitz 2014, eq. 99, by Λ of
/// eq. 72; Schlick 1994; and the coupling of the crate, with T = 1 − F in the largest channel.
fn by_the_papers(brdf: &DBrdf, f90: f64, v: DVec3, l: DVec3) -> DVec3 {
    let h = (v + l).normalize();
    let schlick = |c: f64| brdf.f0 + (DVec3::splat(f90) - brdf.f0) * (1.0 - c).powi(5);
    let a2 = brdf.alpha * brdf.alpha;
    let tan2 = |c: f64| (1.0 - c * c) / (c * c);
    let d = a2 / (std::f64::consts::PI * h.z.powi(4) * (a2 + tan2(h.z)).powi(2));
    let lambda = |c: f64| 0.5 * ((1.0 + a2 * tan2(c)).sqrt() - 1.0);
    let g2 = 1.0 / (1.0 + lambda(v.z) + lambda(l.z));
    let entering = |c: f64| 1.0 - schlick(c).max_element();
    let lambert = brdf.diffuse * (FRAC_1_PI * entering(l.z) * entering(v.z));
    lambert + schlick(v.dot(h)) * (d * g2 / (4.0 * v.z * l.z))
}

#[test]
fn the_lobes_are_those_of_the_papers() {
    for (alpha, f90) in [(0.04, 1.0), (0.3, 1.0), (1.0, 0.6)] {
        let lobe = Lobe::Schlick { f90: f90 as f32 };
        let (diffuse, f0) = (DVec3::new(0.7, 0.4, 0.1), DVec3::new(0.04, 0.3, 0.5));
        let brdf = DBrdf { diffuse, f0, lobe, alpha };
        for (v, l) in [(0.9, 0.8), (0.3, 0.6), (0.1, 0.95), (0.2, 0.15)] {
            for angle in [0.3, 2.0, 3.1] {
                let (v, l) = (polar(v, 0.0), polar(l, angle));
                let expected = by_the_papers(&brdf, f64::from(f90 as f32), v, l);
                let error = ((brdf.eval(DVec3::Z, v, l) - expected) / expected).abs();
                // tan² cancels near the normal.
                assert!(error.max_element() < 1e-11, "{alpha} {v} {l}: {error}");
            }
        }
    }
}

/// (roughness, albedo) of white GGX at normal view: the integral over θ of D G₂ / 4 · 2π sin θ with
/// h at θ/2, by SciPy 1.17 `integrate.quad` to 1e-10. At roughness 1 it is 1 − ln 2.
const WHITE_ALBEDO: [(f64, f64); 6] = [
    (0.1, 0.999_898_6),
    (0.3, 0.990_665_5),
    (0.5, 0.915_812_4),
    (0.7, 0.697_750_4),
    (0.9, 0.419_965_2),
    (1.0, 0.306_852_8),
];

/// The white furnace: single scattering loses the energy that it is known to lose, no more.
#[test]
fn white_metal_loses_the_known_energy() {
    for (roughness, expected) in WHITE_ALBEDO {
        let alpha = roughness * roughness;
        let lobe = Lobe::Schlick { f90: 1.0 };
        let white = DBrdf { diffuse: DVec3::ZERO, f0: DVec3::ONE, lobe, alpha };
        // The integrand does not depend on the angle around the normal.
        let found = albedo(&white, DVec3::Z, [100_000, 1]).x;
        assert!((found - expected).abs() < 1e-5, "roughness {roughness}: {found} {expected}");
    }
}

#[test]
fn lambert_reflects_its_albedo() {
    let brdf = DBrdf::lambert(DVec3::new(0.2, 0.5, 0.9));
    assert!(albedo(&brdf, polar(0.3, 1.0), [8, 8]).abs_diff_eq(brdf.diffuse, 1e-12));
    assert_eq!(brdf.eval(DVec3::Z, -DVec3::Z, DVec3::Z), brdf.diffuse * FRAC_1_PI);
    assert_eq!(brdf.eval(DVec3::Z, DVec3::Z, -DVec3::Z), DVec3::ZERO);
}

/// Reflectance by Snell's law and Fresnel's equations as textbooks have them.
fn snell(index: f64, cos: f64) -> f64 {
    let refracted = (1.0 - (1.0 - cos * cos) / (index * index)).sqrt();
    let across = (cos - index * refracted) / (cos + index * refracted);
    let along = (index * cos - refracted) / (index * cos + refracted);
    0.5 * (across * across + along * along)
}

fn normal_reflectance(index: f64) -> f64 {
    ((index - 1.0) / (index + 1.0)).powi(2)
}

#[test]
fn the_exact_fresnel_term_is_fresnels() {
    for index in [1.2, 1.5, 2.4, 4.02] {
        let exact = |cos| normal_reflectance(index) * DBrdf::relative_fresnel(index, cos);
        for step in 0..=100 {
            let cos = f64::from(step) / 100.0;
            // The textbook's differences cancel: they keep about 14 of 16 digits here.
            assert!((exact(cos) - snell(index, cos)).abs() < 1e-14, "{index} {cos}");
        }
        assert!((exact(0.0) - 1.0).abs() < 1e-15);
        assert!((DBrdf::relative_fresnel(index, 1.0) - 1.0).abs() < 1e-15);
        // At Brewster's angle, tan θ = n, only the wave across the plane is reflected.
        let brewster = 0.5 * ((index * index - 1.0) / (index * index + 1.0)).powi(2);
        assert!((exact(1.0 / (1.0 + index * index).sqrt()) / brewster - 1.0).abs() < 1e-14);
        // At 45° the reflectance along the plane is the square of that across it.
        let g = (index * index - 0.5).sqrt();
        let across = ((g - 0.5_f64.sqrt()) / (g + 0.5_f64.sqrt())).powi(2);
        assert!((exact(0.5_f64.sqrt()) / (0.5 * across * (1.0 + across)) - 1.0).abs() < 1e-13);
    }
}

/// (n − 1, cosine, reflectance over that at normal incidence), from Fresnel's equations in Python's
/// `decimal` with 60 digits; n is 1 + 2⁻¹³ and the like, exact in single precision.
const THIN: [(f64, f64, f64); 4] = [
    (1.0 / 8192.0, 0.125, 3.9088209959680010e+3),
    (1.0 / 8192.0, 0.9375, 1.0189774440712944e+0),
    (1.0 / 1048576.0, 0.0625, 6.4994263071258530e+4),
    (1.0 / 64.0, 0.03125, 8.1652650245248875e+3),
];

/// Near n = 1 the textbook's form has lost all digits of f32; ours keeps them.
#[test]
fn thin_media_keep_their_digits() {
    for (excess, cos, expected) in THIN {
        let double = DBrdf::relative_fresnel(1.0 + excess, cos);
        assert!((double / expected - 1.0).abs() < 1e-14, "{excess} {cos}: {double} {expected}");
        let single = Brdf::relative_fresnel((1.0 + excess) as f32, cos as f32);
        // Ten roundings of 6e-8.
        assert!((f64::from(single) / expected - 1.0).abs() < 6e-7, "{excess} {cos}: {single}");
    }
}

#[test]
fn narrow_lobes_are_mirrors_of_glass() {
    for index in [1.05_f32, 1.5, 4.0] {
        let f0 = Vec3::splat(normal_reflectance(index.into()) as f32);
        let lobe = Lobe::Dielectric { index };
        for cos in [1.0, 0.5, 0.1] {
            let v = polar(cos, 0.4);
            let smooth = Brdf { diffuse: Vec3::ZERO, f0, lobe, alpha: 0.002 };
            let mirrored = albedo(&smooth.into(), v, [256, 256]).x;
            // A mirror but for F's curvature over the lobe: (ln F)'' < 150 for n = 1.05, times α².
            let exact = snell(index.into(), cos);
            assert!((mirrored / exact - 1.0).abs() < 5e-3, "{index} {cos}: {mirrored} {exact}");
        }
    }
}

/// Uncoupled lobes could reflect too much; the fits do not, but for the error of a fit: white-fabric,
/// the worst, where the grazing rise of n = 1.05 meets the Lambertian lobe.
#[test]
fn presets_reflect_no_more_than_they_receive() {
    for preset in &PRESETS {
        for cos in [1.0, 0.7, 0.3, 0.1] {
            let albedo = albedo(&preset.brdf().into(), polar(cos, 0.4), [256, 256]);
            println!("{} {cos}: {albedo}", preset.name);
            assert!(albedo.min_element() >= 0.0 && albedo.max_element() < 1.0, "{}", preset.name);
        }
    }
}

#[test]
fn presets_are_the_thesis_materials() {
    assert_eq!(PRESETS.len(), 21);
    assert!(PRESETS.is_sorted_by_key(|preset| preset.name));
    assert!(PRESETS.iter().all(|preset| preset.brdf().alpha >= MIN_ALPHA));
    // The near-mirror coats that MIN_ALPHA widens.
    let widened = PRESETS.iter().filter(|preset| preset.brdf().alpha == MIN_ALPHA);
    let expected = [
        "alumina-oxide",
        "aluminium",
        "blue-acrylic",
        "green-plastic",
        "red-specular-plastic",
        "white-marble",
        "yellow-phenolic",
    ];
    assert!(widened.map(|preset| preset.name).eq(expected));
    let gold = PRESETS.iter().find(|preset| preset.name == "gold-paint").expect("is one").brdf();
    // ks ((n − 1)/(n + 1))² of the table in the presets' source: 0.3566 (2.81/4.81)².
    assert!((gold.f0.x - 0.121_7).abs() < 1e-4, "{gold:?}");
    assert_eq!(Lobe::from_slot(gold.lobe.slot()), gold.lobe);
}
