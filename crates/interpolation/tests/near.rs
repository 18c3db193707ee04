//! Which lights a grid must not hold.

use glam::Vec3;
use manylights_interpolation::{Grid, Reach};
use manylights_scene::AreaLight;

fn meets(grid: &Grid<f32>, center: Vec3) -> bool {
    Reach::new(grid).meets(&AreaLight::Sphere { center, radius: 0.1, radiance: Vec3::ONE })
}

/// Over a floor the distance counts in spacings along the floor: across them the light varies as fast.
#[test]
fn a_light_above_a_floor_is_near_where_cells_are_wider_than_it_is_high() {
    let floor = Grid::over([[-4.0, 0.0, -4.0], [4.0, 0.01, 4.0]], [5, 2, 9]);
    for (height, is_near) in [(0.05, true), (3.0, true), (4.1, true), (4.2, false), (-4.2, false)] {
        assert_eq!(meets(&floor, Vec3::new(0.3, height, 0.2)), is_near, "{height}");
    }
    assert!(meets(&floor, Vec3::new(8.05, 0.0, 0.0)));
    assert!(!meets(&floor, Vec3::new(8.15, 0.0, 0.0)));
}
