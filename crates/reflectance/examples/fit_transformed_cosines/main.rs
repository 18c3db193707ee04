//! Fits the table of transformed cosines to this repository's GGX, writes it into the crate and its errors to
//! results/ltc/fit.md: `cargo run --release -p manylights-reflectance --example fit_transformed_cosines`.

mod triangles;

use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;

use glam::{DVec3, Vec3};
use manylights_paths::closed_form::polygon_irradiance;
use manylights_reflectance::transformed_cosine::fit::Target;
use manylights_reflectance::transformed_cosine::{FINGERPRINT, Layered, Table, at};
use manylights_scene::{Brdf, DBrdf, Lobe};
use triangles::{around, reflected};

const ROUGHNESSES: [f32; 6] = [0.1, 0.3, 0.4, 0.5, 0.7, 1.0];
const VIEWS: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 88.0];
const SIZES: [f64; 3] = [0.2, 0.6, 1.5];
/// Of the quadrature that errors are measured with.
const NODES: [usize; 2] = [96, 96];

fn main() -> std::io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (table, layered) = (Table::fit(), Layered::fit());
    std::fs::write(root.join("src/transformed_cosine/table.bin"), table.to_bytes())?;
    std::fs::write(root.join("../../results/ltc/fit.md"), report(&table, layered))
}

fn report(table: &Table, layered: Layered) -> String {
    let mut text = format!(
        "# Transformed cosines: the error of the fit\n\nMade by `cargo run --release -p manylights-reflectance \
         --example fit_transformed_cosines`; {}\n## The lobe\n∫ |lobe − fit| over the directions above the \
         horizon, where both have integral 1: no light makes a larger error, over that of a light all \
         around.\n\n| roughness |{}\n|---|{}\n",
        FINGERPRINT.trim_end(),
        VIEWS.map(|degrees| format!(" {degrees}° |")).concat(),
        "---|".repeat(VIEWS.len()),
    );
    let row = |text: &mut String, cells: &dyn Fn(f32, f64) -> String| {
        for roughness in ROUGHNESSES {
            let cells = VIEWS.map(|degrees| format!(" {} |", cells(roughness, degrees))).concat();
            writeln!(text, "| {roughness} |{cells}").expect("a text");
        }
    };
    row(&mut text, &|roughness, degrees| {
        format!("{:.3}", error_of_lobe(table, roughness, degrees))
    });
    write!(
        text,
        "\n## Under triangles\nRoot of the mean squared error over that of the truth, of 1 200 equilateral \
         triangles of size {SIZES:?} at distance 1 from 10° below the horizon up, in all \
         orientations.\n\n| roughness |{}\n|---|{}\n",
        VIEWS.map(|degrees| format!(" {degrees}° |")).concat(),
        "---|".repeat(VIEWS.len()),
    )
    .expect("a text");
    row(&mut text, &|roughness, degrees| {
        SIZES.map(|size| format!("{:.4}", error_under(table, roughness, degrees, size))).join(" ")
    });
    let worst = (0..=1000).map(|i| {
        let [fitted, lobe] = layered.values(f64::from(i) / 1000.0);
        (fitted - lobe).abs()
    });
    write!(
        text,
        "\n## The Lambertian lobe under a layer\n(1 − (1 − c)⁵) c by the transform of height {:.6}: at most {:.3} \
         beside it, where it is 1 at most.\n",
        layered.height,
        worst.fold(0.0, f64::max),
    )
    .expect("a text");
    text
}

fn view(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin, 0.0, cos)
}

fn error_of_lobe(table: &Table, roughness: f32, degrees: f64) -> f64 {
    let (alpha, cosine) = (roughness * roughness, view(degrees).z);
    let lobe = at(&table.lobes(alpha.into()), cosine);
    Target::new(alpha, cosine, NODES).error(&lobe.cosine, 1)
}

fn error_under(table: &Table, roughness: f32, degrees: f64, size: f64) -> f64 {
    let lobe = Lobe::Schlick { f90: 1.0 };
    let brdf = Brdf { diffuse: Vec3::ZERO, f0: Vec3::ONE, lobe, alpha: roughness * roughness };
    let (brdf, view) = (DBrdf::from(brdf), view(degrees));
    let lobe = at(&table.lobes(brdf.alpha), view.z);
    let (mut errors, mut truths) = (0.0, 0.0);
    for corners in around(1200, size) {
        let truth = reflected(&brdf, view, corners);
        let above: Vec<_> =
            above_horizon(corners).into_iter().map(|c| lobe.cosine.apply(c)).collect();
        let corners: Vec<_> = above.iter().map(|corner| corner.to_array()).collect();
        let [a, b] = lobe.magnitudes;
        let found = (a + b) / PI * polygon_irradiance([0.0, 0.0, 1.0], &corners);
        errors += (found - truth).powi(2);
        truths += truth * truth;
    }
    (errors / truths).sqrt()
}

fn above_horizon(corners: [DVec3; 3]) -> Vec<DVec3> {
    let mut above = Vec::new();
    for i in 0..3 {
        let [a, b] = [corners[i], corners[(i + 1) % 3]];
        above.extend((a.z > 0.0).then_some(a));
        let crosses = (a.z > 0.0) != (b.z > 0.0);
        above.extend(crosses.then(|| (a + a.z / (a.z - b.z) * (b - a)).with_z(0.0)));
    }
    above
}
