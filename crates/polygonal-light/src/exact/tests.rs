//! What becomes of triangles before any of them is seen.

use glam::{DVec3, Quat, Vec2, Vec3};
use manylights_area_lights::{Edges, Face};
use manylights_scene::AreaLight;

use super::{ExactRecord, Kind};

/// A square of so many cells in each direction, two triangles each, of the radiances that its cells have; lying
/// obliquely away from the origin, so that no corner is exact.
fn square(cells: u32, radiance: impl Fn(u32, u32) -> Option<Vec3>) -> Vec<AreaLight> {
    let place = |x: u32, y: u32| {
        let at = Vec2::new(x as f32, y as f32) / cells as f32;
        Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7) * Vec3::new(at.x, at.y, 0.0)
            + Vec3::new(1.3, 2.1, -0.7)
    };
    let mut lights = Vec::new();
    for (x, y) in (0..cells).flat_map(|y| (0..cells).map(move |x| (x, y))) {
        let Some(radiance) = radiance(x, y) else { continue };
        let [a, b, c, d] =
            [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| place(x, y));
        for corners in [[a, b, c], [a, c, d]] {
            lights.push(AreaLight::Triangle { corners, radiance, two_sided: false });
        }
    }
    lights
}

fn counts(lights: &[AreaLight], edges: Edges) -> [usize; 3] {
    let records = ExactRecord::all(lights, edges);
    let of = |kind| records.iter().filter(|record| record.kind == kind as u32).count();
    [Kind::Triangle, Kind::Edge, Kind::Far].map(of)
}

/// Σ of area times radiance along the normal, of records that are seen from far, and by the fans of edges.
fn fluxes(lights: &[AreaLight], edges: Edges) -> [DVec3; 2] {
    let (mut far, mut near) = (DVec3::ZERO, DVec3::ZERO);
    for record in ExactRecord::all(lights, edges) {
        let flux = f64::from(record.corners[1].beside) * record.radiance.as_dvec3();
        if record.kind != Kind::Edge as u32 {
            far += flux;
        }
        if record.kind != Kind::Far as u32 {
            near += flux;
        }
    }
    [far, near]
}

#[test]
fn a_square_of_equal_triangles_is_its_outline() {
    let lights = square(18, |_, _| Some(Vec3::ONE));
    assert_eq!(lights.len(), 648);
    assert_eq!(counts(&lights, Edges::Own), [648, 0, 0]);
    assert_eq!(counts(&lights, Edges::Shared), [0, 4, 2]);
    let sizes: Vec<_> = ExactRecord::all(&lights, Edges::Shared).iter().map(|r| r.size).collect();
    assert!(sizes.iter().all(|size| (size - 2.0_f32.sqrt()).abs() < 0.3), "{sizes:?}");
}

#[test]
fn edges_hold_the_differences_of_radiances() {
    // Two halves: the line between them is one more edge.
    let halves = square(8, |x, _| Some(Vec3::splat(if x < 4 { 1.0 } else { 3.0 })));
    assert_eq!(counts(&halves, Edges::Shared), [0, 7, 4]);
    // All different: a square has its diagonal and two sides, and the outline's two more.
    let texture = |x: u32, y: u32| Some(Vec3::new(1.0 + x as f32, 1.0 + y as f32, 1.0));
    let cells = square(5, texture);
    let [triangles, edges, far] = counts(&cells, Edges::Shared);
    // Rows and columns: 4 lines inside of equal difference are one edge each; the outline changes in each cell.
    assert_eq!((triangles, edges, far), (0, 4 + 4 + 20, 50));
    // What is black is not there.
    let half = square(2, |x, _| Some(if x == 0 { Vec3::ZERO } else { Vec3::ONE }));
    assert_eq!(counts(&half, Edges::Shared), [0, 4, 2]);
    // A hole has an outline; what is around it keeps its triangles.
    let ring = square(3, |x, y| (x != 1 || y != 1).then_some(Vec3::ONE));
    assert_eq!(counts(&ring, Edges::Shared), [0, 8, 16]);
    for lights in [&halves, &cells, &ring] {
        let [own, _] = fluxes(lights, Edges::Own);
        for flux in fluxes(lights, Edges::Shared) {
            let error = (flux - own).abs().max_element() / own.max_element();
            assert!(error < 1e-6, "{flux} for {own}");
        }
    }
}

