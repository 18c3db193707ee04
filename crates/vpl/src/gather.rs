//! The gather: batches of lights over all pixels, in compute passes.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_gpu::{
    Binding, Buffer, Dispatch, GpuFrame, Kernel, Resource, UniformBatches, distribute, link,
};
use manylights_method::{Error, PassTime, Progress, Run};
use manylights_metrics::RadianceImage;
use manylights_scene::{Camera, Scene};

use crate::Settings;
use crate::light_record::{GlossyLight, LambertLight};

/// Lights a batch, as `shaders/gather.wesl` declares its arrays: below 64 KiB each.
const LAMBERT_CAPACITY: usize = 1024;
const GLOSSY_CAPACITY: usize = 480;

/// Pairs of light and pixel in one submission: about a second on a slow processor, far below any
/// watchdog on a fast one.
const PAIRS_A_STEP: u64 = 1 << 28;

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    camera: Vec3,
    pixels: u32,
    clamp: f32,
    radius2: f32,
    padding: [u32; 2],
}

/// Which lobes a kernel knows.
#[derive(Clone, Copy)]
struct Lobes {
    receivers: bool,
    lights: bool,
}

/// The pipelines for one scene and the picture so far.
pub(crate) struct Gather {
    view: Buffer,
    radiance: Buffer,
    from_lambert: Arc<Kernel>,
    /// For lights on glossy surfaces; absent where the scene has none.
    from_glossy: Option<Arc<Kernel>>,
}

/// The WGSL of every kernel that a scene needs: lights on Lambertian surfaces, then, where
/// `specular`, lights on glossy ones.
///
/// # Errors
/// Where the shader does not link.
pub fn linked_shaders(
    specular: bool,
    settings: &Settings,
) -> Result<Vec<String>, manylights_gpu::Error> {
    let lights: &[bool] = if specular { &[false, true] } else { &[false] };
    lights
        .iter()
        .map(|&lights| linked(Lobes { receivers: specular, lights }, settings))
        .collect()
}

fn linked(lobes: Lobes, settings: &Settings) -> Result<String, manylights_gpu::Error> {
    let features = [
        ("glossy_receivers", lobes.receivers),
        ("glossy_lights", lobes.lights),
        ("clamped", settings.clamp.is_some()),
        ("attenuated", settings.radius.is_some()),
    ];
    link("gather", include_str!("shaders/gather.wesl"), &features)
}

impl Gather {
    pub(crate) fn new(
        frame: &GpuFrame,
        camera: &Camera,
        specular: bool,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let gpu = frame.gpu();
        let [width, height] = frame.resolution();
        let pixels = width * height;
        let radius = settings.radius.unwrap_or(0.0);
        let view = View {
            camera: camera.position,
            pixels,
            clamp: settings.clamp.unwrap_or(0.0),
            radius2: radius * radius,
            padding: [0; 2],
        };
        let bindings =
            [Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
        let mut kernels = linked_shaders(specular, settings)?
            .into_iter()
            .map(|wgsl| gpu.kernel("gather", &wgsl, &bindings))
            .collect::<Result<Vec<_>, _>>()?
            .into_iter();
        Ok(Self {
            view: gpu.uniform("view", &view)?,
            radiance: gpu.zeroed("radiance", u64::from(pixels) * 16)?,
            from_lambert: kernels.next().expect("every scene has the Lambertian kernel"),
            from_glossy: kernels.next(),
        })
    }

    fn dispatch<'a>(
        &'a self,
        kernel: &'a Kernel,
        resources: &'a [Resource<'a>],
        pixels: u32,
    ) -> Dispatch<'a> {
        let groups = pixels.div_ceil(64);
        // Rows of at most 2¹⁵ groups: adapters guarantee 65 535 in each direction.
        let columns = groups.min(1 << 15);
        let workgroups = [columns, groups.div_ceil(columns), 1];
        Dispatch { pass: "gather", kernel, resources, workgroups }
    }
}

/// One picture in the making.
pub(crate) struct VplRun<'a> {
    scene: &'a Scene,
    frame: &'a GpuFrame,
    settings: Settings,
    seed: u64,
    gather: Gather,
    placed: Option<Placed>,
    times: Vec<PassTime>,
}

/// The lights on the adapter, Lambertian ones first, and how many batches are summed.
struct Placed {
    lambert: UniformBatches,
    glossy: UniformBatches,
    next: usize,
    done: u64,
    total: u64,
}

