//! Virtual lights against a closed form: one bounce in a closed Lambertian sphere with a light at its
//! centre is ρ²I/(πR²) everywhere.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_hvl::Hvl;
use manylights_method::Method;
use manylights_scene::Brdf;
use manylights_scene::Visibility;
use manylights_scene::builtin::integrating_sphere::{ALBEDO, INTENSITY, RADIUS};
use manylights_tests::Stage;
use manylights_virtual_lights::{VirtualLights, scene_maps};
use manylights_vpl::Vpl;
use manylights_vsgl::oracle::DIFFUSE_SHARPNESS;
use manylights_vsgl::{GaussianLight, GaussianLobe, Settings, Vsgl, gaussian_lights, oracle};
use manylights_vsl::Vsl;

fn closed_form() -> f64 {
    f64::from(ALBEDO * ALBEDO * INTENSITY) / (PI * f64::from(RADIUS * RADIUS))
}

/// Pixels over the closed form, less 1, in order.
fn deviations(side: u32, method: &dyn Method, parameters: &[(&str, &str)]) -> Vec<f64> {
    let stage = Stage::builtin("integrating-sphere", [side, side]);
    let image = stage.picture(method, parameters, Visibility::Ignored, 0);
    let deviation = |pixel: &[f32; 3]| f64::from(pixel[1]) / closed_form() - 1.0;
    let mut deviations: Vec<_> = image.pixels.iter().map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    deviations
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Pixels beside a light see its 1/d² instead of the mean over its cell; most do not.
#[test]
fn points() {
    let found = deviations(64, &VirtualLights(Vpl), &[("lights", "4096")]);
    let median = found[found.len() / 2];
    println!("median {median:+.2e}, mean {:+.2e}", mean(&found));
    assert!(median.abs() < 0.01, "{median}");
}

/// Spheres darken concave surfaces: of the directions to a light at distance d, a share is below one
/// of the two horizons where d² < 2rR, which holds for a part ∝ r/R of the lights. So the bias is of
/// first order in r, −4/(3π) r/R, halves with four times the lights, and 2 % needs radii of R/20.
#[test]
fn spheres_by_samples() {
    let bias = |lights, sampling, radius| {
        let parameters =
            [("lights", lights), ("directions", "4"), ("sampling", sampling), ("radius", radius)];
        let bias = mean(&deviations(16, &VirtualLights(Vsl), &parameters));
        println!("{lights} lights, radius {radius}, sampling {sampling}: {bias:+.2e}");
        bias
    };
    let [coarse, fine] = ["2048", "32768"].map(|lights| bias(lights, "cone", "r2"));
    // Six maps of 19² cells: r/R by thesis 5.10 and 5.12.
    let angle = SQRT_2 * FRAC_PI_2 / 19.0;
    let expected = -4.0 / (3.0 * PI) * (angle + angle.powi(3) / 3.0);
    assert!((coarse / expected - 1.0).abs() < 0.15, "{coarse}, {expected}");
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse}, {fine}");
    for (sampling, radius) in
        [("cone", "neighbours"), ("cone", "r1"), ("brdf", "r2"), ("both", "r2")]
    {
        let bias = bias("32768", sampling, radius);
        assert!(bias.abs() < 0.02, "sampling {sampling}, radius {radius}: {bias}");
    }
    assert!(fine.abs() < 0.02, "{fine}");
}

/// By every rule of radii: few pixels are near enough to a sphere for its horizon.
#[test]
fn spheres_by_harmonics() {
    for radius in ["neighbours", "r1", "r2", "fixed"] {
        let scale = if radius == "fixed" { 0.02 * RADIUS } else { 1.0 }.to_string();
        let parameters = [("lights", "4096"), ("radius", radius), ("scale", &scale)];
        let found = deviations(32, &VirtualLights(Hvl), &parameters);
        let [low, median, high] = [5, 50, 95].map(|percent| found[found.len() * percent / 100]);
        println!("radius {radius}: 5 % {low:+.2e}, 50 % {median:+.2e}, 95 % {high:+.2e}");
        for value in [low, median, high, mean(&found)] {
            assert!(value.abs() < 0.02, "radius {radius}: {value}");
        }
    }
}

