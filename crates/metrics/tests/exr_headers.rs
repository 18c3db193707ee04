//! Where pixels lie and what their numbers mean: what the headers of OpenEXR say of it.

use std::path::Path;

use crate::common::exr_files::{SIZE, folder, layer, message};
use crate::common::gradient;
use exr::meta::attribute::{Chromaticities, IntegerBounds};
use exr::prelude::{Encoding, Image, Vec2, WritableImage};
use manylights_metrics::{RadianceImage, read_exr_pair};

/// A picture whose first pixel is at `position` of the display window.
fn write_window(path: &Path, position: [i32; 2], display: IntegerBounds) {
    let mut layer = layer("beauty", &["R", "G", "B"], Encoding::SMALL_LOSSLESS);
    layer.attributes.layer_position = Vec2(position[0], position[1]);
    let mut image = Image::from_layer(layer);
    image.attributes.display_window = display;
    image.write().to_file(path).expect("written");
}

#[test]
fn pictures_are_compared_where_they_lie() {
    let folder = folder();
    let [a, b] = ["a.exr", "b.exr"].map(|name| folder.path().join(name));
    let tight = IntegerBounds::new((0, 0), (SIZE[0], SIZE[1]));
    let frame = IntegerBounds::new((0, 0), (64, 48));
    write_window(&a, [0, 0], tight);
    for (position, display) in [
        ([10, 10], frame),
        ([0, 0], frame),
        ([-3, 0], tight),
        ([0, 1], tight),
        ([10, 10], IntegerBounds::new((10, 10), (SIZE[0], SIZE[1]))),
    ] {
        write_window(&b, position, display);
        for (image, reference) in [(&a, &b), (&b, &a)] {
            let text = read_exr_pair(image, reference).expect_err("elsewhere").to_string();
            assert!(text.contains("croptofull") && !text.contains('\n'), "{text}");
            let place = format!("column {}, row {} of a frame of", position[0], position[1]);
            assert!(text.contains(&place), "{text}");
        }
        // Two crops of one frame are pictures of the same pixels.
        let [image, reference] = read_exr_pair(&b, &b).expect("the same place");
        assert_eq!(image, reference);
        RadianceImage::read_exr(&b).expect("alone, any picture can be read");
    }
    gradient(20, 20).write_exr(&b, &[]).expect("written");
    read_exr_pair(&a, &b).expect("comparing them says that their sizes differ");
    write_window(&b, [0, 0], tight);
    read_exr_pair(&a, &b).expect("the same place");
}

/// The window and the primaries are those of the part that is read.
#[test]
fn windows_of_other_parts_do_not_matter() {
    let folder = folder();
    let [a, b] = ["a.exr", "b.exr"].map(|name| folder.path().join(name));
    let frame = IntegerBounds::new((0, 0), (64, 48));
    write_window(&a, [4, 5], frame);
    let mut depth = layer("depth", &["Z"], Encoding::SMALL_LOSSLESS);
    depth.attributes.layer_position = Vec2(7, 7);
    let mut beauty = layer("beauty", &["R", "G", "B"], Encoding::SMALL_LOSSLESS);
    let attributes = exr::prelude::ImageAttributes::new(frame);
    for (position, same) in [(Vec2(4, 5), true), (Vec2(7, 7), false)] {
        beauty.attributes.layer_position = position;
        let image = Image::empty(attributes.clone()).with_layer(depth.clone());
        image.with_layer(beauty.clone()).write().to_file(&b).expect("written");
        assert_eq!(read_exr_pair(&a, &b).is_ok(), same, "{position:?}");
    }
}

#[test]
fn numbers_of_other_primaries_are_refused() {
    let folder = folder();
    let path = folder.path().join("image.exr");
    let write = |[red, green, blue, white]: [(f32, f32); 4]| {
        let [red, green, blue, white] = [red, green, blue, white].map(|(x, y)| Vec2(x, y));
        let beauty = layer("beauty", &["R", "G", "B"], Encoding::SMALL_LOSSLESS);
        let mut image = Image::from_layer(beauty);
        image.attributes.chromaticities = Some(Chromaticities { red, green, blue, white });
        image.write().to_file(&path).expect("written");
    };
    let rec_709 = [(0.64, 0.33), (0.3, 0.6), (0.15, 0.06), (0.3127, 0.329)];
    let [red, green, blue, white] = rec_709;
    for rounded in [
        rec_709,
        [red, green, blue, (0.313, 0.329)],
        [red, green, blue, (0.312_713, 0.329_016)],
        [(0.640_08, 0.330_04), (0.300_01, 0.600_03), (0.150_02, 0.059_97), white],
    ] {
        write(rounded);
        RadianceImage::read_exr(&path).unwrap_or_else(|error| panic!("{rounded:?}: {error}"));
    }
    for others in [
        // ACES AP1, CIE XYZ, Rec. 2020, Display P3, EBU Tech. 3213, Rec. 709 under D50.
        [(0.713, 0.293), (0.165, 0.83), (0.128, 0.044), (0.321_68, 0.337_67)],
        [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (1.0 / 3.0, 1.0 / 3.0)],
        [(0.708, 0.292), (0.17, 0.797), (0.131, 0.046), white],
        [(0.68, 0.32), (0.265, 0.69), blue, white],
        [red, (0.29, 0.6), blue, white],
        [red, green, blue, (0.3457, 0.3585)],
        [(f32::NAN, 0.33), green, blue, white],
    ] {
        write(others);
        let text = message(&path);
        assert!(text.contains("convert it to linear Rec. 709"), "{text}");
        assert!(text.contains(&format!("red {} {}", others[0].0, others[0].1)), "{text}");
    }
}
