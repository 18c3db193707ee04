//! Exact solid angles of map cells.

use glam::DVec3;

/// Solid angle in sr, seen from the origin, of the rectangle [x0, x1] × [y0, y1] on the plane z = 1.
///
/// Two triangles by van Oosterom and Strackee 1983, tan(Ω/2) = a·(b×c) / (abc + …): the triple product
/// is twice the triangle's area, which is exact here, so no digit is lost for small cells. (The closed
/// form in differences of four arc tangents loses all of them.)
pub fn rectangle_solid_angle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, 1.0));
    let area = (x1 - x0) * (y1 - y0);
    let triangle = |[a, b, c]: [DVec3; 3]| {
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * area.atan2(denominator)
    };
    let [a, b, c, d] = corners;
    triangle([a, b, c]) + triangle([a, c, d])
}

#[cfg(test)]
mod tests {
    use super::rectangle_solid_angle;
    use std::f64::consts::PI;

    #[test]
    fn a_cube_face_is_a_sixth_of_the_sphere() {
        let face = rectangle_solid_angle([-1.0, 1.0], [-1.0, 1.0]);
        assert!((face - 4.0 * PI / 6.0).abs() < 1e-14);
    }

    #[test]
    fn cells_add_up_to_the_face_and_small_ones_keep_their_digits() {
        let cells = 512;
        let edge = |i: u32| f64::from(i) * 2.0 / f64::from(cells) - 1.0;
        let sum: f64 = (0..cells)
            .flat_map(|j| (0..cells).map(move |i| (i, j)))
            .map(|(i, j)| rectangle_solid_angle([edge(i), edge(i + 1)], [edge(j), edge(j + 1)]))
            .sum();
        assert!((sum - 4.0 * PI / 6.0).abs() < 1e-12);
        // A cell of side h at (x, y): h² cos³, up to O(h²) relative.
        let (x, y, h) = (0.3, -0.7, 1e-7);
        let cell = rectangle_solid_angle([x, x + h], [y, y + h]);
        let center: f64 = 1.0 + (x + h / 2.0_f64).powi(2) + (y + h / 2.0_f64).powi(2);
        let width = (x + h) - x; // as rounded
        let height = (y + h) - y;
        assert!((cell / (width * height * center.powf(-1.5)) - 1.0).abs() < 1e-12);
    }
}
