//! Shadow rays from pixels to virtual lights: which lights of a batch a pixel does not see.
//!
//! One pass for all methods, before the gather, so that every method pays for the same rays and asks
//! for the same visibility: that of the light's centre (thesis 5.2.2).

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use manylights_scene::Scene;

use crate::occluders::Occluders;
use crate::{
    Binding, Buffer, Dispatch, Error, Gpu, GpuFrame, Kernel, Pass, Resource, UniformBatches, link,
    workgroups,
};

/// Most lights of a batch, as `shaders/shadow.wesl` declares its array: a bit each and pixel.
const MOST_LIGHTS: usize = 256;
/// Rays of a batch, where 32 lights have fewer: a software adapter on two cores casts 0.7 to 6.4 million
/// a second, pairs that face away included (`results/virtual-lights`), so 3 to 25 seconds.
const RAYS: usize = 1 << 24;
/// Lights in a word.
const WORD: usize = 32;

/// The point that stands for a virtual light in shadow tests.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Center {
    position: Vec3,
    padding0: f32,
    geometric_normal: Vec3,
    padding1: f32,
}

impl Center {
    /// A place, m, and the unit normal of its surface on the lit side.
    pub fn new(position: Vec3, geometric_normal: Vec3) -> Self {
        Self { position, geometric_normal, ..Self::zeroed() }
    }
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct View {
    pixels: u32,
    shift: f32,
    padding: [u32; 2],
}

/// The shadow pass for the pixels of one frame.
pub struct Shadows {
    gpu: Gpu,
    surfaces: Buffer,
    occluders: Arc<Occluders>,
    vertices: Buffer,
    triangles: Buffer,
    kernel: Arc<Kernel>,
    view: Buffer,
    occluded: Buffer,
    pixels: u32,
    lights_a_batch: usize,
}

impl Shadows {
    /// For the pixels of `frame`, which shows `scene`.
    ///
    /// # Errors
    /// Where the hierarchy exceeds what the adapter holds.
    pub fn new(frame: &GpuFrame, scene: &Scene) -> Result<Self, Error> {
        let gpu = frame.gpu();
        let occluders = frame.occluders(scene)?;
        let wgsl = linked_shader(occluders.stack)?;
        let mut bindings =
            vec![Binding::Uniform, Binding::Storage, Binding::Batch, Binding::StorageMut];
        bindings.extend([Binding::Storage; 4]);
        let [width, height] = frame.resolution();
        let pixels = width * height;
        let lights_a_batch = (RAYS / pixels as usize).clamp(WORD, MOST_LIGHTS) / WORD * WORD;
        let words = (lights_a_batch / WORD) as u64 * u64::from(pixels);
        let view = View { pixels, shift: occluders.shift, padding: [0; 2] };
        Ok(Self {
            gpu: gpu.clone(),
            surfaces: frame.surfaces().clone(),
            kernel: gpu.kernel("shadow", &wgsl, &bindings)?,
            view: gpu.uniform("view of shadows", &view)?,
            occluded: gpu.zeroed("occluded lights", 4 * words)?,
            vertices: frame.vertices().clone(),
            triangles: frame.triangles().clone(),
            occluders,
            pixels,
            lights_a_batch,
        })
    }

    /// Lights of which [`Shadows::occluded`] has a bit.
    pub fn lights_a_batch(&self) -> usize {
        self.lights_a_batch
    }

    /// Batches whose rays go into one submission.
    pub fn batches_a_submission(&self) -> usize {
        (RAYS / (self.pixels as usize * self.lights_a_batch)).max(1)
    }

    /// The layout that the shader declares for a batch of [`Center`]s.
    pub const CAPACITY: usize = MOST_LIGHTS;

    /// Whether each pixel does not see each light, at `light * pixels + pixel`: what the gathers read,
    /// for tests.
    ///
    /// # Errors
    /// Where the device gave up.
    pub fn occluded_lights(&self, centers: &[Center]) -> Result<Vec<bool>, Error> {
        let (gpu, most) = (&self.gpu, self.lights_a_batch);
        let batches = UniformBatches::new(gpu, "centres", centers, Self::CAPACITY, most)?;
        let pass = self.pass(&batches)?;
        let pixels = self.pixels as usize;
        let mut occluded = Vec::with_capacity(centers.len() * pixels);
        for (index, &count) in batches.counts().iter().enumerate() {
            gpu.run(&[self.dispatch(&pass, index)])?;
            let words: Vec<u32> = gpu.read(&self.occluded)?;
            for light in 0..count as usize {
                let words = &words[light / WORD * pixels..][..pixels];
                occluded.extend(words.iter().map(|word| word >> (light % WORD) & 1 == 1));
            }
        }
        Ok(occluded)
    }

    /// Bit i % 32 of word (i / 32) · pixels + pixel: whether the pixel does not see light i.
    pub fn occluded(&self) -> &Buffer {
        &self.occluded
    }

    /// The pass over batches of [`Center`]s.
    ///
    /// # Errors
    /// Where the adapter refuses.
    pub fn pass(&self, centers: &UniformBatches) -> Result<Pass, Error> {
        let Occluders { nodes, blocks, .. } = &*self.occluders;
        let [view, surfaces, occluded] =
            [&self.view, &self.surfaces, &self.occluded].map(Resource::Buffer);
        let [vertices, triangles, nodes, blocks] =
            [&self.vertices, &self.triangles, nodes, blocks].map(Resource::Buffer);
        let centers = Resource::Batches(centers);
        let resources = [view, surfaces, centers, occluded, vertices, triangles, nodes, blocks];
        self.gpu.pass("shadow", &self.kernel, &resources)
    }

    /// One batch of a [`Shadows::pass`].
    pub fn dispatch<'a>(&self, pass: &'a Pass, batch: usize) -> Dispatch<'a> {
        let [columns, rows, _] = workgroups(self.pixels, 64);
        let words = (self.lights_a_batch / WORD) as u32;
        pass.over_batch(batch, [columns, rows, words])
    }
}

/// The WGSL of the shadow pass for a hierarchy whose walk needs a stack of so many entries.
///
/// # Errors
/// Where the shader does not link.
pub(crate) fn linked_shader(stack: u32) -> Result<String, Error> {
    let hierarchy = format!("const STACK = {stack}u;\n");
    link("shadow", include_str!("shaders/shadow.wesl"), &[("hierarchy", &hierarchy)], &[])
}
