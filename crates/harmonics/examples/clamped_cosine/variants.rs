//! Inputs, and the five variants on them.

use manylights_harmonics::clamped_cosine::{self, Folded, Local};
use manylights_harmonics::product::Product;
use manylights_harmonics::rotation::{Matrix, Zxzxz};
use manylights_harmonics::zonal::{self, Cap};
use manylights_harmonics::{Basis, count};

/// A light and a surface.
pub(crate) struct Case {
    /// Rows are the axes of the surface, the last one its normal.
    to_local: Matrix<f64>,
    to_local_single: Matrix<f32>,
    /// Coefficients of the light in the frame of the world and in that of the surface.
    world: Vec<f32>,
    pub(crate) local: Vec<f32>,
}

impl Case {
    pub(crate) fn to_world(&self, local: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| (0..3).map(|row| self.to_local[row][axis] * local[row]).sum())
    }
}

/// A hundred of them.
pub(crate) fn cases(bands: usize) -> Vec<Case> {
    let basis = Basis::<f64>::new(bands);
    let mut scales = vec![0.0; bands];
    zonal::cap_stable(Cap { sine: 0.3_f64.sin(), cosine: 0.3_f64.cos() }, &mut scales);
    let coefficients = |direction: [f64; 3]| {
        let mut coefficients = vec![0.0; count(bands)];
        zonal::rotate(&basis, &scales, direction, &mut coefficients);
        coefficients.into_iter().map(|f| f as f32).collect()
    };
    (0..100)
        .map(|i| {
            let to_local = frame(direction(i));
            let light = direction(37 * i % 100);
            let turned = to_local.map(|row| (0..3).map(|axis| row[axis] * light[axis]).sum());
            Case {
                to_local,
                to_local_single: to_local.map(|row| row.map(|component| component as f32)),
                world: coefficients(light),
                local: coefficients(turned),
            }
        })
        .collect()
}

/// One of a hundred directions.
fn direction(i: usize) -> [f64; 3] {
    let (s, c) = (2.4 * i as f64).sin_cos();
    let z = (i as f64 - 49.5) / 50.0;
    let sine = ((1.0 - z) * (1.0 + z)).sqrt();
    [sine * c, sine * s, z]
}

/// Two tangents and the normal.
fn frame(normal @ [x, y, z]: [f64; 3]) -> Matrix<f64> {
    let sine = x.hypot(y);
    [[x * z / sine, y * z / sine, -sine], [-y / sine, x / sine, 0.0], normal]
}

/// Tables and room for a number of bands.
pub(crate) struct Variants {
    basis: Basis<f32>,
    short_basis: Basis<f32>,
    cosine: Vec<f32>,
    product: Product<f32>,
    folded: Folded<f32>,
    cut: Folded<f32>,
    local: Local<f32>,
    rotation: Zxzxz<f32>,
    normal: Vec<f32>,
    light: Vec<f32>,
    result: Vec<f32>,
}

impl Variants {
    pub(crate) fn new(bands: usize) -> Self {
        let mut cosine = vec![0.0; bands];
        clamped_cosine::scales(&mut cosine);
        let all = || vec![0.0; count(bands)];
        Self {
            basis: Basis::new(bands),
            short_basis: Basis::new(3),
            cosine,
            product: Product::new(bands),
            folded: Folded::new(bands, bands),
            cut: Folded::new(bands, 3),
            local: Local::new(bands),
            rotation: Zxzxz::new(bands),
            normal: all(),
            light: all(),
            result: all(),
        }
    }

    /// The product by 2.47, 4.5, 4.5 cut, 4.6 with rotation, 4.6; the last two in the surface's frame.
    pub(crate) fn run(&mut self, variant: usize, case: &Case) -> &[f32] {
        let (to_local, result) = (case.to_local_single, &mut self.result);
        let normal = to_local[2];
        match variant {
            0 => {
                zonal::rotate(&self.basis, &self.cosine, normal, &mut self.normal);
                self.product.apply(&case.world, &self.normal, result);
            }
            1 => {
                self.basis.evaluate(normal, &mut self.normal);
                self.folded.apply(&case.world, &self.normal, result);
            }
            2 => {
                let values = &mut self.normal[..count(3)];
                self.short_basis.evaluate(normal, values);
                self.cut.apply(&case.world, values, result);
            }
            3 => {
                self.light.copy_from_slice(&case.world);
                self.local.apply_turned(&self.rotation, to_local, &mut self.light, result);
            }
            _ => self.local.apply(&case.local, result),
        }
        result
    }
}
