//! What f32 leaves of triangles by distance: the published forms beside those in use.

use glam::Vec3;
use manylights_gpu::SurfaceRecord;
use manylights_harmonics::polygon::{PolygonProjection, solid_angle};
use manylights_harmonics::{count, thesis};
use manylights_polygonal_light::{self as polygonal_light, Approximation, Edges, Settings};
use manylights_reflectance::{Damping, Form, Receiver};
use manylights_scene::{AreaLight, Brdf, Lobe};
use manylights_tests::GPU;

const CORNERS: [Vec3; 3] =
    [Vec3::new(-0.41, 0.05, -0.31), Vec3::new(0.53, -0.02, -0.2), Vec3::new(0.02, 0.07, 0.52)];
const PLACES: u32 = 200;
const BANDS: usize = 9;

/// By corners as seen from the point, sr.
type SolidAngle = fn([[f32; 3]; 3]) -> f32;

/// So far from the triangle in all directions.
fn places(distance: f32) -> impl Iterator<Item = Vec3> {
    (0..PLACES).map(move |i| {
        let y = 1.0 - 2.0 * (i as f32 + 0.5) / PLACES as f32;
        let (sin, cos) = (2.4 * i as f32).sin_cos();
        let r = (1.0 - y * y).sqrt();
        distance * Vec3::new(r * cos, y, r * sin)
    })
}

fn seen(place: Vec3) -> [[f32; 3]; 3] {
    CORNERS.map(|corner| (corner - place).to_array())
}

fn head(first: &str, distances: &[f32]) -> String {
    let cells: Vec<_> = distances.iter().map(|distance| format!("{distance}")).collect();
    format!("| {first} | {} |\n|{}\n", cells.join(" | "), "---|".repeat(distances.len() + 1))
}

fn row(name: &str, errors: impl Iterator<Item = f64>) -> String {
    let cells: Vec<_> = errors.map(|error| format!("{error:.1e}")).collect();
    format!("| {name} | {} |\n", cells.join(" | "))
}

/// By van Oosterom and Strackee from differences of corners and as printed, and by Arvo.
pub(crate) fn solid_angles() -> String {
    let distances = [1.0, 10.0, 100.0, 1000.0];
    let forms: [(&str, SolidAngle); 3] = [
        ("van Oosterom and Strackee, from differences", |corners| solid_angle(&corners)),
        ("the same, of unit vectors (thesis 4.13)", thesis::oosterom_of_units),
        ("Arvo 1995 (thesis 4.12)", thesis::arvo),
    ];
    let worst = |form: SolidAngle, distance| {
        let error = |place: Vec3| {
            let truth = solid_angle(&seen(place).map(|corner| corner.map(f64::from))).abs();
            (f64::from(form(seen(place))).abs() - truth).abs() / truth
        };
        let facing = |place: &Vec3| {
            let [a, b, c] = CORNERS;
            (b - a).cross(c - a).normalize().dot(place.normalize()).abs() > 0.2
        };
        places(distance).filter(facing).map(error).fold(0.0, f64::max)
    };
    let text = "Largest error of a triangle's solid angle, relative to it, over directions with cosines above 0.2 \
                to its normal, by distance in sizes.\n\n";
    let rows = forms.map(|(name, form)| row(name, distances.iter().map(|&d| worst(form, d))));
    text.to_owned() + &head("form", &distances) + &rows.concat()
}

/// Wang's form beside the adapter's.
pub(crate) fn coefficients() -> String {
    let distances = [1.0, 3.0, 7.0, 10.0, 30.0, 100.0, 300.0, 1000.0];
    let errors = distances.map(of_distance);
    let names =
        ["Wang's 17 directions in f32, coefficients", "the same, radiance", "adapter, radiance"];
    let text = "Largest error of a triangle's nine bands by distance in sizes, relative to the largest of that \
                distance: of coefficients, and of the radiance of a metal of roughness 0.3.\n\n";
    let rows = [0, 1, 2].map(|i| row(names[i], errors.iter().map(|errors| errors[i])));
    text.to_owned() + &head("form", &distances) + &rows.concat()
}

fn of_distance(distance: f32) -> [f64; 3] {
    let brdf = Brdf {
        diffuse: Vec3::ZERO,
        f0: Vec3::splat(0.8),
        lobe: Lobe::Schlick { f90: 1.0 },
        alpha: 0.09,
    };
    let camera = 1e8 * Vec3::new(0.3, 0.9, -0.2);
    let light = AreaLight::Triangle { corners: CORNERS, radiance: Vec3::ONE, two_sided: true };
    let towards = |place: Vec3| (camera.normalize() - 0.6 * place.normalize()).normalize();
    let surfaces: Vec<_> =
        places(distance).map(|place| SurfaceRecord::new(place, towards(place), brdf)).collect();
    let settings = Settings {
        approximation: Approximation::Exact(Edges::Own),
        bands: BANDS,
        ..Settings::default()
    };
    let pixels = polygonal_light::gather(&GPU, &surfaces, camera, &[light], &settings);
    let (single, double) =
        (PolygonProjection::<f32>::new(BANDS), PolygonProjection::<f64>::new(BANDS));
    let mut largest = [0.0_f64; 3];
    let mut worst = [0.0_f64; 3];
    for (surface, pixel) in surfaces.iter().zip(pixels.expect("a gather")) {
        let (normal, position) =
            (surface.normal.as_dvec3().normalize(), surface.position.as_dvec3());
        let view = (camera.as_dvec3() - position).normalize();
        let receiver = Receiver::new(brdf, [normal, view], BANDS, Form::Full, Damping::None);
        let corners = CORNERS.map(|corner| {
            let corner = corner.as_dvec3() - position;
            receiver.frame.map(|axis| axis.dot(corner) as f32)
        });
        let exact = corners.map(|corner| corner.map(f64::from));
        let side = solid_angle(&exact).signum();
        let found: Vec<_> =
            project(&single, &corners).into_iter().map(|c| side * f64::from(c)).collect();
        let truth: Vec<_> = project(&double, &exact).into_iter().map(|c| side * c).collect();
        let radiance = |coefficients: &[f64]| receiver.product(coefficients).x;
        let reflected =
            polygonal_light::oracle::radiance(surface, camera.as_dvec3(), &[light], &settings);
        let difference = found.iter().zip(&truth).map(|(one, other)| (one - other).abs());
        let peak = truth.iter().map(|c| c.abs()).fold(0.0, f64::max);
        let values = [
            [peak, difference.fold(0.0, f64::max)],
            [radiance(&truth), radiance(&found) - radiance(&truth)],
            [reflected.x, f64::from(pixel[0]) - reflected.x],
        ];
        for (i, [value, error]) in values.into_iter().enumerate() {
            largest[i] = largest[i].max(value.abs());
            worst[i] = worst[i].max(error.abs());
        }
    }
    [0, 1, 2].map(|i| worst[i] / largest[i])
}

fn project<R: manylights_harmonics::Real>(
    projection: &PolygonProjection<R>,
    corners: &[[R; 3]],
) -> Vec<R> {
    let mut sums = projection.zero();
    projection.add(corners, R::one(), &mut sums);
    let mut values = vec![R::zero(); count(BANDS)];
    projection.coefficients(&sums, &mut values, &mut vec![[R::zero(); 3]; count(BANDS)]);
    values
}
