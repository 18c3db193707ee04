//! Rays per second on one core in a closed room of 284 810 triangles, and the time to build its
//! hierarchy. `scripts/compare-embree` sets the same rays against Embree.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod room;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use manylights_scene::bvh::Bvh;

fn rays(criterion: &mut Criterion) {
    let scene = room::scene();
    assert_eq!(scene.triangles.len(), 284_810);
    let bvh = Bvh::build(&scene);
    let [primary, diffuse, any_hit] = room::rays(&scene, &bvh);
    let mut group = criterion.benchmark_group("rays");
    group.sample_size(10);
    group.throughput(Throughput::Elements(u64::from(room::SIDE * room::SIDE)));
    for (name, rays) in [(room::SETS[0], &primary), (room::SETS[1], &diffuse)] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| rays.iter().filter_map(|ray| bvh.closest(black_box(ray))).count());
        });
    }
    group.bench_function(room::SETS[2], |bencher| {
        bencher.iter(|| any_hit.iter().filter(|ray| bvh.occluded(black_box(ray))).count());
    });
    group.finish();

    let mut group = criterion.benchmark_group("build");
    group.sample_size(10);
    group.throughput(Throughput::Elements(scene.triangles.len() as u64));
    group.bench_function("triangles", |bencher| bencher.iter(|| Bvh::build(black_box(&scene))));
    group.finish();
}

criterion_group!(benches, rays);
criterion_main!(benches);
