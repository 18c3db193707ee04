//! The adapter against the oracle.

use crate::common::{
    CAMERA, GPU, OUTSIDE, SCHEMES, coefficients, colored, dielectric, grey, grid, lambertian,
    measured, on_adapter, packed, settings, surfaces,
};
use glam::{DVec3, Vec3, Vec4};
use manylights_gpu::SurfaceRecord;
use manylights_interpolation::{Order, Pixels, Reading, Scheme, Settings, Storage, oracle};
use manylights_scene::Brdf;

fn read<'a>(
    settings: &'a Settings,
    coefficients: &'a [[f32; 4]],
) -> impl Fn(&Pixels<'_>) -> u32 + 'a {
    move |pixels| {
        let on_gpu = match settings.storage {
            Storage::F32 => GPU.storage("coefficients", coefficients).expect("it fits"),
            Storage::Packed => packed(settings, coefficients),
        };
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

/// Both orders against the oracle and against each other, over the largest radiance, with both storages.
fn check(settings: Settings, brdfs: &[Brdf]) {
    let light = coefficients(&settings);
    check_storage(settings, brdfs, &light, &light);
    let settings = Settings { storage: Storage::Packed, ..settings };
    let words: Vec<[u32; 4]> = GPU.read(&packed(&settings, &light)).expect("what was packed");
    let kept = oracle::unpacked(&words, settings.bands, settings.scheme.reads_gradients());
    check_storage(settings, brdfs, &light, &kept);
}

/// The adapter reads `light`, the oracle what the storage keeps of it.
fn check_storage(settings: Settings, brdfs: &[Brdf], light: &[[f32; 4]], kept: &[[f32; 4]]) {
    let surfaces = surfaces(brdfs);
    let [plain, sorted] = [Order::Plain, Order::Sorted].map(|order| {
        let settings = Settings { order, ..settings };
        let (values, outside) = on_adapter(&settings, brdfs, &surfaces, read(&settings, light));
        assert_eq!(outside, OUTSIDE);
        let error = error(&values, &surfaces, &settings, kept);
        assert!(error <= 1e-6, "{settings:?}, {brdfs:?}: {error:e}");
        values
    });
    let largest = plain.iter().flatten().fold(0.0, |most: f32, value| most.max(value.abs()));
    let pairs = plain.iter().flatten().zip(sorted.iter().flatten());
    let apart = pairs.fold(0.0, |most: f32, (a, b)| most.max((a - b).abs()));
    assert!(apart <= 1e-6 * largest, "{settings:?}, {brdfs:?}: {apart:e}");
}

#[test]
fn the_adapter_reads_as_the_oracle_does() {
    for brdfs in kinds() {
        for scheme in SCHEMES {
            check(settings(scheme, 3, &brdfs), &brdfs);
        }
    }
}

#[test]
fn one_to_fifteen_bands() {
    let brdfs = [lambertian()];
    for bands in 1..=15 {
        let scheme = if bands % 2 == 0 { Scheme::Trilinear } else { Scheme::Hermite };
        check(settings(scheme, bands, &brdfs), &brdfs);
    }
}

#[test]
fn thirteen_bands_with_gradients_fit_uniform_memory() {
    let sorted = |scheme, bands| {
        Settings { order: Order::Sorted, ..settings(scheme, bands, &[lambertian()]) }.is_sorted()
    };
    assert!(sorted(Scheme::Hermite, 13) && sorted(Scheme::Trilinear, 15));
    assert!(!sorted(Scheme::Hermite, 14));
    let packed = settings(Scheme::Hermite, 15, &[lambertian()]);
    assert!(Settings { order: Order::Sorted, storage: Storage::Packed, ..packed }.is_sorted());
}

/// Points a little apart on both sides of a cell's faces.
#[test]
fn radiance_does_not_jump_across_faces() {
    let brdfs = [grey(0.4)];
    let face = |axis: usize, side: f32| {
        let grid = grid();
        let place = [0, 1, 2].map(|i| if i == axis { 1.0 + 1e-7 * side } else { 1.37 });
        let position = [0, 1, 2].map(|i| grid.origin[i] + place[i] * grid.spacing[i]);
        SurfaceRecord::new(position.into(), Vec3::Z, brdfs[0])
    };
    let surfaces: Vec<_> =
        (0..3).flat_map(|axis| [-1.0, 1.0].map(|side| face(axis, side))).collect();
    for scheme in SCHEMES {
        for order in [Order::Plain, Order::Sorted] {
            let settings = Settings { order, ..settings(scheme, 5, &brdfs) };
            let light = coefficients(&settings);
            let (values, _) = on_adapter(&settings, &brdfs, &surfaces, read(&settings, &light));
            for pair in values.chunks_exact(2) {
                let apart = (Vec4::from(pair[0]) - Vec4::from(pair[1])).abs().max_element();
                let value = Vec4::from(pair[0]).abs().max_element();
                assert!(apart <= 1e-6 * value.max(1.0), "{scheme:?}, {order:?}: {apart:e}");
            }
        }
    }
}

/// What was there stays, and a second reading adds the same once more.
#[test]
fn readings_add_up() {
    let brdfs = [lambertian(), grey(0.4)];
    let surfaces = surfaces(&brdfs);
    for order in [Order::Plain, Order::Sorted] {
        let settings = Settings { order, ..settings(Scheme::Hermite, 3, &brdfs) };
        let light = coefficients(&settings);
        let (once, _) = on_adapter(&settings, &brdfs, &surfaces, read(&settings, &light));
        let (twice, outside) = on_adapter(&settings, &brdfs, &surfaces, |pixels| {
            let on_gpu = GPU.storage("coefficients", &light).expect("it fits");
            let mut reading = Reading::new(&GPU, &settings, &on_gpu, pixels).expect("kernels");
            reading.add().expect("a run");
            reading.add().expect("a run");
            reading.outside().expect("a count")
        });
        assert_eq!(twice, once.iter().map(|value| value.map(|v| 2.0 * v)).collect::<Vec<_>>());
        assert_eq!(outside, 2 * OUTSIDE);
    }
}
