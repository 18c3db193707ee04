//! Values for a method's parameters, as people write them.

use manylights_method::{Method, ParameterInfo, ParameterKind, Parameters};

use crate::names;

/// Checked values for all parameters of `method`.
///
/// # Errors
/// One line; the nearest name for an unknown key or word.
pub(crate) fn parameters<'s>(
    method: &dyn Method,
    settings: impl IntoIterator<Item = (&'s str, &'s str)>,
) -> Result<Parameters, String> {
    let settings: Vec<_> = settings.into_iter().collect();
    let infos = method.parameters();
    for (key, text) in &settings {
        let called = |info: &&ParameterInfo| info.name == *key || info.formerly == Some(key);
        let Some(info) = infos.iter().find(called) else {
            let known = infos.iter().map(|info| info.name);
            return Err(names::unknown(&format!("parameter of {}", method.id()), key, known));
        };
        // A number is none of the words, but what stood for one once.
        if let ParameterKind::Choice { words, .. } = info.kind
            && text.parse::<f64>().is_err()
            && words.iter().all(|known| known.word != *text)
        {
            let known = words.iter().map(|known| known.word);
            return Err(names::unknown(&format!("word for parameter `{key}`"), text, known));
        }
    }
    Parameters::new(infos, settings)
}

/// Splits `KEY=VALUE`.
///
/// # Errors
/// One line where there is no `=` or no key.
pub(crate) fn split(setting: &str) -> Result<(String, String), String> {
    match setting.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err(format!("`{setting}` is not KEY=VALUE")),
    }
}

/// Most pixels of one picture: 2²⁶, about 800 MB of radiance.
const MAX_PIXELS: u64 = 1 << 26;
/// Largest side that every adapter can render to.
const MAX_SIDE: u32 = 16_384;

/// Reads `WIDTHxHEIGHT`.
///
/// # Errors
/// One line where the text is something else or the size is zero or absurd.
pub(crate) fn resolution(text: &str) -> Result<[u32; 2], String> {
    let numbers = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let size = numbers.ok_or_else(|| format!("`{text}` is not WIDTHxHEIGHT, such as 512x512"))?;
    check_resolution(size)?;
    Ok(size)
}

/// Refuses sizes that cannot be meant.
///
/// # Errors
/// One line with the limits.
pub(crate) fn check_resolution(size @ [width, height]: [u32; 2]) -> Result<(), String> {
    let sides_fit = size.iter().all(|side| (1..=MAX_SIDE).contains(side));
    if sides_fit && u64::from(width) * u64::from(height) <= MAX_PIXELS {
        return Ok(());
    }
    Err(format!(
        "resolution {width}x{height}: sides must be 1 to {MAX_SIDE} and the area at most {MAX_PIXELS} pixels"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resolutions_are_checked() {
        assert_eq!(resolution("64x32"), Ok([64, 32]));
        assert_eq!(resolution("16384x4096"), Ok([16_384, 4096]));
        for bad in ["", "64", "64x", "x64", "64X64", "-1x4", "1.5x2", "0x64", "64x0", "16385x1"] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
        assert!(resolution("16384x16384").is_err(), "too many pixels");
    }

    #[test]
    fn settings_need_a_key() {
        assert_eq!(split("a=b=c"), Ok(("a".to_owned(), "b=c".to_owned())));
        assert!(split("a").is_err() && split("=1").is_err());
    }
}
