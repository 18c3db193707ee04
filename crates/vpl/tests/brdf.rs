//! The reflectance in WGSL against the one in f64, through the gather itself.

use crate::tensor;
use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use manylights_gpu::{Gpu, SurfaceRecord};
use manylights_scene::{Brdf, Lobe, Measured};
use manylights_virtual_lights::VirtualLight;
use manylights_vpl::{Settings, gather, oracle};
use proptest::prelude::*;

static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

const SETTINGS: Settings = Settings { lights: 1, clamp: None, attenuation_radius: None };

fn light(position: Vec3, normal: Vec3, incoming: Vec3, brdf: Brdf) -> VirtualLight {
    let flux = Vec3::ONE;
    VirtualLight { position, geometric_normal: normal, normal, incoming, flux, brdf }
}

fn direction() -> impl Strategy<Value = Vec3> {
    (-1.0_f32..1.0, 0.0_f32..std::f32::consts::TAU).prop_map(|(z, phi)| {
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z)
    })
}

/// f0 starts at 0.02, below all real dielectrics: with f0 = 0 the lobe is Schlick's (1 − cos)⁵ alone,
/// which keeps no digits where it vanishes.
fn material() -> impl Strategy<Value = Brdf> {
    let lobe = prop_oneof![
        (0.1_f32..1.0).prop_map(|f90| Lobe::Schlick { f90 }),
        (1.05_f32..4.1).prop_map(|index| Lobe::Dielectric { index }),
    ];
    (0.0_f32..1.0, 0.02_f32..1.0, lobe, 0.1_f32..1.0).prop_map(|(diffuse, f0, lobe, roughness)| {
        let lobe = match lobe {
            Lobe::Schlick { f90 } => Lobe::Schlick { f90: f90.max(f0) },
            exact => exact,
        };
        let [diffuse, f0] = [diffuse, f0].map(Vec3::splat);
        Brdf { diffuse, f0, lobe, alpha: roughness * roughness }
    })
}

/// Relative to the oracle, for each pair of one light and one of many surfaces.
///
/// The bound is 1e-5 for lobes that do not amplify rounding: a direction's error of 1e-7 rad changes
/// D(h) by 4e-7/α, so narrower lobes are allowed 1e-6/α.
fn check(surfaces: &[SurfaceRecord], camera: Vec3, light: &VirtualLight, narrowest: f32) {
    let bound = f64::from((1e-6 / narrowest).max(1e-5));
    for (pixel, truth) in rendered(surfaces, camera, light) {
        let error = (pixel - truth).abs().max_element();
        assert!(error <= bound * truth.max_element(), "{pixel} is {truth} off by {error:e}");
    }
}

/// What the adapter and the oracle make of each surface.
fn rendered(surfaces: &[SurfaceRecord], camera: Vec3, light: &VirtualLight) -> Vec<(DVec3, DVec3)> {
    let lights = [*light];
    let pixels = gather(&GPU, surfaces, camera, &lights, &SETTINGS).expect("a gather");
    let truth = |surface| oracle::radiance(surface, camera.as_dvec3(), &lights, &SETTINGS);
    let pixels = pixels.into_iter().map(|pixel| Vec3::from(pixel).as_dvec3());
    pixels.zip(surfaces.iter().map(truth)).collect()
}

/// For tables: a pixel is off by `slope` times 1e-7 of itself, the error of an angle, and where a lobe
/// ends within a cell of the table, and digits with it, by no more than 1e-6 of the brightest.
fn check_table(surfaces: &[SurfaceRecord], camera: Vec3, light: &VirtualLight, slope: f64) {
    let pairs = rendered(surfaces, camera, light);
    let peak = pairs.iter().map(|(_, truth)| truth.max_element()).fold(0.0, f64::max);
    assert!(peak > 0.0);
    for (pixel, truth) in pairs {
        let error = (pixel - truth).abs().max_element();
        let bound = 1e-7 * slope * truth.max_element() + 1e-6 * peak;
        assert!(error <= bound, "{pixel} is {truth} off by {error:e}");
    }
}

