//! What a cell depends on.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::measurement::provenance::{Provenance, sha256};
use crate::measurement::versions::Versions;
use crate::question::experiment::Experiment;
use crate::question::plan::{Budget, Variant};
use crate::registry;

/// What decides the picture and its errors, and where its time was taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Inputs {
    /// Name of the scene.
    pub(crate) scene: String,
    /// Hash of its triangles, materials, lights and camera.
    pub(crate) scene_content: String,
    /// Method.
    pub(crate) method: String,
    /// Its parameters, without the one that a time budget sets.
    pub(crate) parameters: BTreeMap<String, f64>,
    /// What it may cost.
    pub(crate) budget: Budget,
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
    /// The references that it is compared with: samples a pixel by visibility.
    pub(crate) references: BTreeMap<String, u32>,
}

impl Inputs {
    /// Of a variant on a scene of this name, content and exposure.
    pub(crate) fn new(
        experiment: &Experiment,
        variant: &Variant,
        scene: &str,
        content: &str,
        exposure: f32,
    ) -> Self {
        let samples = experiment.scale.reference_samples;
        Self {
            scene: scene.to_owned(),
            scene_content: content.to_owned(),
            method: variant.method.id().to_owned(),
            parameters: variant.given(),
            budget: variant.budget,
            seed: 0,
            repetition: 0,
            transport: experiment.transport.to_string(),
            asked_visibility: variant.unusual_visibility().map(|visibility| visibility.to_string()),
            resolution: experiment.scale.resolution,
            exposure,
            references: experiment.references.iter().map(|v| (v.to_string(), samples)).collect(),
        }
    }

    /// What is asked, as text: the same for inputs that differ only in parameters which one of them is
    /// from before, where the other has them at the value that stands for that.
    pub(crate) fn identity(&self) -> String {
        let mut essential = self.clone();
        if let Ok(method) = registry::method(&self.method) {
            let infos = method.parameters();
            essential.parameters.retain(|name, value| {
                let info = infos.iter().find(|info| info.name == name);
                !info.is_some_and(|info| info.is_as_before(*value))
            });
        }
        serde_json::to_string(&essential).expect("inputs are plain data")
    }

    /// What is asked of a scene, whatever state it is in: of two answers of one machine, the later counts.
    pub(crate) fn turn_identity(&self) -> String {
        Self { scene_content: String::new(), exposure: 0.0, ..self.clone() }.identity()
    }

    /// Names what is asked, whoever answers: the same for all seeds and repetitions, which one
    /// machine must answer together, on every machine and in every build.
    pub(crate) fn question(&self) -> String {
        let asked = Self { seed: 0, repetition: 0, ..self.clone() };
        sha256(asked.identity().as_bytes())
    }

    /// Method, parameters and budget, for people and trackers.
    pub(crate) fn label(&self) -> String {
        let mut words = vec![self.method.clone()];
        words.extend(self.parameters.iter().map(|(name, value)| format!("{name}={value}")));
        words.extend(self.asked_visibility.iter().map(|asked| format!("visibility={asked}")));
        words.extend(match self.budget {
            Budget::Count => None,
            Budget::Seconds(seconds) => Some(format!("time={seconds}s")),
            Budget::Baseline => Some("time=baseline".to_owned()),
        });
        words.join(" ")
    }

    /// Names the cell: the hash of the inputs, of the versions of what computes it and of the machine.
    /// A cell of the same key need not run again.
    pub(crate) fn key(&self, versions: &Versions, provenance: &Provenance) -> String {
        let versions = serde_json::to_string(versions).expect("numbers are plain data");
        let text = format!("[{},{versions},{}]", self.identity(), provenance.place());
        sha256(text.as_bytes())
    }
}
