//! How each method is measured.

use glam::{DVec3, Vec3};
use manylights_gpu::{Error, Gpu, SurfaceRecord};
use manylights_reflectance::Form;
use manylights_scene::Brdf;
use manylights_virtual_lights::{LitTexel, VirtualLight, VirtualSphere};
use manylights_vsgl::{Approximation, GaussianLight};
use {
    manylights_hvl as hvl, manylights_vpl as vpl, manylights_vsgl as vsgl, manylights_vsl as vsl,
};

use crate::Outcome;
use crate::families::Pair;

/// A method under test.
pub(crate) struct Subject {
    /// Name of the file.
    pub(crate) id: &'static str,
    /// Heading of the table.
    pub(crate) title: &'static str,
    /// What errors are relative to, and what the columns are.
    pub(crate) notes: &'static str,
    /// Names of the errors.
    pub(crate) columns: &'static [&'static str],
    /// The adapter against the oracle on one pair, seen by a camera.
    pub(crate) measure: fn(&Gpu, &Pair, Vec3) -> Outcome,
}

/// In order of the field.
pub(crate) const SUBJECTS: [Subject; 4] = [
    Subject {
        id: "vpl",
        title: "Virtual point lights",
        notes: "Errors are relative to the larger of the two; attenuated: by Yuksel's radius, the \
                extent of the light.",
        columns: &["points", "attenuated"],
        measure: measure_vpl,
    },
    Subject {
        id: "vsl",
        title: "Virtual spherical lights",
        notes: "Errors are relative to the larger of the two, with the same 25 cone samples: those of \
                the lobes may fall on either side of a cone's rim in f32 and f64, which says nothing \
                about precision. Non-finite values are counted over all three samplings.",
        columns: &["cone samples"],
        measure: measure_vsl,
    },
    Subject {
        id: "hvl",
        title: "Harmonics virtual lights",
        notes: "Errors are relative to the oracle's, or to what white Lambertian surfaces that face \
                each other would send if that is more: an expansion may cross zero, and what is left \
                on one plane or behind is rounding.",
        columns: &[
            "5 bands",
            "exact horizon",
            "20 bands",
            "zonal, 5",
            "zonal, 20",
            "emission in 3",
        ],
        measure: measure_hvl,
    },
    Subject {
        id: "vsgl",
        title: "Virtual spherical Gaussian lights",
        notes: "Lights are groups of 6² texels. Filter: power, variance and sharpness of the lobes, \
                relative. Gather: radiance under the adapter's lobes, relative to the larger of the \
                two, with filtered normals and by the thesis' products of Gaussians. Of lights below \
                the horizon next to nothing is left with the first, less than the error of erfc in \
                f32 (1.5e-7 of what a facing light gives). Views within 1e-6 of the horizon have a \
                cosine of one digit in f32.",
        columns: &["filter", "gather, filtered", "gather, thesis"],
        measure: measure_vsgl,
    },
];

/// The one pixel of a gather.
fn pixel(pixels: Result<Vec<[f32; 3]>, Error>) -> DVec3 {
    Vec3::from(pixels.expect("the adapter gathers one light")[0]).as_dvec3()
}

/// Adapter and oracle a column. Errors are relative to the larger of them or, where there is a `white`
/// surface, to the larger of that and the oracle's.
fn outcome(columns: impl IntoIterator<Item = [DVec3; 2]>, white: Option<f64>) -> Outcome {
    let mut outcome = Outcome { errors: Vec::new(), largest: 0.0, non_finite: 0 };
    for [value, truth] in columns {
        outcome.non_finite += usize::from(!value.is_finite());
        outcome.largest = outcome.largest.max(truth.max_element());
        let other = white.unwrap_or_else(|| value.abs().max_element());
        let scale = truth.abs().max_element().max(other);
        let difference = (value - truth).abs().max_element();
        outcome.errors.push(if difference == 0.0 { 0.0 } else { difference / scale });
    }
    outcome
}

fn measure_vpl(gpu: &Gpu, pair: &Pair, camera: Vec3) -> Outcome {
    let Pair { surface, light, extent } = pair;
    let columns = [None, Some(*extent)].map(|attenuation_radius| {
        let settings = vpl::Settings { attenuation_radius, ..vpl::Settings::default() };
        let pixels = vpl::gather(gpu, &[*surface], camera, &[*light], &settings);
        [pixel(pixels), vpl::oracle::radiance(surface, camera.as_dvec3(), &[*light], &settings)]
    });
    outcome(columns, None)
}

fn measure_vsl(gpu: &Gpu, pair: &Pair, camera: Vec3) -> Outcome {
    let Pair { surface, light, extent } = pair;
    let spheres = [VirtualSphere { light: *light, radius: *extent }];
    let settings =
        |sampling| vsl::Settings { directions: 25, sampling, ..vsl::Settings::default() };
    let value =
        |sampling| pixel(vsl::gather(gpu, &[*surface], camera, &spheres, &settings(sampling), 0));
    let cone = settings(vsl::Sampling::Cone);
    let truth = vsl::oracle::radiance(0, surface, camera.as_dvec3(), &spheres, &cone, 0);
    let mut outcome = outcome([[value(vsl::Sampling::Cone), truth]], None);
    let others = [vsl::Sampling::Brdf, vsl::Sampling::Both];
    outcome.non_finite += others.into_iter().filter(|&s| !value(s).is_finite()).count();
    outcome
}

