//! Hard cases of lights from a grid: the adapter's f32 against the f64 oracle of the same grid and against the truth
//! without one, written to `results/stability/interpolation.md`. Run with
//! `cargo run --release -p manylights-tests --example grid_stability`.

mod cases;
mod measure;
mod moving;

use manylights_gpu::AdapterReport;
use manylights_tests::GPU;
use manylights_tests::gridded::fields;

fn main() {
    let AdapterReport { name, driver, driver_info, .. } = GPU.report();
    let mut cases = cases::cases();
    let mut sound = true;
    let mut tables = String::new();
    for case in &cases {
        let (table, is_sound) = measure::table(case);
        tables += &table;
        sound &= is_sound;
    }
    let (path, is_sound) = moving::table(&mut cases[0]);
    sound &= is_sound;
    let orders = measure::orders(&[
        ("spheres", cases::spheres(), fields::spheres()),
        ("triangles that face the box", cases::exact(), fields::triangles(true, false)),
        ("one-sided, planes through it", cases::exact(), fields::triangles(false, false)),
        ("two-sided, planes through it", cases::exact(), fields::triangles(false, true)),
    ]);
    let text = format!(
        "# Lights from a grid: hard cases\n\n\
         `cargo run --release -p manylights-tests --example grid_stability` on {name} ({driver} {driver_info}); it \
         fails where a value is not finite.\n\n\
         Five bands, glossy receivers (roughness 0.4 over a diffuse lobe) with all normals; 5³ vertices over 2 × 0.8 × 1.4 m unless said: \
         cells are not cubes. Given is the largest difference of the adapter's f32 from the f64 oracle that reads the same \
         grid, then the difference from the truth, every light at every receiver in f64: at most, and the root mean square over 300 \
         receivers all over the box. Jumps are the largest differences of pairs of receivers that a face between cells \
         parts, 2e-6 of half a side apart, as the grid has them and as the truth has them: slopes over that distance, unless there is a seam. All are relative to the largest truth. \
         \"Near ones apart\" is what the methods do: lights within two cells of the grid are met at each pixel. \"All in the grid\" \
         is what nobody gets, and shows why.\n\n\
         A grid of one vertex a side is refused: ``parameter `grid` = `1`: must be a whole number from 2 to 64``, exit \
         code 2.\n\n\
         {tables}\
         ## A sphere of 0.1 m moves through the grid\n\n\
         160 positions along a line, from three half-boxes before it to three behind. A light that becomes near \
         changes the picture by what interpolation was wrong before: beside the change of the truth in that step.\n\n\
         {path}\n\
         ## Orders\n\n\
         Relative root mean square at 1600 receivers in a cube of 2 m, and the order from 9³ to 17³.\n\n\
         {orders}\n\
         Planes of lights through the cells leave an order of about 1.5: an error of order h in a share h of the cells.\n"
    );
    std::fs::create_dir_all("results/stability").expect("the results folder can be made");
    std::fs::write("results/stability/interpolation.md", &text).expect("the table can be written");
    print!("{text}");
    assert!(sound, "a hard case is not finite");
}
