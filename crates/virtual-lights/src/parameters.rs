//! The parameters that several kinds of virtual lights have.

use manylights_method::{ChoiceWord, Cost, Direction, ParameterInfo, ParameterKind, Parameters};

use crate::radius::RadiusRule;

/// The lights of a picture.
pub const LIGHTS: ParameterInfo = ParameterInfo {
    name: "lights",
    formerly: None,
    introduced: None,
    help: "shadow-map cells that are lit: to 1 %, but whole cells on the six faces about a point light \
           (384 of 400) and one for each primary light; vsgl also lights cells of which any texel is lit",
    kind: ParameterKind::Count { default: 400, min: 1, max: 1 << 24 },
};

/// Time and accuracy grow with the lights.
pub(crate) const COST: Cost = Cost { parameter: LIGHTS.name, grows: Direction::Up };

/// Where radii come from, of lights that are spheres.
pub const RADIUS: ParameterInfo = ParameterInfo {
    name: "radius",
    formerly: None,
    introduced: None,
    help: "rule for the radii of the lights",
    kind: ParameterKind::Choice {
        default: "r2",
        words: &[
            ChoiceWord { word: "neighbours", help: "distance of the tenth nearest light" },
            ChoiceWord { word: "r1", help: "mean distance on the map (thesis 5.9)" },
            ChoiceWord { word: "r2", help: "from the map's field of view (thesis 5.12)" },
            ChoiceWord { word: "fixed", help: "one metre" },
        ],
    },
};

/// Of radii, of lights that are spheres.
pub const SCALE: ParameterInfo = ParameterInfo {
    name: "scale",
    formerly: None,
    introduced: None,
    help: "factor on all radii; the thesis advises 1 to 2; 0 = point lights",
    kind: ParameterKind::Real { default: 1.0, min: 0.0, max: 1e6 },
};

impl RadiusRule {
    /// The rule that [`RADIUS`] chooses.
    pub fn chosen(parameters: &Parameters) -> Self {
        let rules = [
            ("neighbours", Self::NearestNeighbours),
            ("r1", Self::MapNeighbours),
            ("r2", Self::FieldOfView),
            ("fixed", Self::Fixed),
        ];
        parameters.choice(RADIUS.name, &rules)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_names_a_rule() {
        const INFOS: &[ParameterInfo] = &[RADIUS];
        let ParameterKind::Choice { words, .. } = RADIUS.kind else { panic!("a choice") };
        let rule = |known: &ChoiceWord| {
            let chosen = Parameters::new(INFOS, [(RADIUS.name, known.word)]);
            RadiusRule::chosen(&chosen.expect("a word"))
        };
        assert_eq!(words.iter().map(rule).collect::<Vec<_>>(), RadiusRule::ALL);
    }
}
