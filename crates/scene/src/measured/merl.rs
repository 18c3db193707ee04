//! Isotropic measurements of the MERL database (Matusik et al. 2003): 90 × 90 × 180 values over half and
//! difference angles (Rusinkiewicz 1998), θ_h in steps of its square root.
//!
//! The file: three 32-bit sizes, then 64-bit floats of the red, green and blue plane, which are to be
//! multiplied by 1/1500, 1.15/1500 and 1.66/1500; negative values mark what could not be measured and
//! count 0. Deviation from the database's own code, which takes the nearest value: linear interpolation
//! between the middles of cells.

use super::fault::broken;
use super::real::Real;
use crate::LoadError;

/// The first word of such a table on the adapter.
const MERL: u32 = 1;

const SIZE: [usize; 3] = [90, 90, 180];
const POINTS: usize = SIZE[0] * SIZE[1] * SIZE[2];
const SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// The table of one material: red, green, blue for each point, φ_d first.
#[derive(PartialEq)]
pub(super) struct Merl {
    values: Vec<f32>,
}

impl Merl {
    /// Reads a `.binary` file.
    ///
    /// # Errors
    /// Where it is of another size or not finite.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, LoadError> {
        let (sizes, numbers) =
            bytes.split_at_checked(12).ok_or_else(|| broken("the head", "ends too soon"))?;
        let (sizes, _) = sizes.as_chunks();
        if !sizes.iter().map(|&size| u32::from_le_bytes(size) as usize).eq(SIZE) {
            return Err(broken("the head", "is not 90 × 90 × 180"));
        }
        let (numbers, rest) = numbers.as_chunks();
        if numbers.len() != 3 * POINTS || !rest.is_empty() {
            return Err(broken("the values", format!("are not {} numbers", 3 * POINTS)));
        }
        let number = |channel: usize, point: usize| {
            (SCALE[channel] * f64::from_le_bytes(numbers[channel * POINTS + point])) as f32
        };
        let triples = (0..POINTS).map(|point| [0, 1, 2].map(|channel| number(channel, point)));
        let values: Vec<f32> = triples.flatten().map(|value| value.max(0.0)).collect();
        // max() turns a NaN into 0.
        let (finite, numbers) = (values.iter().all(|value| value.is_finite()), numbers.iter());
        if !finite || numbers.map(|&bytes| f64::from_le_bytes(bytes)).any(f64::is_nan) {
            return Err(broken("the values", "are not finite"));
        }
        Ok(Self { values })
    }

    /// f(v, l) of directions above the horizon in a frame with the normal as z.
    pub(super) fn eval<T: Real>(&self, v: [T; 3], l: [T; 3]) -> [T; 3] {
        let h = [v[0] + l[0], v[1] + l[1], v[2] + l[2]];
        let flat = (h[0] * h[0] + h[1] * h[1]).sqrt();
        let length = (flat * flat + h[2] * h[2]).sqrt();
        // The axes of the frame about h: down along its meridian, and across.
        let [c, s] =
            if flat > T::zero() { [h[0] / flat, h[1] / flat] } else { [T::one(), T::zero()] };
        let [sin_h, cos_h] = [flat / length, h[2] / length];
        let down = cos_h * (c * v[0] + s * v[1]) - sin_h * v[2];
        let across = c * v[1] - s * v[0];
        let along = sin_h * (c * v[0] + s * v[1]) + cos_h * v[2];
        let theta_h = flat.atan2(h[2]);
        let theta_d = (down * down + across * across).sqrt().atan2(along);
        // Reciprocity: φ_d and φ_d + π are one.
        let phi_d = across.atan2(down);
        let phi_d = if phi_d < T::zero() { phi_d + T::PI() } else { phi_d };
        self.interpolated([
            (theta_h / T::FRAC_PI_2()).sqrt(),
            theta_d / T::FRAC_PI_2(),
            phi_d / T::PI(),
        ])
    }

    fn interpolated<T: Real>(&self, unit: [T; 3]) -> [T; 3] {
        let cell = |axis: usize| {
            let middle = unit[axis] * T::count(SIZE[axis]) - T::half();
            let last = T::count(SIZE[axis] - 1);
            // Angles from the normal end, the azimuth goes round.
            let middle = if axis < 2 { middle.max(T::zero()).min(last) } else { middle };
            let low = middle.floor();
            let index = (low + T::count(SIZE[axis])).to_usize().unwrap_or(0) % SIZE[axis];
            let next =
                if axis < 2 { (index + 1).min(SIZE[axis] - 1) } else { (index + 1) % SIZE[2] };
            ([index, next], middle - low)
        };
        let ([h, d, p], mix) = {
            let [(h, x), (d, y), (p, z)] = [0, 1, 2].map(cell);
            ([h, d, p], [x, y, z])
        };
        let lerp = |x: T, [a, b]: [T; 2]| (T::one() - x) * a + x * b;
        std::array::from_fn(|channel| {
            let value = |h: usize, d: usize, p: usize| {
                self.values[3 * ((h * SIZE[1] + d) * SIZE[2] + p) + channel].into()
            };
            lerp(
                mix[0],
                h.map(|h| lerp(mix[1], d.map(|d| lerp(mix[2], p.map(|p| value(h, d, p)))))),
            )
        })
    }

    /// As `shaders/measured.wesl` reads it.
    pub(super) fn words(&self) -> Vec<u32> {
        [MERL].into_iter().chain(self.values.iter().map(|value| value.to_bits())).collect()
    }
}
