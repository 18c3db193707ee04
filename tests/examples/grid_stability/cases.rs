//! Grids, lights and receivers.

use glam::Vec3;
use manylights_interpolation::Grid;
use manylights_polygonal_light::{self as polygonal, Approximation, Edges, TriangleForm};
use manylights_scene::AreaLight;
use manylights_spherical_light as spherical;
use manylights_tests::gridded::{Receivers, Source, fields};

/// Scattered receivers.
const SCATTERED: usize = 300;

/// Of each face between cells, places on both sides.
const ON_A_FACE: usize = 12;

/// Half the sides of most boxes, metres: cells are not cubes.
pub(crate) const HALF: Vec3 = Vec3::new(1.0, 0.4, 0.7);

pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) source: Source,
    pub(crate) lights: Vec<AreaLight>,
    pub(crate) vertices: usize,
    /// Half the sides of the box, metres.
    half: Vec3,
    /// Of a scene's length.
    unit: f32,
    /// How far out of the box receivers are, in halves of its sides.
    spread: f32,
    /// What stands out, and why.
    pub(crate) remark: &'static str,
}

pub(crate) fn spheres() -> Source {
    Source::Spheres(spherical::Settings { bands: 5, ..Default::default() })
}

pub(crate) fn exact() -> Source {
    triangles(Approximation::Exact(Edges::Own))
}

fn triangles(approximation: Approximation) -> Source {
    Source::Triangles(polygonal::Settings { bands: 5, approximation, ..Default::default() })
}

impl Case {
    fn new(
        name: &'static str,
        source: Source,
        lights: Vec<AreaLight>,
        remark: &'static str,
    ) -> Self {
        Self { name, source, lights, vertices: 5, half: HALF, unit: 1.0, spread: 1.0, remark }
    }

    pub(crate) fn grid(&self) -> Grid<f32> {
        let half = self.unit * self.half;
        Grid::over([(-half).to_array(), half.to_array()], [self.vertices; 3])
    }

    pub(crate) fn scaled_lights(&self) -> Vec<AreaLight> {
        self.lights.iter().map(|light| scaled(light, self.unit)).collect()
    }

    /// Some all over the box, then pairs that a face parts, which are in neighbouring cells.
    pub(crate) fn receivers(&self) -> (Receivers, usize) {
        let half = self.unit * self.half;
        let normal = |i: usize| Vec3::from(fields::noise(7000 + i));
        let scattered = (0..SCATTERED).map(|i| {
            let place = self.spread * Vec3::from(fields::noise(i));
            fields::receiver(half * place, normal(i))
        });
        let mut surfaces: Vec<_> = scattered.collect();
        let cells = self.vertices - 1;
        for (axis, face) in (0..3).flat_map(|axis| (1..cells).map(move |face| (axis, face))) {
            for i in 0..ON_A_FACE {
                let mut place = Vec3::from(fields::noise(100 * face + i));
                let middle = 2.0 * face as f32 / cells as f32 - 1.0;
                for side in [-1e-6, 1e-6] {
                    place[axis] = middle + side;
                    surfaces.push(fields::receiver(half * place, normal(i)));
                }
            }
        }
        (Receivers { surfaces, camera: self.unit * fields::CAMERA }, SCATTERED)
    }
}

fn scaled(light: &AreaLight, unit: f32) -> AreaLight {
    match *light {
        AreaLight::Sphere { center, radius, radiance } => {
            AreaLight::Sphere { center: unit * center, radius: unit * radius, radiance }
        }
        AreaLight::Triangle { corners, radiance, two_sided } => {
            AreaLight::Triangle { corners: corners.map(|c| unit * c), radiance, two_sided }
        }
    }
}

pub(crate) fn sphere(center: Vec3, radius: f32) -> AreaLight {
    AreaLight::Sphere { center, radius, radiance: Vec3::ONE }
}

/// In the outer cells of the box.
fn around() -> Vec<AreaLight> {
    let places = (0..12).map(|i| 0.8 * HALF * Vec3::from(fields::noise(i)).normalize());
    places.map(|center| sphere(center, 0.05)).collect()
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases =
        vec![Case::new("twelve spheres half a side outside", spheres(), fields::spheres(), "")];
    cases.extend(in_the_grid());
    cases.extend(planes());
    cases.extend(few_and_far());
    cases.extend(sizes());
    cases
}

