//! The minimum of a function without its derivatives.

/// Nelder and Mead 1965: a simplex of N + 1 points that walks downhill and shrinks. From `start`, with edges of
/// `size`, until the values differ by `tolerance` of themselves or after `steps`. Values may be infinite.
pub(super) fn minimum<const N: usize>(
    start: [f64; N],
    size: f64,
    (tolerance, steps): (f64, usize),
    value: impl Fn(&[f64; N]) -> f64,
) -> ([f64; N], f64) {
    let with_value = |point: [f64; N]| (value(&point), point);
    let corner = |i: usize| {
        let mut point = start;
        if i > 0 {
            point[i - 1] += size;
        }
        with_value(point)
    };
    let mut simplex: Vec<_> = (0..=N).map(corner).collect();
    for _ in 0..steps {
        simplex.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let (best, worst) = (simplex[0], simplex[N]);
        if worst.0 - best.0 <= tolerance * best.0 {
            break;
        }
        let mut centre = [0.0; N];
        for (_, point) in &simplex[..N] {
            centre.iter_mut().zip(point).for_each(|(sum, x)| *sum += x / N as f64);
        }
        // From the worst point through the centre of the others; −1 is its mirror image.
        let on_line = |share: f64| {
            let place = |i: usize| centre[i] + share * (worst.1[i] - centre[i]);
            with_value(std::array::from_fn(place))
        };
        let mirrored = on_line(-1.0);
        simplex[N] = if mirrored.0 < best.0 {
            let further = on_line(-2.0);
            if further.0 < mirrored.0 { further } else { mirrored }
        } else if mirrored.0 < simplex[N - 1].0 {
            mirrored
        } else {
            let between = if mirrored.0 < worst.0 { on_line(-0.5) } else { on_line(0.5) };
            if between.0 < mirrored.0.min(worst.0) {
                between
            } else {
                for (other, point) in &mut simplex[1..] {
                    let nearer = std::array::from_fn(|i| best.1[i] + 0.5 * (point[i] - best.1[i]));
                    (*other, *point) = with_value(nearer);
                }
                continue;
            }
        };
    }
    simplex.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let (least, point) = simplex[0];
    (point, least)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley.
    #[test]
    fn finds_the_end_of_a_curved_valley() {
        let valley = |&[x, y]: &[f64; 2]| 1e-12 + (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2);
        let ([x, y], least) = minimum([-1.2, 1.0], 0.1, (1e-9, 1000), valley);
        assert!((x - 1.0).abs() < 1e-5 && (y - 1.0).abs() < 1e-5 && least < 1e-10, "{x} {y}");
    }
}
