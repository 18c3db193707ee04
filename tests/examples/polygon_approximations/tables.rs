//! Tables of the study in f64.

use std::fmt::Write as _;

use manylights_harmonics::zonal::TriangleForm;

use crate::study::{Corners, Study, equilateral, right_isosceles, sliver};

/// Forms by the words of the parameter `approximation`.
pub(crate) const FORMS: [(&str, TriangleForm); 7] = [
    ("sphere", TriangleForm::Sphere),
    ("main", TriangleForm::Main),
    ("solid-angle", TriangleForm::SolidAngle),
    ("compromise", TriangleForm::Compromise),
    ("compromise-root", TriangleForm::CompromiseRoot),
    ("scaled", TriangleForm::Scaled),
    ("point", TriangleForm::Point),
];

const DISTANCES: [f64; 5] = [1.0, 2.0, 5.0, 10.0, 30.0];

/// A row of a table.
pub(crate) fn row(cells: impl IntoIterator<Item = String>) -> String {
    format!("| {} |\n", cells.into_iter().collect::<Vec<_>>().join(" | "))
}

/// Its head.
pub(crate) fn head(columns: impl IntoIterator<Item = String>) -> String {
    let columns: Vec<_> = columns.into_iter().collect();
    let rule = columns.iter().map(|_| "---".to_owned());
    row(columns.clone()) + &row(rule).replace(' ', "")
}

/// Two digits.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().expect("a number");
    if rounded == 0.0 || (1e-3..1e4).contains(&rounded) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

fn shapes() -> [(&'static str, Corners); 3] {
    [
        ("Equilateral", equilateral()),
        ("Right isosceles", right_isosceles()),
        ("Sliver, ten times as wide as high", sliver()),
    ]
}

/// Figures 4.10 and 4.12.
pub(crate) fn by_distance() -> String {
    let studies = [3, 5, 9].map(Study::new);
    let mut text = String::new();
    for (name, triangle) in shapes() {
        let distances = DISTANCES.map(|distance| format!("{distance} sizes"));
        write!(text, "\n### {name}\n\n").expect("a string");
        text += &head(["approximation".to_owned()].into_iter().chain(distances));
        for (word, form) in FORMS {
            let errors = DISTANCES.map(|distance| {
                // Solid angles that are the triangle's own leave what f64 rounds.
                let solid_angle = studies[0].solid_angle_error(form, triangle, distance);
                let solid_angle =
                    if solid_angle < 1e-14 { "0".to_owned() } else { short(solid_angle) };
                let of_bands = studies.each_ref().map(|s| short(s.error(form, triangle, distance)));
                format!("{solid_angle}; {}", of_bands.join(", "))
            });
            text += &row([word.to_owned()].into_iter().chain(errors));
        }
    }
    text
}

/// Figure 4.10d.
pub(crate) fn by_band() -> String {
    let study = Study::new(15);
    let bands = [0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 14];
    let columns = ["approximation", "sizes"].map(str::to_owned);
    let mut text = head(columns.into_iter().chain(bands.map(|l| format!("l = {l}"))));
    for (word, form) in FORMS {
        for distance in [2.0, 10.0] {
            let errors = bands.map(|l| study.band_error(form, equilateral(), (distance, l)));
            let errors = errors.map(|e| if e < 1e-14 { "0".to_owned() } else { short(e) });
            text += &row([word.to_owned(), distance.to_string()].into_iter().chain(errors));
        }
    }
    text
}

/// Figures 4.8 and 4.14.
pub(crate) fn square() -> String {
    let study = Study::new(5);
    let counts = [1, 3, 6, 12, 18];
    let columns = ["approximation", "height"].map(str::to_owned);
    let numbers = counts.map(|k| format!("{} triangles", 2 * k * k));
    let mut text = head(columns.into_iter().chain(numbers));
    for height in [1.0, 0.3] {
        for (word, form) in FORMS {
            let cells = counts.map(|k| study.square_errors(form, k, height).map(short).join(", "));
            text += &row([word.to_owned(), height.to_string()].into_iter().chain(cells));
        }
    }
    text
}
