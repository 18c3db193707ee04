//! Structural similarity (Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error
//! visibility to structural similarity", 2004).

use crate::RadianceImage;

/// Pixels along a side of the window.
pub(crate) const WINDOW: usize = 11;
/// Standard deviation of the window in pixels.
const SIGMA: f64 = 1.5;
const K1: f64 = 0.01;
const K2: f64 = 0.03;

/// Moments under the window: `E[x]`, `E[r]`, `E[x²]`, `E[r²]`, `E[x r]`.
const MOMENTS: usize = 5;

/// Mean of the index over the pixels whose window lies in the picture, then over the components.
/// Sides of at least [`WINDOW`] pixels, `range` above zero.
pub(crate) fn mean(image: &RadianceImage, reference: &RadianceImage, range: f64) -> f64 {
    let mean_of = |component| {
        let planes = [Plane::new(image, component), Plane::new(reference, component)];
        mean_of_component(&planes, range)
    };
    (mean_of(0) + mean_of(1) + mean_of(2)) / 3.0
}

/// One component less its mean over the picture. Variances are differences of moments,
/// `E[x²] − E[x]²`, and lose the digits that a common offset takes; without it they keep them.
struct Plane {
    width: usize,
    offset: f64,
    values: Vec<f64>,
}

impl Plane {
    fn new(image: &RadianceImage, component: usize) -> Self {
        let mut values: Vec<_> =
            image.pixels.iter().map(|pixel| f64::from(pixel[component])).collect();
        let offset = values.iter().sum::<f64>() / values.len() as f64;
        values.iter_mut().for_each(|value| *value -= offset);
        Self { width: image.width as usize, offset, values }
    }

    /// Rows `y..y + WINDOW`.
    fn rows(&self, y: usize) -> impl Iterator<Item = &[f64]> {
        self.values[y * self.width..].chunks_exact(self.width).take(WINDOW)
    }
}

fn mean_of_component(planes: &[Plane; 2], range: f64) -> f64 {
    let width = planes[0].width;
    let weights = window();
    let columns = width + 1 - WINDOW;
    let rows = planes[0].values.len() / width + 1 - WINDOW;
    let mut down = vec![[0.0; MOMENTS]; width];
    let total: f64 = (0..rows)
        .map(|y| {
            filter_down(planes, y, &weights, &mut down);
            let index = |window: &[[f64; MOMENTS]]| index(&across(window, &weights), planes, range);
            down.windows(WINDOW).map(index).sum::<f64>()
        })
        .sum();
    total / (rows * columns) as f64
}

/// The weights of a Gaussian that sum to 1; the window is their outer product.
fn window() -> [f64; WINDOW] {
    let mut weights = [0.0; WINDOW];
    for (k, weight) in weights.iter_mut().enumerate() {
        let distance = k as f64 - (WINDOW / 2) as f64;
        *weight = (-0.5 * (distance / SIGMA).powi(2)).exp();
    }
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Weighted sums down the columns of the rows `y..y + WINDOW`.
fn filter_down(
    planes: &[Plane; 2],
    y: usize,
    weights: &[f64; WINDOW],
    down: &mut [[f64; MOMENTS]],
) {
    down.fill([0.0; MOMENTS]);
    for ((xs, rs), weight) in planes[0].rows(y).zip(planes[1].rows(y)).zip(weights) {
        for ((moments, &x), &r) in down.iter_mut().zip(xs).zip(rs) {
            let (wx, wr) = (weight * x, weight * r);
            for (moment, term) in moments.iter_mut().zip([wx, wr, wx * x, wr * r, wx * r]) {
                *moment += term;
            }
        }
    }
}

/// Weighted sums along a row.
fn across(columns: &[[f64; MOMENTS]], weights: &[f64; WINDOW]) -> [f64; MOMENTS] {
    let mut sums = [0.0; MOMENTS];
    for (column, weight) in columns.iter().zip(weights) {
        for (sum, moment) in sums.iter_mut().zip(column) {
            *sum += weight * moment;
        }
    }
    sums
}

/// Equation 13, from the moments of values less the offsets of their planes.
fn index(moments: &[f64; MOMENTS], planes: &[Plane; 2], range: f64) -> f64 {
    let &[x, r, xx, rr, xr] = moments;
    // Below zero by rounding only.
    let (variance_x, variance_r) = ((xx - x * x).max(0.0), (rr - r * r).max(0.0));
    let covariance = xr - x * r;
    let (mean_x, mean_r) = (x + planes[0].offset, r + planes[1].offset);
    let (c1, c2) = ((K1 * range).powi(2), (K2 * range).powi(2));
    (2.0 * mean_x * mean_r + c1) / (mean_x * mean_x + mean_r * mean_r + c1)
        * (2.0 * covariance + c2)
        / (variance_x + variance_r + c2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equation 13 by the definition of the moments, with two passes over each window.
    fn by_definition(image: &RadianceImage, reference: &RadianceImage, range: f64) -> f64 {
        let (weights, mut sum, mut count) = (window(), 0.0, 0.0);
        let (width, height) = (image.width as usize, image.height as usize);
        for component in 0..3 {
            for (y, x) in
                (0..=height - WINDOW).flat_map(|y| (0..=width - WINDOW).map(move |x| (y, x)))
            {
                let mean = |f: &dyn Fn(f64, f64) -> f64| {
                    let cells = (0..WINDOW).flat_map(|v| (0..WINDOW).map(move |u| (v, u)));
                    let term = |(v, u): (usize, usize)| {
                        let at = |picture: &RadianceImage| {
                            f64::from(picture.pixels[(y + v) * width + x + u][component])
                        };
                        weights[v] * weights[u] * f(at(image), at(reference))
                    };
                    cells.map(term).sum::<f64>()
                };
                let (mx, mr) = (mean(&|x, _| x), mean(&|_, r| r));
                let (vx, vr) = (mean(&|x, _| (x - mx).powi(2)), mean(&|_, r| (r - mr).powi(2)));
                let covariance = mean(&|x, r| (x - mx) * (r - mr));
                let (c1, c2) = ((0.01 * range).powi(2), (0.03 * range).powi(2));
                sum += (2.0 * mx * mr + c1) * (2.0 * covariance + c2)
                    / ((mx * mx + mr * mr + c1) * (vx + vr + c2));
                count += 1.0;
            }
        }
        sum / count
    }

    /// Values 0..=255 from Weyl's sequence, steps of 2⁻⁹ about `offset`.
    fn textured(offset: f32, step: f64) -> RadianceImage {
        let mut image = RadianceImage::black(17, 14);
        for (index, c) in image.pixels.as_flattened_mut().iter_mut().enumerate() {
            *c = offset + ((step * index as f64).fract() * 256.0).floor() as f32 / 512.0;
        }
        image
    }

    /// At an offset of 2¹⁴ and a range of 1, E[x²] − E[x]² would leave 4 digits of the variance.
    #[test]
    fn a_common_offset_costs_no_digits() {
        for offset in [0.0, 1.0, 16384.0] {
            let (image, reference) = (textured(offset, 0.618), textured(offset, 0.414));
            let (found, expected) =
                (mean(&image, &reference, 1.0), by_definition(&image, &reference, 1.0));
            assert!((found - expected).abs() < 1e-9, "{offset}: {found}, expected {expected}");
        }
    }
}
