//! The adapter against the oracle.

use crate::common::{
    CAMERA, GPU, OUTSIDE, SCHEMES, coefficients, colored, dielectric, grey, lambertian, measured,
    on_adapter, settings, surfaces,
};
use glam::DVec3;
use manylights_gpu::SurfaceRecord;
use manylights_interpolation::{Pixels, Reading, Scheme, Settings, oracle};
use manylights_scene::Brdf;

fn plain<'a>(
    settings: &'a Settings,
    coefficients: &'a [[f32; 4]],
) -> impl Fn(&Pixels<'_>) -> u32 + 'a {
    move |pixels| {
        let on_gpu = GPU.storage("coefficients", coefficients).expect("it fits");
        let mut reading = Reading::new(&GPU, settings, &on_gpu, pixels).expect("a kernel");
        reading.add().expect("a run");
        reading.outside().expect("a count")
    }
}

/// Largest difference of the adapter from the oracle, over the largest radiance.
fn error(
    values: &[[f32; 4]],
    surfaces: &[SurfaceRecord],
    settings: &Settings,
    light: &[[f32; 4]],
) -> f64 {
    let camera = CAMERA.as_dvec3();
    let truth: Vec<_> =
        surfaces.iter().map(|surface| oracle::radiance(surface, camera, settings, light)).collect();
    let largest = truth.iter().fold(0.0, |most: f64, value| most.max(value.abs().max_element()));
    assert!(largest > 0.1, "nothing to see");
    let difference = |(value, truth): (&[f32; 4], &DVec3)| {
        let value = DVec3::from_array([0, 1, 2].map(|i| f64::from(value[i])));
        (value - truth).abs().max_element()
    };
    values.iter().zip(&truth).map(difference).fold(0.0, f64::max) / largest
}

/// Every kind of kernel, and a picture whose surfaces are of all kinds.
fn kinds() -> Vec<Vec<Brdf>> {
    vec![
        vec![lambertian()],
        vec![lambertian(), grey(0.4), grey(0.7)],
        vec![lambertian(), colored(0.5), grey(0.4)],
        vec![dielectric()],
        vec![measured(), colored(0.5), grey(0.4), lambertian(), dielectric()],
    ]
}

#[test]
fn the_adapter_reads_as_the_oracle_does() {
    for brdfs in kinds() {
        let surfaces = surfaces(&brdfs);
        for scheme in SCHEMES {
            let settings = settings(scheme, 5, &brdfs);
            let light = coefficients(&settings);
            let (values, outside) =
                on_adapter(&settings, &brdfs, &surfaces, plain(&settings, &light));
            let error = error(&values, &surfaces, &settings, &light);
            println!("{scheme:?}, {} reflectances: {error:.1e}", brdfs.len());
            assert!(error <= 1e-6, "{scheme:?}, {brdfs:?}: {error:e}");
            assert_eq!(outside, OUTSIDE);
        }
    }
}

#[test]
fn one_to_fifteen_bands() {
    let brdfs = [lambertian(), grey(0.4)];
    let surfaces = surfaces(&brdfs);
    for bands in 1..=15 {
        let scheme = if bands % 2 == 0 { Scheme::Trilinear } else { Scheme::Hermite };
        let settings = settings(scheme, bands, &brdfs);
        let light = coefficients(&settings);
        let (values, _) = on_adapter(&settings, &brdfs, &surfaces, plain(&settings, &light));
        let error = error(&values, &surfaces, &settings, &light);
        println!("{bands} bands: {error:.1e}");
        assert!(error <= 1e-6, "{bands} bands: {error:e}");
    }
}
