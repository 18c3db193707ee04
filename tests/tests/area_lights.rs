//! Methods on lights with a surface beside the path-traced reference.

use manylights_area_lights::AreaLights;
use manylights_path_tracer::{Settings, render};
use manylights_scene::{Transport, Visibility};
use manylights_spherical_light::SphericalLights;
use manylights_tests::{Stage, under_spheres};

/// Of `bands`, over the reference's: root of the mean squared difference, of radiance.
fn error(bands: &str) -> f64 {
    let resolution = [48, 36];
    let mut scene = under_spheres(5);
    // Rough enough that fifteen bands hold every lobe to a per cent.
    for material in &mut scene.materials {
        material.roughness = material.roughness.max(0.6);
    }
    let stage = Stage::new(scene, resolution);
    let transport = Transport::Direct { visibility: Visibility::Ignored };
    let parameters = [("bands", bands)];
    let method = AreaLights(SphericalLights);
    let mut run = stage.prepare(&method, &parameters, transport, 0).expect("a run");
    while !run.step().expect("a step").finished() {}
    let found = run.resolve().expect("a picture");
    let settings = Settings { transport, resolution, seed: 1, samples: 1024 };
    let camera = &stage.scene.cameras[0];
    let truth = render(&stage.scene, camera, &settings, None, &mut |_| {}).expect("a reference");
    let sum = |of: &dyn Fn(usize, usize) -> f64| -> f64 {
        (0..truth.image.pixels.len())
            .flat_map(|i| (0..3).map(move |c| (i, c)))
            .map(|(i, c)| of(i, c))
            .sum()
    };
    let squares = sum(&|i, c| f64::from(truth.image.pixels[i][c]).powi(2));
    let errors = sum(&|i, c| f64::from(found.pixels[i][c] - truth.image.pixels[i][c]).powi(2));
    let floor = truth.noise_floor * ((3 * truth.image.pixels.len()) as f64 / squares).sqrt();
    let error = (errors / squares).sqrt();
    println!("{bands} bands: {error:.2e}, noise of the reference {floor:.1e}");
    assert!(floor < 0.5 * error, "the reference is too noisy to tell");
    error
}

/// With more bands a picture of rough surfaces nears the reference.
#[test]
fn spherical_lights_near_the_reference_with_their_bands() {
    let errors = ["3", "7", "15"].map(error);
    println!("{errors:?}");
    assert!(errors[1] < 0.5 * errors[0] && errors[2] < 0.5 * errors[1], "{errors:?}");
    assert!(errors[2] < 0.01, "{errors:?}");
}