fn in_the_grid() -> Vec<Case> {
    let inside = "The lights are met at each pixel, so that nothing is left to the grid. In it they would be finite \
                  and wrong: no polynomial follows a light within a cell.";
    let at_vertex = "The light is met at each pixel. In the grid the vertex would be a rounding from the centre, where \
                     the direction to it turns by one over that distance: gradients are 1e7 of the light, of which \
                     f32 and f64 agree to 1e-6.";
    let around_cell = "The light is met at each pixel. In the grid a vertex a little outside of the sphere would have a \
                       steep gradient, since the cosine of the half-angle is the root of what is known of the distance.";
    let corners = [Vec3::new(-3.0, 0.1, -2.0), Vec3::new(3.0, -0.1, 0.1), Vec3::new(0.2, 0.3, 3.0)];
    let triangle = AreaLight::Triangle { corners, radiance: Vec3::ONE, two_sided: true };
    let one = |name, center, radius, remark| {
        Case::new(name, spheres(), vec![sphere(center, radius)], remark)
    };
    vec![
        one("a sphere of 0.05 m at a vertex", 0.5 * HALF, 0.05, at_vertex),
        one("a sphere of 0.05 m in a cell", 0.31 * HALF, 0.05, inside),
        one("a cell wholly inside a sphere of 1 m", 0.3 * HALF, 1.0, around_cell),
        Case::new("a triangle through the box, exact", exact(), vec![triangle], inside),
        Case::new("all lights near: twelve of 0.05 m in the box", spheres(), around(), inside),
    ]
}

fn planes() -> Vec<Case> {
    let cut =
        "The light has a kink in its plane: `hermite` is no better than `hermite-flat` there.";
    let main = triangles(Approximation::Sphere(TriangleForm::Main));
    let case =
        |name, source, two_sided| Case::new(name, source, fields::triangles(false, two_sided), cut);
    vec![
        case("two-sided triangles whose planes cut cells, exact", exact(), true),
        case("one-sided triangles whose planes cut cells, exact", exact(), false),
        case("one-sided triangles whose planes cut cells, `main`", main, false),
    ]
}

/// Few vertices or lights, and what is far from the grid.
fn few_and_far() -> Vec<Case> {
    let case = |name, remark| Case::new(name, spheres(), fields::spheres(), remark);
    vec![
        Case {
            lights: vec![],
            ..case("no light at all", "Nothing is read, and nothing is there.")
        },
        Case { vertices: 2, ..case("two vertices a side", "A single cell has no face within.") },
        Case {
            spread: 1.5,
            ..case(
                "receivers up to a quarter of a side outside",
                "The nearest point of the grid stands for what is outside: the light of its face.",
            )
        },
        Case {
            vertices: 8,
            half: Vec3::new(1.0, 0.02, 0.7),
            lights: vec![sphere(Vec3::new(0.1, 0.05, 0.05), 0.01)],
            ..case(
                "a flat box, 0.04 m high, a sphere of 0.01 m 0.03 m above it",
                "Cells are 0.29 × 0.006 × 0.2 m. The light is outside two of them along y and taken for far, but a \
                 tenth of a cell away along x: all schemes fail alike, as on floors that are seen to the horizon. \
                 Such a grid should have fewer vertices along y and more along x.",
            )
        },
    ]
}

fn sizes() -> Vec<Case> {
    let case = |name, lights, remark| Case::new(name, spheres(), lights, remark);
    let tiny = fields::spheres().into_iter().map(|light| resized(light, 1e-6)).collect();
    let huge = vec![sphere(Vec3::new(1_000_005.0, 0.0, 0.0), 1e6)];
    let known = "In f32 the distance to its centre is known to 0.06 m of the 5 m to its surface: the cosine of the \
                 half-angle, 3e-3, to 2e-5.";
    vec![
        case("spheres of 1e-6 m, half a side outside", tiny, ""),
        case("a sphere of 1e6 m, 5 m from the middle", huge, known),
        Case {
            unit: 1e-3,
            ..case("the same as the first, scene of 1e-3 m", fields::spheres(), "")
        },
        Case { unit: 1e5, ..case("the same as the first, scene of 1e5 m", fields::spheres(), "") },
    ]
}

fn resized(light: AreaLight, radius: f32) -> AreaLight {
    let AreaLight::Sphere { center, radiance, .. } = light else { return light };
    // As much light from less of it.
    AreaLight::Sphere { center, radius, radiance: radiance / (radius * radius) }
}
