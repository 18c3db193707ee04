//! Experiment files: the question that `manylights run` answers.
//!
//! ```toml
//! title = "…"                        # heading of the table
//! question = "…"
//! scenes = ["cornell", "scenes/hall.toml"]
//! cameras = ["front", "side"]        # of each scene, in the order in which bakes grow; left out: its
//!                                    # first; a listed one's pictures are named SCENE-CAMERA
//! transport = "indirect-1"
//! references = ["traced", "ignored"] # path traced, by visibility; the truth first: ranks are by it
//! errors = [0.02]                    # the time to reach these RMSEs is read off the curves
//! columns = ["counts", "time", "rmse"] # of the table; see columns.rs
//! [[methods]]                        # any number; all combinations of the values run
//! id = "…"
//! parameters = { samples = [16, 64] } # words in quotation marks
//! visibility = "traced"              # or "ignored", or a list; left out: the method's own
//! [[methods]]
//! id = "…"
//! budget = "time"                    # the harness sets the method's cost parameter so that a frame
//!                                    # takes `times`; "build_time": its bake; "total_time": both;
//!                                    # a method without a cost runs once and takes what it takes
//! [baseline]                         # one of those; the first where it is left out
//! id = "…"
//! parameters = { samples = 16 }
//! [profiles.quick]                   # and standard, paper
//! resolution = [96, 96]
//! reference_samples = 1024
//! repetitions = 3                    # timed runs of each cell
//! seeds = [1]
//! times = [0.1, "baseline"]          # seconds; what methods with a time budget are given
//! [exposures]                        # where a scene's own is not wanted
//! cornell = 2.0
//! [[crops]]                          # shown enlarged, the same for all methods
//! scene = "cornell"
//! rectangle = [0.5, 0.5, 0.25, 0.25] # left, top, width, height in parts of the picture
//! [[published]]                      # numbers of a paper, set beside ours
//! source = "…"
//! scene = "cornell"
//! method = { id = "…", parameters = { samples = 64 } }
//! reference = "traced"
//! values = { rmse = 0.01 }           # of sRGB values; "time_ratio" is to the baseline
//! ```
//!
//! A reference may be the picture of another method, of the same seed, instead; all are tables then:
//!
//! ```toml
//! [[references]]
//! name = "per-pixel"                 # of our choice
//! method = { id = "…", parameters = { lights = 4096 }, visibility = "ignored" }
//! [[references]]
//! name = "traced"                    # path traced
//! ```
//!
//! A curve runs along the first parameter, in the method's own order, that has a list of values,
//! else along the method's cost parameter, if it has one; the others tell curves apart.

use std::collections::BTreeMap;
use std::path::Path;

use manylights_scene::Transport;
use serde::Deserialize;

use crate::names;
use crate::question::columns::Column;
use crate::question::crops::Crop;
use crate::question::plan::Variant;
use crate::question::profiles::{Profile, Profiles, Scale, distinct};
use crate::question::published::{self, Published};
use crate::question::references::{self, Reference};
use crate::question::sweep::MethodEntry;
use crate::registry::Methods;

/// A checked experiment in one profile.
#[derive(Debug)]
pub(crate) struct Experiment {
    /// Heading of the table.
    pub(crate) title: String,
    /// What it asks, in a sentence or two.
    pub(crate) question: String,
    /// Names or files for `manylights_scene::load`.
    pub(crate) scenes: Vec<String>,
    /// Cameras of each scene, in the order in which bakes grow; where none are named, its first.
    pub(crate) cameras: Vec<String>,
    /// The light paths of all pictures.
    pub(crate) transport: Transport,
    /// The references, the truth first: ranks are by it.
    pub(crate) references: Vec<Reference>,
    /// Methods with their parameters, all combinations written out.
    pub(crate) variants: Vec<Variant>,
    /// Index into `variants`: what ratios refer to.
    pub(crate) baseline: usize,
    /// RMSEs (sRGB) whose times are read off the curves.
    pub(crate) errors: Vec<f64>,
    /// Columns of the table.
    pub(crate) columns: Vec<Column>,
    /// Exposures by scene, where they are not the scene's.
    pub(crate) exposures: BTreeMap<String, f32>,
    /// What sheets and reports show enlarged.
    pub(crate) crops: Vec<Crop>,
    /// Numbers of papers.
    pub(crate) published: Vec<Published>,
    /// Name of the profile.
    pub(crate) profile: &'static str,
    /// Sizes and counts of the profile.
    pub(crate) scale: Scale,
}

