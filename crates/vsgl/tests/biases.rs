//! How far a flat cell of texels is from the point lights that it stands for, by roughness and distance.

use std::f64::consts::TAU;

use crate::common::{GPU, SETTINGS, glossy, surface, texel};
use glam::{DMat3, DVec2, DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::Brdf;
use manylights_virtual_lights::{LitTexel, VirtualLight};
use manylights_vsgl::{Approximation, filter_group, oracle};

const POINTS: manylights_vpl::Settings =
    manylights_vpl::Settings { lights: 1, clamp: None, attenuation_radius: None };
const SIDE: u32 = 14;
const SAMPLES: u32 = 4096;

/// Lambertian without a roughness, else a white metal.
fn material(roughness: Option<f32>) -> Brdf {
    match roughness {
        None => Brdf::lambert(Vec3::ONE),
        Some(roughness) => Brdf { diffuse: Vec3::ZERO, f0: Vec3::ONE, ..glossy(roughness) },
    }
}

/// Texels of a square of one metre about the origin, lit at 30° to its normal z.
fn cell(brdf: Brdf) -> Vec<(SurfaceRecord, LitTexel)> {
    let place = |i: u32| (i as f32 + 0.5) / SIDE as f32 - 0.5;
    let incoming = Vec3::new(0.5, 0.0, 0.75_f32.sqrt());
    let texels = (0..SIDE * SIDE).map(|i| {
        let position = Vec3::new(place(i % SIDE), place(i / SIDE), 0.0);
        let (surface, mut lit) = texel(position, Vec3::Z, incoming, brdf);
        lit.variance = 1.0 / (12.0 * (SIDE * SIDE) as f32);
        (surface, lit)
    });
    texels.collect()
}

fn point((surface, lit): &(SurfaceRecord, LitTexel)) -> VirtualLight {
    VirtualLight {
        position: surface.position,
        geometric_normal: lit.geometric_normal,
        normal: surface.normal,
        incoming: lit.incoming,
        flux: lit.flux,
        brdf: surface.brdf(),
    }
}

/// In the frame of `axis`.
fn about(axis: DVec3, cosine: f64, turn: f64) -> DVec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let across = (1.0 - cosine * cosine).max(0.0).sqrt() * DVec2::from_angle(TAU * turn);
    DMat3::from_cols(x, y, axis) * across.extend(cosine)
}

/// What surfaces in front of the cell, of all orientations towards it, reflect in all directions, over
/// what they reflect of its texels, less 1.
fn bias(of_cell: Option<f32>, of_surface: Option<f32>, distance: f64) -> f64 {
    let texels = cell(material(of_cell));
    let light = filter_group(&GPU, &texels, Approximation::Filtered).expect("a filter");
    let light = [light.expect("a light")];
    let points: Vec<_> = texels.iter().map(point).collect();
    let (mut found, mut truth) = (0.0, 0.0);
    for sample in 1..=SAMPLES {
        // A Kronecker sequence by the powers of the root of x⁷ = x + 1.
        let [a, b, c, d, e, f] = [1, 2, 3, 4, 5, 6]
            .map(|k| (f64::from(sample) / 1.1127756842787055_f64.powi(k)).fract());
        let place = about(DVec3::Z, a, b);
        let normal = about(-place, c, d);
        // By the cosine, with which the radiance is power.
        let view = about(normal, e.sqrt(), f);
        let at = (distance * place).as_vec3();
        let receiver = surface(at, normal.as_vec3(), material(of_surface));
        let camera = at.as_dvec3() + view;
        found += oracle::radiance(&receiver, camera, &light, &SETTINGS).x;
        truth += manylights_vpl::oracle::radiance(&receiver, camera, &points, &POINTS).x;
    }
    found / truth - 1.0
}

/// What ../src/lib.rs states, of 65 536 samples. A change of the method shows.
#[test]
fn biases_of_a_flat_cell() {
    let distances = [0.5, 1.0, 2.0, 20.0];
    let table = [
        (None, None, [-0.41, -0.18, -0.11, -0.09]),
        (None, Some(0.8), [-0.46, -0.27, -0.22, -0.20]),
        (Some(0.3), None, [-0.33, -0.08, -0.02, 0.00]),
        (Some(0.3), Some(0.8), [-0.41, -0.19, -0.14, -0.12]),
        (Some(0.8), None, [-0.42, -0.19, -0.13, -0.10]),
        (Some(0.8), Some(0.8), [-0.46, -0.28, -0.23, -0.21]),
    ];
    for (of_cell, of_surface, stated) in table {
        let found = distances.map(|distance| bias(of_cell, of_surface, distance));
        println!("{of_cell:?} → {of_surface:?}: {found:+.3?}");
        for (found, stated) in found.into_iter().zip(stated) {
            // Fewer samples are off by as much.
            assert!(
                (found - stated).abs() < 0.03,
                "{of_cell:?} → {of_surface:?}: {found} {stated}"
            );
        }
    }
}
