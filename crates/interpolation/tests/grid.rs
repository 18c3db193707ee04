//! Vertices, cells and the points between them.

use manylights_interpolation::Grid;

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
