//! Isotropic measurements of the RGL database (Dupuy and Jakob 2018, "An Adaptive Parameterization for
//! Efficient Material Acquisition and Rendering"), in their own parameters:
//!
//! f(v, l) n·l = S(u; θ_v) D(θ_h) / (4 σ(θ_v))
//!
//! with colours S, the distribution of micro-normals D, their projected area σ, and u the point of the
//! unit square that the distribution of visible normals warps to the half vector: its inverse is the
//! marginal and conditional integrals of a bilinear density. Directions enter as √(2θ/π) and
//! φ/(2π) + 1/2. S and the density are tabulated for some θ_v and interpolated linearly between them.
//! Measured colours may be negative; they are clamped at 0 before interpolation.

use super::fault::broken;
use super::real::Real;
use super::tensor::TensorFile;
use crate::LoadError;

/// The first word of such a table on the adapter.
const RGL: u32 = 0;

/// Tables of one material. Grids are row-major, columns first in their sizes.
#[derive(PartialEq)]
pub(super) struct Rgl {
    /// Ascending θ_v, radians: at least two.
    angles: Vec<f32>,
    /// D over √(2θ/π).
    distribution: Vec<f32>,
    /// σ over √(2θ/π).
    area: Vec<f32>,
    density_size: [usize; 2],
    /// Density of visible normals over (θ_h, φ_h − φ_v), for each angle; integrates to 1.
    density: Vec<f32>,
    /// Its integral along each row up to each column.
    conditional: Vec<f32>,
    /// The integral of whole rows up to each row.
    marginal: Vec<f32>,
    color_size: [usize; 2],
    /// S, red, green, blue for each point.
    color: Vec<f32>,
}

/// A place between two neighbours of a row of numbers.
#[derive(Clone, Copy)]
struct Place<T> {
    index: usize,
    fraction: T,
}

impl<T: Real> Place<T> {
    /// Of `unit` in [0, 1] among `count` equidistant numbers.
    fn new(unit: T, count: usize) -> Self {
        let last = count - 1;
        let scaled = unit.max(T::zero()).min(T::one()) * T::count(last);
        let index = scaled.to_usize().unwrap_or(0).min(last - 1);
        Self { index, fraction: scaled - T::count(index) }
    }

    fn mix(self, values: [T; 2]) -> T {
        (T::one() - self.fraction) * values[0] + self.fraction * values[1]
    }

    fn read(self, values: &[f32]) -> T {
        self.mix([self.index, self.index + 1].map(|index| values[index].into()))
    }
}

