//! Solid angles along a line under a square (thesis figure 4.16), in a table and drawn.

use plotters::prelude::*;

use crate::study::{Study, seen_from, square};
use crate::tables::{FORMS, head, row};

/// Of the plane below the square, of side 1.
const HEIGHT: f64 = 0.5;
const FARTHEST: f64 = 3.0;
const STEPS: u32 = 120;

/// What a form takes for the solid angle.
struct Curve {
    name: &'static str,
    color: RGBColor,
    /// By place and solid angle, sr.
    points: Vec<(f64, f64)>,
}

/// The truth and all forms that have a solid angle of their own: one triangle, half of the square.
fn curves() -> Vec<Curve> {
    let (study, triangle) = (Study::new(1), square(1)[0]);
    let whole = (4.0 * std::f64::consts::PI).sqrt();
    let along = |of: &dyn Fn([[f64; 3]; 3]) -> Vec<f64>| {
        let place = |step| f64::from(2 * step) / f64::from(STEPS) * FARTHEST - FARTHEST;
        let places = (0..=STEPS).map(place);
        // Y_00 is one over this root.
        places.map(|x| (x, of(seen_from(triangle, [x, 0.0, -HEIGHT]))[0] * whole)).collect()
    };
    let exact =
        Curve { name: "triangle", color: BLACK, points: along(&|corners| study.exact(corners)) };
    let colors =
        [("sphere", RED), ("main", BLUE), ("compromise", MAGENTA), ("compromise-root", GREEN)];
    let approximations = colors.into_iter().map(|(name, color)| {
        let (_, form) = FORMS.into_iter().find(|(word, _)| *word == name).expect("a word");
        Curve { name, color, points: along(&|corners| study.of(form, corners)) }
    });
    [exact].into_iter().chain(approximations).collect()
}

pub(crate) fn table() -> String {
    let curves = curves();
    let names = curves.iter().map(|curve| curve.name.to_owned());
    let mut text = head(["x".to_owned()].into_iter().chain(names));
    for step in (0..=STEPS as usize).step_by(10) {
        let x = format!("{:.1}", curves[0].points[step].0);
        let values = curves.iter().map(|curve| format!("{:.4}", curve.points[step].1));
        text += &row([x].into_iter().chain(values));
    }
    text
}

/// As SVG.
pub(crate) fn figure() -> String {
    let mut text = String::new();
    draw(&mut text).expect("a string takes all lines");
    text
}

fn draw(text: &mut String) -> Result<(), Box<dyn std::error::Error + '_>> {
    let curves = curves();
    let most = curves.iter().flat_map(|curve| &curve.points).map(|(_, y)| *y).fold(0.0, f64::max);
    let root = SVGBackend::with_string(text, (720, 420)).into_drawing_area();
    root.fill(&WHITE)?;
    let (font, size) = ("sans-serif", 14);
    let mut chart = ChartBuilder::on(&root)
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(48)
        .build_cartesian_2d(-FARTHEST..FARTHEST, 0.0..1.05 * most)?;
    chart
        .configure_mesh()
        .x_desc("place on the line, in sides of the square")
        .y_desc("solid angle, sr")
        .label_style((font, size))
        .light_line_style(WHITE)
        .draw()?;
    for Curve { name, color, points } in curves {
        let drawn = chart.draw_series(LineSeries::new(points, color.stroke_width(2)))?;
        drawn
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .background_style(WHITE)
        .label_font((font, size))
        .border_style(BLACK)
        .draw()?;
    root.present()?;
    Ok(())
}
