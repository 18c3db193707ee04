//! Scales of a spherical light's cap and their rates, as the light shrinks or the point enters it.

use manylights_harmonics::zonal::{
    CLOSED_FORM_BANDS, Sighting, cap_rate_sloan, cap_rate_stable, cap_rate_thesis, cap_sloan,
    cap_stable, cap_thesis,
};

use crate::{Table, Worst};

const COLUMNS: [&str; 4] = ["r/d, bands", "closed forms", "thesis", "stable"];

/// Families of (radius, distance).
fn families() -> Vec<(String, Vec<[f32; 2]>)> {
    let mut list = vec![
        ("on the sphere, 1".to_owned(), vec![[0.7, 0.7]]),
        ("inside, above 1".to_owned(), vec![[0.7, 0.5], [0.7, 0.1], [0.7, 1e-18]]),
        (
            "just outside, 1 − 1e-7 to 1 − 1e-2".to_owned(),
            (0..60).map(|i| [0.7, 0.7 * (1.0 + 10_f32.powf(-7.0 + i as f32 / 12.0))]).collect(),
        ),
    ];
    for exponent in 0..6 {
        let high = 10_f32.powi(-exponent);
        let cases = (1..=60).map(|i| [0.37 * high * 10_f32.powf(-i as f32 / 60.0), 0.37]).collect();
        list.push((format!("{high:.0e} to {:.0e}", 0.1 * high), cases));
    }
    list
}

fn sighting<R: manylights_harmonics::Real>([radius, distance]: [R; 2]) -> Sighting<R> {
    Sighting::of_sphere([R::zero(), R::zero(), distance], radius).expect("a light at a distance")
}

type Form<R> = fn(&Sighting<R>, &mut [R]);

fn table(title: &str, about: &str, bound: f64, forms: [Form<f32>; 3], exact: Form<f64>) -> Table {
    let mut table = Table::new(title, about, &COLUMNS, bound);
    for (family, cases) in families() {
        for bands in [CLOSED_FORM_BANDS, 30] {
            let (mut values, mut truth) = (vec![0.0; bands], vec![0.0; bands]);
            let mut worst = [Worst::default(); 3];
            for &case in &cases {
                exact(&sighting(case.map(f64::from)), &mut truth);
                for (worst, form) in worst.iter_mut().zip(forms).skip(usize::from(bands > 10)) {
                    form(&sighting(case), &mut values);
                    worst.add_all(&values, &truth);
                }
            }
            let [closed, thesis, stable] = worst.map(Some);
            let closed = closed.filter(|_| bands <= CLOSED_FORM_BANDS);
            table.row(&format!("{family}, {bands}"), &[closed, thesis, stable]);
        }
    }
    table
}

pub(crate) fn scales() -> Table {
    let about = "c_l of a sphere of radius r at distance d. Worst error relative to the largest \
                 scale of the case.";
    let forms: [Form<f32>; 3] = [
        |s, scales| cap_sloan(s.cap, scales),
        |s, scales| cap_thesis(s.cap, scales),
        |s, scales| cap_stable(s.cap, scales),
    ];
    table("Cap scales", about, 1e-6, forms, |s, scales| cap_stable(s.cap, scales))
}

pub(crate) fn rates() -> Table {
    let about = "dc_l/dd of the same lights; on the sphere and inside it is 0. Worst error relative \
                 to the largest rate of the case.";
    let forms: [Form<f32>; 3] = [
        |s, rates| cap_rate_sloan(s.cap, s.cosine_rate, rates),
        |s, rates| cap_rate_thesis(s.cap, s.cosine_rate, rates),
        |s, rates| cap_rate_stable(s.cap, s.cosine_rate, rates),
    ];
    table("Rates of cap scales", about, 2e-6, forms, |s, rates| {
        cap_rate_stable(s.cap, s.cosine_rate, rates);
    })
}
