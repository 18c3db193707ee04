//! Pictures with spheres in the stead of triangles beside those of the triangles, of the same bands and without
//! interpolation: thesis table 4.4 and figures 4.11, 4.12 and 4.14.

use glam::Vec3;
use manylights_area_lights::AreaLights;
use manylights_metrics::RadianceImage;
use manylights_polygonal_light::PolygonalLights;
use manylights_scene::{AreaLight, Material, Scene, Transport, Visibility};
use manylights_tests::Stage;

use crate::study::square;
use crate::tables::{FORMS, head, row, short};

const RESOLUTION: [u32; 2] = [160, 120];

/// A scene under one square of 2k² two-sided triangles, and what the thesis has for so many.
struct Case {
    name: &'static str,
    scene: Scene,
    /// Of table 4.4, ×10³: raw spheres and the main form.
    published: Option<[f64; 2]>,
}

/// A square of this side about a place, facing a direction.
fn panel(k: u32, side: f32, (center, normal): (Vec3, Vec3)) -> Vec<AreaLight> {
    let (right, up) = normal.normalize().any_orthonormal_pair();
    let radiance = Vec3::splat(4.0 / (side * side));
    let place = |[x, y, _]: [f64; 3]| center + side * (x as f32 * right + y as f32 * up);
    let light = |corners: [[f64; 3]; 3]| AreaLight::Triangle {
        corners: corners.map(place),
        radiance,
        two_sided: true,
    };
    square(k).into_iter().map(light).collect()
}

/// Lacquers of several colours and roughnesses.
fn lacquers(k: u32, side: f32) -> Scene {
    let mut scene = manylights_scene::load("trio", None).expect("built in");
    scene.lights.clear();
    for material in &mut scene.materials {
        material.roughness = material.roughness.max(0.3);
    }
    let above = Vec3::new(0.0, 3.0, 0.0);
    scene.area_lights = panel(k, side, (above, Vec3::new(0.2, -1.0, 0.1)));
    scene
}

/// A box, all of it white and Lambertian.
fn white_room(k: u32) -> Scene {
    let mut scene = manylights_scene::load("cornell", None).expect("built in");
    scene.lights.clear();
    for material in &mut scene.materials {
        let white = Material::lambert(&material.name, Vec3::splat(0.8));
        *material = white;
    }
    let (low, high) = scene.vertices.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), vertex| {
        (low.min(vertex.position), high.max(vertex.position))
    });
    let middle = (low + high) / 2.0;
    let below_ceiling = Vec3::new(middle.x, low.y + 0.95 * (high.y - low.y), middle.z);
    scene.area_lights = panel(k, 0.4 * (high.x - low.x), (below_ceiling, Vec3::NEG_Y));
    scene
}

fn table_4_4() -> [Case; 4] {
    let case = |name, scene, published| Case { name, scene, published: Some(published) };
    [
        case("lacquers, 288", lacquers(12, 2.0), [15.86, 0.096]),
        case("lacquers, 512", lacquers(16, 2.0), [15.76, 0.068]),
        case("lacquers, 800", lacquers(20, 2.0), [15.67, 0.121]),
        case("white room, 722", white_room(19), [62.08, 0.129]),
    ]
}

/// Few triangles, thus large ones beside their distance.
fn large() -> [Case; 3] {
    let case = |name, k| Case { name, scene: lacquers(k, 2.0), published: None };
    [case("lacquers, 2", 1), case("lacquers, 18", 3), case("lacquers, 72", 6)]
}

fn picture(stage: &Stage, word: &str, bands: &str) -> RadianceImage {
    let parameters = [("approximation", word), ("bands", bands)];
    let transport = Transport::Direct { visibility: Visibility::Ignored };
    let method = AreaLights(PolygonalLights);
    let mut run = stage.prepare(&method, &parameters, transport, 1).expect("it takes triangles");
    while !run.step().expect("a step").finished() {}
    run.resolve().expect("a picture")
}

/// Mean absolute error of radiance over the mean of the truth.
fn error(found: &RadianceImage, truth: &RadianceImage) -> f64 {
    let values = |image: &RadianceImage| image.pixels.as_flattened().to_vec();
    let (found, truth) = (values(found), values(truth));
    let pairs = found.iter().zip(&truth);
    let errors: f64 = pairs.map(|(a, b)| f64::from((a - b).abs())).sum();
    errors / truth.iter().map(|&value| f64::from(value)).sum::<f64>()
}

pub(crate) fn table() -> String {
    let words = FORMS.map(|(word, _)| word.to_owned());
    let first = ["scene, triangles", "bands"].map(str::to_owned);
    let last = ["sphere : main", "thesis"].map(str::to_owned);
    let mut text = head(first.into_iter().chain(words).chain(last));
    for Case { name, scene, published } in table_4_4().into_iter().chain(large()) {
        let stage = Stage::new(scene, RESOLUTION);
        for bands in ["5", "7", "9"] {
            let truth = picture(&stage, "exact", bands);
            let errors = FORMS.map(|(word, _)| error(&picture(&stage, word, bands), &truth));
            let cells = errors.map(|error| short(1e3 * error));
            let ratio = format!("{:.0}", errors[0] / errors[1]);
            let thesis = published.map_or("–".to_owned(), |[sphere, main]| {
                format!("{sphere} : {main} = {:.0}", sphere / main)
            });
            let first = [name.to_owned(), bands.to_owned()];
            text += &row(first.into_iter().chain(cells).chain([ratio, thesis]));
        }
    }
    text
}
