//! The adapter's arithmetic, by a kernel that does nothing else.

use manylights_gpu::{Binding, Gpu, Resource};

/// Chains of multiplication and addition that do not wait for each other: more hide what an operation
/// takes, but need registers.
const CHAINS: [usize; 4] = [1, 2, 4, 8];
/// Steps of each chain a turn of the loop, which costs more than they do.
const STEPS: usize = 64;
const TURNS: u64 = 64;
const GROUPS: u32 = 1024;
const LANES: u64 = 64;
const ROUNDS: usize = 4;

/// Multiplications and additions of single floats a second, by the number of chains that does best.
pub(crate) fn operations_a_second(gpu: &Gpu) -> f64 {
    CHAINS.map(|chains| with_chains(gpu, chains)).into_iter().fold(0.0, f64::max)
}

/// The best of some rounds.
fn with_chains(gpu: &Gpu, chains: usize) -> f64 {
    let each = |text: &dyn Fn(usize) -> String| (0..chains).map(text).collect::<String>();
    let shader = format!(
        "@group(0) @binding(0) var<uniform> step: vec4f;\n\
         @group(0) @binding(1) var<storage, read_write> sums: array<f32>;\n\
         @compute @workgroup_size({LANES})\n\
         fn main(@builtin(global_invocation_id) id: vec3u) {{\n\
         let start = f32(id.x) * 1e-6;\n{}\
         for (var i = 0u; i < {TURNS}u; i++) {{\n{}}}\n\
         sums[id.x] = 0.0{};\n}}\n",
        each(&|k| format!("var a{k} = start + {k}.0;\n")),
        each(&|k| format!("a{k} = a{k} * step.x + step.y;\n")).repeat(STEPS),
        each(&|k| format!(" + a{k}")),
    );
    let bindings = [Binding::Uniform, Binding::StorageMut];
    let kernel = gpu.kernel("peak", &shader, &bindings).expect("the adapter compiles it");
    let step = gpu.uniform("step", &[0.5_f32; 4]).expect("memory");
    let sums = gpu.zeroed("sums", u64::from(GROUPS) * LANES * 4).expect("memory");
    let resources = [Resource::Buffer(&step), Resource::Buffer(&sums)];
    let pass = gpu.pass("peak", &kernel, &resources).expect("it fits");
    // The first one compiles.
    let round = |_| gpu.run(&[pass.over([GROUPS, 1, 1])]).expect("a pass")[0].seconds;
    let fastest = (0..=ROUNDS).map(round).fold(f64::MAX, f64::min);
    let operations = 2 * u64::from(GROUPS) * LANES * TURNS * (STEPS * chains) as u64;
    operations as f64 / fastest
}
