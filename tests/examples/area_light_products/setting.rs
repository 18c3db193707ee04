//! What all tables have in common: the scene, and how a variant is timed.

use glam::Vec3;
use manylights_area_lights::AreaLights;
use manylights_gpu::SurfaceRecord;
use manylights_method::{Bake, Method, Parameters};
use manylights_scene::{AreaLight, Scene, Transport, Visibility};
use manylights_spherical_light::SphericalLights;
use manylights_tests::Stage;

pub(crate) const RESOLUTION: [u32; 2] = [160, 120];
pub(crate) const ROUNDS: usize = 5;
const DIRECT: Transport = Transport::Direct { visibility: Visibility::Ignored };
const METHOD: AreaLights<SphericalLights> = AreaLights(SphericalLights);

/// The built-in `trio`, glossy all over, under spheres of light.
pub(crate) fn scene(lights: u32) -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.lights.clear();
    for material in &mut scene.materials {
        if !material.brdf(material.base_color).has_specular() {
            (material.specular, material.roughness) = (1.0, 0.5);
        }
        material.roughness = material.roughness.max(0.3);
    }
    let sphere = |i: u32| {
        let (sin, cos) = (2.4 * i as f32).sin_cos();
        AreaLight::Sphere {
            center: Vec3::new(2.0 * cos, 2.0, 2.0 * sin),
            radius: 0.2,
            radiance: Vec3::splat(20.0 / lights as f32),
        }
    };
    scene.area_lights = (0..lights).map(sphere).collect();
    scene
}

/// The method with some parameters, its tables made.
pub(crate) struct Variant {
    bake: Box<dyn Bake>,
    parameters: Parameters,
}

impl Variant {
    pub(crate) fn new(stage: &Stage, texts: &[(&str, &str)]) -> Self {
        let texts = texts.iter().copied();
        let parameters = Parameters::new(METHOD.parameters(), texts).expect("in range");
        let baking = METHOD.baking().expect("tables");
        let bake = baking.bake(&stage.frame(DIRECT, 0), &parameters).expect("tables");
        Self { bake, parameters }
    }

    /// Seconds of the gather of one picture.
    fn measure(&self, stage: &Stage) -> f64 {
        let frame = stage.frame(DIRECT, 0);
        let mut run = self.bake.prepare(&frame, &self.parameters).expect("a run");
        while !run.step().expect("a step").finished() {}
        let times = run.pass_times();
        times.iter().find(|time| time.pass == "gather").expect("a gather").seconds
    }
}

/// Medians of interleaved rounds; the first compiles.
pub(crate) fn medians(variants: &[(&Stage, &Variant)]) -> Vec<f64> {
    let mut seconds = vec![Vec::new(); variants.len()];
    for _ in 0..=ROUNDS {
        for (seconds, (stage, variant)) in seconds.iter_mut().zip(variants) {
            seconds.push(variant.measure(stage));
        }
    }
    let median = |mut rounds: Vec<f64>| {
        rounds.remove(0);
        rounds.sort_by(f64::total_cmp);
        rounds[ROUNDS / 2]
    };
    seconds.into_iter().map(median).collect()
}

/// Pixels that show a surface.
pub(crate) fn shaded(stage: &Stage) -> f64 {
    let shaded = |surface: &&SurfaceRecord| surface.triangle != SurfaceRecord::NO_TRIANGLE;
    stage.surfaces().iter().filter(shaded).count() as f64
}
