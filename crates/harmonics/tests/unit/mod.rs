//! Unit vectors, for tests and examples of several packages.

/// The direction of f32 components nearest to unit length among some beside the given one: a component
/// off by δ moves band l by up to l(l + 1)/2 δ, which is not what is measured with it.
pub(crate) fn unit(direction: [f64; 3]) -> [f32; 3] {
    let largest = direction.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let error = |d: &[f32; 3]| (d.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>() - 1.0).abs();
    let candidates = (0..400).map(|i| {
        let stretch = 1.0 + 1e-5 * f64::from(i);
        let moved = direction.map(|c| if c.abs() < largest { c * stretch } else { c });
        normalised(moved).map(|c| c as f32)
    });
    candidates.min_by(|a, b| error(a).total_cmp(&error(b))).expect("some candidates")
}

/// The vector at length one.
pub(crate) fn normalised(direction: [f64; 3]) -> [f64; 3] {
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    direction.map(|c| c / length)
}
