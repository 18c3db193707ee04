//! What was packed, in single precision again.

use manylights_harmonics::count;

use crate::packed_layout::PackedLayout;

/// Of vertices that [`pack`](crate::pack) made, as words, the numbers that reading finds there, laid out as those that
/// were packed.
pub fn unpacked(packed: &[[u32; 4]], bands: usize, gradients: bool) -> Vec<[f32; 4]> {
    let size = count(bands);
    let PackedLayout { header, vectors } = PackedLayout::new(bands, gradients);
    let mut numbers = Vec::new();
    for vertex in packed.chunks_exact(vectors) {
        let (head, coefficients) = vertex.split_at(header);
        let scales = head[0].map(f32::from_bits);
        for i in 0..size {
            if gradients {
                let scale = f32::from_bits(head[1 + i.isqrt() / 4][i.isqrt() % 4]);
                numbers.extend(with_gradients(coefficients[i], scales, scale));
            } else {
                let words = &coefficients[i / 2][2 * (i % 2)..];
                let values = [half(words[0]), half(words[0] >> 16), half(words[1])];
                let [red, green, blue] = [0, 1, 2].map(|c| scales[c] * values[c]);
                numbers.push([red, green, blue, 0.0]);
            }
        }
    }
    numbers
}

fn with_gradients([x, y, z, w]: [u32; 4], scales: [f32; 4], band: f32) -> [[f32; 4]; 3] {
    let values = [half(x), half(x >> 16), half(y)];
    let byte = |word: u32, place: u32| band * normalised((word >> (8 * place)) as u8);
    let gradients = [
        [byte(z, 0), byte(z, 1), byte(z, 2)],
        [byte(w, 0), byte(w, 1), byte(w, 2)],
        [byte(y, 2), byte(y, 3), byte(z, 3)],
    ];
    [0, 1, 2].map(|channel| {
        let [x, y, z] = gradients[channel];
        [scales[channel] * values[channel], x, y, z]
    })
}

/// The number in half precision in the lower 16 bits.
fn half(bits: u32) -> f32 {
    let (exponent, fraction) = ((bits >> 10 & 31) as i32, (bits & 1023) as f32 / 1024.0);
    let size = match exponent {
        0 => fraction * 2.0_f32.powi(-14),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1.0 + fraction) * 2.0_f32.powi(exponent - 15),
    };
    if bits >> 15 & 1 == 1 { -size } else { size }
}

/// The number from −1 to 1 in a byte.
fn normalised(byte: u8) -> f32 {
    (f32::from(byte as i8) / 127.0).max(-1.0)
}
