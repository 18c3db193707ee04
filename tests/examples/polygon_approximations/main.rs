//! Spheres in the stead of triangles beside the triangles (thesis 4.2, figures 4.8 to 4.16 and table 4.4),
//! written to `results/triangles-by-spheres/approximations.md`. Run with
//! `cargo run --release -p manylights-tests --example polygon_approximations`.

mod cost;
mod line;
mod pictures;
mod study;
mod tables;

use manylights_gpu::AdapterReport;
use manylights_tests::GPU;

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let text = format!(
        "# Spheres in the stead of triangles\n\n\
         `cargo run --release -p manylights-tests --example polygon_approximations`; pictures on {name} ({driver} \
         {driver_info}), all else in f64 on the processor. Lights are two-sided, truth is the exact \
         triangle's in as many bands; a size is √(2 area).\n\n\
         ## Coefficients by distance (figures 4.10, 4.12)\n\n\
         Root of the mean squared relative error over directions with cosines above 0.1 to the triangle's \
         normal: of the solid angle; of all coefficients of 3, 5, 9 bands. All but `sphere` and `compromise` \
         fall with the square of the distance. A sliver is worse than a well-shaped triangle whatever its \
         solid angle is: its shape is missing.\n\
         {}\n\
         ## Growth with the band (figure 4.10d)\n\n\
         The same of each band of the equilateral triangle, relative to all 15 bands. The thesis finds quadratic \
         growth in l.\n\n{}\n\
         ## A square in many triangles (figures 4.8, 4.14)\n\n\
         Of side 1, parallel to a plane at a height, over 13 × 13 points of 3 × 3: the root of the mean \
         squared error of the summed coefficients of 5 bands over that of the truth, and the mean error of the \
         irradiance over its largest. Raw spheres and 4.17 as printed do not converge.\n\n{}\n\
         ## Solid angle along a line (figure 4.16)\n\n\
         Of half of that square, x + y ≤ 0, from the line y = 0 at half a side below it; `solid-angle`, `scaled` \
         and `point` have the triangle's own. [Drawn](solid-angles.svg). Under the triangle all spheres are \
         too large, the compromise among them, as the thesis calls it; further off it is too small by the \
         cosine at the light, which no number of triangles mends.\n\n{}\n\
         ## Pictures (table 4.4, figures 4.11, 4.12, 4.14)\n\n\
         Mean absolute error of radiance × 10³ beside `approximation = exact` of the same bands, without \
         interpolation, over the mean of that picture. The thesis' scenes (figures 3.12 and 4.8) are not \
         published: `lacquers` is `trio` under a square of side 2, `white room` the box of `cornell` in white, \
         160×120 pixels; its numbers are of pictures, thus the ratio is what can be compared. Its main form is no \
         better with 800 triangles than with 288; here the error falls with their number, as it does in f64.\n\n{}\n\
         ## Operations\n\n\
         On floats in the linked shader that a light takes of a lane, those that are no additions, \
         multiplications or comparisons in brackets; then all over those of `sphere`. Last the thesis' times of \
         coefficients and gradients in a grid of 8³ points under 648 lights (table 4.3); its text has \
         `solid-angle` at 1.27 times the time of `main` with 5 bands and at 1.06 with 9.\n\n{}",
        tables::by_distance(),
        tables::by_band(),
        tables::square(),
        line::table(),
        pictures::table(),
        cost::table(),
    );
    let folder = std::path::Path::new("results/triangles-by-spheres");
    std::fs::create_dir_all(folder).expect("the results folder can be made");
    std::fs::write(folder.join("solid-angles.svg"), line::figure()).expect("can write");
    std::fs::write(folder.join("approximations.md"), &text).expect("can write");
    print!("{text}");
}
