//! Medians and quartiles of repeated measurements.

/// The middle and the spread of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quartiles {
    /// A quarter of the values lies below.
    pub(crate) lower: f64,
    /// The median.
    pub(crate) median: f64,
    /// A quarter of the values lies above.
    pub(crate) upper: f64,
}

/// Quartiles with linear interpolation between order statistics (type 7 of Hyndman and Fan 1996,
/// the default of R and NumPy); `None` of nothing.
pub(crate) fn quartiles(values: impl IntoIterator<Item = f64>) -> Option<Quartiles> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    let quantile = |share: f64| {
        let position = share * last as f64;
        let (below, above) = (values[position.floor() as usize], values[position.ceil() as usize]);
        // Equal neighbours may both be infinite: their difference must not be formed.
        if below == above { below } else { below + position.fract() * (above - below) }
    };
    Some(Quartiles { lower: quantile(0.25), median: quantile(0.5), upper: quantile(0.75) })
}

/// The median; `None` of nothing.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    quartiles(values).map(|quartiles| quartiles.median)
}

/// The mean; not a number of nothing.
pub(crate) fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The unbiased variance of two values or more.
pub(crate) fn variance(values: &[f64]) -> f64 {
    let mean = mean(values.iter().copied());
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (values.len() as f64 - 1.0)
}

/// The 97.5 % quantile of Student's t distribution: a table to ten degrees of freedom, beyond it the
/// expansion of Cornish and Fisher to third order (Abramowitz and Stegun 26.7.5), right to 2e-4.
pub(crate) fn student_95(degrees: usize) -> f64 {
    const TABLE: [f64; 10] =
        [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];
    const NORMAL: f64 = 1.959_964;
    match TABLE.get(degrees - 1) {
        Some(&quantile) => quantile,
        None => {
            let (z, n) = (NORMAL, degrees as f64);
            let first = (z.powi(3) + z) / 4.0;
            let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
            let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
            z + first / n + second / (n * n) + third / n.powi(3)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_agree_with_numpy() {
        // numpy.percentile([4, 1, 3, 2], [25, 50, 75]) = [1.75, 2.5, 3.25]
        let expected = Quartiles { lower: 1.75, median: 2.5, upper: 3.25 };
        assert_eq!(quartiles([4.0, 1.0, 3.0, 2.0]), Some(expected));
        assert_eq!(median([5.0]), Some(5.0));
        assert_eq!(median([f64::INFINITY, f64::INFINITY]), Some(f64::INFINITY));
        assert_eq!(median([]), None);
    }

    #[test]
    fn quantiles_of_students_t() {
        // scipy.stats.t.ppf(0.975, [1, 10, 11, 20, 100])
        for (degrees, quantile) in
            [(1, 12.706), (10, 2.228), (11, 2.20099), (20, 2.08596), (100, 1.98397)]
        {
            assert!((student_95(degrees) - quantile).abs() < 5e-4, "{degrees}");
        }
        assert!((variance(&[1.0, 2.0, 4.0]) - 7.0 / 3.0).abs() < 1e-12);
    }
}
