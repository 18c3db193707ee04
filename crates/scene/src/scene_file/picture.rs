//! Pictures that say how bright the texels of a panel are.

use glam::{DVec3, Vec3};

use crate::material::srgb_to_linear;
use crate::{AreaLight, Texture};

/// The lights of k × k texels, as many for each, times a picture whose mean over all texels and
/// channels is scaled to 1; `None` where it is black.
pub(super) fn tinted(
    lights: Vec<AreaLight>,
    picture: &Texture,
    texels: u32,
) -> Option<Vec<AreaLight>> {
    let colors = box_filtered(picture, texels);
    let sum: f64 = colors.iter().map(|color| color.element_sum()).sum();
    let mean = sum / (3 * colors.len()) as f64;
    let of_a_texel = lights.len() / colors.len();
    let tint = |(i, light): (usize, AreaLight)| {
        let color = (colors[i / of_a_texel] / mean).as_vec3();
        light.with_radiance(color * light.radiance())
    };
    (mean > 0.0).then(|| lights.into_iter().enumerate().map(tint).collect())
}

/// The means of a picture over k × k equal rectangles, in rows from the top, in linear light.
fn box_filtered(picture: &Texture, texels: u32) -> Vec<DVec3> {
    let mut means = vec![DVec3::ZERO; (texels * texels) as usize];
    let columns = overlaps(picture.width, texels);
    let mut row = vec![DVec3::ZERO; texels as usize];
    let mut pixels = picture.texels.chunks_exact(picture.width as usize);
    let linear: [f32; 256] = std::array::from_fn(|byte| srgb_to_linear(byte as u8));
    for across in overlaps(picture.height, texels) {
        row.fill(DVec3::ZERO);
        let pixels = pixels.next().expect("as many rows as the picture is high");
        for (&[r, g, b, _], shares) in pixels.iter().zip(&columns) {
            let color = Vec3::from([r, g, b].map(|byte| linear[usize::from(byte)])).as_dvec3();
            for &(column, share) in shares {
                row[column] += share * color;
            }
        }
        for (line, share) in across {
            for (mean, value) in means[line * texels as usize..].iter_mut().zip(&row) {
                *mean += share * value;
            }
        }
    }
    means
}

/// Which of `texels` equal intervals each of `pixels` equal intervals overlaps, and what share of the
/// former it covers.
fn overlaps(pixels: u32, texels: u32) -> Vec<Vec<(usize, f64)>> {
    let ratio = f64::from(texels) / f64::from(pixels);
    let overlaps = |pixel: u32| {
        let [start, end] = [pixel, pixel + 1].map(|edge| f64::from(edge) * ratio);
        let inside = start as u32..(end.ceil() as u32).min(texels);
        let share = |texel: u32| {
            let texel = f64::from(texel);
            end.min(texel + 1.0) - start.max(texel)
        };
        inside.map(|texel| (texel as usize, share(texel))).collect()
    };
    (0..pixels).map(overlaps).collect()
}
