//! Hard cases of each form in f32 against f64, written to `results/stability/harmonics.md`. Run with
//! `cargo run --release -p manylights-harmonics --example harmonics_stability`.

mod basis;
mod cap;
mod fit;
#[path = "../../tests/unit/mod.rs"]
mod unit;

use std::fmt::Write as _;

/// Worst error of a form over a family of cases.
#[derive(Clone, Copy, Default)]
struct Worst {
    error: f64,
    non_finite: usize,
}

impl Worst {
    /// Takes |value − truth| relative to `scale` into account.
    fn add(&mut self, value: f64, truth: f64, scale: f64) {
        if !value.is_finite() {
            self.non_finite += 1;
        } else if value != truth {
            self.error = self.error.max((value - truth).abs() / scale);
        }
    }

    /// Values against truths, relative to the largest truth.
    fn add_all(&mut self, values: &[f32], truths: &[f64]) {
        let scale = truths.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for (&value, &truth) in values.iter().zip(truths) {
            self.add(f64::from(value), truth, scale);
        }
    }

    /// As [`Self::add_all`], but coefficients of each band relative to that band.
    fn add_bands(&mut self, values: &[f32], truths: &[f64]) {
        for l in 0..truths.len().isqrt() {
            let band = l * l..(l + 1) * (l + 1);
            self.add_all(&values[band.clone()], &truths[band]);
        }
    }
}

impl std::fmt::Display for Worst {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.non_finite {
            0 => write!(f, "{:.1e}", self.error),
            count => write!(f, "{:.1e}, {count} not finite", self.error),
        }
    }
}

/// A table in Markdown; the stable form is the last column, and must stay below `bound`.
struct Table {
    text: String,
    bound: f64,
    failed: bool,
}

impl Table {
    fn new(title: &str, about: &str, columns: &[&str], bound: f64) -> Self {
        let rule = "---|".repeat(columns.len());
        let columns = columns.join(" | ");
        let text = format!("\n## {title}\n\n{about}\n\n| {columns} |\n|{rule}\n");
        Self { text, bound, failed: false }
    }

    /// `None` where a form has no such case.
    fn row(&mut self, case: &str, forms: &[Option<Worst>]) {
        let cells: Vec<_> =
            forms.iter().map(|form| form.map_or("–".to_owned(), |w| w.to_string())).collect();
        writeln!(self.text, "| {case} | {} |", cells.join(" | ")).expect("writing to a string");
        if let Some(Some(stable)) = forms.last() {
            self.failed |= stable.non_finite > 0 || stable.error > self.bound;
        }
    }
}

fn main() {
    let tables = [
        basis::values(),
        basis::gradients(),
        basis::hemispherical(),
        cap::scales(),
        cap::rates(),
        fit::conditions(),
    ];
    let mut text = String::from(
        "# Harmonics: hard cases in f32\n\n\
         `cargo run --release -p manylights-harmonics --example harmonics_stability`; the command fails where \
         the last column of a table leaves its bound or is not finite. The same for WGSL: \
         `harmonics-wgsl.md`.\n",
    );
    tables.iter().for_each(|table| text.push_str(&table.text));
    let folder = "results/stability";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(format!("{folder}/harmonics.md"), &text).expect("the table can be written");
    print!("{text}");
    assert!(!tables.iter().any(|table| table.failed), "a stable form left its bound");
}