impl Rgl {
    /// Reads a `.bsdf` file.
    ///
    /// # Errors
    /// Where it is broken, or measures what is not isotropic or not in RGB.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, LoadError> {
        let file = TensorFile::open(bytes)?;
        if file.has("wavelengths") {
            let remedy = "use the RGB version of the measurement";
            return Err(LoadError::new("wavelengths", "the file is spectral", remedy));
        }
        let ([azimuths], _) = file.floats("phi_i")?;
        if azimuths != 1 {
            let remedy = "use an isotropic measurement";
            return Err(LoadError::new("phi_i", "the material is anisotropic", remedy));
        }
        let ([count], angles) = file.floats("theta_i")?;
        if count < 2 || !angles.is_sorted_by(|a, b| a < b) {
            return Err(broken("theta_i", "does not ascend over two angles or more"));
        }
        let one_azimuth = || broken("vndf, rgb", "have more than one azimuth");
        let ([1, angles_of_density, rows, columns], density) = file.floats("vndf")? else {
            return Err(one_azimuth());
        };
        let ([1, angles_of_color, channels, color_rows, color_columns], color) =
            file.floats("rgb")?
        else {
            return Err(one_azimuth());
        };
        if [angles_of_density, angles_of_color, channels] != [count, count, 3] {
            return Err(broken("vndf, rgb", "do not fit theta_i and three channels"));
        }
        if [rows, columns, color_rows, color_columns].iter().any(|&size| size < 2) {
            return Err(broken("vndf, rgb", "have fewer than two rows or columns"));
        }
        let (mut distribution, mut area) = (row(&file, "ndf")?, row(&file, "sigma")?);
        if !file.flag("jacobian")? {
            // S is the whole value then.
            distribution.fill(1.0);
            area.fill(0.25);
        }
        if area.iter().any(|&area| area <= 0.0) {
            return Err(broken("sigma", "is not positive"));
        }
        if distribution.iter().any(|&distribution| distribution < 0.0) {
            return Err(broken("ndf", "is negative"));
        }
        let mut made = Self {
            angles,
            distribution,
            area,
            density_size: [columns, rows],
            density,
            conditional: Vec::new(),
            marginal: Vec::new(),
            color_size: [color_columns, color_rows],
            color: interleaved(&color, color_rows * color_columns),
        };
        made.integrate()?;
        Ok(made)
    }

    /// Normalises the densities and sums them up, in f64.
    fn integrate(&mut self) -> Result<(), LoadError> {
        let [columns, rows] = self.density_size;
        if self.density.iter().any(|&value| value < 0.0) {
            return Err(broken("vndf", "is negative"));
        }
        for density in self.density.chunks_exact_mut(rows * columns) {
            let step = 1.0 / (columns - 1) as f64;
            let lines = density.chunks_exact(columns).map(|line| running(line, step));
            let conditional: Vec<f64> = lines.flatten().collect();
            let totals: Vec<f32> =
                conditional.chunks_exact(columns).map(|line| line[columns - 1] as f32).collect();
            let marginal = running(&totals, 1.0 / (rows - 1) as f64);
            let total = marginal[rows - 1];
            if total <= 0.0 || total.is_nan() {
                return Err(broken("vndf", "is zero for an angle"));
            }
            self.conditional.extend(conditional.iter().map(|value| (value / total) as f32));
            self.marginal.extend(marginal.iter().map(|value| (value / total) as f32));
            for value in density {
                *value = (f64::from(*value) / total) as f32;
            }
        }
        Ok(())
    }

    /// f(v, l) n·l of directions above the horizon in a frame with the normal as z and v in the
    /// x-z plane, x ≥ 0.
    pub(super) fn eval<T: Real>(&self, v: [T; 3], l: [T; 3]) -> [T; 3] {
        let h = [v[0] + l[0], v[1] + l[1], v[2] + l[2]];
        let theta_v = elevation(v);
        let across = Place::new(theta_to_unit(elevation(h)), self.density_size[0]);
        let turns = h[1].atan2(h[0]) / (T::PI() + T::PI()) + T::half();
        let around = Place::new(turns, self.density_size[1]);
        let angle = self.angle(theta_v);
        let u = self.unwarped(angle, across, around);
        let sampled = [Place::new(u[0], self.color_size[0]), Place::new(u[1], self.color_size[1])];
        let distribution = Place::new(theta_to_unit(elevation(h)), self.distribution.len());
        let area = Place::new(theta_to_unit(theta_v), self.area.len());
        let scale = distribution.read(&self.distribution)
            / (area.read(&self.area) * (T::one() + T::one() + T::one() + T::one()));
        self.color(angle, sampled).map(|color| color * scale)
    }

    /// The place of θ_v among the angles.
    fn angle<T: Real>(&self, theta: T) -> Place<T> {
        let above = self.angles.partition_point(|&angle| T::from_f32(angle) <= theta);
        let index = above.saturating_sub(1).min(self.angles.len() - 2);
        let [low, high] = [self.angles[index], self.angles[index + 1]].map(T::from_f32);
        let fraction = (theta - low) / (high - low);
        Place { index, fraction: fraction.max(T::zero()).min(T::one()) }
    }

    /// The point of the unit square that the density warps to the place (across, around).
    fn unwarped<T: Real>(&self, angle: Place<T>, across: Place<T>, around: Place<T>) -> [T; 2] {
        let [columns, rows] = self.density_size;
        let between = |table: &[f32], stride: usize, index: usize| {
            angle.mix([0, 1].map(|next| table[(angle.index + next) * stride + index].into()))
        };
        let grid = |table: &[f32], row: usize, column: usize| {
            between(table, columns * rows, row * columns + column)
        };
        let column = |table: &[f32], column: usize| {
            around.mix([0, 1].map(|next| grid(table, around.index + next, column)))
        };
        let below = column(&self.conditional, across.index);
        let ends = [0, 1].map(|next| column(&self.density, across.index + next));
        let step = T::one() / T::count(columns - 1);
        let x = below + step * within_cell(across.fraction, ends);
        let totals = [0, 1].map(|next| grid(&self.conditional, around.index + next, columns - 1));
        let step = T::one() / T::count(rows - 1);
        let y = between(&self.marginal, rows, around.index)
            + step * within_cell(around.fraction, totals);
        [x / around.mix(totals).max(T::min_positive_value()), y]
    }

    fn color<T: Real>(&self, angle: Place<T>, [x, y]: [Place<T>; 2]) -> [T; 3] {
        let [columns, rows] = self.color_size;
        std::array::from_fn(|channel| {
            let texel = |slice: usize, row: usize, column: usize| {
                self.color[3 * ((slice * rows + row) * columns + column) + channel].into()
            };
            let row = |slice, row| x.mix([0, 1].map(|next| texel(slice, row, x.index + next)));
            let slice = |slice| y.mix([0, 1].map(|next| row(slice, y.index + next)));
            angle.mix([0, 1].map(|next| slice(angle.index + next)))
        })
    }

    /// D at an angle, unscaled.
    pub(super) fn distribution(&self, theta: f64) -> f64 {
        Place::new(theta_to_unit(theta), self.distribution.len()).read(&self.distribution)
    }

    /// As `shaders/measured.wesl` reads it: kind, sizes, then the tables as bits of f32.
    pub(super) fn words(&self) -> Vec<u32> {
        let [columns, rows] = self.density_size;
        let [color_columns, color_rows] = self.color_size;
        let sizes = [
            self.angles.len(),
            self.distribution.len(),
            self.area.len(),
            columns,
            rows,
            color_columns,
            color_rows,
        ];
        let tables = [
            &self.angles,
            &self.distribution,
            &self.area,
            &self.density,
            &self.conditional,
            &self.marginal,
            &self.color,
        ];
        let numbers = tables.into_iter().flatten().map(|value| value.to_bits());
        [RGL].into_iter().chain(sizes.map(|size| size as u32)).chain(numbers).collect()
    }
}

