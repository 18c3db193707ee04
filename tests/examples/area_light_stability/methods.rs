//! The methods for lights with a surface, and their parameters.

use manylights_ltc::{self as ltc, LightRecord};
use manylights_polygonal_light::{self as polygonal_light, Approximation, Edges, TriangleForm};
use manylights_scene::AreaLight;
use manylights_spherical_light::{
    self as spherical_light, Coefficients, CosineProduct, Extent, Product, SphereLight,
};
use manylights_tests::GPU;

use crate::measure::Column;

pub(crate) fn spherical() -> Vec<Column> {
    let full = spherical_light::Settings::default();
    let tabulated = spherical_light::Settings { coefficients: Coefficients::Tabulated, ..full };
    let product = |product, bands| spherical_light::Settings {
        bands,
        product: Product::Cosine(product),
        ..full
    };
    let column = |(name, settings)| Column {
        name,
        radiances: Box::new(move |surfaces, camera, lights| {
            let lights: Vec<_> = lights.iter().map(sphere).collect();
            let found = spherical_light::gather(&GPU, surfaces, camera, &lights, &settings);
            let truth = surfaces.iter().map(|surface| {
                spherical_light::oracle::radiance(surface, camera.as_dvec3(), &lights, &settings)
            });
            (found.expect("a gather"), truth.collect())
        }),
    };
    [
        ("sphere", full),
        ("tabulated", tabulated),
        ("disc", spherical_light::Settings { extent: Extent::Disc, ..full }),
        ("tabulated disc", spherical_light::Settings { extent: Extent::Disc, ..tabulated }),
        ("4.6", product(CosineProduct::Local, 9)),
        ("4.5", product(CosineProduct::Folded, 5)), // 9 bands take an adapter 20 s to compile
    ]
    .map(column)
    .into()
}

fn sphere(light: &AreaLight) -> SphereLight {
    let AreaLight::Sphere { center, radius, radiance } = *light else { panic!("a sphere") };
    SphereLight::new(center, radius, radiance)
}

pub(crate) fn polygonal() -> Vec<Column> {
    let column = |(name, approximation)| {
        let settings = polygonal_light::Settings { approximation, ..Default::default() };
        Column {
            name,
            radiances: Box::new(move |surfaces, camera, lights| {
                let found = polygonal_light::gather(&GPU, surfaces, camera, lights, &settings);
                let truth = surfaces.iter().map(|surface| {
                    polygonal_light::oracle::radiance(surface, camera.as_dvec3(), lights, &settings)
                });
                (found.expect("a gather"), truth.collect())
            }),
        }
    };
    [
        ("shared", Approximation::Exact(Edges::Shared)),
        ("own", Approximation::Exact(Edges::Own)),
        ("`sphere`", Approximation::Sphere(TriangleForm::Sphere)),
        ("`main`", Approximation::Sphere(TriangleForm::Main)),
        ("`solid-angle`", Approximation::Sphere(TriangleForm::SolidAngle)),
        ("`compromise`", Approximation::Sphere(TriangleForm::Compromise)),
        ("`compromise-root`", Approximation::Sphere(TriangleForm::CompromiseRoot)),
        ("`scaled`", Approximation::Sphere(TriangleForm::Scaled)),
        ("`point`", Approximation::Sphere(TriangleForm::Point)),
    ]
    .map(column)
    .into()
}

pub(crate) fn transformed() -> Vec<Column> {
    vec![Column {
        name: "difference",
        radiances: Box::new(|surfaces, camera, lights| {
            let lights: Vec<_> = lights.iter().map(LightRecord::new).collect();
            let found = ltc::gather(&GPU, surfaces, camera, &lights);
            let truth = surfaces
                .iter()
                .map(|surface| ltc::oracle::radiance(surface, camera.as_dvec3(), &lights));
            (found.expect("a gather"), truth.collect())
        }),
    }]
}
