//! How fast what a grid reads comes near what every light brings to every point: projection and reading on the
//! adapter, the truth in f64 without a grid.

use glam::{DVec3, Vec3};
use manylights_gpu::SurfaceRecord;
use manylights_interpolation::{Grid, Scheme};
use manylights_polygonal_light::{self as polygonal, Approximation, Edges, TriangleForm};
use manylights_scene::{AreaLight, Brdf, Lobe};
use manylights_spherical_light as spherical;
use manylights_tests::gridded::{Receivers, SCHEMES, Source};

const CAMERA: Vec3 = Vec3::new(600.0, 1000.0, -200.0);

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

/// A glossy surface that faces the camera.
fn receiver(position: Vec3, normal: Vec3) -> SurfaceRecord {
    let lobe = Lobe::Schlick { f90: 1.0 };
    let brdf = Brdf { f0: Vec3::splat(0.2), lobe, alpha: 0.16, ..Brdf::lambert(Vec3::splat(0.4)) };
    let facing = if normal.dot(CAMERA) < 0.0 { -normal } else { normal };
    SurfaceRecord::new(position, facing.normalize(), brdf)
}

/// Numbers from −1 to 1, low-discrepancy.
fn noise(i: usize) -> [f32; 3] {
    let steps = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_960_3_f64];
    steps.map(|step| (2.0 * ((i + 1) as f64 * step).fract() - 1.0) as f32)
}

/// All over the box.
fn receivers(half: Vec3) -> Receivers {
    let surface =
        |i| receiver(half * Vec3::from(noise(i)), Vec3::from(noise(7000 + i)) + 1e-3 * Vec3::Y);
    Receivers { surfaces: (0..1600).map(surface).collect(), camera: CAMERA }
}

/// Around the larger box, half a side to a whole one outside.
fn places() -> impl Iterator<Item = Vec3> {
    (0..12).map(|i| {
        let (z, turn) = ((2 * i + 1) as f32 / 12.0 - 1.0, i as f32 * 2.399_963_3);
        let ring = (1.0 - z * z).sqrt();
        let towards = Vec3::new(ring * turn.cos(), ring * turn.sin(), z);
        (2.0 + (i % 3) as f32 * 0.5) * towards / towards.abs().max_element()
    })
}

fn sphere_lights() -> Vec<AreaLight> {
    let sphere = |center| AreaLight::Sphere { center, radius: 0.15, radiance: Vec3::ONE };
    places().map(sphere).collect()
}

/// They face the box, or nearly turn their edge to it: planes through its middle would all meet in one vertex.
fn triangle_lights(facing: bool, two_sided: bool) -> Vec<AreaLight> {
    let triangle = |center: Vec3| {
        let towards = center.normalize();
        let (a, b) = towards.any_orthonormal_pair();
        let (right, up) = if facing { (a, b) } else { ((towards + 0.2 * a).normalize(), b) };
        let corners = [right - up, -right - up, up].map(|corner| center + 0.2 * corner);
        AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided }
    };
    places().map(triangle).collect()
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
        (spheres(), sphere_lights()),
        (triangles(Approximation::Exact(Edges::Own)), triangle_lights(true, false)),
        (triangles(Approximation::Sphere(TriangleForm::Main)), triangle_lights(true, true)),
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
        let lights = triangle_lights(false, two_sided);
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
            let mut position = half * Vec3::from(noise(i));
            // A face in the middle, and as little to its sides as f32 can tell.
            let cells = [-2e-7, 2e-7].map(|side| {
                position[axis] = side * half[axis];
                surfaces.push(receiver(position, Vec3::from(noise(7000 + i))));
                grid.place(position.to_array()).cell
            });
            assert_ne!(cells[0], cells[1]);
        }
    }
    let receivers = Receivers { surfaces, camera: CAMERA };
    for (source, lights) in [
        (spheres(), sphere_lights()),
        (triangles(Approximation::Exact(Edges::Own)), triangle_lights(false, false)),
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
    let (half, lights) = (HALVES[1], sphere_lights());
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
