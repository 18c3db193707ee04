//! What a light takes of a lane, in operations on floats (thesis table 4.3, in milliseconds, and 4.2.5).

use manylights_gpu::operations;
use manylights_polygonal_light::{Approximation, Settings, linked_shader};
use manylights_reflectance::ReceiverKinds;

use crate::tables::{FORMS, head, row};

const BANDS: [usize; 5] = [5, 6, 7, 8, 9];
/// Thesis table 4.3: the main form over raw spheres, of grids with gradients.
const MAIN_OVER_SPHERE: [f64; 5] =
    [2.53 / 2.22, 3.39 / 2.96, 4.42 / 3.77, 5.35 / 4.76, 5.74 / 5.18];

/// All operations, then those of a square root, division or the like.
fn of_light(kinds: ReceiverKinds, approximation: Approximation, bands: usize) -> [u64; 2] {
    let settings = Settings { bands, approximation, ..Settings::default() };
    let shader = linked_shader(kinds, &settings).expect("it links");
    let found = operations(&shader.wgsl, "package_estimator__1add_light", 1).expect("a function");
    [found.simple + found.special, found.special]
}

pub(crate) fn table() -> String {
    let glossy = ReceiverKinds { specular: true, ..ReceiverKinds::default() };
    let columns = ["receivers", "approximation"].map(str::to_owned);
    let mut text = head(columns.into_iter().chain(BANDS.map(|bands| format!("{bands} bands"))));
    for (name, kinds) in [("Lambertian", ReceiverKinds::default()), ("glossy", glossy)] {
        let of = |form, bands| of_light(kinds, Approximation::Sphere(form), bands);
        for (word, form) in FORMS {
            let cells = BANDS.map(|bands| {
                let [all, special] = of(form, bands);
                let ratio = all as f64 / of(FORMS[0].1, bands)[0] as f64;
                format!("{all} ({special}), {ratio:.2}")
            });
            text += &row([name.to_owned(), word.to_owned()].into_iter().chain(cells));
        }
    }
    let thesis = MAIN_OVER_SPHERE.map(|ratio| format!("{ratio:.2}"));
    text + &row(["thesis, time", "main"].map(str::to_owned).into_iter().chain(thesis))
}
