//! Hard cases of virtual lights: the adapter's f32 against the f64 oracle of each method, over the same
//! families of light and surface, written to `results/stability/{vpl,vsl,hvl,vsgl}.md`. Run with
//! `cargo run --release -p manylights-tests --example virtual_light_stability`.

mod families;
mod methods;

use std::fmt::Write as _;

use manylights_gpu::{AdapterReport, Gpu};
use manylights_tests::GPU;

use families::{Family, families};
use methods::{SUBJECTS, Subject};

/// What a family, or one pair of it, has shown.
struct Outcome {
    /// Largest relative error of each column.
    errors: Vec<f64>,
    /// Largest true radiance, W·m⁻²·sr⁻¹.
    largest: f64,
    non_finite: usize,
}

impl Outcome {
    fn of(gpu: &Gpu, subject: &Subject, family: &Family) -> Self {
        let errors = vec![0.0; subject.columns.len()];
        let mut all = Self { errors, largest: 0.0, non_finite: 0 };
        for pair in &family.pairs {
            let one = (subject.measure)(gpu, pair, family.camera);
            for (worst, error) in all.errors.iter_mut().zip(one.errors) {
                *worst = worst.max(error);
            }
            all.largest = all.largest.max(one.largest);
            all.non_finite += one.non_finite;
        }
        all
    }
}

/// The table of a method, and whether all values are finite.
fn table(gpu: &Gpu, subject: &Subject) -> (String, bool) {
    let AdapterReport { name, driver, driver_info, .. } = gpu.report();
    let columns = subject.columns;
    let mut table = format!(
        "# {}: hard cases\n\n\
         `cargo run --release -p manylights-tests --example virtual_light_stability` on {name} ({driver} \
         {driver_info}).\n\n\
         Largest difference of the adapter's f32 to the f64 oracle over each family of light and surface \
         pairs. {} The largest true radiance shows how hard the family is.\n\n\
         | family | pairs | {} | largest radiance | non-finite |\n|---|---|{}---|---|\n",
        subject.title,
        subject.notes,
        columns.join(" | "),
        "---|".repeat(columns.len()),
    );
    let mut finite = true;
    for family in families() {
        let Outcome { errors, largest, non_finite } = Outcome::of(gpu, subject, &family);
        finite &= non_finite == 0;
        let errors: Vec<_> = errors.iter().map(|error| format!("{error:.1e}")).collect();
        let (name, pairs, errors) = (&family.name, family.pairs.len(), errors.join(" | "));
        writeln!(table, "| {name} | {pairs} | {errors} | {largest:.1e} | {non_finite} |")
            .expect("writing to a string");
    }
    (table, finite)
}

fn main() {
    let folder = "results/stability";
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    let finite = SUBJECTS.map(|subject| {
        let (table, finite) = table(&GPU, &subject);
        std::fs::write(format!("{folder}/{}.md", subject.id), &table)
            .expect("the table can be written");
        print!("{table}");
        finite
    });
    assert_eq!(finite, [true; 4], "a hard case is not finite");
}
