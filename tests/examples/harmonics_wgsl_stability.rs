//! The generated WGSL on the adapter at hand against f64, written to
//! `results/stability/harmonics-wgsl.md`. Run with
//! `cargo run -p manylights-tests --example harmonics_wgsl_stability`.

#[path = "../tests/harmonics_wgsl/adapter.rs"]
mod adapter;

use std::fmt::Write as _;

use adapter::{GPU, gradients_error, scales_error, values_error};

fn main() {
    let report = GPU.report();
    let mut table = format!(
        "# Harmonics in WGSL: hard cases\n\n\
         `cargo run -p manylights-tests --example harmonics_wgsl_stability` on {} ({} {}).\n\n\
         Worst error in f32 against f64: values and gradients relative to the largest of their band \
         in that direction, at poles, axes, around them and between; cap scales relative to c_0, r/d \
         from 1 to 1e-6.\n\n\
         | bands | values | gradients | cap scales |\n|---|---|---|---|\n",
        report.name, report.driver, report.driver_info
    );
    let mut failed = false;
    for bands in [2, 3, 4, 5, 6, 8, 9, 10, 12] {
        let (values, gradients) = (values_error(bands), gradients_error(bands));
        let scales = scales_error(bands);
        failed |= values > 1e-5 || gradients > 1e-5 || scales > 1e-6;
        writeln!(table, "| {bands} | {values:.1e} | {gradients:.1e} | {scales:.1e} |")
            .expect("writing to a string");
        eprintln!("{bands} bands");
    }
    let folder = "results/stability";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/harmonics-wgsl.md"), &table)
        .expect("the table can be written");
    print!("{table}");
    assert!(!failed, "a form left its bound");
}