#[test]
fn sides_planes_and_curved_surfaces_do_not_mix() {
    let mut lights = square(1, |_, _| Some(Vec3::ONE));
    let AreaLight::Triangle { two_sided, .. } = &mut lights[1] else { panic!("a triangle") };
    *two_sided = true;
    assert_eq!(counts(&lights, Edges::Shared), [2, 0, 0]);
    // A roof.
    let [a, b] = [Vec3::ZERO, Vec3::X];
    let triangle = |corners| AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
    let roof =
        [triangle([a, b, Vec3::new(0.5, 1.0, 0.3)]), triangle([b, a, Vec3::new(0.5, -1.0, 0.3)])];
    assert_eq!(counts(&roof, Edges::Shared), [2, 0, 0]);
    // A finely cut sheet, each strip turned by less than the next one's notice.
    let place = |i: u32, y: f32| {
        let angle = 1e-3 * i as f32;
        Vec3::new(angle.sin(), y, angle.cos())
    };
    let sheet: Vec<_> = (0..100)
        .flat_map(|i| {
            let [a, b] = [place(i, 0.0), place(i + 1, 0.0)];
            let [c, d] = [place(i + 1, 1.0), place(i, 1.0)];
            [triangle([a, b, c]), triangle([a, c, d])]
        })
        .collect();
    assert_eq!(counts(&sheet, Edges::Shared)[0], 200);
    // Nothing of no area.
    assert_eq!(counts(&[triangle([a, b, 0.5 * b])], Edges::Shared), [0, 0, 0]);
}

/// The areas of a closed surface sum to exactly nothing where its corners lie so: it has no normal.
#[test]
fn a_closed_tube_is_no_plane() {
    const SIDES: u32 = 3000;
    let place = |i: u32, y: f32| {
        // Both halves alike, of so few digits that all sums are exact.
        let side = if i % SIDES < SIDES / 2 { 1.0 } else { -1.0 };
        let angle = std::f32::consts::TAU * (i % (SIDES / 2)) as f32 / SIDES as f32;
        let digits = (1 << 20) as f32;
        let [x, z] = [angle.cos(), angle.sin()].map(|c| side * (c * digits).round() / digits);
        Vec3::new(x, y, z)
    };
    let triangle = |corners| AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: false };
    let tube: Vec<_> = (0..SIDES)
        .flat_map(|i| {
            let [a, b] = [place(i, 0.0), place(i + 1, 0.0)];
            let [c, d] = [place(i + 1, 1.0), place(i, 1.0)];
            [triangle([a, b, c]), triangle([a, c, d])]
        })
        .collect();
    let normals = tube.iter().filter_map(Face::new).map(|face| face.across());
    assert_eq!(normals.sum::<DVec3>(), DVec3::ZERO);
    assert_eq!(counts(&tube, Edges::Shared), [2 * SIDES as usize, 0, 0]);
}

/// Pairs of them would not fit in any memory.
#[test]
fn many_triangles_share_one_edge() {
    const COPIES: usize = 1 << 18;
    let square = square(1, |_, _| Some(Vec3::ONE));
    let lights: Vec<_> = square.iter().flat_map(|light| [*light].repeat(COPIES)).collect();
    assert_eq!(counts(&lights, Edges::Shared), [0, 4, 2 * COPIES]);
    assert!(ExactRecord::all(&lights, Edges::Shared)[..4].iter().all(|edge| {
        edge.kind == Kind::Edge as u32 && edge.radiance.abs() == Vec3::splat(COPIES as f32)
    }));
}
