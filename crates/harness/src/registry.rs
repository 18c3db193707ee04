//! The only list of methods in the workspace. Help, lists, sweeps and plot styles derive from it.

use manylights_hvl::Hvl;
use manylights_method::Method;
use manylights_path_tracer::PathTracer;
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
    use std::collections::BTreeSet;

    use manylights_method::ParameterKind;

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
    fn cost_parameters_are_counts() {
        for method in METHODS {
            let cost = method.cost_parameter();
            let declared = method.parameters().iter().find(|info| info.name == cost);
            let kind = declared.map(|info| info.kind);
            assert!(matches!(kind, Some(ParameterKind::Count { .. })), "{} {cost}", method.id());
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
