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

/// Mean of paired differences and half of its 95 % confidence interval (Student's t; the differences
/// are taken to be normal). `None` below two pairs: one has no spread.
pub(crate) fn paired_difference(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    let count = pairs.len();
    if count < 2 {
        return None;
    }
    let n = count as f64;
    let mean = pairs.iter().map(|(a, b)| a - b).sum::<f64>() / n;
    let variance = pairs.iter().map(|(a, b)| (a - b - mean).powi(2)).sum::<f64>() / (n - 1.0);
    Some((mean, student_95(count - 1) * (variance / n).sqrt()))
}

/// The 97.5 % quantile of Student's t distribution: a table to ten degrees of freedom, beyond it the
/// expansion of Cornish and Fisher to third order (Abramowitz and Stegun 26.7.5), right to 2e-4.
fn student_95(degrees: usize) -> f64 {
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
    fn differences_have_the_interval_of_students_t() {
        // scipy.stats.ttest_rel([1, 2, 4], [0, 2, 2]).confidence_interval() = (-1.484, 3.484)
        let (mean, half) = paired_difference(&[(1.0, 0.0), (2.0, 2.0), (4.0, 2.0)]).expect("three");
        assert!((mean - 1.0).abs() < 1e-12 && (half - 2.484).abs() < 1e-3, "{mean} ± {half}");
        assert_eq!(paired_difference(&[(1.0, 2.0)]), None);
        // scipy.stats.t.ppf(0.975, [11, 20, 100]) = [2.20099, 2.08596, 1.98397]
        for (degrees, quantile) in [(11, 2.20099), (20, 2.08596), (100, 1.98397)] {
            assert!((student_95(degrees) - quantile).abs() < 2e-4);
        }
    }
}
