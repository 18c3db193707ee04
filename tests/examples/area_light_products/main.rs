//! Thesis table 4.2 and figure 4.2 here: what each way from a light's coefficients to radiance takes, beside
//! the full lobe; written to `results/throughput/area-light-products.md`. Run with
//! `cargo run --release -p manylights-tests --example area_light_products`.

mod lights;
#[path = "../virtual_light_throughput/peak.rs"]
mod peak;
mod setting;

use std::fmt::Write as _;

use manylights_gpu::{AdapterReport, operations};
use manylights_reflectance::{CosineProduct, Materials, ReceiverKinds};
use manylights_spherical_light::{Product, Settings, linked_shader};
use manylights_tests::{GPU, Stage};

use setting::{RESOLUTION, ROUNDS, Variant, medians, scene, shaded};

const BANDS: [usize; 4] = [3, 5, 7, 9];
const LIGHTS: [u32; 2] = [1, 32];

/// Words of the parameter `product`, and the thesis' times at 3, 5, 7 and 9 bands, ms.
const WAYS: [(&str, Product, Option<[f64; 4]>); 6] = [
    ("general", Product::Cosine(CosineProduct::General), Some([1.65, 6.92, 183.54, 836.34])),
    ("4.5", Product::Cosine(CosineProduct::Folded), Some([1.65, 6.42, 128.22, 590.13])),
    ("4.5-cut", Product::Cosine(CosineProduct::FoldedCut), Some([1.63, 3.78, 41.54, 289.88])),
    ("4.6-rotated", Product::Cosine(CosineProduct::Turned), Some([1.59, 2.19, 5.08, 15.78])),
    ("4.6", Product::Cosine(CosineProduct::Local), Some([1.46, 1.78, 2.92, 6.09])),
    ("full", Product::Full, None),
];

/// A way with a number of bands, its tables made.
struct Column {
    way: usize,
    bands: usize,
    variant: Variant,
}

fn columns(stage: &Stage) -> Vec<Column> {
    let mut columns = Vec::new();
    for bands in BANDS {
        for (way, (word, ..)) in WAYS.iter().enumerate() {
            let texts = [("bands", &*bands.to_string()), ("product", word)];
            columns.push(Column { way, bands, variant: Variant::new(stage, &texts) });
        }
    }
    columns
}

/// On floats, of a pixel under so many lights: what each light adds, and what their sum becomes.
fn floats(kinds: ReceiverKinds, column: &Column, lights: u32) -> u64 {
    let (_, product, _) = WAYS[column.way];
    let settings = Settings { bands: column.bands, product, ..Settings::default() };
    let shader = linked_shader(kinds, &settings).expect("it links");
    let of = |function: &str| {
        let found = operations(&shader.wgsl, function, 1).expect("it has the function");
        found.simple + found.special
    };
    of("package_estimator__1add_light") * u64::from(lights) + of("package_estimator_radiance")
}

/// A line a column.
fn lines(stage: &Stage, lights: u32, columns: &[Column], peak: f64) -> String {
    let kinds = Materials::of_scene(&stage.scene).kinds();
    let counts: Vec<_> = columns.iter().map(|column| floats(kinds, column, lights)).collect();
    let variants: Vec<_> = columns.iter().map(|column| (stage, &column.variant)).collect();
    let seconds = medians(&variants);
    let pixels = shaded(stage);
    let mut text = String::new();
    for ((column, &time), count) in columns.iter().zip(&seconds).zip(counts) {
        let (word, _, thesis) = WAYS[column.way];
        let same = |word| {
            let found = columns
                .iter()
                .position(|other| other.bands == column.bands && WAYS[other.way].0 == word);
            time / seconds[found.expect("every way has every number of bands")]
        };
        let band = BANDS.iter().position(|&bands| bands == column.bands).expect("one of them");
        let published = thesis.map_or("–".to_owned(), |times| {
            let local = WAYS[4].2.expect("printed")[band];
            format!("{} | {:.2}", times[band], times[band] / local)
        });
        let published = if thesis.is_none() { "– | –".to_owned() } else { published };
        writeln!(
            text,
            "| {} | {word} | {:.0} | {:.2} | {:.2} | {count} | {:.0} % | {published} |",
            column.bands,
            1e9 * time / pixels,
            same("4.6"),
            same("full"),
            100.0 * count as f64 * pixels / time / peak,
        )
        .expect("writing to a string");
    }
    text
}

/// Figure 4.2: a line a number of bands.
fn counts() -> String {
    let mut text = "| bands |".to_owned();
    for (word, ..) in &WAYS[..5] {
        write!(text, " {word} |").expect("writing to a string");
    }
    text += "\n|---|---|---|---|---|---|\n";
    for bands in 2..=9 {
        write!(text, "| {bands} |").expect("writing to a string");
        for (_, product, _) in &WAYS[..5] {
            let Product::Cosine(product) = product else { continue };
            let found = product.operations(bands);
            write!(text, " {} |", found.additions + found.multiplications)
                .expect("writing to a string");
        }
        text.push('\n');
    }
    text
}

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let peak = peak::operations_a_second(&GPU);
    let mut text = format!(
        "# Products of light and cosine\n\n\
         `cargo run --release -p manylights-tests --example area_light_products` on {name} ({driver} \
         {driver_info}).\n\n\
         `spherical-light` on `trio`, glossy all over, {}×{} pixels: the gather pass, which sums the lights' \
         coefficients at every pixel and shades once; `full` shades light by light. Median of {ROUNDS} \
         interleaved rounds. All ways are straight lines of WGSL. Operations are those on floats in the \
         linked shader for a pixel under all lights, without the fetch of its lobe; the peak is that of \
         multiplications and additions that wait for nothing: {:.1} G operations/s. The thesis' table 4.2 \
         has whole frames on an RTX 2080.\n",
        RESOLUTION[0],
        RESOLUTION[1],
        peak / 1e9,
    );
    for lights in LIGHTS {
        let stage = Stage::new(scene(lights), RESOLUTION);
        let columns = columns(&stage);
        write!(
            text,
            "\n## Lights: {lights}\n\n\
             | bands | product | ns a pixel | ÷ 4.6 | ÷ full | operations | of the peak | thesis ms | ÷ 4.6 |\n\
             |---|---|---|---|---|---|---|---|---|\n{}",
            lines(&stage, lights, &columns, peak),
        )
        .expect("writing to a string");
    }
    write!(
        text,
        "\n## Operations of the product for one channel (figure 4.2)\n\n\
         With the Y_lm of the normal where it needs them; turned to the surface's frame: the half even in y \
         alone, which is all that an isotropic lobe meets.\n\n{}",
        counts(),
    )
    .expect("writing to a string");
    text += &lights::section();
    let folder = "results/throughput";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/area-light-products.md"), &text)
        .expect("the table can be written");
    print!("{text}");
}
