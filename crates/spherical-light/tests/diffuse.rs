//! The Lambertian lobe of the thesis' products, against quadrature.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::common::{SETTINGS, dielectric, glossy, spiral, surface, view};
use glam::{DVec3, Vec3};
use manylights_harmonics::quadrature::sphere_nodes;
use manylights_harmonics::{Basis, count};
use manylights_scene::{Brdf, DBrdf};
use manylights_spherical_light::{CosineProduct, Diffuse, Product, Settings, SphereLight, oracle};

const MOST_BANDS: usize = 9;
/// Exact for two functions of so many bands under the cosine's and the layer's six degrees.
const NODES: usize = 12;
const HALVES: [[f64; 2]; 2] = [[-1.0, 0.0], [0.0, 1.0]];

static BASIS: LazyLock<Basis<f64>> = LazyLock::new(|| Basis::new(MOST_BANDS));

/// What an oracle adds for the Lambertian lobe, under the layer that the specular lobe makes.
fn diffuse_term(brdf: Brdf, view: DVec3, light: SphereLight, settings: &Settings) -> DVec3 {
    let of = |brdf| oracle::radiance(&surface(Vec3::ZERO, Vec3::Z, brdf), view, &[light], settings);
    of(brdf) - of(Brdf { diffuse: Vec3::ZERO, ..brdf })
}

/// Coefficients of a function that is smooth over each of these nodes' parts of the sphere.
fn project(
    bands: usize,
    nodes: impl IntoIterator<Item = (DVec3, f64)>,
    f: impl Fn(DVec3) -> f64,
) -> Vec<f64> {
    let (mut sums, mut y) = (vec![0.0; count(bands)], vec![0.0; count(MOST_BANDS)]);
    for (direction, weight) in nodes {
        BASIS.evaluate(direction.to_array(), &mut y);
        let value = weight * f(direction);
        sums.iter_mut().zip(&y).for_each(|(sum, y)| *sum += value * y);
    }
    sums
}

fn nodes(range: [f64; 2]) -> impl Iterator<Item = (DVec3, f64)> {
    sphere_nodes(NODES, range).into_iter().map(|(w, weight)| (DVec3::from(w), weight))
}

fn at(coefficients: &[f64], direction: DVec3) -> f64 {
    let mut y = vec![0.0; count(MOST_BANDS)];
    BASIS.evaluate(direction.to_array(), &mut y);
    coefficients.iter().zip(&y).map(|(a, b)| a * b).sum()
}

/// Harmonics of the cap that a light covers.
fn harmonics(light: &SphereLight, bands: usize) -> Vec<f64> {
    let center = light.center.as_dvec3();
    let (toward, distance) = (center.normalize(), center.length());
    let (a, b) = toward.any_orthonormal_pair();
    let cosine = (1.0 - (f64::from(light.radius) / distance).powi(2)).sqrt();
    let about = |(w, weight): (DVec3, f64)| (w.x * a + w.y * b + w.z * toward, weight);
    project(bands, nodes([cosine, 1.0]).map(about), |_| 1.0)
}

/// ∫ f over nodes.
fn integral(nodes: impl Iterator<Item = (DVec3, f64)>, f: impl Fn(DVec3) -> f64) -> f64 {
    nodes.map(|(w, weight)| weight * f(w)).sum()
}

/// ∫ of light, cosine and transmission. A product multiplies the light's bands with its own cosine, keeps as many
/// bands and lets them through the layer; three bands of the light meet the cosine under the layer.
fn by_quadrature(
    light: &[f64],
    transmission: impl Fn(f64) -> f64,
    product: CosineProduct,
    diffuse: Diffuse,
) -> f64 {
    let bands = light.len().isqrt();
    if diffuse == Diffuse::ThreeBands {
        return whole(&light[..count(3)], transmission);
    }
    let cosine = project(bands, nodes(HALVES[1]), |w| w.z);
    let cosine = |w: DVec3| match product {
        CosineProduct::General | CosineProduct::Folded => at(&cosine, w),
        CosineProduct::FoldedCut => at(&cosine[..count(3)], w),
        CosineProduct::Local | CosineProduct::Turned => w.z.max(0.0),
    };
    let both = || HALVES.into_iter().flat_map(nodes);
    let product = project(bands, both(), |w| at(light, w) * cosine(w));
    integral(both(), |w| at(&product, w) * transmission(w.z.abs()))
}

/// ∫ of the light under cosine and transmission.
fn whole(light: &[f64], transmission: impl Fn(f64) -> f64) -> f64 {
    integral(nodes(HALVES[1]), |w| at(light, w) * w.z * transmission(w.z))
}

#[test]
fn the_oracles_are_integrals() {
    const BANDS: usize = 5;
    let view = view(40.0);
    for brdf in [Brdf::lambert(Vec3::splat(0.7)), glossy(0.5), dielectric(0.5)] {
        let exact = DBrdf::from(brdf);
        for (toward, half_angle) in [(3, 0.2_f32), (17, 1.2), (28, 0.02)] {
            let toward = spiral(toward, 30, -0.5).as_vec3();
            let light = SphereLight::new(2.0 * toward, 2.0 * half_angle.sin(), Vec3::ONE);
            let of_light = harmonics(&light, BANDS);
            for product in CosineProduct::ALL {
                for diffuse in [Diffuse::Product, Diffuse::ThreeBands] {
                    let settings = Settings {
                        bands: BANDS,
                        product: Product::Cosine(product),
                        diffuse,
                        ..SETTINGS
                    };
                    let irradiance =
                        by_quadrature(&of_light, |c| exact.transmission(c), product, diffuse);
                    let truth = exact.diffuse * (exact.transmission(view.z) * irradiance / PI);
                    let value = diffuse_term(brdf, view, light, &settings);
                    let error = (value - truth).abs().max_element() / truth.abs().max_element();
                    println!("{product:?} {diffuse:?} {half_angle}: {error:.1e}");
                    let what = format!("{brdf:?} {product:?} {diffuse:?} {toward} {half_angle}");
                    assert!(error < 1e-10, "{what}: {value} for {truth}");
                }
            }
        }
    }
}

/// Of the layer's transmission a product keeps as many bands as the light has: the more, the nearer it is to the
/// integral, over the irradiance of the light overhead.
#[test]
fn bands_of_the_layer() {
    for (brdf, most) in
        [(Brdf::lambert(Vec3::ONE), [1e-12; 3]), (glossy(0.5), [0.025, 0.016, 0.009])]
    {
        let exact = DBrdf::from(brdf);
        let through = |c: f64| exact.transmission(c);
        let error = |bands, i| {
            let light = SphereLight::new(spiral(i, 60, -0.5).as_vec3(), 0.2, Vec3::ONE);
            let light = harmonics(&light, bands);
            let kept = by_quadrature(&light, through, CosineProduct::Local, Diffuse::Product);
            (kept - whole(&light, through)).abs() / (PI * 0.04)
        };
        let worst = [5, 7, 9].map(|bands| (0..60).map(|i| error(bands, i)).fold(0.0, f64::max));
        println!("{brdf:?}: {worst:?}");
        assert!(worst.iter().zip(most).all(|(&worst, most)| worst < most), "{brdf:?}: {worst:?}");
    }
}