fn measure_hvl(gpu: &Gpu, pair: &Pair, camera: Vec3) -> Outcome {
    let Pair { surface, light, extent } = pair;
    let spheres = [hvl::rounded(&VirtualSphere { light: *light, radius: *extent })];
    let plain = hvl::Settings::default();
    let zonal = hvl::Settings { form: Form::Zonal, ..plain };
    let columns = [
        plain,
        hvl::Settings { horizon: hvl::Horizon::Exact, ..plain },
        hvl::Settings { bands: 20, ..plain },
        zonal,
        hvl::Settings { bands: 20, ..zonal },
        hvl::Settings { emission_bands: 3, ..plain },
    ];
    let eye = camera.as_dvec3();
    let white = white(surface, &spheres[0], eye);
    let columns = columns.map(|settings| {
        let pixels = hvl::gather(gpu, &[*surface], camera, &spheres, &settings);
        [pixel(pixels), hvl::oracle::radiance(surface, eye, &spheres, &settings)]
    });
    outcome(columns, Some(white))
}

/// What a white Lambertian surface sends if it and the light, on such a surface, face each other: where they
/// do not, what is left may be rounding.
fn white(surface: &SurfaceRecord, sphere: &VirtualSphere, eye: DVec3) -> f64 {
    let brdf = Brdf::lambert(Vec3::ONE);
    let toward = sphere.light.position - surface.position;
    let toward = toward.try_normalize().unwrap_or(surface.normal);
    let surface = SurfaceRecord::new(surface.position, toward, brdf);
    let (geometric_normal, normal, incoming) = (-toward, -toward, -toward);
    let light = VirtualLight { geometric_normal, normal, incoming, brdf, ..sphere.light };
    let settings = hvl::Settings { form: Form::Zonal, ..hvl::Settings::default() };
    hvl::oracle::radiance(&surface, eye, &[VirtualSphere { light, ..*sphere }], &settings)
        .max_element()
}

fn measure_vsgl(gpu: &Gpu, pair: &Pair, camera: Vec3) -> Outcome {
    let (texels, surface) = (group(pair), &pair.surface);
    let light = vsgl::filter_group(gpu, &texels, Approximation::Filtered)
        .expect("the adapter filters 36 texels");
    let light = light.expect("the texels have flux");
    let columns = [Approximation::Filtered, Approximation::Thesis].map(|lobe| {
        let settings = vsgl::Settings { lobe, ..vsgl::Settings::default() };
        let pixels = vsgl::gather(gpu, &[*surface], camera, &[light], &settings);
        [pixel(pixels), vsgl::oracle::radiance(surface, camera.as_dvec3(), &[light], &settings)]
    });
    let mut outcome = outcome(columns, None);
    let GaussianLight { diffuse, specular, .. } = light;
    let truths = vsgl::oracle::filter(&texels, Approximation::Filtered);
    let lobes = [diffuse, specular].into_iter().zip(truths);
    let lobes = lobes.filter(|(_, truth)| truth.power != DVec3::ZERO);
    let filter: Vec<_> = lobes.flat_map(|(found, truth)| filter_errors(&found, &truth)).collect();
    outcome.non_finite += filter.iter().filter(|error| !error.is_finite()).count();
    outcome.errors.insert(0, filter.into_iter().fold(0.0, f64::max));
    outcome
}

/// A slightly curved square of 6² texels about the light; extent 0 puts all of them there.
fn group(pair: &Pair) -> Vec<(SurfaceRecord, LitTexel)> {
    let (light, extent) = (&pair.light, 2.0 * pair.extent);
    let (a, b) = light.normal.any_orthonormal_pair();
    let texels = (0..36).map(|i| {
        let [x, y] = [i % 6, i / 6].map(|i| (i as f32 + 0.5) / 6.0 - 0.5);
        let bent = (light.normal + 0.3 * x * a - 0.2 * y * b).normalize();
        let texel = LitTexel {
            flux: light.flux * Vec3::new(1.0, 1.0 + x, 1.0 - y) / 36.0,
            variance: (extent / 6.0).powi(2) / 12.0,
            incoming: (light.incoming + 0.1 * x * a).normalize(),
            padding0: 0.0,
            geometric_normal: bent,
            padding1: 0.0,
        };
        let place = light.position + extent * (x * a + y * b);
        (SurfaceRecord::new(place, bent, light.brdf), texel)
    });
    texels.collect()
}

/// Of power, sharpness and variance.
fn filter_errors(found: &vsgl::GaussianLobe, truth: &vsgl::oracle::DGaussianLobe) -> [f64; 3] {
    let relative = |found: f32, truth: f64| (f64::from(found) - truth).abs() / truth.abs();
    let power = (found.power.as_dvec3() - truth.power).length() / truth.power.length();
    let sharpness = relative(found.sharpness, truth.sharpness);
    // Extents below the last digit of the places have none left in f32 records.
    let digit = f64::from(f32::EPSILON) * truth.position.length();
    let variance = match truth.variance.sqrt() > 1e3 * digit {
        true => relative(found.variance, truth.variance),
        false => 0.0,
    };
    [power, sharpness, variance]
}
