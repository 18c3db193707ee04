//! Lambert's irradiance of polygons, horizon included: the limit in bands.

use crate::common::{GPU, exact};
use crate::exact::{CAMERA, receivers};
use glam::Vec3;
use manylights_paths::closed_form::polygon_irradiance;
use manylights_polygonal_light::{Edges, Settings, gather};
use manylights_scene::{AreaLight, Brdf};

/// Root of the mean squared difference to the closed form over receivers all around, relative to the largest
/// irradiance.
fn missed(corners: [Vec3; 3], distance: f32, bands: usize) -> f64 {
    let surfaces = receivers(Brdf::lambert(Vec3::ONE), distance, 600);
    let light = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
    let settings = Settings { bands, ..exact(Edges::Own) };
    let pixels = gather(&GPU, &surfaces, CAMERA, &[light], &settings).expect("a gather");
    let truth = |surface: &manylights_gpu::SurfaceRecord| {
        let seen = corners.map(|corner| (corner - surface.position).as_dvec3().to_array());
        polygon_irradiance(surface.normal.as_dvec3().to_array(), &seen) / std::f64::consts::PI
    };
    let truths: Vec<_> = surfaces.iter().map(truth).collect();
    let peak = truths.iter().copied().fold(0.0, f64::max);
    let squares =
        pixels.iter().zip(&truths).map(|(pixel, truth)| (f64::from(pixel[0]) - truth).powi(2));
    (squares.sum::<f64>() / truths.len() as f64).sqrt() / peak
}

#[test]
fn bands_tend_to_lamberts_formula() {
    let corners = [[-0.4, 0.05, -0.3], [0.5, -0.02, -0.2], [0.02, 0.07, 0.5]].map(Vec3::from);
    for distance in [0.2, 0.5, 1.0, 5.0, 50.0] {
        let missed = [3, 5, 9, 15].map(|bands| missed(corners, distance, bands));
        println!("{distance}: {missed:?}");
        for (missed, most) in missed.into_iter().zip([0.05, 0.03, 0.012, 0.006]) {
            assert!(missed < most, "{distance}: {missed}");
        }
        assert!(missed.windows(2).all(|pair| pair[1] < pair[0]), "{distance}: {missed:?}");
    }
}
