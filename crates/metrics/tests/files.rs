//! Pictures on disk: round trips, and files that somebody damaged.

use std::fs;
use std::path::Path;

use crate::common::exr_files::{SIZE, encoding, folder, layer, message};
use crate::common::{gradient, map, next, noise};
use exr::prelude::{Blocks, Compression, Encoding, Image, Vec2, WritableImage, f16};
use manylights_metrics::{Error, RadianceImage, write_exr_layers};

#[test]
fn layers_are_named_channels_of_one_part() {
    let folder = folder();
    let path = folder.path().join("layers.exr");
    let [a, b] = [1, 2].map(|seed| map(&noise(33, 21, seed), |c| c - 100.0));
    let attributes = [("manylights.cell".to_owned(), "key".to_owned())];
    write_exr_layers(&path, &[("image", &a), ("error", &b)], &attributes).expect("written");
    let read = exr::prelude::read_all_flat_layers_from_file(&path).expect("readable");
    let [layer] = read.layer_data.as_slice() else { panic!("one part") };
    let names: Vec<_> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["error.B", "error.G", "error.R", "image.B", "image.G", "image.R"]);
    for (index, image, component) in [(2, &b, 0), (0, &b, 2), (4, &a, 1)] {
        let values: Vec<f32> = layer.channel_data.list[index].sample_data.values_as_f32().collect();
        let expected: Vec<f32> = image.pixels.iter().map(|pixel| pixel[component]).collect();
        assert_eq!(values, expected, "{}", names[index]);
    }
    let other = RadianceImage::black(2, 2);
    assert!(write_exr_layers(&path, &[("image", &a), ("error", &other)], &[]).is_err());
    assert!(write_exr_layers(&path, &[], &[]).is_err());
}

#[test]
fn exr_keeps_every_bit() {
    let folder = folder();
    let path = folder.path().join("image.exr");
    let mut image = map(&noise(33, 21, 1), |c| (c - 100.0) * 1e-3);
    let extremes = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE];
    for (pixel, value) in image.pixels.iter_mut().zip(extremes) {
        *pixel = [value, -0.0, 1e-45];
    }
    let attributes = [("scene".to_owned(), "cornell".to_owned()), ("ρ".into(), "½\nλ".into())];
    image.write_exr(&path, &attributes).expect("written");
    let read = RadianceImage::read_exr(&path).expect("readable");
    let bits = |image: &RadianceImage| -> Vec<_> {
        image.pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
    };
    assert_eq!((read.width, read.height), (33, 21));
    assert_eq!(bits(&read), bits(&image));

    let meta = exr::meta::MetaData::read_from_file(&path, true).expect("valid");
    let found = &meta.headers[0].own_attributes.other;
    for (name, value) in &attributes {
        let is_it = |(key, text): (&exr::prelude::Text, &exr::prelude::AttributeValue)| {
            key.bytes() == name.as_bytes()
                && text.to_text().is_ok_and(|text| text.bytes() == value.as_bytes())
        };
        assert!(found.iter().any(is_it), "{name} is missing");
    }
}

#[test]
fn exr_of_others_is_read() {
    let folder = folder();
    let path = folder.path().join("others.exr");
    let lossless = [
        encoding(Compression::Uncompressed, Blocks::ScanLines),
        encoding(Compression::RLE, Blocks::Tiles(Vec2(16, 8))),
        encoding(Compression::ZIP1, Blocks::ScanLines),
        encoding(Compression::ZIP16, Blocks::Tiles(Vec2(64, 64))),
        encoding(Compression::PIZ, Blocks::ScanLines),
    ];
    for encoding in lossless {
        let depth = layer("depth", &["Z"], encoding);
        let beauty = layer("beauty", &["A", "R", "G", "B"], encoding);
        let attributes = exr::prelude::ImageAttributes::with_size((SIZE[0], SIZE[1]));
        let image = Image::empty(attributes).with_layer(depth).with_layer(beauty);
        image.write().to_file(&path).expect("written");
        let read = RadianceImage::read_exr(&path).expect("readable");
        for (index, pixel) in (0..).zip(&read.pixels) {
            let half = f16::from_f32((2 * index) as f32).to_f32();
            assert_eq!(*pixel, [half, (3 * index) as f32, (4 * index) as f32], "{encoding:?}");
        }
    }
}

#[test]
fn files_that_are_no_pictures_say_so() {
    let folder = folder();
    let path = folder.path().join("image.exr");
    assert!(message(&path).contains("image.exr"), "a missing file is named");
    assert!(message(folder.path()).contains("cannot read"));
    for bytes in [&b""[..], b"P6 1 1 255 abc", b"\x76\x2f\x31\x01", &[0xff; 4096]] {
        fs::write(&path, bytes).expect("written");
        message(&path);
    }
    let depth = layer("depth", &["Z", "R", "G"], Encoding::SMALL_LOSSLESS);
    Image::from_layer(depth).write().to_file(&path).expect("written");
    assert!(message(&path).contains("channels R, G and B"));
    let dwa = encoding(Compression::DWAA(None), Blocks::ScanLines);
    Image::from_layer(layer("beauty", &["R", "G", "B"], dwa))
        .write()
        .to_file(&path)
        .expect("written");
    assert!(message(&path).contains("DWA"));
}

/// Where the value of an attribute starts.
fn value_at(bytes: &[u8], attribute: &[u8]) -> usize {
    let found = bytes.windows(attribute.len()).position(|window| window == attribute);
    found.expect("the attribute is required") + attribute.len()
}

