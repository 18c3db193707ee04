//! Prints how many additions and multiplications each form of the cap's scales and of their rates
//! takes, by running the library's code on a counting scalar:
//!
//! `cargo run --release --example operations -p manylights-harmonics > results/sh-speed/operations.md`

mod counted;

use counted::{Counted, Operations, count};
use manylights_harmonics::zonal::{self, Cap, Sighting};
use manylights_harmonics::{MAX_BANDS, Real, rotation};

type Form = fn(Cap<Counted>, &mut [Counted]);
type RateForm = fn(Cap<Counted>, Counted, &mut [Counted]);

/// Name of a form, its bands, its code.
const FORMS: [(&str, usize, Form); 3] = [
    ("closed (Sloan 2008)", zonal::CLOSED_FORM_BANDS, zonal::cap_sloan),
    ("recurrence (thesis 3.10)", MAX_BANDS, zonal::cap_thesis),
    ("stable", MAX_BANDS, zonal::cap_stable),
];

const RATE_FORMS: [(&str, usize, RateForm); 3] = [
    ("closed, differentiated", zonal::CLOSED_FORM_BANDS, zonal::cap_rate_sloan),
    ("thesis 3.30–3.32", MAX_BANDS, zonal::cap_rate_thesis),
    ("stable", MAX_BANDS, zonal::cap_rate_stable),
];

const BANDS: [usize; 11] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 30];

fn main() {
    let sighting = Sighting::of_sphere([0.0, 0.0, 2.0].map(Counted), Counted(1.0));
    let sighting = sighting.expect("a light at a distance has a direction");
    println!("# Operations of spherical lights\n");
    println!(
        "Additions/multiplications of the crate's own code, run on a counting scalar (command: \
         `examples/operations`). Subtractions are additions; negations and constants are free. \
         Given are sine and cosine of the cap; the squares that a form needs are counted.\n"
    );
    println!("## Scales of a cap\n");
    table(FORMS.map(|(name, most, form)| {
        (name, most, move |out: &mut [Counted]| form(sighting.cap, out))
    }));
    println!(
        "\nThe papers count 3/5 (closed) against 3/6 (recurrence) at 3 bands and 13/19 against 6/18 \
         at 6 (JFIG, section 3). Ours differ: closed forms share their factors and use Horner's \
         rule, so they need fewer; in the recurrence every Legendre polynomial up to l = n is \
         computed, two multiplications more a band than a count of the differences alone.\n"
    );
    println!("## Rates of change with the distance\n");
    table(RATE_FORMS.map(|(name, most, form)| {
        let rate = sighting.cosine_rate;
        (name, most, move |out: &mut [Counted]| form(sighting.cap, rate, out))
    }));
    println!("\n## Rotations of all coefficients\n");
    println!("| bands | about z | zxzxz | by blocks | filling the blocks |\n|---|---|---|---|---|");
    for bands in BANDS {
        println!("| {bands} | {} |", rotations(bands).map(|cost| cost.to_string()).join(" | "));
    }
}

/// A row a number of bands, a column a form.
fn table<F: Fn(&mut [Counted])>(forms: [(&str, usize, F); 3]) {
    println!("| bands | {} |", forms.each_ref().map(|form| form.0).join(" | "));
    println!("|---|---|---|---|");
    for bands in BANDS {
        let cells = forms.each_ref().map(|(_, most, form)| {
            if bands > *most {
                return "—".to_owned();
            }
            let mut out = vec![Counted(0.0); bands];
            count(|| form(&mut out)).to_string()
        });
        println!("| {bands} | {} |", cells.join(" | "));
    }
}

/// What the ways to turn all coefficients cost.
fn rotations(bands: usize) -> [Operations; 4] {
    let angle = [0.6, 0.8].map(Counted);
    let matrix = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]
        .map(|row: [f64; 3]| row.map(Counted::of));
    let mut values = vec![Counted(1.0); bands * bands];
    let mut scratch = values.clone();
    let zxzxz = rotation::Zxzxz::new(bands);
    let mut blocks = rotation::Blocks::new(bands);
    [
        count(|| rotation::rotate_z(bands, angle, &mut values)),
        count(|| zxzxz.apply(matrix, &mut values, &mut scratch)),
        count(|| blocks.apply(&values, &mut scratch)),
        count(|| blocks.set(matrix)),
    ]
}
