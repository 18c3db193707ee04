//! The spaces of colour that the observer needs. Values of CIE XYZ are relative to the display's white
//! throughout.

use crate::srgb;

/// X, Y, Z of linear Rec. 709, from its primaries and white of 0.3127, 0.3290 (IEC 61966-2-1).
const TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_80, 0.357_584_34, 0.180_480_79],
    [0.212_639_01, 0.715_168_68, 0.072_192_32],
    [0.019_330_82, 0.119_194_78, 0.950_532_15],
];

type Matrix = [[f64; 3]; 3];

/// Both ways between linear Rec. 709 and X/Xₙ, Y/Yₙ, Z/Zₙ.
pub(super) struct Display {
    to_relative: Matrix,
    from_relative: Matrix,
}

impl Display {
    pub(super) fn new() -> Self {
        let to_relative = TO_XYZ.map(|row| row.map(|part| part / row.iter().sum::<f64>()));
        Self { to_relative, from_relative: inverse(to_relative) }
    }

    /// Y_y, c_x, c_z of sRGB values: linear in radiance, so that filters average light.
    pub(super) fn opponent(&self, pixel: &[f32; 3]) -> [f64; 3] {
        let linear = pixel.map(|value| srgb::linear(value.into()));
        let [x, y, z] = product(&self.to_relative, linear);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// What the display shows of Y_y, c_x, c_z.
    pub(super) fn lab_of_opponent(&self, [luminance, red_green, blue_yellow]: [f64; 3]) -> Lab {
        let y = (luminance + 16.0) / 116.0;
        let relative = [red_green / 500.0 + y, y, y - blue_yellow / 200.0];
        self.lab(product(&self.from_relative, relative).map(|value| value.clamp(0.0, 1.0)))
    }

    /// Of linear Rec. 709 in `[0, 1]`.
    pub(super) fn lab(&self, linear: [f64; 3]) -> Lab {
        let [x, y, z] = product(&self.to_relative, linear).map(response);
        let lightness = 116.0 * y - 16.0;
        // Hunt's effect: colours look the stronger the lighter they are.
        let hunt = 0.01 * lightness;
        Lab { lightness, a: hunt * 500.0 * (x - y), b: hunt * 200.0 * (y - z) }
    }
}

/// CIE L*a*b* with Hunt's effect.
#[derive(Clone, Copy)]
pub(super) struct Lab {
    lightness: f64,
    a: f64,
    b: f64,
}

impl Lab {
    /// HyAB (Abasi, Amani Tehran and Fairchild 2020), which suits colours far from each other, too.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        (self.lightness - other.lightness).abs() + (self.a - other.a).hypot(self.b - other.b)
    }
}

/// f of CIE L*a*b*: a cube root with a straight line near zero.
fn response(relative: f64) -> f64 {
    const DELTA: f64 = 6.0 / 29.0;
    match relative > DELTA.powi(3) {
        true => relative.cbrt(),
        false => relative / (3.0 * DELTA * DELTA) + 4.0 / 29.0,
    }
}

fn product(matrix: &Matrix, [x, y, z]: [f64; 3]) -> [f64; 3] {
    matrix.map(|[a, b, c]| a * x + b * y + c * z)
}

/// Cross products of rows over the determinant.
fn inverse([a, b, c]: Matrix) -> Matrix {
    let cross = |u: [f64; 3], v: [f64; 3]| {
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    };
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant: f64 = a.iter().zip(columns[0]).map(|(&part, cofactor)| part * cofactor).sum();
    [0, 1, 2].map(|row| columns.map(|column| column[row] / determinant))
}
