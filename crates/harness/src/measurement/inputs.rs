//! What a cell depends on.

use std::collections::BTreeMap;

use manylights_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::measurement::provenance::{Provenance, sha256};
use crate::question::experiment::Experiment;
use crate::question::plan::{Bounded, Budget, Variant};
use crate::question::recorded_value::RecordedValue;
use crate::question::references::{Reference, Source};

/// What decides the picture and its errors, and where its time was taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Inputs {
    /// Name of the scene.
    pub(crate) scene: String,
    /// Name of the camera, where the experiment lists some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) camera: Option<String>,
    /// Hash of its triangles, materials, lights and camera.
    pub(crate) scene_content: String,
    /// Method.
    pub(crate) method: String,
    /// Its parameters, without the one that a time budget sets.
    pub(crate) parameters: BTreeMap<String, RecordedValue>,
    /// What it may cost.
    pub(crate) budget: Budget,
    /// Which time a budget bounds.
    #[serde(default, skip_serializing_if = "Bounded::is_time")]
    pub(crate) bounded: Bounded,
    /// Same seed, same picture.
    pub(crate) seed: u64,
    /// Which of the timed runs.
    pub(crate) repetition: u32,
    /// Light paths.
    pub(crate) transport: String,
    /// Visibility of the last segment, where it is not the method's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) asked_visibility: Option<String>,
    /// Width, height in pixels.
    pub(crate) resolution: [u32; 2],
    /// Factor from radiance to display-referred values.
    pub(crate) exposure: f32,
    /// The references that it is compared with, by name.
    pub(crate) references: BTreeMap<String, ReferenceInputs>,
}

/// What a reference depends on, beside all that it shares with the cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum ReferenceInputs {
    /// Path traced with the visibility that names it: samples a pixel.
    Samples(u32),
    /// By another method, with the seed of the cell.
    Method {
        /// Its id.
        method: String,
        /// Its parameters.
        parameters: BTreeMap<String, RecordedValue>,
        /// Visibility of the last segment, where it is not the method's own.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        asked_visibility: Option<String>,
    },
}

impl ReferenceInputs {
    /// As asked for.
    pub(crate) fn new(reference: &Reference, samples: u32) -> Self {
        match &reference.source {
            Source::Paths(_) => Self::Samples(samples),
            Source::Method(variant) => Self::Method {
                method: variant.method.id().to_owned(),
                parameters: variant.given(),
                asked_visibility: variant.unusual_visibility().map(|chosen| chosen.to_string()),
            },
        }
    }

    /// Whether a reference of these inputs is one that was `asked` for: more samples are.
    pub(crate) fn serves(&self, asked: &Self) -> bool {
        match (self, asked) {
            (Self::Samples(samples), Self::Samples(asked)) => samples >= asked,
            _ => self == asked,
        }
    }
}

impl Inputs {
    /// Of a variant on a scene of this content, seen by a camera of the experiment's list where it has
    /// one, with the references that were asked for.
    pub(crate) fn new(
        experiment: &Experiment,
        scene: &Scene,
        camera: Option<&str>,
        content: &str,
        variant: &Variant,
    ) -> Self {
        let samples = experiment.scale.reference_samples;
        Self {
            scene: scene.name.clone(),
            camera: camera.map(str::to_owned),
            scene_content: content.to_owned(),
            method: variant.method.id().to_owned(),
            parameters: variant.given(),
            budget: variant.budget,
            bounded: variant.bounded,
            seed: 0,
            repetition: 0,
            transport: experiment.transport.to_string(),
            asked_visibility: variant.unusual_visibility().map(|visibility| visibility.to_string()),
            resolution: experiment.scale.resolution,
            exposure: scene.exposure,
            references: experiment
                .references
                .iter()
                .map(|reference| (reference.name.clone(), ReferenceInputs::new(reference, samples)))
                .collect(),
        }
    }

    /// Names what is asked, whoever answers: the same for all seeds and repetitions, which one
    /// machine must answer together, on every machine and in every build.
    pub(crate) fn question(&self) -> String {
        let asked = Self { seed: 0, repetition: 0, ..self.clone() };
        sha256(&serde_json::to_vec(&asked).expect("inputs are plain data"))
    }

    /// Method, parameters and budget, for people and trackers.
    pub(crate) fn label(&self) -> String {
        let mut words = vec![self.method.clone()];
        words.extend(self.parameters.iter().map(|(name, value)| format!("{name}={value}")));
        words.extend(self.asked_visibility.iter().map(|asked| format!("visibility={asked}")));
        let bounded = self.bounded.word();
        words.extend(match self.budget {
            Budget::Count => None,
            Budget::Seconds(seconds) => Some(format!("{bounded}={seconds}s")),
            Budget::Baseline => Some(format!("{bounded}=baseline")),
        });
        words.join(" ")
    }

    /// Scene and camera, for headings and files.
    pub(crate) fn view(&self) -> String {
        view(&self.scene, self.camera.as_deref())
    }

    /// Names the cell: the hash of the inputs, the program and the machine. A cell of the same key
    /// need not run again.
    pub(crate) fn key(&self, provenance: &Provenance) -> String {
        let text = serde_json::to_string(&(self, provenance)).expect("inputs are plain data");
        sha256(text.as_bytes())
    }
}

/// The scene's name; that of the camera follows where the experiment lists some. Cameras of foreign files
/// are named as anybody likes, and this names files.
pub(crate) fn view(scene: &str, camera: Option<&str>) -> String {
    let safe = |letter: char| if letter.is_alphanumeric() || letter == '_' { letter } else { '-' };
    camera.map_or_else(
        || scene.to_owned(),
        |camera| format!("{scene}-{}", camera.chars().map(safe).collect::<String>()),
    )
}
