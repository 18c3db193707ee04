//! A picture in the making: primary hits, exact parts, sums over slices.

use glam::Vec3;
use manylights_metrics::RadianceImage;
use manylights_scene::bvh::{Hit, Ray};
use manylights_scene::{Camera, Scene};
use manylights_scene::{Transport, Visibility};
use rayon::prelude::*;

use crate::Error;
use crate::sums::{self, Sums};
use manylights_paths::{SLICE, Sampler, Tracer};

/// Longest side and most pixels of a picture.
const MAX_SIDE: u32 = 1 << 16;
const MAX_PIXELS: u64 = 1 << 28;

/// One picture, slice by slice. Every pixel is a function of the seed and of its own index, and sums
/// are kept for each pixel: the result does not depend on the number of threads.
pub(crate) struct Picture<'a> {
    tracer: Tracer<'a>,
    camera: &'a Camera,
    resolution: [u32; 2],
    seed: u64,
    pixels: Vec<Pixel>,
    sums: Vec<Sums>,
    /// Samples of a slice.
    slice_samples: u32,
    slices: u32,
    rays: u64,
}

/// What is known of a pixel before sampling.
#[derive(Clone, Copy)]
struct Pixel {
    hit: Option<Hit>,
    exact: Vec3,
}

impl<'a> Picture<'a> {
    /// Traces the primary hits through the pixel centres and computes what needs no sampling. Slices
    /// have `slice_samples` samples, at most [`SLICE`].
    pub(crate) fn new(
        scene: &'a Scene,
        camera: &'a Camera,
        transport: Transport,
        resolution: [u32; 2],
        seed: u64,
        slice_samples: u32,
    ) -> Result<Self, Error> {
        assert!((1..=SLICE).contains(&slice_samples), "a slice is part of one Sobol net");
        check(scene, transport, resolution)?;
        let tracer = Tracer::new(scene, transport);
        let [width, height] = resolution;
        let traced: Vec<_> = (0..width * height)
            .into_par_iter()
            .map(|index| {
                let direction = camera.direction(index % width, index / width, resolution);
                let hit = tracer.closest(&Ray::new(camera.position, direction));
                let mut walk = tracer.walk(Sampler::new(seed, index, 0));
                let exact = hit.map_or(Vec3::ZERO, |hit| {
                    walk.exact(&tracer.primary(hit, direction), -direction)
                });
                (Pixel { hit, exact }, walk.rays + 1)
            })
            .collect();
        let rays = traced.iter().map(|(_, rays)| rays).sum();
        let pixels: Vec<_> = traced.into_iter().map(|(pixel, _)| pixel).collect();
        let sums = vec![Sums::default(); pixels.len()];
        let slices = 0;
        Ok(Self { tracer, camera, resolution, seed, pixels, sums, slice_samples, slices, rays })
    }

    /// Adds the next slice to every pixel.
    pub(crate) fn slice(&mut self) -> Result<(), Error> {
        let slice = self.slices;
        let this = &*self;
        let means: Vec<(Vec3, u64)> = if self.tracer.is_random() {
            (0..self.pixels.len() as u32)
                .into_par_iter()
                .map(|index| this.pixel_mean(index, slice))
                .collect()
        } else {
            vec![(Vec3::ZERO, 0); self.pixels.len()]
        };
        let width = self.resolution[0];
        for (index, &(mean, rays)) in (0..).zip(&means) {
            let value = self.pixels[index as usize].exact + mean;
            if !value.is_finite() {
                let (x, y, value) = (index % width, index / width, value.to_array());
                return Err(Error::NonFinite { x, y, slice, value });
            }
            self.sums[index as usize].add(slice, mean.to_array());
            self.rays += rays;
        }
        self.slices += 1;
        Ok(())
    }

    fn pixel_mean(&self, index: u32, slice: u32) -> (Vec3, u64) {
        let Some(hit) = self.pixels[index as usize].hit else { return (Vec3::ZERO, 0) };
        let width = self.resolution[0];
        let direction = self.camera.direction(index % width, index / width, self.resolution);
        let point = self.tracer.primary(hit, direction);
        let mut walk = self.tracer.walk(Sampler::new(self.seed, index, slice));
        let sum = walk.samples(&point, -direction, self.slice_samples);
        (sum / self.slice_samples as f32, walk.rays)
    }

    /// Slices that are done.
    pub(crate) fn slices(&self) -> u32 {
        self.slices
    }

    /// Rays traced by this object.
    pub(crate) fn rays(&self) -> u64 {
        self.rays
    }

    /// The sums so far, for the cache.
    pub(crate) fn sums(&self) -> &[Sums] {
        &self.sums
    }

    /// Goes on from sums of an earlier run with the same inputs.
    pub(crate) fn restore(&mut self, sums: Vec<Sums>, slices: u32) {
        assert_eq!(sums.len(), self.pixels.len(), "sums of another picture");
        (self.sums, self.slices) = (sums, slices);
    }

    /// The picture so far.
    pub(crate) fn image(&self) -> RadianceImage {
        self.with_exact(|sums| sums.mean(self.slices))
    }

    /// Even (0) or odd (1) slices alone.
    pub(crate) fn half(&self, half: usize) -> RadianceImage {
        self.with_exact(|sums| sums.half(half, self.slices))
    }

    /// Variance of the mean.
    pub(crate) fn variance(&self) -> RadianceImage {
        sums::image(self.resolution, self.sums.iter().map(|sums| sums.variance(self.slices)))
    }

    /// RMSE of the picture that its variance lets expect.
    pub(crate) fn noise_floor(&self) -> f64 {
        let sum: f64 = self.sums.iter().flat_map(|sums| sums.variance(self.slices)).sum();
        (sum / (3 * self.sums.len()) as f64).sqrt()
    }

    fn with_exact(&self, mean: impl Fn(&Sums) -> [f64; 3]) -> RadianceImage {
        let pixels = self.pixels.iter().zip(&self.sums).map(|(pixel, sums)| {
            let (exact, mean) = (pixel.exact.to_array(), mean(sums));
            std::array::from_fn(|c| f64::from(exact[c]) + mean[c])
        });
        sums::image(self.resolution, pixels)
    }
}

fn check(scene: &Scene, transport: Transport, [width, height]: [u32; 2]) -> Result<(), Error> {
    let sides = 1..=MAX_SIDE;
    let pixels = u64::from(width) * u64::from(height);
    if !sides.contains(&width) || !sides.contains(&height) || pixels > MAX_PIXELS {
        return Err(Error::Settings(format!(
            "resolution {width}x{height}: sides must be from 1 to {MAX_SIDE} with at most \
             {MAX_PIXELS} pixels"
        )));
    }
    match transport {
        Transport::Indirect { bounces: 0, .. } => {
            Err(Error::Settings("transport indirect-0: use indirect-1 or more".into()))
        }
        Transport::Indirect { bounces: 2.., visibility: Visibility::Ignored } => {
            Err(Error::Settings(format!(
                "transport {transport} with ignored visibility: only indirect-1 can ignore it"
            )))
        }
        Transport::Direct { .. } => Ok(()),
        _ if !scene.area_lights.is_empty() => Err(Error::Settings(format!(
            "transport {transport}: the scene has lights that are no surfaces of it, which shine \
             in transport direct alone"
        ))),
        Transport::DirectAndIndirect { .. } if scene.emissive_triangles().next().is_some() => {
            Err(Error::Settings(format!(
                "transport {transport} holds the exact direct light of point-like lights, and this \
                 scene has emissive triangles: use direct, indirect-1 or all"
            )))
        }
        _ => Ok(()),
    }
}
