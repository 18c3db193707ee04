//! Lights at the vertices of a grid, read at receivers: the path of methods that interpolate, on the adapter and
//! in f64.

pub mod fields;

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_interpolation::{
    self as interpolation, Grid, Loops, Order, Pixels, ProjectionSettings, Reading, Scheme,
};
use manylights_polygonal_light as polygonal;
use manylights_reflectance::{Damping, Form, Materials, Tables};
use manylights_scene::AreaLight;
use manylights_spherical_light::{self as spherical, SphereLight};

use crate::GPU;

/// Every scheme.
pub const SCHEMES: [Scheme; 4] =
    [Scheme::Trilinear, Scheme::Taylor, Scheme::HermiteFlat, Scheme::Hermite];

/// What is known of lights.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// Spheres as spheres.
    Spheres(spherical::Settings),
    /// Triangles, exact or by spheres.
    Triangles(polygonal::Settings),
}

/// Receivers and who sees them.
pub struct Receivers {
    /// What is there.
    pub surfaces: Vec<SurfaceRecord>,
    /// From where.
    pub camera: Vec3,
}

impl Source {
    fn bands(&self) -> usize {
        match self {
            Self::Spheres(settings) => settings.bands,
            Self::Triangles(settings) => settings.bands,
        }
    }

    /// Radiances of receivers from a grid, and how many are outside of it.
    pub fn read(
        &self,
        grid: Grid<f32>,
        scheme: Scheme,
        lights: &[AreaLight],
        receivers: &Receivers,
    ) -> (Vec<DVec3>, u32) {
        let settings = self.reading(grid, scheme, receivers);
        let how = ProjectionSettings {
            gradients: scheme.reads_gradients(),
            loops: Loops::Forward,
            evaluation: Evaluation::Recurrence,
        };
        let projected = match self {
            Self::Spheres(own) => {
                let shader = spherical::linked_projection(own, how).expect("it links");
                interpolation::project(&GPU, grid, &shader, &spheres(lights))
            }
            Self::Triangles(own) => polygonal::project(&GPU, grid, own, how, lights),
        };
        let (coefficients, _) = projected.expect("a projection");
        let brdfs = receivers.surfaces.iter().map(SurfaceRecord::brdf);
        let materials = Materials::new(brdfs);
        let buffer = |name: &str, of: &[[f32; 2]]| GPU.storage(name, of).expect("it fits");
        let mut tables = Vec::new();
        if settings.kinds.specular {
            let shared = Tables::shared();
            let lobes = materials.lobe_records(shared, settings.bands, Form::Full, Damping::None);
            tables = vec![buffer("shapes", &materials.shape_records()), buffer("lobes", &lobes)];
        }
        let count = receivers.surfaces.len() as u32;
        let surfaces = GPU.storage("surfaces", &receivers.surfaces).expect("they fit");
        let results = GPU.zeroed("results", 16 * u64::from(count)).expect("they fit");
        let pixels = Pixels {
            surfaces: &surfaces,
            count,
            camera: receivers.camera,
            tables: &tables,
            results: &results,
        };
        let reading = Reading::new(&GPU, &settings, &coefficients.buffer, &pixels);
        let mut reading = reading.expect("kernels");
        reading.add().expect("a reading");
        let values: Vec<[f32; 4]> = GPU.read(&results).expect("radiances");
        let values = values.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b).as_dvec3()).collect();
        (values, reading.outside().expect("a count"))
    }

    /// The same in f64, from coefficients that are rounded as stored ones are.
    pub fn read_exactly(
        &self,
        grid: Grid<f32>,
        scheme: Scheme,
        lights: &[AreaLight],
        receivers: &Receivers,
    ) -> Vec<DVec3> {
        let settings = self.reading(grid, scheme, receivers);
        let coefficients = match self {
            Self::Spheres(own) => spherical::oracle::coefficients(&grid, &spheres(lights), own),
            Self::Triangles(own) => polygonal::oracle::coefficients(&grid, lights, own),
        };
        let stored: Vec<[f32; 4]> = if scheme.reads_gradients() {
            let all = coefficients.as_flattened().iter();
            all.map(|parts| parts.map(|value| value as f32)).collect()
        } else {
            let values = coefficients.iter().map(|of| of.map(|parts| parts[0] as f32));
            values.map(|[r, g, b]| [r, g, b, 0.0]).collect()
        };
        let camera = receivers.camera.as_dvec3();
        let read = |surface| interpolation::oracle::radiance(surface, camera, &settings, &stored);
        receivers.surfaces.iter().map(read).collect()
    }

    /// Radiances of receivers without a grid, in f64.
    pub fn truth(&self, lights: &[AreaLight], receivers: &Receivers) -> Vec<DVec3> {
        let camera = receivers.camera.as_dvec3();
        let of_spheres = spheres(lights);
        let truth = |surface: &SurfaceRecord| match self {
            Self::Spheres(own) => spherical::oracle::radiance(surface, camera, &of_spheres, own),
            Self::Triangles(own) => polygonal::oracle::radiance(surface, camera, lights, own),
        };
        receivers.surfaces.iter().map(truth).collect()
    }

    /// The same on the adapter.
    pub fn gather(&self, lights: &[AreaLight], receivers: &Receivers) -> Vec<DVec3> {
        let Receivers { surfaces, camera } = receivers;
        let found = match self {
            Self::Spheres(own) => spherical::gather(&GPU, surfaces, *camera, &spheres(lights), own),
            Self::Triangles(own) => polygonal::gather(&GPU, surfaces, *camera, lights, own),
        };
        let found = found.expect("a gather").into_iter();
        found.map(|radiance| Vec3::from(radiance).as_dvec3()).collect()
    }

    fn reading(
        &self,
        grid: Grid<f32>,
        scheme: Scheme,
        receivers: &Receivers,
    ) -> interpolation::Settings {
        let kinds = Materials::new(receivers.surfaces.iter().map(SurfaceRecord::brdf)).kinds();
        let (bands, order) = (self.bands(), Order::Sorted);
        interpolation::Settings {
            grid,
            scheme,
            bands,
            kinds,
            order,
            storage: interpolation::Storage::F32,
        }
    }
}

fn spheres(lights: &[AreaLight]) -> Vec<SphereLight> {
    lights.iter().filter_map(SphereLight::of).collect()
}
