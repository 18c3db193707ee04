//! How the time grows with lights and bands, and what tabulated coefficients take.

use std::fmt::Write as _;

use manylights_tests::Stage;

use crate::setting::{RESOLUTION, Variant, medians, scene, shaded};

const LIGHTS: [u32; 5] = [10, 40, 160, 640, 2048];
const BANDS: [&str; 5] = ["3", "5", "7", "9", "10"];

/// The exponent of y = c x^k that fits best.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let along: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    along / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

pub(crate) fn section() -> String {
    let mut text = format!(
        "\n## Lights (`product = full`)\n\n\
         Nanoseconds a pixel and light of the gather pass. The exponent is that of the time over all numbers \
         of lights, and over those from 160 on, where fetching a pixel's lobe no longer counts.\n\n\
         | bands | coefficients |{} exponent | from 160 on | tabulated ÷ analytic |\n|---|---|{}---|---|---|\n",
        LIGHTS.map(|lights| format!(" {lights} |")).concat(),
        "---|".repeat(LIGHTS.len()),
    );
    let stages = LIGHTS.map(|lights| Stage::new(scene(lights), RESOLUTION));
    let words = ["analytic", "tabulated"];
    for bands in BANDS {
        let variants = words.map(|word| {
            let texts = [("bands", bands), ("coefficients", word)];
            stages.each_ref().map(|stage| Variant::new(stage, &texts))
        });
        let timed: Vec<_> =
            variants.iter().flat_map(|variants| stages.iter().zip(variants)).collect();
        let seconds = medians(&timed);
        let (analytic, tabulated) = seconds.split_at(LIGHTS.len());
        for (word, seconds) in words.iter().zip([analytic, tabulated]) {
            let points: Vec<_> =
                LIGHTS.map(f64::from).into_iter().zip(seconds.iter().copied()).collect();
            let pairs = points.iter().zip(&stages);
            let rates = pairs.map(|((lights, time), stage)| 1e9 * time / lights / shaded(stage));
            let rates: String = rates.map(|rate| format!(" {rate:.2} |")).collect();
            let ratio = seconds.iter().sum::<f64>() / analytic.iter().sum::<f64>();
            writeln!(
                text,
                "| {bands} | {word} |{rates} {:.2} | {:.2} | {ratio:.2} |",
                exponent(&points),
                exponent(&points[2..]),
            )
            .expect("writing to a string");
        }
    }
    text
}
