//! All metrics of one pair of pictures of 1280 × 1024 pixels; SSIM is most of the time.

use criterion::{Criterion, criterion_group, criterion_main};
use manylights_metrics::{RadianceImage, compare};

fn picture(factor: usize) -> RadianceImage {
    let mut image = RadianceImage::black(1280, 1024);
    for (index, c) in image.pixels.as_flattened_mut().iter_mut().enumerate() {
        *c = (index * factor % 251) as f32 / 251.0;
    }
    image
}

fn bench(criterion: &mut Criterion) {
    let (image, reference) = (picture(7), picture(11));
    let mut group = criterion.benchmark_group("compare");
    group.sample_size(10);
    group.bench_function("1280x1024", |bencher| bencher.iter(|| compare(&image, &reference, 1.0)));
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
