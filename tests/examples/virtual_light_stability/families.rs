//! The hard cases, alike for every method.

use glam::{Quat, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::{Brdf, Lobe};
use manylights_virtual_lights::VirtualLight;

/// A surface and a light; `extent` is the radius of a sphere, half the side of a cloud of texels.
pub(crate) struct Pair {
    pub(crate) surface: SurfaceRecord,
    pub(crate) light: VirtualLight,
    pub(crate) extent: f32,
}

/// Pairs of a kind, all seen by one camera.
pub(crate) struct Family {
    pub(crate) name: String,
    pub(crate) pairs: Vec<Pair>,
    pub(crate) camera: Vec3,
}

fn materials() -> Vec<(String, Brdf)> {
    let glossy = |roughness: f32| Brdf {
        diffuse: Vec3::splat(0.5),
        f0: Vec3::splat(0.04),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: roughness * roughness,
    };
    let widths = [1.0, 0.5, 0.3, 0.1, 0.03, 0.01];
    let glossy = widths.map(|roughness| (format!("GGX {roughness}"), glossy(roughness)));
    let lambert = ("Lambert".to_owned(), Brdf::lambert(Vec3::splat(0.5)));
    std::iter::once(lambert).chain(glossy).collect()
}

fn light(position: Vec3, normal: Vec3, brdf: Brdf) -> VirtualLight {
    let incoming = (normal + 0.5 * normal.any_orthonormal_vector()).normalize();
    VirtualLight { position, geometric_normal: normal, normal, incoming, flux: Vec3::ONE, brdf }
}

/// Lengths from `size` down to 1e-12 of it.
fn shrinking(size: f32) -> impl Iterator<Item = f32> {
    (0..=24).map(move |step| size * 10_f32.powf(-0.5 * step as f32))
}

/// An oblique frame, so that no coordinate is exact.
fn oblique(v: Vec3) -> Vec3 {
    Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * v
}

/// Of each material.
pub(crate) fn families() -> Vec<Family> {
    let mut families = Vec::new();
    for (material, brdf) in materials() {
        let all = [1e-3, 1.0, 1e4].into_iter().flat_map(|size| of_size(size, brdf));
        let all = all.chain([far_away(brdf), behind(brdf), grazing(brdf)]);
        families.extend(all.map(|family| {
            let name = format!("{}, {material}", family.name);
            Family { name, ..family }
        }));
    }
    families
}

/// A light that comes near, one that becomes a point, points that come near, one that the horizon cuts, one
/// on the plane of the surface.
fn of_size(size: f32, brdf: Brdf) -> [Family; 5] {
    let origin = size * Vec3::new(0.3, -0.2, 0.5);
    let camera = origin + size * oblique(Vec3::new(0.4, 1.0, 0.2));
    let up = oblique(Vec3::Y);
    let surface = SurfaceRecord::new(origin, up, brdf);
    let at = |offset: Vec3, extent| {
        let light = light(origin + oblique(offset), -up, brdf);
        Pair { surface, light, extent }
    };
    let beside = |d: f32| {
        let light = light(origin + oblique(d * Vec3::X), up, brdf);
        Pair { surface, light, extent: 0.1 * size }
    };
    let across = Vec3::new(0.3, 1.0, 0.1).normalize();
    let family = |name: &str, pair: &dyn Fn(f32) -> Pair| Family {
        name: format!("{name}, scene of {size:e}"),
        pairs: shrinking(size).map(pair).collect(),
        camera,
    };
    [
        family("distance → 0, into the light", &|d| at(d * across, 0.1 * size)),
        family("extent → 0", &|extent| at(size * across, extent)),
        family("points, distance → 0", &|d| at(d * across, 0.0)),
        family("light that touches the surface", &|d| {
            at(d * Vec3::new(1.0, 0.01, 0.0), 0.1 * size)
        }),
        family("on the same plane", &beside),
    ]
}

/// The same pair ever farther from the origin.
fn far_away(brdf: Brdf) -> Family {
    let up = oblique(Vec3::Y);
    let pair = |i| {
        let origin = 10_f32.powi(i) * Vec3::new(0.6, -0.5, 0.6);
        let light = light(origin + oblique(Vec3::new(0.4, 1.0, 0.2)), -up, brdf);
        Pair { surface: SurfaceRecord::new(origin, up, brdf), light, extent: 0.1 }
    };
    let name = "up to 1e4 from the origin".to_owned();
    Family { name, pairs: (0..=4).map(pair).collect(), camera: Vec3::new(3.0, 9.0, 2.0) }
}

/// Lights that face away, ever deeper below the horizon.
fn behind(brdf: Brdf) -> Family {
    let up = oblique(Vec3::Y);
    let pair = |i| {
        let away = oblique(Vec3::new(0.2, -0.1 * i as f32, 0.4));
        let surface = SurfaceRecord::new(Vec3::ZERO, up, brdf);
        Pair { surface, light: light(away, up, brdf), extent: 0.15 }
    };
    Family { name: "back faces".to_owned(), pairs: (1..20).map(pair).collect(), camera: up }
}

/// A surface that turns away from the camera, down to 1e-6 rad above its horizon.
fn grazing(brdf: Brdf) -> Family {
    let pair = |i| {
        let angle = 10_f32.powf(-0.5 * i as f32);
        let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
        Pair {
            surface: SurfaceRecord::new(Vec3::ZERO, normal, brdf),
            light: light(Vec3::new(1.0, 0.7, 0.3), -Vec3::X, brdf),
            extent: 0.15,
        }
    };
    let name = "grazing view".to_owned();
    Family { name, pairs: (1..=12).map(pair).collect(), camera: Vec3::Y }
}
