//! Passes with a lane or several for each pixel, or for each of any points.

/// Workgroups of so many pixels, in rows of at most 2¹⁵: adapters guarantee 65 535 in each direction.
pub fn workgroups(pixels: u32, pixels_a_group: u32) -> [u32; 3] {
    let groups = pixels.div_ceil(pixels_a_group);
    let columns = groups.min(1 << 15);
    [columns, groups.div_ceil(columns), 1]
}
