//! What families show of a method, as a table.

use std::fmt::Write as _;

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_scene::AreaLight;

use crate::families::{Family, materials};

/// Share of what a light could send at most, below which nobody asks for digits: tails of narrow lobes, what bands
/// leak below the horizon, lights without area.
pub(crate) const DARK: f64 = 1e-3;

/// Radiances of surfaces that a camera sees under lights, by the adapter and by the oracle.
pub(crate) type Radiances =
    Box<dyn Fn(&[SurfaceRecord], Vec3, &[AreaLight]) -> (Vec<[f32; 3]>, Vec<DVec3>)>;

/// One choice of a method's parameters.
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) radiances: Radiances,
}

/// Relative to the largest truth of a path on one material, or to `DARK` where that is less.
#[derive(Clone, Copy, Default)]
struct Outcome {
    error: f64,
    /// The largest difference of two neighbours, the adapter's and the oracle's.
    steps: [f64; 2],
    /// The largest change of the error between two neighbours.
    own_step: f64,
    non_finite: usize,
    negative: usize,
}

impl Outcome {
    fn of(pairs: &[[f64; 2]]) -> Self {
        let largest = pairs.iter().map(|pair| pair[1].abs()).fold(DARK, f64::max);
        let errors = pairs.iter().map(|pair| (pair[0] - pair[1]).abs() / largest);
        let mut outcome = Self { error: errors.fold(0.0, f64::max), ..Self::default() };
        for pair in pairs {
            outcome.non_finite += pair.iter().filter(|value| !value.is_finite()).count();
            outcome.negative += usize::from(pair[0] < 0.0);
        }
        for neighbours in pairs.windows(2) {
            let [adapter, oracle] = [0, 1].map(|k| (neighbours[1][k] - neighbours[0][k]) / largest);
            outcome.steps =
                [outcome.steps[0].max(adapter.abs()), outcome.steps[1].max(oracle.abs())];
            outcome.own_step = outcome.own_step.max((adapter - oracle).abs());
        }
        outcome
    }

    fn worse(self, other: Self) -> Self {
        Self {
            error: self.error.max(other.error),
            steps: if other.steps[0] > self.steps[0] { other.steps } else { self.steps },
            own_step: self.own_step.max(other.own_step),
            non_finite: self.non_finite + other.non_finite,
            negative: self.negative + other.negative,
        }
    }
}

fn outcome(family: &Family, column: &Column) -> Outcome {
    let mut all = Outcome::default();
    for brdfs in materials() {
        let surfaces: Vec<_> = brdfs.iter().flat_map(|&brdf| family.surfaces(brdf)).collect();
        let (found, truth) = (column.radiances)(&surfaces, family.camera(), &family.lights());
        let of_places = surfaces.len() / brdfs.len();
        let all_found = found.chunks(of_places).zip(truth.chunks(of_places));
        for (found, truth) in all_found {
            let values = found.iter().zip(truth).zip(family.covered());
            let pairs: Vec<_> = values
                .map(|((found, truth), covered)| {
                    [f64::from(found[0]), truth.x].map(|value| value / covered)
                })
                .collect();
            all = all.worse(Outcome::of(&pairs));
        }
    }
    all
}

/// Of all columns, with the steps of the first one; whether all is finite. Negative values are counted where
/// they may not be.
pub(crate) fn table(
    columns: &[Column],
    families: &[Family],
    never_negative: bool,
) -> (String, bool) {
    let names: Vec<_> = columns.iter().map(|column| column.name).collect();
    let negative = if never_negative { " negative |" } else { "" };
    let mut text = format!(
        "| path | {} | step | oracle's step | step of the difference | non-finite |{negative}\n|{}\n",
        names.join(" | "),
        "---|".repeat(names.len() + if never_negative { 6 } else { 5 }),
    );
    let mut sound = true;
    for family in families {
        let outcomes: Vec<_> = columns.iter().map(|column| outcome(family, column)).collect();
        let all = outcomes.iter().copied().reduce(Outcome::worse).expect("a column");
        sound &= all.non_finite == 0 && !(never_negative && all.negative > 0);
        let errors: Vec<_> =
            outcomes.iter().map(|outcome| format!("{:.1e}", outcome.error)).collect();
        let [adapter, oracle] = outcomes[0].steps;
        let steps = match family.is_path {
            true => [adapter, oracle, all.own_step].map(|step| format!("{step:.1e}")).join(" | "),
            false => "– | – | –".to_owned(),
        };
        let (name, errors, non_finite) = (family.name, errors.join(" | "), all.non_finite);
        write!(text, "| {name} | {errors} | {steps} | {non_finite} |")
            .expect("writing to a string");
        if never_negative {
            write!(text, " {} |", all.negative).expect("writing to a string");
        }
        text.push('\n');
    }
    (text, sound)
}
