use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;
use manylights_scene::presets::PRESETS;
use manylights_scene::{Brdf, DBrdf, Material, Measured};

use super::*;
use crate::sampler::{SLICE, Sampler};

fn point(brdf: Brdf) -> SurfacePoint {
    let normal = Vec3::new(0.3, -0.5, 0.8).normalize();
    let zero = Vec3::ZERO;
    SurfacePoint {
        position: zero,
        geometric_normal: normal,
        normal,
        triangle: 0,
        material: 0,
        brdf,
        emission: zero,
    }
}

fn brdfs() -> [Brdf; 8] {
    let color = Vec3::new(0.9, 0.5, 0.2);
    [
        Brdf::lambert(color),
        Material::glossy("a", color, 0.6).brdf(color),
        Material::glossy("b", color, 0.25).brdf(color),
        Material::metal("c", color, 1.0).brdf(color),
        Material::metal("d", color, 0.35).brdf(color),
        preset("gold-paint"),
        preset("red-fabric2"),
        measured(),
    ]
}

#[path = "../../../scene/tests/common/tensor.rs"]
mod tensor;

fn measured() -> Brdf {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("satin.bsdf");
    std::fs::write(&path, tensor::satin()).expect("can write");
    Measured::load(&path).expect("valid").brdf()
}

fn preset(name: &str) -> Brdf {
    PRESETS.iter().find(|preset| preset.name == name).expect("is one").brdf()
}

/// A unit direction at an angle from the normal.
fn around(normal: Vec3, cos: f64, angle: f64) -> Vec3 {
    let (x, y) = normal.any_orthonormal_pair();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    (sin * angle.cos()) as f32 * x + (sin * angle.sin()) as f32 * y + cos as f32 * normal
}

/// Calls `visit` with brdf, point and viewer for views from the normal to grazing.
fn for_each_view(mut visit: impl FnMut(&SurfacePoint, Vec3)) {
    for brdf in brdfs() {
        for cos_v in [0.98, 0.5, 0.1] {
            let point = point(brdf);
            visit(&point, around(point.normal, cos_v, 1.0));
        }
    }
}

/// Cells of equal solid angle over the whole sphere: visible normals mirror the viewer below the
/// horizon, too.
const ROWS: usize = 32;
const COLUMNS: usize = 32;

/// Probability of each cell, by midpoint quadrature of the density.
fn cell_probabilities(point: &SurfacePoint, lobes: &Lobes<'_>) -> Vec<f64> {
    const FINE: usize = 24;
    let mut cells = vec![0.0; ROWS * COLUMNS];
    let (rows, columns) = (ROWS * FINE, COLUMNS * FINE);
    let area = 2.0 * TAU / (rows * columns) as f64;
    for row in 0..rows {
        let cos = 1.0 - 2.0 * (row as f64 + 0.5) / rows as f64;
        for column in 0..columns {
            let angle = TAU * (column as f64 + 0.5) / columns as f64;
            let density = lobes.density(around(point.normal, cos, angle));
            cells[row / FINE * COLUMNS + column / FINE] += area * f64::from(density);
        }
    }
    cells
}

fn cell(normal: Vec3, direction: Vec3) -> usize {
    let (x, y) = normal.any_orthonormal_pair();
    let row = (1.0 - normal.dot(direction)) / 2.0 * ROWS as f32;
    let angle = y.dot(direction).atan2(x.dot(direction)).rem_euclid(std::f32::consts::TAU);
    let column = angle / std::f32::consts::TAU * COLUMNS as f32;
    (row as usize).min(ROWS - 1) * COLUMNS + (column as usize).min(COLUMNS - 1)
}

/// Draws directions without the cut-off of those that reflect nothing.
fn draw(lobes: &Lobes<'_>, [u, v]: [f32; 2]) -> Vec3 {
    if u < lobes.specular {
        lobes.visible_normal([u / lobes.specular, v])
    } else {
        cosine([(u - lobes.specular) / (1.0 - lobes.specular), v], lobes.point.normal)
    }
}

