//! Checks of the numbers in a scene file. `place` is where they stand, `key` what they are.

use std::ops::RangeInclusive;

use glam::Vec3;

use crate::LoadError;

/// Lengths in metres whose squares and their ratios f32 holds.
pub(super) const LENGTHS: RangeInclusive<f32> = 1e-9..=1e9;

/// `value`, if it is in `range`; NaN never is.
pub(super) fn number(
    place: &str,
    key: &str,
    value: f32,
    range: RangeInclusive<f32>,
) -> Result<f32, LoadError> {
    if range.contains(&value) {
        return Ok(value);
    }
    let remedy = format!("use a number from {} to {}", range.start(), range.end());
    Err(LoadError::new(place, format!("{key} = {value} is out of range"), remedy))
}

pub(super) fn vector(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let vector = Vec3::from(value);
    if vector.is_finite() {
        return Ok(vector);
    }
    Err(LoadError::new(place, format!("{key} is not finite"), "use finite numbers"))
}

/// A position from which distances are finite.
pub(super) fn position(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let farthest = *LENGTHS.end();
    for coordinate in vector(place, key, value)?.to_array() {
        number(place, key, coordinate, -farthest..=farthest)?;
    }
    Ok(value.into())
}

pub(super) fn direction(place: &str, key: &str, value: Vec3) -> Result<Vec3, LoadError> {
    let remedy = "give it a direction";
    value
        .try_normalize()
        .ok_or_else(|| LoadError::new(place, format!("{key} has no length"), remedy))
}

/// A finite colour without negative channels.
pub(super) fn radiance(place: &str, key: &str, value: [f32; 3]) -> Result<Vec3, LoadError> {
    let color = vector(place, key, value)?;
    if color.min_element() >= 0.0 {
        return Ok(color);
    }
    Err(LoadError::new(place, format!("{key} is negative"), "use numbers from 0"))
}
