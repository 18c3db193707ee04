//! What the tests of this package share: pictures by any method, and their references.

pub mod gridded;
pub mod page;
pub mod processors;

use std::sync::LazyLock;

use glam::Vec3;
use manylights_gpu::{Gpu, GpuFrame, SurfaceRecord};
use manylights_method::{Error, Frame, Method, Parameters, Run};
use manylights_metrics::RadianceImage;
use manylights_path_tracer::{Reference, Settings};
use manylights_scene::{AreaLight, Scene, Transport, Visibility};

/// The adapter. It keeps kernels, which take long to compile.
pub static GPU: LazyLock<Gpu> =
    LazyLock::new(|| Gpu::new(None).expect("an adapter: scripts/test installs one"));

/// The built-in `trio` under `count` spheres of light on a spiral around it in the place of its spot light,
/// the narrowest lobe widened to roughness 0.3: what methods on lights with a surface take.
pub fn under_spheres(count: u32) -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.name = format!("trio under {count} spheres");
    scene.lights.clear();
    for material in &mut scene.materials {
        material.roughness = material.roughness.max(0.3);
    }
    let sphere = |i: u32| {
        let turn = (i as f32 + 0.5) / count as f32;
        let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
        AreaLight::Sphere {
            center: Vec3::new(2.5 * cos, 0.5 + 2.0 * turn, 2.5 * sin),
            radius: 0.1 + 0.4 * turn,
            radiance: Vec3::new(1.0, 0.8, 0.5 + 0.5 * turn) * (20.0 / count as f32),
        }
    };
    scene.area_lights = (0..count).map(sphere).collect();
    scene
}

/// The same under triangles that face its middle, every other one from both sides.
pub fn under_triangles(count: u32) -> Scene {
    let mut scene = under_spheres(count);
    scene.name = format!("trio under {count} triangles");
    for (i, light) in scene.area_lights.iter_mut().enumerate() {
        let AreaLight::Sphere { center, radius, radiance } = *light else { continue };
        let (right, up) = center.normalize().any_orthonormal_pair();
        let corners = [right - up, -right - up, up].map(|corner| center + 1.5 * radius * corner);
        *light = AreaLight::Triangle { corners, radiance, two_sided: i % 2 == 1 };
    }
    scene
}

/// A scene on the adapter, seen by its first camera.
pub struct Stage {
    /// As loaded.
    pub scene: Scene,
    /// With its G-buffer.
    pub on_gpu: GpuFrame,
}

impl Stage {
    /// At this width and height.
    pub fn new(scene: Scene, resolution: [u32; 2]) -> Self {
        let on_gpu = GpuFrame::new(&GPU, &scene, &scene.cameras[0], resolution);
        Self { on_gpu: on_gpu.expect("the scene fits"), scene }
    }

    /// Of a built-in scene.
    pub fn builtin(name: &str, resolution: [u32; 2]) -> Self {
        Self::new(manylights_scene::load(name, None).expect("built in"), resolution)
    }

    /// The surfaces of all pixels.
    pub fn surfaces(&self) -> Vec<SurfaceRecord> {
        self.on_gpu.gpu().read(self.on_gpu.surfaces()).expect("a G-buffer")
    }

    /// One indirect bounce by a method with these parameters.
    pub fn picture(
        &self,
        method: &dyn Method,
        parameters: &[(&str, &str)],
        visibility: Visibility,
        seed: u64,
    ) -> RadianceImage {
        self.run(method, parameters, visibility, seed).resolve().expect("a picture")
    }

    /// The same, done but not read back.
    pub fn run(
        &self,
        method: &dyn Method,
        parameters: &[(&str, &str)],
        visibility: Visibility,
        seed: u64,
    ) -> Box<dyn Run + '_> {
        let transport = Transport::Indirect { bounces: 1, visibility };
        let run = self.prepare(method, parameters, transport, seed);
        let mut run = run.expect("the method renders the scene");
        while !run.step().expect("a step").finished() {}
        run
    }

    /// The same for any transport, not begun.
    ///
    /// # Errors
    /// Those of the method.
    pub fn prepare(
        &self,
        method: &dyn Method,
        parameters: &[(&str, &str)],
        transport: Transport,
        seed: u64,
    ) -> Result<Box<dyn Run + '_>, Error> {
        let parameters = Parameters::new(method.parameters(), parameters.iter().copied());
        method.prepare(&self.frame(transport, seed), &parameters.expect("in range"))
    }

    /// What a method is told of a picture.
    pub fn frame(&self, transport: Transport, seed: u64) -> Frame<'_> {
        Frame {
            scene: &self.scene,
            camera: &self.scene.cameras[0],
            resolution: self.on_gpu.resolution(),
            transport,
            seed,
            gpu: Some(&self.on_gpu),
        }
    }

    /// The same by tracing paths.
    pub fn reference(&self, visibility: Visibility, samples: u32) -> Reference {
        let transport = Transport::Indirect { bounces: 1, visibility };
        let resolution = self.on_gpu.resolution();
        let settings = Settings { transport, resolution, seed: 0, samples };
        let (scene, camera) = (&self.scene, &self.scene.cameras[0]);
        manylights_path_tracer::render(scene, camera, &settings, None, &mut |_| {})
            .expect("a reference")
    }
}
