//! What is left of coefficients in a third of their bytes.

use crate::common::{
    GPU, SCHEMES, coefficients, grid, lambertian, noise, on_adapter, packed, settings, surfaces,
};
use manylights_interpolation::{Order, Reading, Scheme, Settings, Storage, oracle};

/// Half of the last digit of half precision, and of 8 bits with a sign.
const HALF: f32 = 1.0 / 2048.0;
const BYTE: f32 = 0.5 / 127.0;

/// What the adapter packs, in single precision again.
fn there_and_back(settings: &Settings, light: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let words: Vec<[u32; 4]> = GPU.read(&packed(settings, light)).expect("what was packed");
    assert_eq!(words.len(), settings.grid.count() * settings.stored_vectors());
    oracle::unpacked(&words, settings.bands, settings.scheme.reads_gradients())
}

/// Values by channel, and the gradients, of each coefficient of a vertex.
fn numbers(vertex: &[[f32; 4]], gradients: bool) -> Vec<([f32; 3], Vec<f32>)> {
    let of = |channels: &[[f32; 4]]| match gradients {
        true => (
            [0, 1, 2].map(|c| channels[c][0]),
            channels.iter().flat_map(|parts| parts[1..].to_vec()).collect(),
        ),
        false => ([0, 1, 2].map(|c| channels[0][c]), Vec::new()),
    };
    vertex.chunks_exact(if gradients { 3 } else { 1 }).map(of).collect()
}

fn largest(values: impl IntoIterator<Item = f32>) -> f32 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// That values keep half precision's digits, where they are not far below the largest of their channel, and that
/// gradients keep 8 bits of the largest of their band.
fn assert_close(settings: &Settings, light: &[[f32; 4]], back: &[[f32; 4]]) {
    let gradients = settings.scheme.reads_gradients();
    let vectors = settings.vectors();
    assert_eq!(light.len(), back.len());
    for (vertex, (light, back)) in
        light.chunks_exact(vectors).zip(back.chunks_exact(vectors)).enumerate()
    {
        let [light, back] = [light, back].map(|numbers_of| numbers(numbers_of, gradients));
        for c in 0..3 {
            let most = largest(light.iter().map(|(values, _)| values[c]));
            for (i, (before, after)) in light.iter().zip(&back).enumerate() {
                let (before, after) = (before.0[c], after.0[c]);
                let bound = (1.01 * HALF * before.abs()).max(1e-7 * most).max(1e-36);
                assert!((before - after).abs() <= bound, "{vertex}, {i}: {before:e}, {after:e}");
            }
            let (first, most) = (light[0].0[c], most / 256.0);
            assert!(first <= most.max(1e-36) || first == back[0].0[c], "L00 of {vertex}");
        }
        for l in 0..settings.bands {
            let band = l * l..(l + 1) * (l + 1);
            let most = largest(light[band.clone()].iter().flat_map(|(_, parts)| parts.clone()));
            for i in band {
                for (before, after) in light[i].1.iter().zip(&back[i].1) {
                    let bound = (1.01 * BYTE * most).max(1e-36);
                    assert!(
                        (before - after).abs() <= bound,
                        "{vertex}, {i}: {before:e}, {after:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn values_keep_11_digits_and_gradients_8() {
    for scheme in [Scheme::Trilinear, Scheme::Hermite] {
        for bands in 1..=15 {
            let settings = Settings { storage: Storage::Packed, ..settings(scheme, bands, &[]) };
            let light = coefficients(&settings);
            let back = there_and_back(&settings, &light);
            assert_close(&settings, &light, &back);
            let (mut error, mut truth) = (0.0_f64, 0.0);
            let vectors = settings.vectors();
            for (before, after) in light.chunks_exact(vectors).zip(back.chunks_exact(vectors)) {
                let [before, after] =
                    [before, after].map(|vertex| numbers(vertex, scheme.reads_gradients()));
                // L_00 is exact: of the others alone.
                for ((before, _), (after, _)) in before.iter().zip(&after).skip(1) {
                    for (before, after) in before.iter().zip(after) {
                        error += f64::from(before - after).powi(2);
                        truth += f64::from(*before).powi(2);
                    }
                }
            }
            let relative = (error / truth).sqrt();
            println!("{scheme:?}, {bands} bands: {relative:.1e}");
            assert!(bands == 1 || relative > 5e-5 && relative <= 3e-4, "{bands}: {relative:e}");
        }
    }
}

/// Nothing, no L_00 or a negative one, lights of any size, a dark channel.
fn hazards(settings: &Settings) -> Vec<[f32; 4]> {
    let vectors = settings.vectors();
    let gradients = settings.scheme.reads_gradients();
    let sizes = [0.0, 1e-42, 1e-37, 1e-30, 1e-10, 1.0, 1e5, 1e10, 1e30];
    let vertex = |v: usize| {
        (0..vectors).map(move |k| {
            let parts = [0, 1, 2, 3].map(|j| sizes[v % 9] * noise(4 * (v * vectors + k) + j));
            let is_first = k < if gradients { 3 } else { 1 };
            match v / 9 % 5 {
                1 if is_first => [0.0; 4],
                2 if is_first => parts.map(|part| -part.abs()),
                3 if is_first => parts.map(|part| 1e-9 * part.abs()),
                4 if gradients && k % 3 == 0 => [0.0; 4],
                4 if gradients => [parts[0], 1e4 * parts[1], 0.0, parts[3]],
                4 => [0.0, parts[1], parts[2], 0.0],
                _ => parts,
            }
        })
    };
    (0..settings.grid.count()).flat_map(vertex).collect()
}

#[test]
fn no_light_is_too_dim_or_too_bright() {
    for scheme in [Scheme::Trilinear, Scheme::Hermite] {
        let settings = Settings { storage: Storage::Packed, ..settings(scheme, 5, &[]) };
        let light = hazards(&settings);
        let back = there_and_back(&settings, &light);
        assert!(back.iter().flatten().all(|value| value.is_finite()));
        let is_dark = |numbers: &[[f32; 4]]| numbers.as_flattened().iter().all(|&v| v == 0.0);
        assert!(is_dark(&light[..settings.vectors()]) && is_dark(&back[..settings.vectors()]));
        assert_close(&settings, &light, &back);
    }
}

/// Where a grid holds no light, both orders read nothing.
#[test]
fn of_no_light_nothing_is_read() {
    let brdfs = [lambertian()];
    for scheme in SCHEMES {
        for order in [Order::Plain, Order::Sorted] {
            let settings =
                Settings { order, storage: Storage::Packed, ..settings(scheme, 4, &brdfs) };
            let none = vec![[0.0; 4]; settings.vectors() * settings.grid.count()];
            let (values, _) = on_adapter(&settings, &brdfs, &surfaces(&brdfs), |pixels| {
                let stored = packed(&settings, &none);
                let mut reading = Reading::new(&GPU, &settings, &stored, pixels).expect("kernels");
                reading.add().expect("a run");
                reading.outside().expect("a count")
            });
            assert!(values.as_flattened().iter().all(|&value| value == 0.0), "{scheme:?}");
        }
    }
}

#[test]
fn a_third_of_the_bytes_is_kept() {
    let grid = grid();
    let share = |scheme, bands| {
        let settings = Settings { grid, storage: Storage::Packed, ..settings(scheme, bands, &[]) };
        settings.stored_vectors() as f64 / settings.vectors() as f64
    };
    assert!((share(Scheme::Hermite, 9) - 85.0 / 243.0).abs() < 1e-15);
    assert!(share(Scheme::Hermite, 5) < 0.38 && share(Scheme::Trilinear, 9) < 0.52);
}
