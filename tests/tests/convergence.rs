//! Virtual point lights against the reference that they converge to.

use glam::Vec3;
use manylights_metrics::Errors;
use manylights_scene::Light;
use manylights_scene::Visibility;
use manylights_tests::Stage;
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;

/// Errors at these counts, and the noise floor of the reference.
fn errors<const N: usize>(
    stage: &Stage,
    visibility: Visibility,
    samples: u32,
    counts: [u32; N],
) -> ([Errors; N], f64) {
    let reference = stage.reference(visibility, samples);
    let errors = counts.map(|lights| {
        let image =
            stage.picture(&VirtualLights(Vpl), &[("lights", &lights.to_string())], visibility, 0);
        manylights_metrics::compare_linear(&image, &reference.image).expect("comparable")
    });
    (errors, reference.noise_floor)
}

/// On a Lambertian scene the error falls with the count, towards the reference whose last segment
/// ignores visibility.
///
/// Lights lie on a grid of spacing h ∝ count^(−1/2). Pixels within h of a light see its 1/d² instead
/// of the mean over its cell: a share ∝ h of those next to edges is wrong by as much as it is bright,
/// so the mean absolute error falls with h, to a quarter for 16 times the lights, until the noise of the
/// reference is left: of a normal one √(2/π) of its RMSE. The RMSE falls with h^(1/2) and is a matter of
/// chance: of parallel light and 1024 lights single pixels make it 0.010 to 0.026 in four seeds.
fn without_visibility(stage: &Stage) {
    let counts = [64, 1024, 16_384, 262_144];
    let (errors, floor) = errors(stage, Visibility::Ignored, 2048, counts);
    let errors = errors.map(|errors| errors.mae);
    println!("mean absolute errors {errors:?}, noise floor {floor}");
    for pair in errors[..3].windows(2) {
        assert!(pair[1] < 0.5 * pair[0], "{errors:?}");
    }
    assert!(errors[3] < floor, "{errors:?}, {floor}");
}

#[test]
fn spot_light() {
    without_visibility(&Stage::builtin("cornell", [48, 48]));
}

#[test]
fn parallel_light() {
    let mut scene = manylights_scene::load("cornell", None).expect("built in");
    // Through the open front.
    let direction = Vec3::new(0.3, -0.5, -1.0).normalize();
    scene.lights = vec![Light::Directional { direction, irradiance: Vec3::splat(3.0) }];
    without_visibility(&Stage::new(scene, [48, 48]));
}

/// The mean absolute error, since single pixels next to an edge make the RMSE of so few lights a matter
/// of chance.
#[test]
fn with_shadow_rays() {
    let stage = Stage::builtin("cornell", [48, 48]);
    let (errors, floor) = errors(&stage, Visibility::Traced, 1024, [16, 256, 4096]);
    let errors = errors.map(|errors| errors.mae);
    println!("mean absolute errors {errors:?}, noise floor {floor}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.5 * pair[0], "{errors:?}");
    }
}
