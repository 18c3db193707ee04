//! The only list of methods in the workspace. Help, lists, sweeps and plot styles derive from it.

use manylights_area_lights::AreaLights;
use manylights_hvl::Hvl;
use manylights_ltc::Ltc;
use manylights_method::Method;
use manylights_path_tracer::PathTracer;
use manylights_polygonal_light::PolygonalLights;
use manylights_spherical_light::SphericalLights;
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;
use manylights_vsgl::Vsgl;
use manylights_vsl::Vsl;

use crate::names;

/// Methods to choose from, in the order of lists; a method's place fixes its colour and marker in plots.
pub type Methods = &'static [&'static dyn Method];

/// Every method of the program.
pub const METHODS: Methods = &[
    &PathTracer,
    &VirtualLights(Vpl),
    &VirtualLights(Vsl),
    &VirtualLights(Hvl),
    &VirtualLights(Vsgl),
    &AreaLights(SphericalLights),
    &AreaLights(PolygonalLights),
    &AreaLights(Ltc),
];

/// Where the method of this name stands in a list.
///
/// # Errors
/// One line with the nearest name.
pub(crate) fn place(methods: Methods, id: &str) -> Result<usize, String> {
    let ids = methods.iter().map(|method| method.id());
    let place = ids.clone().position(|known| known == id);
    place.ok_or_else(|| names::unknown("method", id, ids))
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use manylights_method::{Amounts, Direction, ParameterInfo, ParameterKind, Parameters};

    use super::*;

    fn well_formed(name: &str) -> bool {
        name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    }

    #[test]
    fn ids_are_unique_and_well_formed() {
        let ids: BTreeSet<_> = METHODS.iter().map(|method| method.id()).collect();
        assert_eq!(ids.len(), METHODS.len());
        assert!(ids.iter().all(|id| well_formed(id)), "{ids:?}");
    }

    #[test]
    fn methods_and_parameters_are_documented() {
        for method in METHODS {
            assert!(!method.title().trim().is_empty(), "{}", method.id());
            let mut seen = BTreeSet::new();
            for info in method.parameters() {
                assert!(seen.insert(info.name), "{} declares {} twice", method.id(), info.name);
                assert!(well_formed(&info.name.replace('_', "-")), "{}", info.name);
                assert!(info.help.len() > 8, "{} {} has no help", method.id(), info.name);
                let before = info.introduced.map(|text| (info.name, text));
                Parameters::new(method.parameters(), before).expect("a value of the parameter");
            }
            let baked = method.baking().map_or(&[][..], |baking| baking.counters());
            for counters in [method.counters(), baked] {
                let mut counted = BTreeSet::new();
                for info in counters {
                    assert!(counted.insert(info.name), "{} twice in {}", info.name, method.id());
                    assert!(well_formed(&info.name.replace('_', "-")), "{}", info.name);
                    assert!(info.help.len() > 8, "{} {} has no help", method.id(), info.name);
                }
            }
        }
    }

    #[test]
    fn costs_are_positive_numbers() {
        for method in METHODS {
            let Some(cost) = method.cost() else {
                assert!(!method.is_progressive(), "{}", method.id());
                continue;
            };
            assert!(Amounts::new(cost, method.parameters()).is_some(), "{} {cost:?}", method.id());
            let declared = method.parameters().iter().find(|info| info.name == cost.parameter);
            let counts =
                matches!(declared.map(|info| info.kind), Some(ParameterKind::Count { .. }));
            let along_progress = counts && cost.grows == Direction::Up;
            assert!(along_progress || !method.is_progressive(), "{} {cost:?}", method.id());
        }
    }

    /// `4.5`, or `4.5-cut`: the equation that a choice is, as its paper numbers it.
    fn names_an_equation(word: &str) -> bool {
        let (equation, variant) = word.split_once('-').unwrap_or((word, "as-printed"));
        let numbers = equation.split_once('.').map(|(chapter, place)| [chapter, place]);
        let digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
        numbers.is_some_and(|numbers| numbers.into_iter().all(digits)) && well_formed(variant)
    }

    #[test]
    fn choices_are_documented_words() {
        for info in METHODS.iter().flat_map(|method| method.parameters()) {
            let ParameterKind::Choice { default, words } = info.kind else { continue };
            let distinct: BTreeSet<_> = words.iter().map(|known| known.word).collect();
            assert_eq!(distinct.len(), words.len(), "{} has a word twice", info.name);
            assert!(distinct.contains(default), "{}: {default}", info.name);
            for known in words {
                let fits = well_formed(known.word) || names_an_equation(known.word);
                assert!(fits, "{}={}", info.name, known.word);
                assert!(known.help.len() > 5, "{}={} has no help", info.name, known.word);
            }
        }
    }

    /// Bounds and defaults of numbers are a method's own.
    #[test]
    fn a_name_means_one_thing() {
        let sort = |info: &ParameterInfo| match info.kind {
            ParameterKind::Count { .. } => ("count", None),
            ParameterKind::Real { .. } => ("real", None),
            ParameterKind::Choice { words, .. } => ("choice", Some(words)),
        };
        let mut meanings = BTreeMap::new();
        for info in METHODS.iter().flat_map(|method| method.parameters()) {
            let meaning = (sort(info), info.help);
            assert_eq!(*meanings.entry(info.name).or_insert(meaning), meaning, "{}", info.name);
        }
    }

    #[test]
    fn an_unknown_method_is_an_error() {
        assert!(place(METHODS, "no-such-method").is_err());
        assert_eq!(
            place(METHODS, "referense").err(),
            Some("unknown method `referense`: did you mean `reference`?".into())
        );
    }
}