/// Cosines of which f32 keeps five digits: below, rounding of the directions alone moves them by more.
fn well_above(cosine: f32) -> bool {
    cosine > 0.02
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn receivers_agree_with_the_oracle(
        brdf in material(),
        frames in prop::collection::vec((direction(), direction()), 512),
    ) {
        // The light shines up from the origin; receivers stand around it.
        let camera = Vec3::new(0.3, 4.0, 0.2);
        let surfaces: Vec<_> = frames
            .into_iter()
            .filter(|(place, normal)| {
                let to_camera = (camera - *place).normalize();
                well_above(place.y) && well_above(normal.dot(-*place))
                    && well_above(normal.dot(to_camera))
            })
            .map(|(place, normal)| SurfaceRecord::new(place, normal, brdf))
            .collect();
        let light = light(Vec3::ZERO, Vec3::Y, Vec3::Y, Brdf::lambert(Vec3::ONE));
        check(&surfaces, camera, &light, brdf.alpha);
    }

    #[test]
    fn lights_agree_with_the_oracle(
        brdf in material(),
        incoming in direction(),
        places in prop::collection::vec(direction(), 512),
    ) {
        prop_assume!(well_above(incoming.y));
        let camera = Vec3::new(0.3, 4.0, 0.2);
        let surfaces: Vec<_> = places
            .into_iter()
            .filter(|place| well_above(place.y))
            .map(|place| SurfaceRecord::new(place, -place, Brdf::lambert(Vec3::ONE)))
            .collect();
        let light = light(Vec3::ZERO, Vec3::Y, incoming, brdf);
        check(&surfaces, camera, &light, brdf.alpha);
    }
}

fn white_metal(alpha: f32) -> Brdf {
    Brdf { diffuse: Vec3::ZERO, f0: Vec3::ONE, lobe: Lobe::Schlick { f90: 1.0 }, alpha }
}

/// The frames of receivers and lights, as the properties above draw them; `slope` is the largest
/// relative change of the table over an angle.
fn measured_agrees(brdf: Brdf, slope: f64) {
    let golden = std::f32::consts::TAU * 0.618_034;
    let directions: Vec<_> = (0..2048)
        .map(|index| {
            let z = (index as f32 + 0.5) / 1024.0 - 1.0;
            let (r, phi) = ((1.0 - z * z).sqrt(), index as f32 * golden % 6.3);
            Vec3::new(r * phi.cos(), z, r * phi.sin())
        })
        .collect();
    let camera = Vec3::new(0.3, 4.0, 0.2);
    // Normals wander against the places.
    let frames = directions.iter().zip(directions.iter().cycle().skip(701).step_by(7));
    let surfaces: Vec<_> = frames
        .filter(|(place, normal)| {
            let to_camera = (camera - **place).normalize();
            well_above(place.y)
                && well_above(normal.dot(-**place))
                && well_above(normal.dot(to_camera))
        })
        .map(|(&place, &normal)| SurfaceRecord::new(place, normal, brdf))
        .collect();
    assert!(surfaces.len() > 150);
    let lambert = light(Vec3::ZERO, Vec3::Y, Vec3::Y, Brdf::lambert(Vec3::ONE));
    check_table(&surfaces, camera, &lambert, slope);

    let above = directions.iter().filter(|place| well_above(place.y));
    let surfaces: Vec<_> =
        above.map(|&place| SurfaceRecord::new(place, -place, Brdf::lambert(Vec3::ONE))).collect();
    for incoming in [Vec3::new(0.1, 1.0, 0.2), Vec3::new(-1.0, 0.4, 0.3)] {
        let light = light(Vec3::ZERO, Vec3::Y, incoming.normalize(), brdf);
        check_table(&surfaces, camera, &light, slope);
    }
}

#[test]
fn measurements_agree_with_the_oracle() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("satin.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    measured_agrees(Measured::load(&path).expect("valid").brdf(), 100.0);
}

/// 128 columns over √(2θ/π), of which D may change by its half in one, some more in its tail.
#[test]
#[ignore = "needs MANYLIGHTS_ASSETS"]
fn real_measurements_agree_with_the_oracle() {
    let folder = std::env::var_os("MANYLIGHTS_ASSETS").expect("MANYLIGHTS_ASSETS is set");
    for name in ["paper_white", "vch_golden_yellow"] {
        let file = format!("brdf/rgl/{name}_rgb.bsdf");
        let measured = Measured::load(&std::path::Path::new(&folder).join(file));
        measured_agrees(measured.expect("a measurement").brdf(), 1000.0);
    }
}

