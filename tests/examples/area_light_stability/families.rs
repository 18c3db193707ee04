//! Paths of receivers past lights, in metres; all receivers have the normal y, lights lie about the origin.

use glam::{Quat, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::{AreaLight, Brdf, Lobe};

const STEPS: u32 = 400;

/// Receivers in turn, under lights.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    lights: Vec<AreaLight>,
    places: Vec<Vec3>,
    /// Radius of a sphere, size of a polygon: nearer than this, lights are taken to cover all.
    extent: f32,
    /// Of a scene's length.
    unit: f32,
    /// Whether the places are a path, on which the truth is continuous or has the steps of the light.
    pub(crate) is_path: bool,
}

impl Family {
    pub(crate) fn new(
        name: &'static str,
        (lights, extent): (Vec<AreaLight>, f32),
        places: Vec<Vec3>,
    ) -> Self {
        Self { name, lights, places, extent, unit: 1.0, is_path: true }
    }

    pub(crate) fn scaled(self, unit: f32) -> Self {
        Self { unit, ..self }
    }

    pub(crate) fn scattered(self) -> Self {
        Self { is_path: false, ..self }
    }

    pub(crate) fn surfaces(&self, brdf: Brdf) -> impl Iterator<Item = SurfaceRecord> {
        let place = move |&place| oblique(self.unit * place);
        self.places.iter().map(move |at| SurfaceRecord::new(place(at), oblique(Vec3::Y), brdf))
    }

    pub(crate) fn camera(&self) -> Vec3 {
        oblique(1e3 * self.unit * Vec3::new(0.6, 1.0, -0.2))
    }

    pub(crate) fn lights(&self) -> Vec<AreaLight> {
        let place = |at: Vec3| oblique(self.unit * at);
        let placed = |light: &AreaLight| match *light {
            AreaLight::Sphere { center, radius, radiance } => {
                AreaLight::Sphere { center: place(center), radius: self.unit * radius, radiance }
            }
            AreaLight::Triangle { corners, radiance, two_sided } => {
                AreaLight::Triangle { corners: corners.map(place), radiance, two_sided }
            }
        };
        self.lights.iter().map(placed).collect()
    }

    /// What lights cover of the hemisphere, about, at each place: the measure of radiances.
    pub(crate) fn covered(&self) -> impl Iterator<Item = f64> {
        let extent = f64::from(self.extent);
        self.places
            .iter()
            .map(move |place| (extent / place.as_dvec3().length().max(extent)).powi(2))
    }
}

/// A frame in which no coordinate is exact.
fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

fn parts() -> impl Iterator<Item = f32> {
    (0..STEPS).map(|i| i as f32 / (STEPS - 1) as f32)
}

pub(crate) fn line(from: Vec3, to: Vec3) -> Vec<Vec3> {
    parts().map(|t| from.lerp(to, t)).collect()
}

/// From `origin` towards a direction, between powers of ten.
pub(crate) fn decades(origin: Vec3, toward: Vec3, [from, to]: [f32; 2]) -> Vec<Vec3> {
    let toward = toward.normalize();
    parts().map(|t| origin + toward * 10_f32.powf(from + t * (to - from))).collect()
}

/// So far below a light, beside it.
pub(crate) fn beside(height: f32) -> Vec3 {
    Vec3::new(0.6, height, 0.1)
}

/// Downwards from a light.
pub(crate) const DOWN: Vec3 = Vec3::new(0.3, -0.9, 0.2);

pub(crate) fn spheres() -> Vec<Family> {
    let family = |name, radius, places| {
        let light = AreaLight::Sphere { center: Vec3::ZERO, radius, radiance: Vec3::ONE };
        Family::new(name, (vec![light], radius), places)
    };
    let sinking = |name| family(name, 0.3, line(beside(-0.8), beside(0.8)));
    let around = |powers| decades(Vec3::ZERO, DOWN, powers);
    let down = DOWN.normalize();
    vec![
        family("far light, 1 to 1e6 of its radius", 1.0, around([0.0, 6.0])),
        family("tiny light at 1 m, as a point of 1e-7 m", 1e-7, line(beside(-0.8), beside(-0.1))),
        family("from outside to the centre", 0.5, line(DOWN, Vec3::ZERO)),
        family("near the centre, down to 1e-12 m", 0.5, around([-12.0, -1.0])),
        // The direction to the centre turns about within a rounding.
        family("at the centre and around it by 1e-20 m", 0.5, around([-30.0, -20.0])).scattered(),
        family(
            "across the surface of the sphere, 1e-4 of the radius",
            1.0,
            line(0.9999 * down, 1.0001 * down),
        ),
        sinking("sinking through the receiver's plane"),
        family(
            "half below the horizon, to where the point touches it",
            0.3,
            line(Vec3::new(3.0, 0.0, 0.1), Vec3::new(0.3, 0.0, 0.0)),
        ),
        family("wholly below the horizon", 0.1, line(beside(0.2), beside(0.9))),
        sinking("sinking, scene 1e-3 units large").scaled(1e-3),
        sinking("sinking, scene 1e4 units large").scaled(1e4),
    ]
}

/// Those of the kernel for Lambertian receivers, and those of the other one.
pub(crate) fn materials() -> [Vec<Brdf>; 2] {
    let glossy = |diffuse: f32, f0: f32, roughness: f32| Brdf {
        diffuse: Vec3::splat(diffuse),
        f0: Vec3::splat(f0),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    let lambert = Brdf::lambert(Vec3::splat(0.5));
    [vec![lambert], vec![glossy(0.5, 0.04, 1.0), glossy(0.0, 0.8, 0.3), glossy(0.0, 0.8, 0.1)]]
}
