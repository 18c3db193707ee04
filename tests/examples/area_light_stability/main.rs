//! Hard cases of lights with a surface: the adapter's f32 against each method's f64 oracle along paths of
//! receivers past lights, written to `results/stability/area-lights.md`. Run with
//! `cargo run --release -p manylights-tests --example area_light_stability`.

mod families;
mod measure;
mod methods;
mod shapes;
mod single_precision;
mod triangles;

use manylights_gpu::AdapterReport;
use manylights_tests::GPU;

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let (spheres, triangles) = (families::spheres(), triangles::triangles());
    let (of_spheres, spheres_sound) = measure::table(&methods::spherical(), &spheres, false);
    let (of_triangles, triangles_sound) = measure::table(&methods::polygonal(), &triangles, false);
    let transformed = methods::transformed();
    let (of_both, both_sound) = measure::table(
        &transformed,
        &triangles.into_iter().chain(spheres).collect::<Vec<_>>(),
        true,
    );
    let text = format!(
        "# Lights with a surface: hard cases\n\n\
         `cargo run --release -p manylights-tests --example area_light_stability` on {name} ({driver} \
         {driver_info}); it fails where a value is not finite, or one of `ltc` is negative.\n\n\
         400 receivers along each path, on a Lambertian surface and on GGX of roughness 1, 0.3 and 0.1. \
         Values are radiances over the square of the sine r/d (size/distance for polygons, at most 1), so that a \
         far light counts as much as a near one. Given is the largest difference of the adapter's f32 to the f64 \
         oracle, of each choice of parameters, then the largest step from one receiver to the next, of the adapter and of \
         the oracle (the first choice), and the largest change of the difference in one step (all choices): a \
         seam of the adapter's own would show there. All are relative to the largest value of the path, or to 1e-3 of what the \
         light could send at most where that is less. \
         How far bands or approximations are from the truth is not measured here.\n\n\
         ## spherical-light\n\n\
         Nine bands, five of 4.5; the full lobe in each form of the coefficients and with discs for spheres, the \
         product 4.6 in the surface's frame and 4.5 in the world's.\n\n{of_spheres}\n\
         Where the point touches a sphere the cosine of its angle is the root of a difference that f32 knows to \
         1e-7: 4e-4.\n\n\
         ## polygonal-light\n\n\
         Nine bands; exact with shared and with own edges, then spheres in the triangles' stead.\n\n{of_triangles}\n\
         Beyond 1e-5:\n\
         - Far ones: one point in the stead of seven, from 100 sizes of a triangle (33 of the panel) on; the form changes to \
         seven at 8 sizes, before which sums over edges have lost two digits.\n\
         - Vertices and edges: at 1e-4 sizes from one a point's place beside it is known in f32 to 6e-4 of that distance.\n\
         - Needles: digits go with their width, relative to a light that is itself that narrow.\n\
         - In the plane: exact triangles are seen from 1e-5 sizes beside it, on the side on which a rounded point lies, \
         which need not be that of the truth; so it is with the solid angle of three forms.\n\
         - Under the huge triangle: its centroid is known to 6e-8 of 1e4 m, and the direction to it, at 1 m, to 6e-4.\n\n\
         ## ltc\n\n\
         Triangles, then spheres.\n\n{of_both}\n\
         Beyond 1e-5:\n\
         - Vertices, edges, needles, in the plane, touching a sphere: as above, but by up to 3.5 times more at vertices, \
         for which rounding of the point alone does not account; corners are known from the first \
         corner and the edges, to 6e-8 of a size, so that one without area may send 1e-7 of a light.\n\
         - At 8 sizes and beside the plane: tails of the narrowest lobe, in which a sum over edges, of transformed \
         triangles up to 10 of their sizes away, has lost 6e-7 of the light.\n\n\
         ## Solid angles in f32\n\n{}\n\
         ## Coefficients in f32\n\n{}",
        single_precision::solid_angles(),
        single_precision::coefficients(),
    );
    std::fs::create_dir_all("results/stability").expect("the results folder can be made");
    std::fs::write("results/stability/area-lights.md", &text).expect("the table can be written");
    print!("{text}");
    let sound = [spheres_sound, triangles_sound, both_sound];
    assert_eq!(sound, [true; 3], "a hard case is not finite, or negative");
}
