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

/// Magic, version and number of fields.
const PREAMBLE: &[u8] = b"tensor_file\0\x01\x00";

/// Bytes before the data of the first field.
pub(crate) fn head_size(fields: &[Field]) -> usize {
    let entry = |field: &Field| 2 + field.name.len() + 2 + 1 + 8 + 8 * field.shape.len();
    PREAMBLE.len() + 4 + fields.iter().map(entry).sum::<usize>()
}

/// The file of these fields.
pub(crate) fn file(fields: &[Field]) -> Vec<u8> {
    let mut bytes = PREAMBLE.to_vec();
    bytes.extend((fields.len() as u32).to_le_bytes());
    let mut offset = head_size(fields) as u64;
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

/// The grids of [`material`]: θ_v; columns and rows of the density; of colours.
const ANGLES: [f32; 3] = [0.0, 0.4, std::f32::consts::FRAC_PI_2];
pub(crate) const DENSITY: [u64; 2] = [9, 5];
pub(crate) const COLOR: [u64; 2] = [5, 4];

/// A measurement whose tables are functions of a place in the unit square, θ_v and, for colours, the
/// channel: the density of visible normals, D, σ and S. Two fields are those of real files that nobody
/// reads.
pub(crate) fn material(
    density: impl Fn(f32, f32, f32) -> f32,
    distribution: impl Fn(f32) -> f32,
    area: impl Fn(f32) -> f32,
    color: impl Fn(f32, f32, f32, u64) -> f32,
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
    let slices = ANGLES.iter().copied();
    let densities = slices.clone().flat_map(|theta| grid(DENSITY, &|x, y| density(x, y, theta)));
    let planes = slices.flat_map(|theta| [(theta, 0), (theta, 1), (theta, 2)]);
    let colors = planes.flat_map(|(theta, c)| grid(COLOR, &|x, y| color(x, y, theta, c)));
    let count = ANGLES.len() as u64;
    let text = b"Nothing that was ever measured.".to_vec();
    vec![
        Field::floats("phi_i", &[1], vec![0.0]),
        Field::floats("theta_i", &[count], ANGLES.to_vec()),
        Field::floats("sigma", &[2, DENSITY[0]], line(&area)),
        Field::floats("ndf", &[2, DENSITY[0]], line(&distribution)),
        Field::floats("vndf", &[1, count, DENSITY[1], DENSITY[0]], densities.collect()),
        Field::floats("rgb", &[1, count, 3, COLOR[1], COLOR[0]], colors.collect()),
        Field { name: "description", kind: 1, shape: vec![text.len() as u64], bytes: text },
        Field::floats("luminance", &[1, count, 1, 1], vec![0.5; ANGLES.len()]),
        Field { name: "jacobian", kind: 1, shape: vec![1], bytes: vec![1] },
    ]
}

/// [`satin_fields`] as a file.
pub(crate) fn satin() -> Vec<u8> {
    file(&satin_fields())
}

/// A smooth invention that has everything: a lobe over a base, colours, a density that varies.
pub(crate) fn satin_fields() -> Vec<Field> {
    material(
        |x, y, theta| (1.2 + 0.5 * theta - x) * (1.0 + 0.3 * (y - 0.5)) + 0.2 * x * y,
        |x| 0.2 + 1.5 * (-6.0 * x * x).exp(),
        |x| 1.0 - 0.6 * x,
        |x, y, theta, c| (0.3 + 0.1 * c as f32 + 0.2 * x * (1.0 - y)) * (1.0 - 0.3 * theta),
    )
}
