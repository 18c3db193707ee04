//! Vertices, cells and the points between them.

use manylights_interpolation::Grid;
use proptest::prelude::*;

fn grid() -> Grid<f64> {
    Grid::over([[-1.0, 0.0, 2.0], [1.0, 3.0, 4.0]], [3, 4, 5])
}

#[test]
fn vertices_run_from_corner_to_corner_x_fastest() {
    let grid = grid();
    let positions: Vec<_> = grid.positions().collect();
    assert_eq!(positions.len(), grid.count());
    assert_eq!(positions[0], [-1.0, 0.0, 2.0]);
    assert_eq!(positions[1], [0.0, 0.0, 2.0]);
    assert_eq!(positions[59], [1.0, 3.0, 4.0]);
    assert_eq!(positions[grid.index([2, 1, 3])], [1.0, 1.0, 3.5]);
}

#[test]
fn a_point_is_where_its_cell_says() {
    let grid = grid();
    for point in [[-0.3, 2.9, 3.3], [1.0, 3.0, 4.0], [-1.0, 0.0, 2.0], [0.0, 1.0, 2.5]] {
        let place = grid.place(point);
        assert!(!place.is_outside, "{point:?}");
        for i in 0..3 {
            assert!((0.0..=1.0).contains(&place.local[i]), "{place:?}");
            let back = grid.origin[i] + (place.cell[i] as f64 + place.local[i]) * grid.spacing[i];
            assert!((back - point[i]).abs() < 1e-15, "{point:?}: {place:?}");
        }
    }
}

#[test]
fn the_nearest_point_stands_for_one_outside() {
    let place = grid().place([-7.0, 1.5, 40.0]);
    assert!(place.is_outside);
    assert_eq!((place.cell, place.local), ([0, 1, 3], [0.0, 0.5, 1.0]));
}

#[test]
fn corners_are_the_vertices_around_a_cell() {
    let grid = grid();
    let positions: Vec<_> = grid.positions().collect();
    let corners = grid.corners([1, 2, 3]);
    assert_eq!(positions[corners[0]], [0.0, 2.0, 3.5]);
    assert_eq!(positions[corners[1]], [1.0, 2.0, 3.5]);
    assert_eq!(positions[corners[2]], [0.0, 3.0, 3.5]);
    assert_eq!(positions[corners[7]], [1.0, 3.0, 4.0]);
}

#[test]
fn a_box_has_as_many_vertices_as_a_cube_and_cells_near_to_cubes() {
    let of = |sides: [f64; 3], vertices| Grid::of_cubes([[0.0; 3], sides], vertices).vertices;
    for vertices in [2, 3, 8, 13, 64] {
        assert_eq!(of([0.7; 3], vertices), [vertices; 3]);
    }
    // A view over a wide floor.
    assert_eq!(of([15.0, 1.5, 25.0], 8), [12, 2, 21]);
    assert_eq!(of([1.0, 2.0, 1.0], 8), [6, 12, 7]);
    assert_eq!(of([1.0, 1e-3, 1.0], 8), [16, 2, 16]);
    assert_eq!(of([1e9, 1e-3, 1e-3], 4), [16, 2, 2]);
    assert_eq!(of([1e9, 1e-3, 1e-3], 2), [2, 2, 2]);
}

/// The largest spacing of all grids that have so many vertices at the most, by trying them.
fn least_spacing(sides: [f64; 3], most: usize) -> f64 {
    let spacing = |counts: [usize; 3]| {
        [0, 1, 2].map(|i| sides[i] / (counts[i] - 1) as f64).into_iter().fold(0.0, f64::max)
    };
    let pairs = (2..=most / 4).flat_map(|x| (2..=most / (2 * x)).map(move |y| (x, y)));
    pairs.map(|(x, y)| spacing([x, y, most / (x * y)])).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn no_grid_of_so_many_vertices_has_a_smaller_largest_spacing(
        sides in prop::array::uniform3(1e-3_f64..30.0),
        vertices in 2_usize..12,
    ) {
        let grid = Grid::of_cubes([[-1.0; 3], sides.map(|side| side - 1.0)], vertices);
        prop_assert!(grid.count() <= vertices.pow(3));
        let largest = grid.spacing.into_iter().fold(0.0, f64::max);
        let alike = sides.into_iter().fold(0.0, f64::max) / (vertices - 1) as f64;
        prop_assert!(largest <= alike * (1.0 + 1e-12));
        let least = least_spacing(sides, vertices.pow(3));
        prop_assert!((largest - least).abs() <= 1e-9 * least, "{:?}", grid.vertices);
    }
}
