//! Writes files like those of the RGL database.

/// A field: name, type code, shape, bytes.
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) kind: u8,
    pub(crate) shape: Vec<u64>,
    pub(crate) bytes: Vec<u8>,
}

impl Field {
    pub(crate) fn floats(name: &'static str, shape: &[u64], values: Vec<f32>) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { name, kind: 10, shape: shape.to_vec(), bytes }
    }
}

/// The file of these fields.
pub(crate) fn file(fields: &[Field]) -> Vec<u8> {
    let head: usize = fields.iter().map(|f| 2 + f.name.len() + 2 + 1 + 8 + 8 * f.shape.len()).sum();
    let mut bytes = b"tensor_file\0\x01\x00".to_vec();
    bytes.extend((fields.len() as u32).to_le_bytes());
    let mut offset = (bytes.len() + head) as u64;
    for field in fields {
        bytes.extend((field.name.len() as u16).to_le_bytes());
        bytes.extend(field.name.as_bytes());
        bytes.extend((field.shape.len() as u16).to_le_bytes());
        bytes.push(field.kind);
        bytes.extend(offset.to_le_bytes());
        bytes.extend(field.shape.iter().flat_map(|size| size.to_le_bytes()));
        offset += field.bytes.len() as u64;
    }
    bytes.extend(fields.iter().flat_map(|field| &field.bytes));
    bytes
}

/// Numbers of the grids of [`material`]: θ_v; columns and rows of the density; of colours.
pub(crate) const ANGLES: u64 = 3;
pub(crate) const DENSITY: [u64; 2] = [9, 5];
pub(crate) const COLOR: [u64; 2] = [5, 4];

/// A measurement whose tables are functions of a place in the unit square and, for colours, the
/// channel: the density of visible normals, D, σ and S, the same for all θ_v.
pub(crate) fn material(
    density: impl Fn(f32, f32) -> f32,
    distribution: impl Fn(f32) -> f32,
    area: impl Fn(f32) -> f32,
    color: impl Fn(f32, f32, u64) -> f32,
) -> Vec<Field> {
    let unit = |index: u64, count: u64| index as f32 / (count - 1) as f32;
    let line = |f: &dyn Fn(f32) -> f32| -> Vec<f32> {
        let once: Vec<f32> = (0..DENSITY[0]).map(|i| f(unit(i, DENSITY[0]))).collect();
        [once.clone(), once].concat()
    };
    let grid = |[columns, rows]: [u64; 2], f: &dyn Fn(f32, f32) -> f32| -> Vec<f32> {
        let places = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        places.map(|(i, j)| f(unit(i, columns), unit(j, rows))).collect()
    };
    let angles = (0..ANGLES).map(|i| unit(i, ANGLES) * std::f32::consts::FRAC_PI_2).collect();
    let densities = grid(DENSITY, &density).repeat(ANGLES as usize);
    let colors: Vec<f32> = (0..3).flat_map(|c| grid(COLOR, &|x, y| color(x, y, c))).collect();
    vec![
        Field::floats("phi_i", &[1], vec![0.0]),
        Field::floats("theta_i", &[ANGLES], angles),
        Field::floats("sigma", &[2, DENSITY[0]], line(&area)),
        Field::floats("ndf", &[2, DENSITY[0]], line(&distribution)),
        Field::floats("vndf", &[1, ANGLES, DENSITY[1], DENSITY[0]], densities),
        Field::floats("rgb", &[1, ANGLES, 3, COLOR[1], COLOR[0]], colors.repeat(ANGLES as usize)),
        Field { name: "jacobian", kind: 1, shape: vec![1], bytes: vec![1] },
    ]
}

/// A smooth invention that has everything: a lobe over a base, colours, a density that varies.
pub(crate) fn satin() -> Vec<u8> {
    file(&material(
        |x, y| (1.2 - x) * (1.0 + 0.3 * (y - 0.5)),
        |x| 0.2 + 1.5 * (-6.0 * x * x).exp(),
        |x| 1.0 - 0.6 * x,
        |x, y, c| 0.3 + 0.1 * c as f32 + 0.2 * x * (1.0 - y),
    ))
}
