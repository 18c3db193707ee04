//! A pass over points of any kind, with results of any size.

use manylights_gpu::{Gpu, PointBindings, PointPass, Table, UniformBatches, link};

/// Adds the weighted sum of a batch's records, as many powers of the point's coordinate as the table
/// has elements, but for records that the point does not see.
const SOURCE: &str = "
import package::bindings::{powers, settings};
import package::visible::is_visible;

struct Uniform { points: u32 }
struct Batch { count: u32, records: array<vec4f, 2> }

@group(0) @binding(0) var<uniform> all: Uniform;
@group(0) @binding(1) var<storage, read> points: array<f32>;
@group(0) @binding(2) var<uniform> batch: Batch;
@group(0) @binding(3) var<storage, read_write> results: array<f32>;

@compute @workgroup_size(2)
fn sums(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let point = 2u * group.x + lane;
    if (point >= all.points) { return; }
    for (var i = 0u; i < batch.count; i++) {
        if (!is_visible(point, all.points, i)) { continue; }
        for (var k = 0u; k < 3u; k++) {
            let value = settings.scale * batch.records[i].x * pow(points[point], powers[k]);
            results[3u * point + k] += value;
        }
    }
}
";

#[test]
fn results_of_three_floats_at_points_of_one_add_up_over_batches() {
    let gpu = Gpu::new(None).expect("an adapter: scripts/test installs one");
    let bindings = PointBindings {
        settings: &[("unused", "u32"), ("scale", "f32")],
        tables: vec![
            Table { name: "other", element: "vec4f" },
            Table { name: "powers", element: "f32" },
        ],
    };
    let wgsl = link("sums", SOURCE, &[("bindings", &bindings.module())], &[]).expect("links");
    let kernel = gpu.kernel("sums", &wgsl, &bindings.layout()).expect("valid WGSL");
    let storage = |data: &[f32]| gpu.storage("data", data).expect("memory");
    let own = vec![
        gpu.uniform("settings", &[0.0_f32, 2.0]).expect("memory"),
        storage(&[0.0; 4]),
        storage(&[0.0, 1.0, 2.0]),
    ];
    let points = [1.0_f32, 2.0, 3.0, 4.0, 5.0];
    // The second record of a batch is occluded from the last point.
    let occluded = gpu.storage("occluded", &[0_u32, 0, 0, 0, 0b10]).expect("memory");
    let count = points.len() as u32;
    let pass =
        PointPass::new(&gpu, "sums", (&storage(&points), count), 12, &count, Some(&occluded), own)
            .expect("memory");
    let records = [1.0_f32, 10.0, 100.0].map(|weight| [weight, 0.0, 0.0, 0.0]);
    let batches = UniformBatches::new(&gpu, "records", &records, 2, 2).expect("memory");
    let sums = pass.bind(&kernel, &batches).expect("it fits");
    let workgroups = pass.workgroups(2);
    let times =
        gpu.run(&[0, 1].map(|batch| sums.over_batch(batch, workgroups))).expect("two passes");
    assert_eq!(times.iter().map(|time| time.pass).collect::<Vec<_>>(), ["sums", "sums"]);
    let results: Vec<[f32; 3]> = pass.results().expect("read-back");
    for (point, result) in points.iter().zip(results) {
        let weight = if *point == 5.0 { 101.0 } else { 111.0 };
        for (power, value) in (0..).zip(result) {
            let expected = 2.0 * weight * point.powi(power);
            assert!((value / expected - 1.0).abs() < 1e-5, "{value} for {expected}");
        }
    }
}
