//! Files that others could have written.

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    LineOrder, Vec2, f16,
};
use manylights_metrics::RadianceImage;
use tempfile::TempDir;

pub(crate) const SIZE: [usize; 2] = [37, 19];

pub(crate) fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

pub(crate) fn message(path: &Path) -> String {
    let text = RadianceImage::read_exr(path).expect_err("unreadable").to_string();
    assert!(!text.contains('\n'), "more than one line: {text}");
    text
}

pub(crate) fn encoding(compression: Compression, blocks: Blocks) -> Encoding {
    Encoding { compression, blocks, line_order: LineOrder::Increasing }
}

/// A layer whose channels all hold the values 0, 1, 2, … times their index from 1.
pub(crate) fn layer(
    name: &str,
    channels: &[&str],
    encoding: Encoding,
) -> Layer<AnyChannels<FlatSamples>> {
    let count = (SIZE[0] * SIZE[1]) as u32;
    let list = channels.iter().zip(1_u32..).map(|(&name, factor)| {
        let samples = match name {
            "R" => {
                FlatSamples::F16((0..count).map(|i| f16::from_f32((i * factor) as f32)).collect())
            }
            "G" => FlatSamples::U32((0..count).map(|i| i * factor).collect()),
            _ => FlatSamples::F32((0..count).map(|i| (i * factor) as f32).collect()),
        };
        AnyChannel::new(name, samples)
    });
    let attributes = LayerAttributes::named(name);
    Layer::new(Vec2(SIZE[0], SIZE[1]), attributes, encoding, AnyChannels::sort(list.collect()))
}