/// Writes the last column and row of the data window, and the number of blocks that they would give,
/// over those of a small file.
fn claim_size(bytes: &mut [u8], corner: [i32; 2]) {
    let corner_at = value_at(bytes, b"dataWindow\0box2i\0\x10\0\0\0") + 8;
    for (slot, value) in bytes[corner_at..].chunks_exact_mut(4).zip(corner) {
        slot.copy_from_slice(&value.to_le_bytes());
    }
    let blocks_at = value_at(bytes, b"chunkCount\0int\0\x04\0\0\0");
    let blocks = corner[1].saturating_add(1).unsigned_abs().div_ceil(16);
    bytes[blocks_at..][..4].copy_from_slice(&blocks.to_le_bytes());
}

#[test]
fn absurd_sizes_are_refused_by_the_header() {
    let folder = folder();
    let path = folder.path().join("huge.exr");
    gradient(16, 16).write_exr(&path, &[]).expect("written");
    let original = fs::read(&path).expect("readable");
    let cases = [
        ([1_000_000_000, 1_000_000_000], "at most"),
        ([1_000_000_000, 15], "at most"),
        ([8192, 8191], "at most"),
        ([60_000_000, 0], "blocks of"),
        ([8191, 8191], "cannot be in a file of"),
        ([1_000_000, 15], "cannot be in a file of"),
        ([15, 1023], "missing bytes"),
        ([i32::MAX, i32::MAX], "invalid"),
        ([i32::MIN, i32::MIN], "invalid"),
    ];
    for (corner, expected) in cases {
        let mut bytes = original.clone();
        claim_size(&mut bytes, corner);
        fs::write(&path, &bytes).expect("written");
        let text = message(&path);
        assert!(text.contains(expected), "{corner:?}: {text}");
    }
}

/// Reads damaged copies of a file; a panic fails the test, an error or a picture does not.
fn read_damaged(path: &Path, seed: u64) {
    let original = fs::read(path).expect("readable");
    for length in (0..original.len()).step_by(1 + original.len() / 97) {
        fs::write(path, &original[..length]).expect("written");
        message(path);
    }
    let mut state = seed;
    for _ in 0..100 {
        let mut bytes = original.clone();
        for _ in 0..=next(&mut state) % 4 {
            let high = usize::from(next(&mut state)) << 8;
            let position = (high + usize::from(next(&mut state))) % bytes.len();
            bytes[position] = match next(&mut state) {
                value @ 0..128 => value.wrapping_mul(37),
                128..192 => 0xff,
                _ => 0,
            };
        }
        fs::write(path, &bytes).expect("written");
        if let Ok(image) = RadianceImage::read_exr(path) {
            assert_eq!(image.pixels.len(), (image.width * image.height) as usize);
        }
    }
}

#[test]
fn damaged_exr_never_panics() {
    let folder = folder();
    let path = folder.path().join("damaged.exr");
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    for (compression, seed) in compressions.into_iter().zip(1..) {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 16))] {
            let beauty = layer("beauty", &["R", "G", "B"], encoding(compression, blocks));
            Image::from_layer(beauty).write().to_file(&path).expect("written");
            read_damaged(&path, seed);
        }
    }
}

#[test]
fn attributes_that_openexr_cannot_hold_are_refused() {
    let folder = folder();
    let path = folder.path().join("image.exr");
    for name in ["", "channels", "dataWindow", "a\0b", &"n".repeat(256)] {
        let result = gradient(12, 12).write_exr(&path, &[(name.to_owned(), "value".to_owned())]);
        assert!(matches!(result, Err(Error::Write { .. })), "`{name}`");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 0, "nothing is left behind");
}

#[test]
fn unwritable_outputs_are_named() {
    let folder = folder();
    let missing = folder.path().join("missing").join("image.exr");
    let empty = RadianceImage::black(0, 3);
    for result in [
        gradient(12, 12).write_exr(&missing, &[]),
        gradient(12, 12).write_png(&missing, 1.0),
        gradient(12, 12).write_exr(folder.path(), &[]),
    ] {
        let text = result.expect_err("unwritable").to_string();
        assert!(text.starts_with("cannot write") && !text.contains('\n'), "{text}");
    }
    assert!(matches!(empty.write_png(&missing, 1.0), Err(Error::Shape { .. })));
    for exposure in [0.0, -1.0, f32::NAN] {
        let result = gradient(12, 12).write_png(&folder.path().join("image.png"), exposure);
        assert!(matches!(result, Err(Error::Exposure(_))));
    }
}

#[test]
fn png_holds_srgb_and_shows_what_is_not_finite() {
    let folder = folder();
    let path = folder.path().join("image.png");
    let mut image = RadianceImage::black(4, 2);
    // By the curve's definition: 0.215 is 0.5011, code 127.8; 0.5 is 187.5; 0.002 is 6.6.
    image.pixels[1] = [0.1075, 0.25, 0.001];
    image.pixels[2] = [7.0, -1.0, 0.5];
    image.pixels[3] = [f32::INFINITY, 0.0, 0.0];
    image.write_png(&path, 2.0).expect("written");
    let read = image::open(&path).expect("a PNG").into_rgb8();
    assert_eq!(read.dimensions(), (4, 2));
    assert_eq!(read.get_pixel(0, 0).0, [0, 0, 0]);
    assert_eq!(read.get_pixel(1, 0).0, [128, 188, 7]);
    assert_eq!(read.get_pixel(2, 0).0, [255, 0, 255]);
    assert_eq!(read.get_pixel(3, 0).0, [255, 0, 255]);
    assert!(image.display(2.0).pixels[3][0].is_nan());
}

#[cfg(unix)]
#[test]
fn files_can_be_read_by_others_as_the_umask_allows() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let (ours, plain) = (folder.path().join("image.exr"), folder.path().join("plain"));
    gradient(12, 12).write_exr(&ours, &[]).expect("written");
    fs::write(&plain, "").expect("written");
    let mode = |path| fs::metadata(path).expect("there").permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}
