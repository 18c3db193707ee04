//! One line of `cells.jsonl`: a run of one variant on one scene, with all that it depends on.

use std::collections::BTreeMap;

use manylights_metrics::{Errors, RadianceImage};
use serde::{Deserialize, Serialize, Serializer};

use crate::error::one_line;
use crate::measurement::inputs::Inputs;
use crate::measurement::provenance::{Provenance, sha256};
use crate::measurement::tiles::Tiles;
use crate::measurement::versions::Versions;

/// Of the lines that are written. Raised when a program of an older format would misread them; fields that
/// it may ignore, and fields that have a default where they are missing, are no reason.
///
/// | format | lines |
/// |---|---|
/// | 1 | without `format` and `versions`; keys hash the program, and name the pictures still |
/// | 2 | keys hash [`versions`](crate::measurement::versions) instead |
pub(crate) const FORMAT: u32 = 2;

/// A finished cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Cell {
    /// See [`FORMAT`].
    #[serde(default = "first_format")]
    pub(crate) format: u32,
    /// See [`Inputs::key`].
    pub(crate) key: String,
    /// What was asked.
    #[serde(flatten)]
    pub(crate) inputs: Inputs,
    /// What came out.
    #[serde(flatten)]
    pub(crate) outcome: Outcome,
    /// Of what computed it.
    #[serde(default)]
    pub(crate) versions: Versions,
    /// Program and machine.
    pub(crate) provenance: Provenance,
}

impl Cell {
    /// In the format of today.
    pub(crate) fn new(
        inputs: Inputs,
        outcome: Outcome,
        versions: Versions,
        provenance: Provenance,
    ) -> Self {
        let key = inputs.key(&versions, &provenance);
        Self { format: FORMAT, key, inputs, outcome, versions, provenance }
    }
}

/// What lines have that name no format.
pub(crate) fn first_format() -> u32 {
    1
}

/// How a cell ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "outcome", rename_all = "lowercase")]
pub(crate) enum Outcome {
    /// With a picture.
    Done(Box<Done>),
    /// The scene or the transport is not the method's.
    Declined {
        /// In words.
        reason: String,
    },
    /// The device gave up, or pixels are not finite: the comparison fails.
    Failed {
        /// In words.
        reason: String,
    },
}

impl Outcome {
    /// Of a run that ended before it had a picture.
    pub(crate) fn refused(error: manylights_method::Error) -> Self {
        match error {
            manylights_method::Error::Declined(reason) => {
                Self::Declined { reason: one_line(&reason) }
            }
            manylights_method::Error::Failed(reason) => Self::Failed { reason: one_line(&reason) },
        }
    }
}

/// Times, counts and errors of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Done {
    /// Value of the method's cost parameter, where it has one: as asked for, or as found for a time budget.
    #[serde(default, serialize_with = "optional_number", skip_serializing_if = "Option::is_none")]
    pub(crate) amount: Option<f64>,
    /// Visibility of the last segment that the method computes, where it is a choice.
    #[serde(default)]
    pub(crate) visibility: Option<String>,
    /// Wall clock of what was baked, or grown for this camera; 0 where nothing is.
    #[serde(default)]
    pub(crate) bake_seconds: f64,
    /// The same by pass, by the processor's own clock.
    #[serde(default)]
    pub(crate) bake_pass_seconds: BTreeMap<String, f64>,
    /// What the bake counted.
    #[serde(default)]
    pub(crate) bake_counters: BTreeMap<String, u64>,
    /// Whether an earlier cell was baked so: both tell the same time, which was taken once.
    #[serde(default)]
    pub(crate) bake_shared: bool,
    /// Wall clock of what does not depend on the amount of work.
    pub(crate) prepare_seconds: f64,
    /// Wall clock of the work. Warmed up; without read-back, metrics and files.
    pub(crate) step_seconds: f64,
    /// By the processor's own clock.
    #[serde(default)]
    pub(crate) pass_seconds: BTreeMap<String, f64>,
    /// What the method counted.
    #[serde(default)]
    pub(crate) counters: BTreeMap<String, u64>,
    /// Of the pixels' bits, row by row, little endian.
    pub(crate) image_sha256: String,
    /// By name of the reference.
    pub(crate) errors: BTreeMap<String, Comparison>,
    /// The way to the picture, at doubling amounts, where the method is progressive.
    #[serde(default)]
    pub(crate) checkpoints: Vec<Checkpoint>,
}

/// A progressive run that was looked at on its way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// Work done, in units of the cost parameter.
    #[serde(serialize_with = "number")]
    pub(crate) amount: f64,
    /// Wall clock of the work so far.
    pub(crate) step_seconds: f64,
    /// RMSE of sRGB values by name of the reference.
    pub(crate) display_rmse: BTreeMap<String, f64>,
}

