//! Errors that a user reads: one line that says what, where and how to mend it.

use std::fmt::Display;

/// Longest part of a message that is shown; names in a hostile file may be megabytes long.
const MAX_PART: usize = 300;

/// Why a scene, or something in it, could not be had. Displays as one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}; {remedy}")]
pub struct LoadError {
    place: String,
    problem: String,
    remedy: String,
}

impl LoadError {
    pub(crate) fn new(place: impl Display, problem: impl Display, remedy: impl Display) -> Self {
        Self {
            place: one_line(&place.to_string()),
            problem: one_line(&problem.to_string()),
            remedy: one_line(&remedy.to_string()),
        }
    }

    /// The same error, one level further out: `place` comes first.
    pub(crate) fn within(self, place: impl Display) -> Self {
        Self { place: one_line(&format!("{place}: {}", self.place)), ..self }
    }

    /// `word` is none of `known`: the remedy names the nearest of them.
    pub(crate) fn unknown<'a>(
        place: impl Display,
        kind: &str,
        word: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        Self::new(place, format!("unknown {kind} `{word}`"), suggestion(word, known))
    }
}

/// The remedy for a misspelt `word`: the nearest of the `known` ones.
pub(crate) fn suggestion<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let nearest = known.into_iter().min_by_key(|name| strsim::damerau_levenshtein(word, name));
    match nearest {
        Some(name) => format!("did you mean `{name}`?"),
        None => "there is none to choose from".to_owned(),
    }
}

/// Control characters become spaces, and what is too long is cut.
pub(crate) fn one_line(text: &str) -> String {
    let printable = |c: char| if c.is_control() { ' ' } else { c };
    let mut line: String = text.chars().map(printable).take(MAX_PART).collect();
    if text.chars().nth(MAX_PART).is_some() {
        line.push('…');
    }
    line
}
