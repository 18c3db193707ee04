//! Help for misspelt names.

/// One line for a name that is none of `known`, with the nearest one where there is one.
pub(crate) fn unknown<'k>(
    what: &str,
    name: &str,
    known: impl IntoIterator<Item = &'k str>,
) -> String {
    let known: Vec<_> = known.into_iter().collect();
    match nearest(name, &known) {
        Some(candidate) => format!("unknown {what} `{name}`: did you mean `{candidate}`?"),
        None if known.is_empty() => format!("unknown {what} `{name}`: there is none"),
        None => format!("unknown {what} `{name}`: known are {}", known.join(", ")),
    }
}

/// What serde says of a file, in one line; an unknown key with the nearest of the known ones.
pub(crate) fn mended(message: &str) -> String {
    // serde words it: unknown field `a`, expected one of `b`, `c`
    if message.starts_with("unknown field") {
        let mut quoted = message.split('`').skip(1).step_by(2);
        let key = quoted.next().unwrap_or_default();
        unknown("key", key, quoted)
    } else {
        message.lines().collect::<Vec<_>>().join("; ")
    }
}

fn nearest<'k>(name: &str, known: &[&'k str]) -> Option<&'k str> {
    known
        .iter()
        .map(|&candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|&(similarity, _)| similarity > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_suggested() {
        let known = ["cornell", "cornell-glossy", "trio"];
        assert_eq!(
            unknown("scene", "cornel", known),
            "unknown scene `cornel`: did you mean `cornell`?"
        );
        assert_eq!(
            unknown("scene", "x", known),
            "unknown scene `x`: known are cornell, cornell-glossy, trio"
        );
        assert_eq!(unknown("key", "x", []), "unknown key `x`: there is none");
    }
}
