//! Planar polygons as lights: cut into triangles by ear clipping.

use earcut::Earcut;
use glam::{DVec2, DVec3, Vec3};

use super::checks::position;
use crate::LoadError;

/// Most corners: each edge is held against each other.
const MAX_CORNERS: usize = 1024;
/// Largest distance of a corner from the plane, in parts of the polygon's size: what a file of five
/// digits leaves.
const OUT_OF_PLANE: f64 = 1e-4;
/// Least area in parts of the square of its size: of less, single precision knows no plane.
const LEAST_AREA: f64 = 1e-6;

/// The triangles of a simple polygon, with its front, from which the corners are counter-clockwise.
pub(super) fn triangles(corners: &[[f32; 3]], place: &str) -> Result<Vec<[Vec3; 3]>, LoadError> {
    if !(3..=MAX_CORNERS).contains(&corners.len()) {
        let problem = format!("a polygon has {} corners", corners.len());
        let remedy = format!("give it 3 to {MAX_CORNERS}");
        return Err(LoadError::new(place, problem, remedy));
    }
    let corners: Vec<Vec3> = corners
        .iter()
        .map(|&corner| position(place, "corners", corner))
        .collect::<Result<_, _>>()?;
    let outline = flat(&corners, place)?;
    if crosses_itself(&outline) {
        let problem = "the outline of a polygon crosses or touches itself";
        return Err(LoadError::new(place, problem, "order its corners along its outline"));
    }
    let mut indices: Vec<usize> = Vec::new();
    Earcut::new().earcut(outline.iter().map(|corner| corner.to_array()), &[], &mut indices);
    let turned = |&[a, b, c]: &[usize; 3]| {
        let front = (outline[b] - outline[a]).perp_dot(outline[c] - outline[a]) > 0.0;
        (if front { [a, b, c] } else { [a, c, b] }).map(|corner| corners[corner])
    };
    Ok(indices.as_chunks().0.iter().map(turned).collect())
}

/// The outline in its plane, counter-clockwise.
fn flat(corners: &[Vec3], place: &str) -> Result<Vec<DVec2>, LoadError> {
    let relative: Vec<DVec3> =
        corners.iter().map(|corner| corner.as_dvec3() - corners[0].as_dvec3()).collect();
    let size = relative.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let next = relative.iter().cycle().skip(1);
    let area = relative.iter().zip(next).map(|(a, b)| 0.5 * a.cross(*b)).sum::<DVec3>();
    if area.length() <= LEAST_AREA * size * size {
        let problem = "a polygon has no area";
        return Err(LoadError::new(place, problem, "order its corners along its outline"));
    }
    let normal = area.normalize();
    let distance = relative.iter().map(|corner| normal.dot(*corner).abs()).fold(0.0, f64::max);
    if distance > OUT_OF_PLANE * size {
        let problem = format!("a corner of a polygon is {distance:.3e} m out of its plane");
        return Err(LoadError::new(place, problem, "use a planar polygon or several"));
    }
    let (x, y) = normal.any_orthonormal_pair();
    Ok(relative.iter().map(|corner| DVec2::new(x.dot(*corner), y.dot(*corner))).collect())
}

/// Whether edges have a point in common that is not the corner between them.
fn crosses_itself(outline: &[DVec2]) -> bool {
    let count = outline.len();
    let edge = |i: usize| [outline[i], outline[(i + 1) % count]];
    (0..count).any(|i| {
        let [a, b] = edge(i);
        let [_, c] = edge((i + 1) % count);
        let turns_back = (b - a).perp_dot(c - b) == 0.0 && (b - a).dot(c - b) <= 0.0;
        let others = i + 2..if i == 0 { count - 1 } else { count };
        turns_back || others.into_iter().any(|j| meet(edge(i), edge(j)))
    })
}

/// Whether two closed segments have a point in common.
fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    let boxes_overlap = a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all();
    let cut = |from, to, [p, q]: [DVec2; 2]| {
        let [p, q] = [side(from, to, p), side(from, to, q)];
        p.min(q) <= 0.0 && p.max(q) >= 0.0
    };
    boxes_overlap && cut(a, b, [c, d]) && cut(c, d, [a, b])
}