/// The one row of a table that does not depend on the azimuth.
fn row(file: &TensorFile, name: &str) -> Result<Vec<f32>, LoadError> {
    let ([_, columns], mut values) = file.floats(name)?;
    let (first, rest) = values.split_at(columns);
    if columns < 2 || rest.chunks(columns).any(|row| row != first) {
        return Err(broken(name, "depends on the azimuth, or has a single column"));
    }
    values.truncate(columns);
    Ok(values)
}

/// Planes of three channels for each angle as triples, without negative ones.
fn interleaved(planes: &[f32], points: usize) -> Vec<f32> {
    let slices = planes.chunks_exact(3 * points);
    let triples =
        slices.flat_map(|slice| (0..points).map(move |i| [0, 1, 2].map(|c| slice[c * points + i])));
    triples.flatten().map(|value| value.max(0.0)).collect()
}

/// Integral of the linear interpolation of equidistant `values` up to each of them.
fn running(values: &[f32], step: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    for pair in values.windows(2) {
        sum += 0.5 * step * (f64::from(pair[0]) + f64::from(pair[1]));
        sums.push(sum);
    }
    sums
}

/// ∫₀ˣ of the linear interpolation of two numbers.
fn within_cell<T: Real>(x: T, [left, right]: [T; 2]) -> T {
    x * (left + T::half() * x * (right - left))
}

/// √(2θ/π): 0 at the normal, 1 at the horizon.
fn theta_to_unit<T: Real>(theta: T) -> T {
    (theta / T::FRAC_PI_2()).sqrt()
}

/// The angle from the normal.
fn elevation<T: Real>([x, y, z]: [T; 3]) -> T {
    (x * x + y * y).sqrt().atan2(z)
}
