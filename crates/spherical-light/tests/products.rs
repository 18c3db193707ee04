//! The thesis' ways from coefficients to radiance (4.1), beside the full lobe.

use crate::common::{
    DIRECT, GPU, SETTINGS, dielectric, glossy, metal, mirror_like, oblique, render, scene, view,
};
use crate::gather::{receivers, sphere, worst};
use crate::tensor;
use glam::Vec3;
use manylights_harmonics::clamped_cosine::Local;
use manylights_harmonics::{Basis, count, even_count, even_index, index};
use manylights_reflectance::lobes::LobeTable;
use manylights_reflectance::{
    CosineProduct, Damping, Diffuse, Fixed, LobeQuadrature, ReceiverKinds,
};
use manylights_scene::{Brdf, Measured};
use manylights_spherical_light::{Product, Settings, gather, linked_shader, oracle};

fn settings(product: CosineProduct, bands: usize) -> Settings {
    Settings { bands, product: Product::Cosine(product), ..SETTINGS }
}

/// On a Lambertian surface, under a layer, on metal and under the exact Fresnel term.
#[test]
fn every_product_on_the_adapter() {
    let brdfs = [Brdf::lambert(Vec3::splat(0.7)), glossy(0.4), metal(0.3), dielectric(0.5)];
    for product in CosineProduct::ALL {
        let both = [Diffuse::Product, Diffuse::ThreeBands];
        // Adapters take 20 s to compile a general product of 9 bands.
        let cases = [(3, &brdfs[..], &both[..]), (5, &brdfs, &both), (9, &brdfs[1..2], &both[..1])];
        for (bands, brdfs, diffuse) in cases {
            for (brdf, &diffuse) in brdfs.iter().flat_map(|b| diffuse.iter().map(move |d| (b, d))) {
                let settings = Settings { diffuse, ..settings(product, bands) };
                let worst = worst(*brdf, &[sphere(0.15), sphere(0.6)], &settings);
                assert!(worst < 1e-5, "{brdf:?}, {settings:?}: {worst:e}");
            }
        }
    }
}

/// A lobe a channel, about the mirror direction as well.
#[test]
fn measured_materials() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("synthetic.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    let satin = Measured::load(&path).expect("valid").brdf();
    for product in [CosineProduct::General, CosineProduct::Local] {
        let settings = settings(product, 4);
        let worst = worst(satin, &[sphere(0.15), sphere(0.6)], &settings);
        assert!(worst < 1e-5, "{settings:?}: {worst:e}");
    }
}

/// Fewer bands than the cosine's three, and as many as 4.6 serves.
#[test]
fn few_and_many_bands() {
    for product in CosineProduct::ALL {
        for bands in [1, 2, 15] {
            if bands <= product.most_bands() {
                let settings = settings(product, bands);
                let worst = worst(metal(0.4), &[sphere(0.15), sphere(0.6)], &settings);
                assert!(worst < 1e-5, "{settings:?}: {worst:e}");
            }
        }
    }
}

/// Thesis 4.4 with the cosine itself: the irradiance of 4.6 is Σ A_l c_l P_l, which `full` sums.
#[test]
fn diffuse_from_specular_is_the_sum_over_bands() {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let surfaces = receivers(Brdf::lambert(Vec3::splat(0.7)), camera);
    for bands in [3, 5, 9] {
        let of = |product| {
            let settings = Settings { bands, product, ..SETTINGS };
            gather(&GPU, &surfaces, camera, &[sphere(0.3)], &settings).expect("a gather")
        };
        let truth = of(Product::Full);
        let peak = truth.as_flattened().iter().fold(0.0_f32, |peak, value| peak.max(value.abs()));
        for product in [CosineProduct::Local, CosineProduct::Turned] {
            let found = of(Product::Cosine(product));
            let pairs = found.as_flattened().iter().zip(truth.as_flattened());
            let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) / peak;
            assert!(worst <= 1e-6, "{product:?}, {bands} bands: {worst:e}");
        }
    }
}

/// Those that hold the same cosine agree; three bands of it are another one.
#[test]
fn oracles_of_the_same_cosine_agree() {
    let camera = oblique(Vec3::new(0.3, 7.0, 0.2));
    let lights = [sphere(0.15), sphere(0.6)];
    let (mut apart, mut peak) = (0.0_f64, 0.0_f64);
    for surface in &receivers(glossy(0.5), camera)[..40] {
        let of =
            |product| oracle::radiance(surface, camera.as_dvec3(), &lights, &settings(product, 6));
        let [general, folded, cut, local, turned] = CosineProduct::ALL.map(of);
        assert!((general - folded).abs().max_element() < 1e-12 * general.abs().max_element());
        assert!((local - turned).abs().max_element() < 1e-12 * local.abs().max_element());
        apart = apart.max((general - cut).abs().max_element());
        peak = peak.max(general.abs().max_element());
    }
    assert!(apart > 1e-3 * peak, "{apart:e} of {peak:e}");
}