impl Experiment {
    /// The cameras of each scene by name; one without a name for the scene's first.
    pub(crate) fn cameras(&self) -> Vec<Option<&str>> {
        match self.cameras.as_slice() {
            [] => vec![None],
            names => names.iter().map(|name| Some(name.as_str())).collect(),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    question: String,
    scenes: Vec<String>,
    #[serde(default)]
    cameras: Vec<String>,
    transport: String,
    references: Vec<toml::Value>,
    methods: Vec<MethodEntry>,
    baseline: Option<MethodEntry>,
    #[serde(default)]
    errors: Vec<f64>,
    columns: Option<Vec<Column>>,
    #[serde(default)]
    exposures: BTreeMap<String, f32>,
    #[serde(default)]
    crops: Vec<Crop>,
    #[serde(default)]
    published: Vec<published::PublishedEntry>,
    profiles: Profiles,
}

/// Reads and checks an experiment file.
///
/// # Errors
/// One line: the file, what is wrong, how to mend it.
pub(crate) fn read(path: &Path, profile: Profile, methods: Methods) -> Result<Experiment, String> {
    let at = |reason: String| format!("{}: {reason}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| at(error.to_string()))?;
    parse(&text, profile, methods).map_err(at)
}

/// Title and scenes of an experiment file, for lists.
///
/// # Errors
/// As [`read`].
pub(crate) fn summary(path: &Path) -> Result<(String, Vec<String>), String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let file: File = toml::from_str(&text).map_err(|error| mend(&text, &error))?;
    Ok((file.title, file.scenes))
}

fn parse(text: &str, profile: Profile, methods: Methods) -> Result<Experiment, String> {
    let file: File = toml::from_str(text).map_err(|error| mend(text, &error))?;
    let (name, scale) = file.profiles.checked(profile)?;
    if file.scenes.is_empty() || file.methods.is_empty() || file.references.is_empty() {
        return Err("`scenes`, `methods` and `references` each need at least one entry".into());
    }
    distinct("cameras", &file.cameras)?;
    let transport: Transport = file.transport.parse()?;
    let times = scale.times()?;
    distinct("errors", &file.errors)?;
    distinct("columns", file.columns.as_deref().unwrap_or_default())?;
    let mut variants = Vec::new();
    for entry in &file.methods {
        for variant in entry.variants(methods, &times)? {
            variant.check_visibility(transport).map_err(|reason| format!("methods: {reason}"))?;
            if variants.contains(&variant) {
                return Err(format!("methods: `{}` is listed twice", variant.label()));
            }
            variants.push(variant);
        }
    }
    let references = references::parse(&file.references, transport, methods)?;
    if file.errors.iter().any(|error| !(error.is_finite() && *error > 0.0)) {
        return Err("errors: RMSEs are positive numbers".into());
    }
    let exposed = |exposure: &f32| exposure.is_finite() && *exposure > 0.0;
    if !file.exposures.values().all(exposed) {
        return Err("exposures: factors are positive numbers".into());
    }
    file.crops.iter().try_for_each(Crop::check)?;
    let mut published = Vec::new();
    for entry in &file.published {
        published.extend(entry.resolve(methods, &variants, &times, &references)?);
    }
    Ok(Experiment {
        errors: file.errors,
        columns: file.columns.unwrap_or_else(|| Column::ALL.to_vec()),
        exposures: file.exposures,
        crops: file.crops,
        published,
        title: file.title,
        question: file.question,
        scenes: file.scenes,
        cameras: file.cameras,
        transport,
        references,
        baseline: baseline(file.baseline.as_ref(), methods, &variants)?,
        variants,
        profile: name,
        scale,
    })
}

impl Experiment {
    /// Refuses what is said of scenes that are not among `scenes`, and of pictures that are not among
    /// `views`: scenes seen by the cameras that are listed.
    ///
    /// # Errors
    /// One line with the nearest name.
    pub(crate) fn check_scenes(&self, scenes: &[&str], views: &[String]) -> Result<(), String> {
        let views: Vec<&str> = views.iter().map(String::as_str).collect();
        let exposures = self.exposures.keys().map(|name| ("exposures", name, scenes));
        let crops = self.crops.iter().map(|crop| ("crops", &crop.scene, &views[..]));
        let published = self.published.iter();
        let published = published.map(|value| ("published", &value.scene, &views[..]));
        for (place, name, known) in exposures.chain(crops).chain(published) {
            if !known.contains(&name.as_str()) {
                let known = known.iter().copied();
                return Err(format!("{place}: {}", names::unknown("scene", name, known)));
            }
        }
        Ok(())
    }
}

fn baseline(
    entry: Option<&MethodEntry>,
    methods: Methods,
    variants: &[Variant],
) -> Result<usize, String> {
    let Some(entry) = entry else { return Ok(0) };
    let wanted = entry.single(methods).map_err(|reason| format!("baseline: {reason}"))?;
    variants
        .iter()
        .position(|variant| *variant == wanted)
        .ok_or_else(|| format!("baseline: `{}` is not among the methods", wanted.label()))
}

/// Line number and nearest key from what the TOML reader says.
fn mend(text: &str, error: &toml::de::Error) -> String {
    let line = error.span().map(|span| {
        let before = text.get(..span.start).unwrap_or(text);
        format!("line {}: ", before.matches('\n').count() + 1)
    });
    let reason = names::mended(error.message());
    format!("{}{reason}", line.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::question::profiles::REFERENCE_SEED;
    use crate::registry::METHODS;

    const GOOD: &str = r#"
title = "t"
question = "q"
scenes = ["cornell"]
transport = "indirect-1"
references = ["traced", "ignored"]
[[methods]]
id = "reference"
parameters = { samples = [1, 4, 16] }
[baseline]
id = "reference"
parameters = { samples = 4 }
[profiles.quick]
resolution = [16, 16]
reference_samples = 16
repetitions = 2
seeds = [1]
"#;

    fn refused(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        parse(&GOOD.replace(from, to), Profile::Quick, METHODS).expect_err(to)
    }

    /// Whatever time bounds the others, one without an amount of work is one without a budget.
    #[test]
    fn the_baseline_has_no_amount_of_work() {
        for word in ["count", "time", "build_time", "total_time"] {
            let methods = format!("\"ltc\"\nbudget = \"{word}\"");
            let text = GOOD
                .replacen("\"reference\"", &methods, 1)
                .replace("id = \"reference\"", "id = \"ltc\"")
                .replace("parameters = { samples = [1, 4, 16] }\n", "")
                .replace("parameters = { samples = 4 }\n", "")
                .replace("seeds", "times = [1.0, 2.0]\nseeds");
            let experiment = parse(&text, Profile::Quick, METHODS).expect(word);
            assert_eq!(experiment.variants.len(), 1, "{word}");
            let twice = text.replace("[baseline]", "[[methods]]\nid = \"ltc\"\n[baseline]");
            let refusal = parse(&twice, Profile::Quick, METHODS).expect_err(word);
            assert!(refusal.contains("listed twice"), "{refusal}");
            // Nothing is searched, so that neither times nor single values are asked for.
            let bounded = format!("[baseline]\nid = \"ltc\"\nbudget = \"{word}\"");
            let text = text
                .replace("[baseline]\nid = \"ltc\"", &bounded)
                .replace("times = [1.0, 2.0]\n", "");
            let experiment = parse(&text, Profile::Quick, METHODS).expect(word);
            assert_eq!((experiment.variants.len(), experiment.baseline), (1, 0), "{word}");
        }
        for word in ["time", "build_time", "total_time"] {
            let bounded = format!("[baseline]\nid = \"reference\"\nbudget = \"{word}\"");
            let refusal = refused("[baseline]\nid = \"reference\"", &bounded);
            let said = format!("`reference` has a {word} budget: set its parameters instead");
            assert!(refusal.contains(&said), "{refusal}");
        }
    }

    #[test]
    fn sweeps_are_written_out_and_the_baseline_is_found() {
        let experiment = parse(GOOD, Profile::Quick, METHODS).expect("good");
        let labels: Vec<_> = experiment.variants.iter().map(Variant::label).collect();
        assert_eq!(labels, ["reference samples=1", "reference samples=4", "reference samples=16"]);
        assert_eq!(experiment.baseline, 1);
        let names: Vec<_> = experiment.references.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(names, ["traced", "ignored"]);
        assert!(experiment.references.iter().all(Reference::is_path_traced));
    }

    #[test]
    fn references_are_path_traced_or_by_a_method() {
        let written = r#"references = [
            { name = "many-paths", method = { id = "reference", parameters = { samples = 64 } } },
            "traced",
        ]"#;
        let text = GOOD.replace("references = [\"traced\", \"ignored\"]", written);
        let experiment = parse(&text, Profile::Quick, METHODS).expect("good");
        let described: Vec<_> = experiment
            .references
            .iter()
            .map(|r| format!("{}: {}", r.name, r.description(experiment.transport, 16)))
            .collect();
        assert_eq!(
            described,
            [
                "many-paths: reference samples=64, of the same seed",
                "traced: path traced, visibility traced, 16 samples a pixel",
            ]
        );
        assert!(!experiment.references[0].is_path_traced());
        let method = "{ id = \"reference\" }";
        for (name, method, said) in [
            ("\"A B\"", method, "lower-case letters"),
            ("\"\"", method, "lower-case letters"),
            ("\"traced\"", method, "choose another name"),
            ("\"x\"", "{ id = \"refernce\" }", "did you mean `reference`?"),
            ("\"x\"", "{ id = \"reference\", parameters = { samples = [1, 2] } }", "single"),
            ("\"x\"", "{ id = \"reference\", budget = \"time\" }", "set its parameters"),
            ("\"x\"", "{ id = \"reference\", colour = 1 }", "unknown key `colour`"),
            ("1", method, "expected a string"),
        ] {
            let written = format!("references = [{{ name = {name}, method = {method} }}]");
            let text = GOOD.replace("references = [\"traced\", \"ignored\"]", &written);
            let reason = parse(&text, Profile::Quick, METHODS).expect_err(said);
            assert!(reason.contains(said) && reason.lines().count() == 1, "{reason} / {said}");
        }
    }

    #[test]
    fn every_mistake_is_one_line_that_says_how_to_mend_it() {
        for (from, to, said) in [
            ("title =", "titel =", "line 2: unknown key `titel`: did you mean `title`?"),
            ("samples = [1", "sample = [1", "did you mean `samples`?"),
            ("id = \"reference\"", "id = \"refernce\"", "did you mean `reference`?"),
            ("[16, 16]", "[0, 16]", "sides must be 1"),
            ("[16, 16]", "[16, 8]", "11×11"),
            ("[16, 16]", "[16]", "line 14"),
            ("reference_samples = 16", "reference_samples = 1", "at least 2"),
            ("seeds = [1]", "seeds = []", "one seed"),
            ("repetitions = 2", "repetitions = 0", "one repetition"),
            ("\"ignored\"", "\"forgotten\"", "use traced or ignored"),
            ("\"ignored\"", "\"traced\"", "`traced` is listed twice"),
            ("\"ignored\"", "3", "neither a name nor a table"),
            ("indirect-1", "indirect-2", "a choice of direct, indirect-1 and"),
            ("indirect-1", "direct+indirect-2", "unknown transport"),
            (
                "samples = [1, 4, 16] }",
                "samples = 1 }\nvisibility = \"sometimes\"",
                "use traced or ignored",
            ),
            ("indirect-1", "everything", "unknown transport"),
            ("samples = 4 ", "samples = 5 ", "not among the methods"),
            ("samples = 4 ", "samples = [1, 4]", "single values"),
            ("[1, 4, 16]", "[1, 1]", "listed twice"),
            ("[1, 4, 16]", "[]", "without values"),
            ("[1, 4, 16]", "[true]", "must be a number, a word or a list"),
            ("[1, 4, 16]", "\"many\"", "must be a whole number"),
            ("scenes = [\"cornell\"]", "scenes = []", "at least one entry"),
            ("profiles.quick", "profiles.quik", "did you mean `quick`?"),
            ("{ samples = [1, 4, 16] }", "{}\nbudget = \"time\"", "no `times`"),
            (
                "{ samples = [1, 4, 16] }",
                "{}\nbudget = \"total_time\"",
                "total_time budget, but the profile no",
            ),
            ("transport", "cameras = [\"a\", \"a\"]\ntransport", "`a` is listed twice"),
            ("[1, 4, 16] }", "[1, 4, 16] }\nbudget = \"money\"", "unknown variant `money`"),
            ("seeds = [1]", "seeds = [1]\ntimes = [0]", "positive numbers of seconds"),
            ("seeds = [1]", "seeds = [1]\ntimes = [\"noon\"]", "\"baseline\""),
            ("[baseline]", "[exposures]\ncornell = 0.0\n[baseline]", "positive"),
            (
                "[baseline]",
                "[[crops]]\nscene = \"a\"\nrectangle = [0.9, 0, 0.2, 1]\n[baseline]",
                "within",
            ),
            ("question", "columns = [\"psrn\"]\nquestion", "psnr"),
            ("question", "errors = [0.0]\nquestion", "positive"),
            ("question", "errors = [0.1, 0.2, 0.1]\nquestion", "errors: `0.1` is listed twice"),
            ("question", "columns = [\"rmse\", \"rmse\"]\nquestion", "listed twice"),
            ("seeds = [1]", "seeds = [2, 1, 2]", "profiles.quick: seeds: `2` is listed twice"),
            (
                "seeds = [1]",
                "seeds = [1]\ntimes = [1, 1.0]",
                "times: `Seconds(1.0)` is listed twice",
            ),
        ] {
            let reason = refused(from, to);
            assert!(reason.contains(said) && reason.lines().count() == 1, "{reason} / {said}");
        }
        let timed = GOOD.replace("seeds = [1]", "seeds = [1]\ntimes = [1]");
        let built = timed.replace("{ samples = [1, 4, 16] }", "{}\nbudget = \"build_time\"");
        let reason =
            parse(&built, Profile::Quick, METHODS).expect_err("path tracing bakes nothing");
        assert!(reason.contains("bakes nothing that grows with `samples`"), "{reason}");
        let missing = parse(GOOD, Profile::Paper, METHODS).expect_err("no paper profile");
        assert!(missing.contains("[profiles.paper]"), "{missing}");
        let seed = refused("seeds = [1]", &format!("seeds = [{REFERENCE_SEED}]"));
        assert!(seed.contains("choose another"), "{seed}");
    }
}