/// 180 cells over the azimuth, whose values differ by less than a hundredth here.
#[test]
fn merl_tables_agree_with_the_oracle() {
    let value = |index: usize| 400.0 + 30.0 * ((index % 180) as f64 / 9.0).sin();
    // Over θ_d fast, over θ_h slowly.
    let row =
        |row: i32| 20.0 * (f64::from(row % 90) / 20.0).cos() + 15.0 * f64::from(row / 90) / 90.0;
    let rows = (0..90 * 90).map(row);
    let plane: Vec<f64> = rows.flat_map(|row| (0..180).map(move |p| row + value(p))).collect();
    let planes = [1.0, 2.0, 3.0].map(|scale| plane.iter().map(move |x| (scale * x).to_le_bytes()));
    let mut bytes: Vec<u8> = [90_u32, 90, 180].iter().flat_map(|n| n.to_le_bytes()).collect();
    bytes.extend(planes.into_iter().flatten().flatten());
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("waves.binary");
    std::fs::write(&path, bytes).expect("can write");
    measured_agrees(Measured::load(&path).expect("valid").brdf(), 100.0);
}

/// Albedo of a perfectly reflecting GGX surface seen at `view`, by midpoint quadrature in f64.
fn albedo(brdf: &Brdf, view: DVec3) -> f64 {
    let (rings, sectors) = (2000, 1000);
    let truth = manylights_scene::DBrdf::from(*brdf);
    let mut sum = 0.0;
    for ring in 0..rings {
        for sector in 0..sectors {
            // Uniform in cos²: the weight is the cosine itself.
            let cos2 = (f64::from(ring) + 0.5) / f64::from(rings);
            let phi = (f64::from(sector) + 0.5) / f64::from(sectors) * std::f64::consts::TAU;
            let sin = (1.0 - cos2).sqrt();
            let l = DVec3::new(sin * phi.cos(), cos2.sqrt(), sin * phi.sin());
            sum += truth.eval(DVec3::Y, view, l).x;
        }
    }
    sum * std::f64::consts::PI / f64::from(rings * sectors)
}

/// A closed sphere of unit radiance around one surface, made of 65 536 lights of equal solid angle.
fn furnace(brdf: &Brdf, view: Vec3) -> f32 {
    let count = 65_536;
    let golden = std::f32::consts::TAU * 0.618_034;
    let radiance_to_flux = 2.0 * std::f32::consts::PI / count as f32 * std::f32::consts::PI;
    let lights: Vec<_> = (0..count)
        .map(|index| {
            let y = (index as f32 + 0.5) / count as f32;
            let r = (1.0 - y * y).sqrt();
            let phi = index as f32 * golden % std::f32::consts::TAU;
            let place = Vec3::new(r * phi.cos(), y, r * phi.sin());
            let flux = Vec3::splat(radiance_to_flux);
            VirtualLight { flux, ..light(place, -place, -place, Brdf::lambert(Vec3::ONE)) }
        })
        .collect();
    let surfaces = [SurfaceRecord::new(Vec3::ZERO, Vec3::Y, *brdf)];
    gather(&GPU, &surfaces, view, &lights, &SETTINGS).expect("a gather")[0][0]
}

#[test]
fn white_furnace_in_wgsl_loses_what_single_scattering_loses() {
    for roughness in [0.5_f32, 0.8, 1.0] {
        for cosine in [0.3_f32, 0.7, 1.0] {
            let brdf = white_metal(roughness * roughness);
            let view = Vec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0);
            let truth = albedo(&brdf, view.as_dvec3());
            let measured = f64::from(furnace(&brdf, view));
            println!("roughness {roughness} cosine {cosine}: {measured:.4}, known {truth:.4}");
            assert!(truth < 1.0);
            // 65 536 directions resolve these lobes to 0.2 %.
            assert!((measured / truth - 1.0).abs() < 2e-3);
        }
    }
}

#[test]
fn the_quadrature_knows_the_closed_form() {
    // α = 1, f0 = 1, normal incidence: D = 1/π, V = 1/(2(1 + μ)), so the albedo is
    // ∫ μ/(1 + μ) dμ over [0, 1] = 1 − ln 2.
    let brdf = white_metal(1.0);
    let closed = 1.0 - std::f64::consts::LN_2;
    assert!((albedo(&brdf, DVec3::Y) - closed).abs() < 1e-6);
}