/// A light of 5 bands under the cosine, against the lobe without it (all of it, not a circular one) in more and
/// more bands: what the product misses of the cosine-weighted lobe, which is the limit.
#[test]
fn the_product_tends_to_the_full_lobe() {
    const LIGHT: usize = 5;
    for (roughness, degrees, published) in [
        (0.3_f32, 30_usize, [0.20, 0.012, 0.004, 4e-4]),
        (0.5, 60, [0.15, 0.006, 0.003, 6e-4]),
        (1.0, 60, [0.13, 0.013, 0.005, 1e-3]),
    ] {
        let brdf = mirror_like(roughness);
        let quadrature = LobeQuadrature::new(brdf.into(), [96, 96], Fixed::View);
        let table = LobeTable::of(brdf, LIGHT, Damping::None);
        let limit = &table.values()[degrees * even_count(LIGHT)..][..even_count(LIGHT)];
        let limit: Vec<_> = limit.iter().map(|[a, b]| a + b).collect();
        let norm = limit.iter().map(|value| value * value).sum::<f64>().sqrt();
        let found = [5, 7, 9, 15].map(|bands: usize| {
            let basis = Basis::new(bands);
            let (mut lobe, mut y) = (vec![0.0; count(bands)], vec![0.0; count(bands)]);
            for (direction, [a, b, _]) in quadrature.reflected(view(degrees as f64)) {
                basis.evaluate(direction.to_array(), &mut y);
                for (sum, y) in lobe.iter_mut().zip(&y) {
                    *sum += (a + b) * y;
                }
            }
            let mut product = vec![0.0; count(bands)];
            Local::new(bands).apply(&lobe, &mut product);
            let mut missed = 0.0;
            for l in 0..LIGHT {
                for m in 0..=l {
                    let difference = product[index(l, m as isize)] - limit[even_index(l, m)];
                    missed += difference * difference;
                }
            }
            missed.sqrt() / norm
        });
        println!("{roughness}, {degrees}°: {found:.4?}");
        for (found, published) in found.into_iter().zip(published) {
            assert!((found / published - 1.0_f64).abs() < 0.3, "{found} for {published}");
        }
    }
}

#[test]
fn shaders_hold_what_a_scene_needs() {
    let specular = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let kinds = [
        ReceiverKinds::default(),
        specular,
        ReceiverKinds { colored: true, exact_fresnel: true, ..specular },
        ReceiverKinds { colored: true, measured: true, ..specular },
    ];
    for product in CosineProduct::ALL {
        for (kinds, diffuse) in kinds
            .into_iter()
            .flat_map(|kinds| [(kinds, Diffuse::Product), (kinds, Diffuse::ThreeBands)])
        {
            let settings = Settings { diffuse, ..settings(product, 3) };
            let shader = linked_shader(kinds, &settings).expect("links");
            shader.compile(&GPU).map(|_| ()).expect("valid WGSL");
            if !kinds.specular {
                for word in ["shapes", "glossy", "schlick", "smith", "lobe"] {
                    assert!(!shader.wgsl.contains(word), "`{word}` in the Lambertian shader");
                }
            }
        }
    }
}

/// The counts of figure 4.2: each way takes fewer than the one before, the cosine itself fewest.
#[test]
fn operations_fall_from_the_general_product_to_the_local_one() {
    for bands in [4, 5, 6, 7, 8, 9] {
        let of = |product: CosineProduct| {
            let operations = product.operations(bands);
            operations.additions + operations.multiplications
        };
        let [general, folded, cut, local, turned] = CosineProduct::ALL.map(of);
        println!("{bands} bands: {general} {folded} {cut} {local} {turned}");
        assert!(general > folded && folded > cut && cut > turned && turned > local);
    }
}

#[test]
fn long_products_are_declined() {
    let scene = scene(1);
    let refused = render(&scene, [4, 4], &[("product", "4.5"), ("bands", "10")], DIRECT);
    let Err(reason) = refused.map(|_| ()) else { panic!("4.5 took 10 bands") };
    let reason = reason.to_string();
    assert!(reason.contains("bands=9") && reason.contains("product=4.6"), "{reason}");
    let (image, _) =
        render(&scene, [4, 4], &[("product", "4.6"), ("bands", "10")], DIRECT).expect("a picture");
    assert!(image.pixels.as_flattened().iter().any(|&value| value > 0.0));
}