/// Errors against one reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Comparison {
    /// Of radiance, W·m⁻²·sr⁻¹.
    pub(crate) linear: Errors,
    /// Of sRGB values at the scene's exposure.
    pub(crate) display: Errors,
    /// Noise of the reference, as RMSE of radiance; zero where another method is the reference.
    pub(crate) linear_floor: f64,
    /// Noise of the reference, as RMSE of sRGB values.
    pub(crate) display_floor: f64,
    /// Of the first of a seed's repetitions, which all have the same picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) tiles: Option<Tiles>,
}

/// Counts without a decimal point.
fn number<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    match *value as u64 {
        whole if whole as f64 == *value => serializer.serialize_u64(whole),
        _ => serializer.serialize_f64(*value),
    }
}

fn optional_number<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => number(value, serializer),
        None => serializer.serialize_none(),
    }
}

/// Hash of the bits of a picture.
pub(crate) fn image_sha256(image: &RadianceImage) -> String {
    let bytes: Vec<u8> =
        image.pixels.iter().flatten().flat_map(|component| component.to_le_bytes()).collect();
    sha256(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::inputs::ReferenceInputs;
    use crate::question::plan::{Bounded, Budget};
    use crate::question::recorded_value::RecordedValue;

    fn inputs() -> Inputs {
        Inputs {
            scene: "s".into(),
            scene_content: "c".into(),
            method: "m".into(),
            parameters: BTreeMap::from([
                ("n".into(), RecordedValue::Number(4.0)),
                ("w".into(), RecordedValue::Word("hann".into())),
            ]),
            budget: Budget::Seconds(0.1),
            seed: 1,
            repetition: 0,
            transport: "all".into(),
            asked_visibility: Some("ignored".into()),
            resolution: [16, 16],
            exposure: 1.5,
            references: BTreeMap::from([
                ("traced".into(), ReferenceInputs::Samples(16)),
                (
                    "per-pixel".into(),
                    ReferenceInputs::Method {
                        method: "m".into(),
                        parameters: BTreeMap::from([("n".into(), RecordedValue::Number(0.5))]),
                        asked_visibility: None,
                    },
                ),
            ]),
            bounded: Bounded::TotalTime,
            camera: Some("side".into()),
        }
    }

    #[test]
    fn a_cell_survives_the_journal() {
        let errors = Errors {
            rmse: 0.1,
            mse: 0.01,
            mae: 0.1,
            psnr: f64::INFINITY,
            ssim: 0.5,
            rel_mse: 0.3,
            smape: 0.2,
            rel_p999: 0.9,
            rel_mse_trimmed: Some(0.2),
            flip: None,
        };
        let comparison = Comparison {
            linear: errors,
            display: errors,
            linear_floor: 1e-3,
            display_floor: 1e-4,
            tiles: None,
        };
        let checkpoint = Checkpoint {
            amount: 16.0,
            step_seconds: 0.01,
            display_rmse: BTreeMap::from([("traced".into(), 0.1)]),
        };
        let done = Done {
            amount: Some(0.1 + 0.2),
            visibility: Some("traced".into()),
            bake_seconds: 0.5,
            bake_pass_seconds: BTreeMap::from([("grid".into(), 0.375)]),
            bake_counters: BTreeMap::from([("records".into(), 7)]),
            bake_shared: true,
            prepare_seconds: 0.25,
            step_seconds: 0.1 + 0.2,
            pass_seconds: BTreeMap::from([("gather".into(), 0.125)]),
            counters: BTreeMap::from([("rays".into(), u64::MAX)]),
            image_sha256: image_sha256(&RadianceImage::black(1, 1)),
            errors: BTreeMap::from([("traced".into(), comparison)]),
            checkpoints: vec![checkpoint],
        };
        let provenance = Provenance::here(None);
        let outcome = Outcome::Done(Box::new(done));
        let cell = Cell::new(inputs(), outcome, Versions::new(), provenance);
        let line = serde_json::to_string(&cell).expect("plain data");
        assert!(!line.contains('\n'));
        assert!(line.contains(r#""amount":16,"#), "{line}");
        assert_eq!(serde_json::from_str::<Cell>(&line).expect("own line"), cell);
    }

    #[test]
    fn the_key_depends_on_inputs_versions_and_machine_not_on_the_build() {
        let here = Provenance::here(None);
        let other_seed = Inputs { seed: 2, ..inputs() };
        let other_build = Provenance {
            program: "another".into(),
            commit: Some("another".into()),
            rustc: "another".into(),
            ..here.clone()
        };
        let other_machine = Provenance { machine: "another".into(), ..here.clone() };
        let first = Versions::from([("method".into(), 1)]);
        let second = Versions::from([("method".into(), 2)]);
        let key = inputs().key(&first, &here);
        assert_eq!(key, inputs().key(&first, &other_build));
        assert_ne!(key, other_seed.key(&first, &here));
        assert_ne!(key, inputs().key(&second, &here));
        assert_ne!(key, inputs().key(&first, &other_machine));
    }
}
