//! What may happen to a cached reference, and what must not come of it.

use std::fs;
use std::path::{Path, PathBuf};

use manylights_path_tracer::{Reference, SLICE, Settings, render};
use manylights_scene::{Scene, load};

fn scene() -> Scene {
    load("cornell", None).expect("a built-in scene")
}

fn settings(samples: u32) -> Settings {
    let transport = "indirect-1".parse().expect("a transport");
    Settings { transport, resolution: [9, 7], seed: 1, samples }
}

fn rendered(settings: &Settings, cache: Option<&Path>) -> (Reference, u64) {
    let scene = scene();
    let mut slices = 0;
    let reference = render(&scene, &scene.cameras[0], settings, cache, &mut |at| {
        slices += 1;
        assert!(at.done <= at.total);
    });
    (reference.expect("a picture"), slices)
}

fn assert_same(a: &Reference, b: &Reference) {
    assert_eq!(a.image, b.image);
    assert_eq!(a.halves, b.halves);
    assert_eq!(a.variance, b.variance);
    assert_eq!((a.samples, a.noise_floor), (b.samples, b.noise_floor));
}

fn only_file(folder: &Path) -> PathBuf {
    let mut files: Vec<_> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    assert_eq!(files.len(), 1, "{files:?}");
    files.remove(0)
}

#[test]
fn goes_on_where_it_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let (once, _) = rendered(&settings(8 * SLICE), None);
    let (_, slices) = rendered(&settings(3 * SLICE), Some(folder.path()));
    assert_eq!(slices, 3);
    let (continued, slices) = rendered(&settings(8 * SLICE), Some(folder.path()));
    assert_eq!(slices, 5);
    assert_same(&once, &continued);
    let (again, slices) = rendered(&settings(8 * SLICE), Some(folder.path()));
    assert_eq!(slices, 0, "nothing is left to do");
    assert_same(&once, &again);
}

/// Numbers must not depend on what other runs left in the cache.
#[test]
fn fewer_samples_than_are_kept_give_the_picture_of_fewer() {
    let folder = tempfile::tempdir().expect("a folder");
    let (few, _) = rendered(&settings(2 * SLICE), None);
    rendered(&settings(8 * SLICE), Some(folder.path()));
    let (after_many, slices) = rendered(&settings(2 * SLICE), Some(folder.path()));
    assert_eq!(slices, 2);
    assert_same(&few, &after_many);
    // Both are kept.
    assert_eq!(rendered(&settings(8 * SLICE), Some(folder.path())).1, 0);
    assert_eq!(rendered(&settings(2 * SLICE), Some(folder.path())).1, 0);
}

#[test]
fn a_file_with_more_samples_than_its_name_says_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    rendered(&settings(8 * SLICE), Some(folder.path()));
    let many = fs::read(only_file(folder.path())).expect("the file");
    fs::remove_file(only_file(folder.path())).expect("removable");
    let (few, _) = rendered(&settings(2 * SLICE), Some(folder.path()));
    fs::write(only_file(folder.path()), many).expect("writable");
    let (again, _) = rendered(&settings(2 * SLICE), Some(folder.path()));
    assert!(again.notes[0].contains("more samples than its name says"), "{:?}", again.notes);
    assert_same(&few, &again);
}

#[test]
fn halves_make_up_the_picture() {
    let (reference, _) = rendered(&settings(6 * SLICE), None);
    let [even, odd] = &reference.halves;
    assert_ne!(even, odd);
    for ((mean, a), b) in reference.image.pixels.iter().zip(&even.pixels).zip(&odd.pixels) {
        for channel in 0..3 {
            let half_sum = 0.5 * (a[channel] + b[channel]);
            assert!((mean[channel] - half_sum).abs() <= 2.0 * f32::EPSILON * half_sum);
        }
    }
}

#[test]
fn damage_is_found_and_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let (whole, _) = rendered(&settings(2 * SLICE), Some(folder.path()));
    let path = only_file(folder.path());
    let bytes = fs::read(&path).expect("the file");
    let mut damages: Vec<(String, Vec<u8>)> = [0, 1, 40, bytes.len() / 2, bytes.len() - 1]
        .into_iter()
        .map(|length| (format!("cut to {length}"), bytes[..length].to_vec()))
        .collect();
    for position in [0, 8, 41, bytes.len() / 3, bytes.len() - 1] {
        let mut garbled = bytes.clone();
        garbled[position] ^= 0x40;
        damages.push((format!("byte {position}"), garbled));
    }
    damages.push(("longer".into(), [&bytes[..], b"x"].concat()));
    for (what, damaged) in damages {
        fs::write(&path, damaged).expect("writable");
        let (reference, slices) = rendered(&settings(2 * SLICE), Some(folder.path()));
        assert_eq!(slices, 2, "{what}: damage was not noticed");
        assert!(reference.notes[0].contains("damaged"), "{what}: {:?}", reference.notes);
        assert_same(&whole, &reference);
        assert_eq!(fs::read(&path).expect("the file"), bytes, "{what}");
    }
}

/// The file of one reference under the name of another.
#[test]
fn a_foreign_file_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    rendered(&settings(2 * SLICE), Some(folder.path()));
    let path = only_file(folder.path());
    let foreign = fs::read(&path).expect("the file");
    fs::remove_file(&path).expect("removable");
    let other = Settings { seed: 2, ..settings(2 * SLICE) };
    let (expected, _) = rendered(&other, Some(folder.path()));
    fs::write(only_file(folder.path()), foreign).expect("writable");
    let (reference, _) = rendered(&other, Some(folder.path()));
    assert!(reference.notes[0].contains("another reference"), "{:?}", reference.notes);
    assert_same(&expected, &reference);
}

/// What a run leaves that is killed while it writes: a file of another name.
#[test]
fn leftovers_of_a_killed_run_do_not_count() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(".tmpKilled"), b"half a file").expect("writable");
    let (reference, slices) = rendered(&settings(2 * SLICE), Some(folder.path()));
    assert_eq!(slices, 2);
    assert!(reference.notes.is_empty());
}

#[test]
fn runs_at_once_do_not_corrupt() {
    let folder = tempfile::tempdir().expect("a folder");
    std::thread::scope(|scope| {
        for samples in [2 * SLICE, 6 * SLICE, 4 * SLICE] {
            let path = folder.path();
            scope.spawn(move || rendered(&settings(samples), Some(path)));
        }
    });
    let (expected, _) = rendered(&settings(6 * SLICE), None);
    let (reference, _) = rendered(&settings(6 * SLICE), Some(folder.path()));
    assert!(reference.notes.is_empty());
    assert_same(&expected, &reference);
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, b"").expect("writable");
    let scene = scene();
    let error = render(&scene, &scene.cameras[0], &settings(1), Some(&file), &mut |_| {});
    let message = error.expect_err("no folder").to_string();
    assert!(message.contains("file") && !message.contains('\n'), "{message}");
}