/// The density integrates to one (quadrature error: 1e-3 at the narrowest lobe), and samples fall
/// into cells as it says: Pearson's χ² of cells that expect five or more has mean n and variance 2n,
/// and stratified samples have less.
#[test]
fn samples_follow_the_density() {
    for_each_view(|point, to_viewer| {
        let lobes = Lobes::new(point, to_viewer);
        let expected = cell_probabilities(point, &lobes);
        let sum: f64 = expected.iter().sum();
        assert!((sum - 1.0).abs() < 2e-3, "density integrates to {sum}: {point:?}");

        let count = 200_000;
        let mut found = vec![0.0; expected.len()];
        for index in 0..count {
            // One point of each randomisation: independent samples.
            let [u, v] = Sampler::new(9, index, 0).group(0, index % SLICE);
            found[cell(point.normal, draw(&lobes, [u, v]))] += 1.0;
        }
        let count = f64::from(count);
        let cells = || std::iter::zip(&expected, &found).map(|(p, n)| (p * count, *n));
        let large = || cells().filter(|(expected, _)| *expected >= 5.0);
        let chi2: f64 = large().map(|(e, n)| (n - e) * (n - e) / e).sum();
        let degrees = large().count() as f64;
        let limit = degrees + 5.0 * (2.0 * degrees).sqrt();
        assert!(chi2 < limit, "χ² {chi2} of {degrees} cells: {point:?}");
        let rare: f64 = cells().filter(|(e, _)| *e < 5.0).map(|(e, n)| n - e).sum();
        assert!(rare.abs() < 0.005 * count, "{rare} samples where there should be none");
    });
}

/// f(v, l) n·l over the hemisphere, in double precision: the Lambertian part over l, the specular
/// part over micro-normals, where it is smooth.
fn albedo(brdf: DBrdf, normal: DVec3, v: DVec3) -> DVec3 {
    const STEPS: usize = 256;
    let (x, y) = normal.any_orthonormal_pair();
    let polar = |angle: f64, cos: f64| {
        (1.0 - cos * cos).max(0.0).sqrt() * (angle.cos() * x + angle.sin() * y) + cos * normal
    };
    let mut sum = DVec3::ZERO;
    for i in 0..STEPS {
        let u = (i as f64 + 0.5) / STEPS as f64;
        let cos_h = (u * FRAC_PI_2).cos();
        for j in 0..STEPS {
            let angle = TAU * (j as f64 + 0.5) / STEPS as f64;
            let l = polar(angle, u.sqrt());
            sum += (brdf.eval(normal, v, l) - brdf.specular(normal, v, l)) * std::f64::consts::PI;
            let h = polar(angle, cos_h);
            let l = 2.0 * v.dot(h) * h - v;
            // dl = 4 v·h dh, dh = sin θ dθ dφ, θ = u π/2
            let measure = 4.0 * v.dot(h).max(0.0) * (1.0 - cos_h * cos_h).sqrt() * FRAC_PI_2 * TAU;
            sum += brdf.specular(normal, v, l) * normal.dot(l).max(0.0) * measure;
        }
    }
    sum / (STEPS * STEPS) as f64
}

/// The white furnace, with everything that the sampler can get wrong in it: the mean weight is the
/// albedo, within five standard errors and the quadrature's 1e-3.
#[test]
fn mean_weights_are_the_albedo() {
    for_each_view(|point, to_viewer| {
        let lobes = Lobes::new(point, to_viewer);
        let expected = albedo(point.brdf.into(), point.normal.as_dvec3(), to_viewer.as_dvec3());
        let count = 100_000;
        let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
        for index in 0..count {
            let [u, v] = Sampler::new(4, index, 0).group(0, index % SLICE);
            let weight = lobes.sample([u, v]).map_or(Vec3::ZERO, |scatter| {
                assert!((scatter.direction.length() - 1.0).abs() < 1e-5);
                let density = lobes.density(scatter.direction);
                assert!((density / scatter.density - 1.0).abs() < 1e-5);
                scatter.weight
            });
            sum += weight.as_dvec3();
            squares += (weight * weight).as_dvec3();
        }
        let mean = sum / f64::from(count);
        let deviation =
            ((squares / f64::from(count) - mean * mean) / f64::from(count)).map(f64::sqrt);
        let error = (mean - expected).abs() - 5.0 * deviation;
        assert!(error.max_element() < 1e-3, "{mean} {expected} ± {deviation}: {point:?}");
    });
}

/// A viewer below the horizon of the shading normal (smooth shading of coarse meshes) sees the
/// Lambertian lobe alone, and that not through a coat, which transmits nothing at grazing view.
#[test]
fn viewers_below_the_horizon_get_the_cosine() {
    for brdf in brdfs() {
        let point = point(brdf);
        let lobes = Lobes::new(&point, around(point.normal, -0.2, 0.0));
        assert_eq!(lobes.specular, 0.0);
        match lobes.sample([0.3, 0.6]) {
            Some(scatter) => assert!(scatter.weight.is_finite() && scatter.density > 0.0),
            None => assert!(brdf.has_specular()),
        }
    }
}
