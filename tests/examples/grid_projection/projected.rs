//! What is projected, and how it is timed.

use std::fmt;
use std::time::Instant;

use glam::Vec3;
use manylights_harmonics::wgsl::order::Evaluation;
use manylights_harmonics::zonal::TriangleForm;
use manylights_interpolation::{Grid, Loops, ProjectionSettings, Projector};
use manylights_polygonal_light::{Approximation, Edges, Narrow};
use manylights_scene::AreaLight;
use manylights_spherical_light::SphereLight;
use manylights_tests::{GPU, processors};
use {manylights_polygonal_light as polygonal, manylights_spherical_light as spherical};

pub(crate) const ROUNDS: usize = 5;

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Spheres,
    Main,
    SolidAngle,
    Exact,
}

impl Kind {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Spheres => "spheres",
            Self::Main => "main",
            Self::SolidAngle => "solid-angle",
            Self::Exact => "exact",
        }
    }

    /// Of triangles.
    pub(crate) fn approximation(self) -> Approximation {
        match self {
            Self::Main => Approximation::Sphere(TriangleForm::Main),
            Self::SolidAngle => Approximation::Sphere(TriangleForm::SolidAngle),
            Self::Spheres | Self::Exact => Approximation::Exact(Edges::Own),
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub(crate) kind: Kind,
    pub(crate) bands: usize,
    pub(crate) evaluation: Evaluation,
    pub(crate) loops: Loops,
    pub(crate) gradients: bool,
    /// Along each side.
    pub(crate) vertices: usize,
    /// Twice a square.
    pub(crate) lights: u32,
}

impl Case {
    pub(crate) fn how(&self) -> ProjectionSettings {
        let Self { gradients, loops, evaluation, .. } = *self;
        ProjectionSettings { gradients, loops, evaluation }
    }

    pub(crate) fn loops_name(&self) -> &'static str {
        match (self.kind, self.loops) {
            (Kind::Exact, _) => "–",
            (_, Loops::Forward) => "forward",
            (_, Loops::Reverse) => "reverse",
        }
    }

    pub(crate) fn evaluation_name(&self) -> &'static str {
        match (self.kind, self.evaluation) {
            (Kind::Exact, _) => "–",
            (_, Evaluation::Polynomial) => "polynomial",
            (_, Evaluation::Recurrence) => "recurrence",
        }
    }

    /// One projection, ready to be run again.
    fn prepared(self) -> Box<dyn Fn()> {
        let (grid, triangles) = (grid(self.vertices), panel(self.lights));
        if self.kind == Kind::Spheres {
            let settings = spherical::Settings { bands: self.bands, ..Default::default() };
            let shader = spherical::linked_projection(&settings, self.how()).expect("it links");
            let projector = Projector::new(&GPU, grid, &shader).expect("it fits");
            let spheres: Vec<_> = triangles.iter().map(sphere).collect();
            return Box::new(move || {
                projector.project(&spheres).expect("a projection");
            });
        }
        let (bands, approximation) = (self.bands, self.kind.approximation());
        let settings = polygonal::Settings { bands, approximation, narrow: Narrow::Decline };
        Box::new(move || {
            let projected = polygonal::project(&GPU, grid, &settings, self.how(), &triangles);
            projected.expect("a projection");
        })
    }
}

/// Seconds of all processors.
#[derive(Clone, Copy)]
pub(crate) struct Time {
    pub(crate) median: f64,
    quartiles: [f64; 2],
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.quartiles.map(|seconds| 1e3 * seconds);
        write!(f, "{:.1} [{low:.1}, {high:.1}]", 1e3 * self.median)
    }
}

/// Of interleaved rounds, after one that compiles.
pub(crate) fn times(cases: &[Case]) -> Vec<Time> {
    let warm = |case: &Case| {
        let (start, prepared) = (Instant::now(), case.prepared());
        prepared();
        let (kind, loops) = (case.kind.name(), case.loops_name());
        let (bands, seconds) = (case.bands, start.elapsed().as_secs_f64());
        eprintln!("{kind}, {bands} bands, {}, {loops}: {seconds:.1} s", case.evaluation_name());
        prepared
    };
    let prepared: Vec<_> = cases.iter().map(warm).collect();
    let mut seconds = vec![Vec::new(); cases.len()];
    for _ in 0..ROUNDS {
        for (seconds, project) in seconds.iter_mut().zip(&prepared) {
            let before = processors::seconds(false);
            project();
            seconds.push(processors::seconds(false) - before);
        }
    }
    let condensed = |mut rounds: Vec<f64>| {
        rounds.sort_by(f64::total_cmp);
        let quartiles = [ROUNDS / 4, ROUNDS - 1 - ROUNDS / 4].map(|place| rounds[place]);
        Time { median: rounds[ROUNDS / 2], quartiles }
    };
    seconds.into_iter().map(condensed).collect()
}

/// Below the panel.
fn grid(vertices: usize) -> Grid<f32> {
    Grid::over([[-1.0, -0.5, -1.0], [1.0, 0.5, 1.0]], [vertices; 3])
}

/// A square of a metre, one metre and a half above the grid's middle, that faces it, in so many triangles.
fn panel(count: u32) -> Vec<AreaLight> {
    let side = (count / 2).isqrt();
    assert_eq!(2 * side * side, count, "twice a square");
    let corner =
        |x: u32, z: u32| Vec3::new(x as f32 / side as f32 - 0.5, 1.5, z as f32 / side as f32 - 0.5);
    let square = |i: u32| {
        let (x, z) = (i % side, i / side);
        let corners = [corner(x, z), corner(x + 1, z), corner(x + 1, z + 1), corner(x, z + 1)];
        [[0, 1, 2], [0, 2, 3]].map(|three| AreaLight::Triangle {
            corners: three.map(|i| corners[i]),
            radiance: Vec3::new(1.0, 0.8, 0.6),
            two_sided: false,
        })
    };
    (0..side * side).flat_map(square).collect()
}

/// Of a triangle's centre and area.
fn sphere(light: &AreaLight) -> SphereLight {
    let (center, radius) = disk(light);
    SphereLight::new(center, radius, light.radiance())
}

fn disk(light: &AreaLight) -> (Vec3, f32) {
    let AreaLight::Triangle { corners: [a, b, c], .. } = *light else {
        unreachable!("a panel is of triangles")
    };
    let area = 0.5 * (b - a).cross(c - a).length();
    ((a + b + c) / 3.0, (area / std::f32::consts::PI).sqrt())
}

/// Share of pairs of vertex and triangle that exact projections take by points: beyond 16 radii of its disk.
pub(crate) fn far_share(vertices: usize, lights: u32) -> f64 {
    let disks: Vec<_> = panel(lights).iter().map(disk).collect();
    let grid = grid(vertices);
    let of_vertex = |vertex: [f32; 3]| {
        let far =
            |(center, radius): &&(Vec3, f32)| center.distance(Vec3::from(vertex)) > 16.0 * radius;
        disks.iter().filter(far).count()
    };
    grid.positions().map(of_vertex).sum::<usize>() as f64 / (grid.count() * disks.len()) as f64
}