/// The closed form of the zonal one counts all of a sphere that is above the horizon, which on concave
/// surfaces is more than its centre's cosine says; the expansion of the full form and H clip it twice.
/// The excess falls with the radius: to 0.36 to 0.38 with 16 times the lights, a quarter of the radius.
#[test]
fn spheres_by_zonal_harmonics() {
    for radius in ["neighbours", "r1", "r2"] {
        let [few, many] = ["4096", "65536"].map(|lights| {
            let parameters = [("lights", lights), ("radius", radius), ("form", "zonal")];
            mean(&deviations(32, &VirtualLights(Hvl), &parameters))
        });
        println!("radius {radius}: {few:+.2e}, {many:+.2e}");
        assert!(many > 0.0 && many < 0.02, "radius {radius}: {many}");
        assert!((2.4..3.2).contains(&(few / many)), "radius {radius}: {few}, {many}");
    }
}

/// Mean of the picture over the closed form, less 1, of the adapter and of the oracle.
fn gaussian_bias(lights: u64, texels: u32) -> [f64; 2] {
    let stage = Stage::builtin("integrating-sphere", [12, 12]);
    let settings = Settings { lights, texels, ..Settings::default() };
    let parameters = [("lights", &*lights.to_string()), ("texels", &*texels.to_string())];
    let image = stage.picture(&VirtualLights(Vsgl), &parameters, Visibility::Ignored, 0);
    let maps = scene_maps(&stage.on_gpu, &stage.scene, settings.lights, 0).expect("maps");
    let (lights, _) =
        gaussian_lights(&stage.on_gpu, &stage.scene, &maps, &settings).expect("lights");
    let (surfaces, eye) = (stage.surfaces(), stage.scene.cameras[0].position.as_dvec3());
    let truth = surfaces.iter().map(|surface| oracle::radiance(surface, eye, &lights, &settings).y);
    let sums = [image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum(), truth.sum::<f64>()];
    let bias = sums.map(|sum: f64| sum / closed_form() / surfaces.len() as f64 - 1.0);
    println!("{} lights of {texels}² texels: {bias:+.4?}", lights.len());
    bias
}

/// Irradiance, in units of the exitance, that a plane covered by lights receives from itself: a Gaussian
/// of places is not flat, so half of each lies above the plane. Point lights give none.
fn self_illumination() -> f64 {
    let lobe = |position, power| GaussianLobe {
        position,
        // Squares of one metre.
        variance: 1.0 / 12.0,
        axis: Vec3::Y,
        sharpness: DIFFUSE_SHARPNESS as f32,
        power,
        padding: 0.0,
    };
    let light = |center| GaussianLight {
        diffuse: lobe(center, Vec3::ONE),
        specular: lobe(center, Vec3::ZERO),
        center,
        geometric_normal: Vec3::Y,
    };
    let row = |x| (-40..=40).map(move |z| Vec3::new(x as f32, 0.0, z as f32));
    let lights: Vec<_> = (-40..=40).flat_map(row).map(light).collect();
    let radiances = (0..36).map(|i| {
        let [x, z] = [i % 6, i / 6].map(|i| (i as f32 + 0.5) / 6.0 - 0.5);
        let surface = SurfaceRecord::new(Vec3::new(x, 0.0, z), Vec3::Y, Brdf::lambert(Vec3::ONE));
        oracle::radiance(&surface, DVec3::Y, &lights, &Settings::default()).y
    });
    radiances.sum::<f64>() / 36.0 * PI
}

/// Point lights in a sphere arrive with cos² over d², which is constant. Here the lobe G/∫G stands for
/// cos/π, and its mean over the sphere, 2∫₀¹ π G/∫G dc = 1/(1 + e^{−λ}), is the lobe's power in front of
/// its surface: the rest is lost, 9.2 %. What lights close by add along the surface does not vanish
/// either, since it depends on their number alone. So the bias stays with any number of lights.
#[test]
fn gaussians() {
    let lost = 1.0 / (1.0 + DIFFUSE_SHARPNESS.exp());
    let gained = self_illumination();
    let limit = gained - lost;
    println!("lost {lost:.4}, gained {gained:.4}");
    let biases = [(150, 4), (2400, 4), (9600, 1)].map(|(n, texels)| gaussian_bias(n, texels));
    for [adapter, oracle] in biases {
        assert!((adapter - oracle).abs() < 1e-5, "{adapter} {oracle}");
    }
    // Where the sphere bends away, at √(2Rs), lights close by end: as a share that falls with the fourth
    // root of their number.
    let [few, some, many] = biases.map(|[adapter, _]| (adapter - limit).abs());
    assert!(some < 0.5 * few && many < 0.75 * some && many < 0.02, "{biases:?} {limit}");
}
