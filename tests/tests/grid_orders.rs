//! How fast what a grid reads comes near what every light brings to every point: projection and reading on the
//! adapter, the truth in f64 without a grid.

use glam::{DVec3, Vec3};
use manylights_interpolation::{Grid, Scheme};
use manylights_polygonal_light::{self as polygonal, Approximation, Edges, TriangleForm};
use manylights_scene::AreaLight;
use manylights_spherical_light as spherical;
use manylights_tests::gridded::{Receivers, SCHEMES, Source, fields};

/// A box with cells that are cubes, and one with cells that are not.
const HALVES: [Vec3; 2] = [Vec3::ONE, Vec3::new(1.0, 0.25, 0.5)];

fn spheres() -> Source {
    Source::Spheres(spherical::Settings { bands: 5, ..Default::default() })
}

fn triangles(approximation: Approximation) -> Source {
    Source::Triangles(polygonal::Settings { bands: 5, approximation, ..Default::default() })
}

fn grid(half: Vec3, vertices: usize) -> Grid<f32> {
    Grid::over([(-half).to_array(), half.to_array()], [vertices; 3])
}

/// All over the box.
fn receivers(half: Vec3) -> Receivers {
    let surface = |i| {
        fields::receiver(
            half * Vec3::from(fields::noise(i)),
            Vec3::from(fields::noise(7000 + i)) + 1e-3 * Vec3::Y,
        )
    };
    Receivers { surfaces: (0..1600).map(surface).collect(), camera: fields::CAMERA }
}

fn relative(found: &[DVec3], truth: &[DVec3]) -> f64 {
    let error: f64 = found.iter().zip(truth).map(|(a, b)| a.distance_squared(*b)).sum();
    (error / truth.iter().map(|value| value.length_squared()).sum::<f64>()).sqrt()
}

/// Errors at 9³ vertices, and the orders from there to 17³, scheme by scheme.
fn errors_and_orders(source: Source, lights: &[AreaLight], half: Vec3) -> [[f64; 2]; 4] {
    let receivers = receivers(half);
    let truth = source.truth(lights, &receivers);
    SCHEMES.map(|scheme| {
        let [coarse, fine] = [9, 17].map(|vertices| {
            let (found, outside) = source.read(grid(half, vertices), scheme, lights, &receivers);
            assert_eq!(outside, 0);
            relative(&found, &truth)
        });
        let order = (coarse / fine).log2();
        println!("{half}, {scheme:?}: {coarse:.2e} {fine:.2e}, order {order:.2}");
        [coarse, order]
    })
}

#[test]
fn errors_of_smooth_light_fall_by_the_order_of_the_scheme() {
    let fields = [
        (spheres(), fields::spheres()),
        (triangles(Approximation::Exact(Edges::Own)), fields::triangles(true, false)),
        (triangles(Approximation::Sphere(TriangleForm::Main)), fields::triangles(true, true)),
    ];
    let ranges = [1.9..2.1, 1.9..2.1, 2.2..4.0, 3.0..4.0];
    let bounds = [0.03, 0.03, 2.5e-3, 1.5e-3];
    for (source, lights) in fields {
        for half in HALVES {
            let found = errors_and_orders(source, &lights, half);
            for ((scheme, [error, order]), (range, bound)) in
                SCHEMES.iter().zip(found).zip(ranges.iter().zip(bounds))
            {
                assert!(range.contains(&order), "{source:?}, {half}, {scheme:?}: order {order}");
                assert!(error <= bound, "{source:?}, {half}, {scheme:?}: {error:e}");
            }
        }
    }
}

/// Light has a kink where it is cut by its own plane, which no scheme of polynomials follows.
#[test]
fn planes_of_lights_in_cells_leave_an_order_of_one_and_a_half() {
    let source = triangles(Approximation::Exact(Edges::Own));
    for two_sided in [false, true] {
        let lights = fields::triangles(false, two_sided);
        let [.., flat, hermite] = errors_and_orders(source, &lights, Vec3::ONE);
        for [_, order] in [flat, hermite] {
            assert!((1.3..1.7).contains(&order), "two-sided {two_sided}: order {order}");
        }
    }
}

/// A little to both sides of a cell's faces.
#[test]
fn what_is_read_does_not_jump_across_faces() {
    let half = HALVES[1];
    let grid = grid(half, 5);
    let mut surfaces = Vec::new();
    for i in 0..40 {
        for axis in 0..3 {
            let mut position = half * Vec3::from(fields::noise(i));
            // A face in the middle, and as little to its sides as f32 can tell.
            let cells = [-2e-7, 2e-7].map(|side| {
                position[axis] = side * half[axis];
                surfaces.push(fields::receiver(position, Vec3::from(fields::noise(7000 + i))));
                grid.place(position.to_array()).cell
            });
            assert_ne!(cells[0], cells[1]);
        }
    }
    let receivers = Receivers { surfaces, camera: fields::CAMERA };
    for (source, lights) in [
        (spheres(), fields::spheres()),
        (triangles(Approximation::Exact(Edges::Own)), fields::triangles(false, false)),
    ] {
        for scheme in SCHEMES {
            let (found, _) = source.read(grid, scheme, &lights, &receivers);
            let most = found.iter().fold(0.0, |most: f64, value| most.max(value.max_element()));
            let apart = found.chunks_exact(2).map(|pair| (pair[0] - pair[1]).abs().max_element());
            let jump = apart.fold(0.0, f64::max) / most;
            println!("{scheme:?}: {jump:.1e}");
            assert!(jump <= 1e-6, "{source:?}, {scheme:?}: {jump:e}");
        }
    }
}

/// Hermite's mixed derivatives on the adapter are those of f64, where cells are not cubes.
#[test]
fn schemes_on_the_adapter_are_those_of_f64() {
    let (half, lights) = (HALVES[1], fields::spheres());
    let receivers = receivers(half);
    for scheme in SCHEMES {
        let (found, _) = spheres().read(grid(half, 3), scheme, &lights, &receivers);
        let exact = spheres().read_exactly(grid(half, 3), scheme, &lights, &receivers);
        let error = relative(&found, &exact);
        println!("{scheme:?}: {error:.1e}");
        assert!(error < 2e-6, "{scheme:?}: {error:e}");
    }
    let [flat, mixed] = [Scheme::HermiteFlat, Scheme::Hermite]
        .map(|scheme| spheres().read_exactly(grid(half, 3), scheme, &lights, &receivers));
    assert!(relative(&flat, &mixed) > 1e-4, "nothing to tell apart");
}
