//! What a case shows, as a table.

use std::fmt::Write as _;

use glam::DVec3;
use manylights_interpolation::{Grid, Reach, Scheme};
use manylights_scene::AreaLight;
use manylights_tests::gridded::{Receivers, SCHEMES, Source, fields};

use crate::cases::Case;

/// Radiances of receivers: the adapter's, those of f64 from the same grid, and those without one.
pub(crate) struct Radiances {
    pub(crate) found: Vec<DVec3>,
    oracle: Vec<DVec3>,
    pub(crate) truth: Vec<DVec3>,
    outside: u32,
}

impl Radiances {
    /// Of lights that are gathered and lights that a grid holds.
    pub(crate) fn new(
        case: &Case,
        scheme: Scheme,
        [near, far]: &[Vec<AreaLight>; 2],
        receivers: &Receivers,
    ) -> Self {
        let (source, grid) = (case.source, case.grid());
        let (mut found, outside) = source.read(grid, scheme, far, receivers);
        let mut oracle = source.read_exactly(grid, scheme, far, receivers);
        let mut truth = source.truth(far, receivers);
        if !near.is_empty() {
            add(&mut found, &source.gather(near, receivers));
            let exact = source.truth(near, receivers);
            add(&mut oracle, &exact);
            add(&mut truth, &exact);
        }
        Self { found, oracle, truth, outside }
    }

    /// The largest truth, the measure of all; 1 where there is no light.
    pub(crate) fn most(&self) -> f64 {
        let most = self.truth.iter().fold(0.0, |most: f64, value| most.max(value.max_element()));
        if most > 0.0 { most } else { 1.0 }
    }
}

fn add(to: &mut [DVec3], of: &[DVec3]) {
    to.iter_mut().zip(of).for_each(|(sum, value)| *sum += *value);
}

/// The lights that `case` keeps out of its grid, and the others.
pub(crate) fn parted(case: &Case) -> [Vec<AreaLight>; 2] {
    let reach = Reach::new(&case.grid());
    let lights = case.scaled_lights();
    [true, false]
        .map(|near| lights.iter().copied().filter(|light| reach.meets(light) == near).collect())
}

pub(crate) fn largest_difference(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((*a - *b).abs().max_element()))
}

fn root_mean_square(a: &[DVec3], b: &[DVec3]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).sum();
    (sum / (3 * a.len()).max(1) as f64).sqrt()
}

/// Between the two of each pair.
fn jump(pairs: &[DVec3]) -> f64 {
    let apart = pairs.chunks_exact(2).map(|pair| (pair[0] - pair[1]).abs().max_element());
    apart.fold(0.0, f64::max)
}

pub(crate) const SCHEME_NAMES: [&str; 4] = ["trilinear", "taylor", "hermite-flat", "hermite"];

/// Whether all is finite, and the table.
pub(crate) fn table(case: &Case) -> (String, bool) {
    let (receivers, scattered) = case.receivers();
    let parts = parted(case);
    let mut text = format!(
        "## {}{}\n\n{} of {} lights near.\n\n| lights | scheme | from the oracle | from the truth, most | \
         root mean square | jump | truth's | outside | non-finite |\n|{}\n",
        case.name[..1].to_uppercase(),
        &case.name[1..],
        parts[0].len(),
        case.lights.len(),
        "---|".repeat(9)
    );
    let mut ways = vec![("near ones apart", parts.clone())];
    if !parts[0].is_empty() {
        ways.push(("all in the grid", [vec![], case.scaled_lights()]));
    }
    let mut sound = true;
    for (way, lights) in ways {
        for (scheme, name) in SCHEMES.into_iter().zip(SCHEME_NAMES) {
            let radiances = Radiances::new(case, scheme, &lights, &receivers);
            let Radiances { found, oracle, truth, outside } = &radiances;
            let most = radiances.most();
            let non_finite = found.iter().filter(|value| !value.is_finite()).count();
            sound &= non_finite == 0;
            let numbers = [
                largest_difference(found, oracle),
                largest_difference(found, truth),
                root_mean_square(&found[..scattered], &truth[..scattered]),
                jump(&found[scattered..]),
                jump(&truth[scattered..]),
            ];
            let numbers = numbers.map(|number| format!("{:.1e}", number / most)).join(" | ");
            writeln!(text, "| {way} | {name} | {numbers} | {outside} | {non_finite} |")
                .expect("writing to a string");
        }
    }
    if !case.remark.is_empty() {
        write!(text, "\n{}\n", case.remark).expect("writing to a string");
    }
    (text + "\n", sound)
}

/// Errors of a source at 5³, 9³ and 17³ vertices of a cube, and the order between the last two.
pub(crate) fn orders(of: &[(&str, Source, Vec<AreaLight>)]) -> String {
    let mut text =
        "| lights | scheme | 5³ | 9³ | 17³ | order |\n|---|---|---|---|---|---|\n".to_owned();
    let surfaces = (0..1600)
        .map(|i| fields::receiver(fields::noise(i).into(), fields::noise(7000 + i).into()));
    let receivers = Receivers { surfaces: surfaces.collect(), camera: fields::CAMERA };
    for (field, source, lights) in of {
        let truth = source.truth(lights, &receivers);
        let size = root_mean_square(&truth, &vec![DVec3::ZERO; truth.len()]);
        for (scheme, name) in SCHEMES.into_iter().zip(SCHEME_NAMES) {
            let errors = [5, 9, 17].map(|vertices| {
                let grid = Grid::over([[-1.0; 3], [1.0; 3]], [vertices; 3]);
                let (found, _) = source.read(grid, scheme, lights, &receivers);
                root_mean_square(&found, &truth) / size
            });
            let [coarse, middle, fine] = errors;
            writeln!(
                text,
                "| {field} | {name} | {coarse:.1e} | {middle:.1e} | {fine:.1e} | {:.2} |",
                (middle / fine).log2()
            )
            .expect("writing to a string");
        }
    }
    text
}
