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

/// Each reaches into the last cells of its side, or stands outside two of them.
fn around(distance: f32, radius: f32) -> Vec<AreaLight> {
    let places = (0..12).map(|i| distance * HALF * Vec3::from(fields::noise(i)).normalize());
    places.map(|center| sphere(center, radius)).collect()
}

pub(crate) fn cases() -> Vec<Case> {
    let case = Case::new;
    let inside = "The lights are met at each pixel, so that nothing is left to the grid. In it they would be finite \
                  and wrong: no polynomial follows a light within a cell.";
    let smooth = || fields::spheres();
    let cut =
        "The light has a kink in its plane: Hermite is no better than its second-order form there.";
    vec![
        case("twelve spheres half a side outside", spheres(), smooth(), ""),
        case(
            "a sphere of 0.05 m at a vertex",
            spheres(),
            vec![sphere(0.5 * HALF, 0.05)],
            at_vertex,
        ),
        case("a sphere of 0.05 m in a cell", spheres(), vec![sphere(0.31 * HALF, 0.05)], inside),
        case(
            "a cell wholly inside a sphere of 1 m",
            spheres(),
            vec![sphere(0.3 * HALF, 1.0)],
            around_cell,
        ),
        case("all lights near: twelve of 0.05 m in the box", spheres(), around(0.8, 0.05), inside),
        case("no light at all", spheres(), vec![], "Nothing is read, and nothing is there."),
        case(
            "two-sided triangles whose planes cut cells, exact",
            exact(),
            fields::triangles(false, true),
            cut,
        ),
        case(
            "one-sided triangles whose planes cut cells, exact",
            exact(),
            fields::triangles(false, false),
            cut,
        ),
        case(
            "one-sided triangles whose planes cut cells, `main`",
            triangles(Approximation::Sphere(TriangleForm::Main)),
            fields::triangles(false, false),
            cut,
        ),
        case(
            "a triangle through the box, exact",
            exact(),
            vec![AreaLight::Triangle {
                corners: [
                    Vec3::new(-3.0, 0.1, -2.0),
                    Vec3::new(3.0, -0.1, 0.1),
                    Vec3::new(0.2, 0.3, 3.0),
                ],
                radiance: Vec3::ONE,
                two_sided: true,
            }],
            inside,
        ),
        Case {
            vertices: 2,
            ..case("two vertices a side", spheres(), smooth(), "A single cell has no face within.")
        },
        Case {
            spread: 1.5,
            ..case(
                "receivers up to a quarter of a side outside",
                spheres(),
                smooth(),
                "The nearest point of the grid stands for what is outside: the light of its face.",
            )
        },
        case(
            "spheres of 1e-6 m, half a side outside",
            spheres(),
            smooth().into_iter().map(|light| resized(light, 1e-6)).collect(),
            "",
        ),
        case(
            "a sphere of 1e6 m, 5 m from the middle",
            spheres(),
            vec![sphere(Vec3::new(1_000_005.0, 0.0, 0.0), 1e6)],
            "In f32 the distance to its centre is known to 0.06 m of the 5 m to its surface: the cosine of the \
             half-angle, 3e-3, to 2e-5.",
        ),
        Case {
            vertices: 8,
            half: Vec3::new(1.0, 0.02, 0.7),
            ..case(
                "a flat box, 0.04 m high, a sphere of 0.01 m 0.03 m above it",
                spheres(),
                vec![sphere(Vec3::new(0.1, 0.05, 0.05), 0.01)],
                "Cells are 0.29 × 0.006 × 0.2 m. The light is outside two of them along y and taken for far, but a \
                 tenth of a cell away along x: all schemes fail alike, as on floors that are seen to the horizon. \
                 Such a grid should have fewer vertices along y and more along x.",
            )
        },
        Case { unit: 1e-3, ..case("the same, scene of 1e-3 m", spheres(), smooth(), "") },
        Case { unit: 1e5, ..case("the same, scene of 1e5 m", spheres(), smooth(), "") },
    ]
}

fn resized(light: AreaLight, radius: f32) -> AreaLight {
    let AreaLight::Sphere { center, radiance, .. } = light else { return light };
    // As much light from less of it.
    AreaLight::Sphere { center, radius, radiance: radiance / (radius * radius) }
}
