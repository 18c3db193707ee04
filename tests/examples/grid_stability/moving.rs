//! A light that moves through a grid.

use std::fmt::Write as _;

use glam::Vec3;
use manylights_tests::gridded::SCHEMES;

use crate::cases::{Case, HALF, sphere};
use crate::measure::{Radiances, SCHEME_NAMES, largest_difference, parted};

const STEPS: usize = 160;

/// Positions in the grid's own halves: from three before its faces to three behind, off all vertices.
fn center(step: usize) -> Vec3 {
    let along = 8.0 * step as f32 / (STEPS - 1) as f32 - 4.0;
    HALF * Vec3::new(along, 0.13 + 0.05 * along, -0.21)
}

/// A row a scheme.
pub(crate) fn table(case: &mut Case) -> (String, bool) {
    let mut text = "| scheme | positions near | from the truth, most | while near | largest change in a step | \
                    truth's | where a light becomes near | truth's there | non-finite |\n|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let (receivers, _) = case.receivers();
    let mut sound = true;
    for (scheme, name) in SCHEMES.into_iter().zip(SCHEME_NAMES) {
        let mut path = Vec::new();
        for step in 0..STEPS {
            case.lights = vec![sphere(center(step), 0.1)];
            let parts = parted(case);
            let is_near = !parts[0].is_empty();
            path.push((is_near, Radiances::new(case, scheme, &parts, &receivers)));
        }
        let most = path.iter().map(|(_, radiances)| radiances.most()).fold(0.0, f64::max);
        let error = |near: bool| {
            let of_kind = path.iter().filter(|(is_near, _)| *is_near == near);
            of_kind.fold(0.0, |most: f64, (_, r)| most.max(largest_difference(&r.found, &r.truth)))
        };
        let [mut changes, mut at_border] = [[0.0_f64; 2]; 2];
        for pair in path.windows(2) {
            let [(was_near, before), (is_near, after)] = pair else { continue };
            let change = [
                largest_difference(&before.found, &after.found),
                largest_difference(&before.truth, &after.truth),
            ];
            for k in 0..2 {
                changes[k] = changes[k].max(change[k]);
                if was_near != is_near {
                    at_border[k] = at_border[k].max(change[k]);
                }
            }
        }
        let near = path.iter().filter(|(is_near, _)| *is_near).count();
        let finite = |r: &Radiances| r.found.iter().filter(|value| !value.is_finite()).count();
        let non_finite: usize = path.iter().map(|(_, radiances)| finite(radiances)).sum();
        sound &= non_finite == 0;
        let numbers =
            [error(false), error(true), changes[0], changes[1], at_border[0], at_border[1]];
        let numbers = numbers.map(|number| format!("{:.1e}", number / most)).join(" | ");
        writeln!(text, "| {name} | {near} of {STEPS} | {numbers} | {non_finite} |")
            .expect("writing to a string");
    }
    (text, sound)
}
