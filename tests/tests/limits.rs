//! Devices with the limits that every adapter guarantees: all methods render with them, and what
//! exceeds them is answered in one line.

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use manylights_gpu::{Binding, Error, Gpu, GpuFrame, Kernel, Limits, Resource, UniformBatches};
use manylights_harness::registry::METHODS;
use manylights_method::{Frame, Parameters};
use manylights_scene::{Transport, Visibility};
use manylights_tests::{under_spheres, under_triangles};

static GPU: LazyLock<Gpu> = LazyLock::new(|| {
    Gpu::with_limits(None, Limits::Default).expect("an adapter: scripts/test installs one")
});

const RESOLUTION: [u32; 2] = [16, 12];

#[test]
fn every_method_renders_with_default_limits() {
    // What WebGPU guarantees, whatever the adapter offers.
    let opened = &GPU.report().limits;
    assert_eq!(opened["max_storage_buffer_binding_size"], 128 << 20);
    assert_eq!(opened["max_texture_dimension_2d"], 8192);
    let indirect = |visibility| Transport::Indirect { bounces: 1, visibility };
    let load = |name| manylights_scene::load(name, None).expect("built in");
    let direct = Transport::Direct { visibility: Visibility::Ignored };
    // As many lights as 50 × 50 texels, of two triangles each.
    let stages = [
        (load("cornell"), indirect(Visibility::Traced)),
        (load("trio"), indirect(Visibility::Ignored)),
        (under_spheres(2500), direct),
        (under_triangles(5000), direct),
    ];
    let mut rendered = BTreeSet::new();
    for (scene, transport) in &stages {
        let camera = &scene.cameras[0];
        let on_gpu = GpuFrame::new(&GPU, scene, camera, RESOLUTION).expect("the scene fits");
        let gpu = Some(&on_gpu);
        let frame =
            Frame { scene, camera, resolution: RESOLUTION, transport: *transport, seed: 0, gpu };
        for method in METHODS {
            let what = format!("{} on {}", method.id(), scene.name);
            let mut run = match method.prepare(&frame, &Parameters::defaults(method.parameters())) {
                Ok(run) => run,
                Err(manylights_method::Error::Declined(_)) => continue,
                Err(error) => panic!("{what}: {error}"),
            };
            while !run.step().expect("a step").finished() {}
            let image = run.resolve().expect("a picture");
            let sum: f32 = image.pixels.as_flattened().iter().sum();
            assert!(sum.is_finite() && sum > 0.0, "{what}: {sum}");
            rendered.insert(method.id());
        }
    }
    let all: BTreeSet<_> = METHODS.iter().map(|method| method.id()).collect();
    assert_eq!(rendered, all, "a method declines everything");
}

/// The one line of an error, which names what was needed, what is allowed and how to mend it.
fn refusal<T>(result: Result<T, Error>, words: &[&str]) {
    let line = result.err().expect("it exceeds the limits").to_string();
    assert!(!line.contains('\n'), "{line}");
    let common = ["needs", "MANYLIGHTS_LIMITS=default allows", "or the adapter's own limits"];
    for word in common.iter().chain(words) {
        assert!(line.contains(word), "`{word}` in: {line}");
    }
}

#[test]
fn a_buffer_that_is_too_large_is_answered_in_bytes() {
    let bytes = (128_u64 << 20) + 4;
    refusal(GPU.zeroed("a table", bytes), &["a table", "134217732 bytes", "134217728"]);
}

#[test]
fn a_picture_that_is_too_large_is_answered() {
    let scene = manylights_scene::load("cornell", None).expect("built in");
    let frame = |resolution| GpuFrame::new(&GPU, &scene, &scene.cameras[0], resolution);
    refusal(frame([8193, 1]), &["8193x1", "8193 texels a side", "8192", "lower resolution"]);
    // 64 bytes a pixel.
    refusal(frame([2048, 1025]), &["G-buffer", "134348800 bytes", "lower resolution"]);
}

#[test]
fn batches_that_are_too_large_are_answered_in_bytes() {
    let records = [[0_f32; 4]];
    let batches = UniformBatches::new(&GPU, "lights", &records, 4096, 1);
    refusal(batches, &["a batch of lights", "65552 bytes", "65536"]);
    // 8193 batches of 32 KiB, padded to the alignment.
    let records = vec![[0_f32; 4]; 8193];
    let batches = UniformBatches::new(&GPU, "lights", &records, 2047, 1);
    refusal(batches, &["lights needs 268468224 bytes", "268435456", "fewer lights"]);
}

fn nothing(bindings: &[Binding]) -> Result<Arc<Kernel>, Error> {
    GPU.kernel("nothing", "@compute @workgroup_size(1) fn nothing() {}", bindings)
}

#[test]
fn a_kernel_with_too_many_buffers_is_answered() {
    nothing(&[Binding::Storage; 8]).expect("eight are guaranteed");
    refusal(nothing(&[Binding::Storage; 9]), &["`nothing`", "9 storage buffers", "allows 8"]);
}

#[test]
fn too_many_workgroups_are_answered() {
    let buffer = GPU.zeroed("results", 16).expect("memory");
    let kernel = nothing(&[Binding::StorageMut]).expect("valid WGSL");
    let pass = GPU.pass("nothing", &kernel, &[Resource::Buffer(&buffer)]).expect("it fits");
    GPU.run(&[pass.over([65535, 1, 1])]).expect("so many are guaranteed");
    refusal(GPU.run(&[pass.over([1, 65536, 1])]), &["`nothing`", "65536 workgroups", "65535"]);
}
