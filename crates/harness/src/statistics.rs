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
}
