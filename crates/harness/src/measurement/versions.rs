//! What a cell was computed by, in numbers that are raised when it computes something else.
//!
//! They stand in a cell's key in the place of a hash of the program, which changes at every build. A test
//! (`tests/tests/versions.rs`) renders small pictures of each and fails where one moved and its number did
//! not.

use std::collections::BTreeMap;

use manylights_area_lights::AREA_LIGHTS_VERSION;
use manylights_gpu::SHADERS_VERSION;
use manylights_method::{Method, Processor};
use manylights_metrics::METRICS_VERSION;
use manylights_path_tracer::REFERENCE_VERSION;
use manylights_reflectance::TABLES_VERSION;
use manylights_virtual_lights::PLACEMENT_VERSION;

use crate::question::references::{Reference, Source};

/// Versions by name. Of a cell from before they were counted there are none.
pub(crate) type Versions = BTreeMap<String, u32>;

/// Those that a cell of `method` depends on, with the methods that are its references. On the adapter these are all shared stages, whether or not
/// the method uses them: a cell that runs again needlessly costs minutes, one that does not is wrong.
pub(crate) fn of(method: &dyn Method, references: &[Reference]) -> Versions {
    let everywhere = [
        ("method", method.version()),
        ("metrics", METRICS_VERSION),
        ("reference", REFERENCE_VERSION),
    ];
    let on_adapter = [
        ("placement", PLACEMENT_VERSION),
        ("shaders", SHADERS_VERSION),
        ("tables", TABLES_VERSION),
    ];
    let judges = references.iter().filter_map(|reference| match &reference.source {
        Source::Paths(_) => None,
        Source::Method(variant) => Some((reference.name.as_str(), variant.method)),
    });
    let processors = judges.clone().map(|(_, judge)| judge.processor());
    let shared = match processors.chain([method.processor()]).any(|it| it == Processor::Gpu) {
        true => &on_adapter[..],
        false => &[][..],
    };
    let judges = judges.map(|(name, judge)| (format!("reference {name}"), judge.version()));
    // A stage that came later is left out at its first version, so that older results keep their keys.
    let later = [("area_lights", AREA_LIGHTS_VERSION)];
    let later = later.iter().filter(|(_, version)| !shared.is_empty() && *version > 1);
    let own = everywhere.iter().chain(shared).chain(later);
    let own = own.map(|&(name, version)| (name.to_owned(), version));
    own.chain(judges).collect()
}