impl<'a> VplRun<'a> {
    pub(crate) fn new(
        scene: &'a Scene,
        frame: &'a GpuFrame,
        settings: Settings,
        seed: u64,
        gather: Gather,
    ) -> Self {
        Self { scene, frame, settings, seed, gather, placed: None, times: Vec::new() }
    }

    fn place(&mut self) -> Result<Placed, Error> {
        let gpu = self.frame.gpu();
        let (lights, times) =
            distribute(self.frame, self.scene, self.settings.lights, self.seed)?;
        self.add_times(&times, "distribute");
        let (glossy, lambert): (Vec<_>, Vec<_>) =
            lights.iter().partition(|light| light.brdf.has_specular());
        let lambert: Vec<_> = lambert.into_iter().map(LambertLight::new).collect();
        let glossy: Vec<_> = glossy.into_iter().map(GlossyLight::new).collect();
        Ok(Placed {
            lambert: UniformBatches::new(gpu, "lambert lights", &lambert, LAMBERT_CAPACITY)?,
            glossy: UniformBatches::new(gpu, "glossy lights", &glossy, GLOSSY_CAPACITY)?,
            next: 0,
            done: 0,
            total: lights.len() as u64,
        })
    }

    /// Adds adapter times under one pass name.
    fn add_times(&mut self, times: &[manylights_gpu::PassTime], pass: &'static str) {
        let seconds: f64 = times.iter().filter_map(|time| time.seconds).sum();
        match self.times.iter_mut().find(|time| time.pass == pass) {
            Some(time) => time.seconds += seconds,
            None => self.times.push(PassTime { pass, seconds }),
        }
    }
}

impl Placed {
    /// The batches not yet summed, with their kernels.
    fn pending<'k>(
        &'k self,
        gather: &'k Gather,
    ) -> impl Iterator<Item = (&'k Kernel, Resource<'k>, u32)> {
        let of = |kernel: Option<&'k Arc<Kernel>>, batches: &'k UniformBatches| {
            let counts = batches.counts().iter().enumerate();
            counts
                .filter(|&(_, &count)| count > 0)
                .filter_map(move |(index, &count)| {
                    Some((&**kernel?, Resource::Batch(batches, index), count))
                })
        };
        of(Some(&gather.from_lambert), &self.lambert)
            .chain(of(gather.from_glossy.as_ref(), &self.glossy))
            .skip(self.next)
    }
}

impl Run for VplRun<'_> {
    fn step(&mut self) -> Result<Progress, Error> {
        let mut placed = match self.placed.take() {
            Some(placed) => placed,
            None => self.place()?,
        };
        let [width, height] = self.frame.resolution();
        let pixels = width * height;
        let batches = (PAIRS_A_STEP / (u64::from(pixels) * LAMBERT_CAPACITY as u64)).max(1);
        let slice: Vec<_> = placed.pending(&self.gather).take(batches as usize).collect();
        let lights: u64 = slice.iter().map(|(.., count)| u64::from(*count)).sum();
        let advanced = slice.len();
        let resources: Vec<[Resource<'_>; 4]> = slice
            .iter()
            .map(|(_, batch, _)| {
                [
                    Resource::Buffer(&self.gather.view),
                    Resource::Buffer(self.frame.surfaces()),
                    *batch,
                    Resource::Buffer(&self.gather.radiance),
                ]
            })
            .collect();
        let dispatches: Vec<_> = slice
            .iter()
            .zip(&resources)
            .map(|((kernel, ..), resources)| self.gather.dispatch(kernel, resources, pixels))
            .collect();
        let times =
            if dispatches.is_empty() { Vec::new() } else { self.frame.gpu().run(&dispatches)? };
        placed.next += advanced;
        placed.done += lights;
        let progress = Progress { done: placed.done, total: placed.total };
        self.placed = Some(placed);
        self.add_times(&times, "gather");
        Ok(progress)
    }

    fn resolve(&mut self) -> Result<RadianceImage, Error> {
        let [width, height] = self.frame.resolution();
        let pixels: Vec<[f32; 4]> = self.frame.gpu().read(&self.gather.radiance)?;
        let pixels = pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect();
        Ok(RadianceImage { width, height, pixels })
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("lights", self.placed.as_ref().map_or(0, |placed| placed.done))]
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.times.clone()
    }
}
