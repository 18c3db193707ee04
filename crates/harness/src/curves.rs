//! `curves.svg`: error against time, one facet for each scene and reference.

use std::collections::BTreeMap;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::{BindKeyPoints, LogCoord, WithKeyPoints};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::answer::SceneAnswer;
use crate::error::Failure;
use crate::experiment::Experiment;
use crate::numbers::short;
use crate::style::{Marker, dashes, method_style};

const FACET: (u32, u32) = (460, 300);
const HEAD: u32 = 40;
const LEGEND_LINE: u32 = 24;
const LEGEND_COLUMN: u32 = 300;
const FONT: &str = "sans-serif";
const TEXT: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(200, 200, 200);
const FINE_GRID: RGBColor = RGBColor(236, 236, 236);
const FLOOR: RGBColor = RGBColor(120, 120, 120);

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axis = WithKeyPoints<LogCoord<f64>>;
type Plane<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// A curve: the variants of one series.
struct Series {
    name: String,
    method: &'static str,
    /// Which of the curves of its method.
    nth: usize,
    variants: Vec<usize>,
}

/// Draws the figure.
///
/// # Errors
/// Where nothing could be drawn.
pub(crate) fn svg(experiment: &Experiment, scenes: &[SceneAnswer]) -> Result<String, Failure> {
    let mut text = String::new();
    draw(&mut text, experiment, scenes)
        .map_err(|error| Failure::Failed(format!("curves.svg: {error}")))?;
    Ok(text)
}

fn draw<'t>(text: &'t mut String, experiment: &Experiment, scenes: &[SceneAnswer]) -> Drawn<'t> {
    let series = series(experiment);
    let columns = experiment.references.len();
    let width = FACET.0 * (columns as u32).max(2);
    let per_line = (width / LEGEND_COLUMN) as usize;
    let legend_lines = (series.len() + 1).div_ceil(per_line) as u32;
    let height = HEAD + FACET.1 * scenes.len() as u32 + LEGEND_LINE * (legend_lines + 1);
    let root = SVGBackend::with_string(text, (width, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, rest) = root.split_vertically(HEAD);
    let title = format!("{}: error against time", experiment.title);
    let style = (FONT, 18).into_font().color(&TEXT).pos(Pos::new(HPos::Center, VPos::Center));
    head.draw(&Text::new(title, (width as i32 / 2, HEAD as i32 / 2), style))?;
    let (plots, legend) = rest.split_vertically(FACET.1 * scenes.len() as u32);
    let (times, errors) = ranges(experiment, scenes);
    let facets = plots.split_evenly((scenes.len(), columns));
    for (index, facet) in facets.iter().enumerate() {
        let scene = &scenes[index / columns];
        let reference = experiment.references[index % columns].to_string();
        draw_facet(facet, scene, &reference, &series, times.clone(), errors.clone())?;
    }
    draw_legend(&legend, &series, per_line)?;
    root.present()
}

fn series(experiment: &Experiment) -> Vec<Series> {
    let mut list: Vec<Series> = Vec::new();
    let mut curves_of = BTreeMap::new();
    for (index, variant) in experiment.variants.iter().enumerate() {
        let name = variant.series();
        if let Some(series) = list.iter_mut().find(|series| series.name == name) {
            series.variants.push(index);
            continue;
        }
        let method = variant.method.id();
        let nth = curves_of.entry(method).or_insert(0);
        list.push(Series { name, method, nth: *nth, variants: vec![index] });
        *nth += 1;
    }
    list
}

/// Points (milliseconds, RMSE of sRGB values) of some variants against a reference, in the order of
/// the sweep, which need not be that of the measured times.
fn points(scene: &SceneAnswer, reference: &str, variants: &[usize]) -> Vec<(f64, f64)> {
    let point = |&variant: &usize| {
        let medians = scene.rows[variant].medians()?;
        let rmse = medians.errors.get(reference)?.display.rmse;
        Some((1e3 * medians.seconds.median, rmse))
    };
    // Neither zero has a place on a logarithmic axis.
    variants.iter().filter_map(point).filter(|&(ms, rmse)| ms > 0.0 && rmse > 0.0).collect()
}

/// Around all points and floors, the same for all facets.
fn ranges(experiment: &Experiment, scenes: &[SceneAnswer]) -> (Range<f64>, Range<f64>) {
    let variants: Vec<usize> = (0..experiment.variants.len()).collect();
    let mut times = Vec::new();
    let mut errors = Vec::new();
    for scene in scenes {
        for reference in experiment.references.iter().map(ToString::to_string) {
            let points = points(scene, &reference, &variants);
            times.extend(points.iter().map(|point| point.0));
            errors.extend(points.iter().map(|point| point.1));
            errors.extend(floor(scene, &reference));
        }
    }
    (bounds(&times), bounds(&errors))
}

fn floor(scene: &SceneAnswer, reference: &str) -> Option<f64> {
    scene.floor(reference).map(|(_, display)| display).filter(|&floor| floor > 0.0)
}

/// The nearest 1, 2 or 5 times a power of ten around the values, with some room.
fn bounds(values: &[f64]) -> Range<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min) / 1.2;
    let high = values.iter().copied().fold(0.0, f64::max) * 1.2;
    if low > high {
        return 0.1..1.0; // nothing to show
    }
    let steps: Vec<f64> = multiples(low / 10.0..high * 10.0, &[1, 2, 5]).collect();
    let start = steps.iter().copied().rfind(|&step| step <= low).unwrap_or(low);
    let end = steps.iter().copied().find(|&step| step >= high).unwrap_or(high);
    start..end
}

/// These multiples of all powers of ten within a range, in order.
fn multiples(range: Range<f64>, digits: &[u32]) -> impl Iterator<Item = f64> {
    let first = range.start.log10().floor() as i32;
    let last = range.end.log10().ceil() as i32;
    // Decimal texts, so that bounds and labels are the same numbers.
    (first..=last)
        .flat_map(move |n| digits.iter().map(move |k| format!("{k}e{n}")))
        .map(|text| text.parse().expect("a number as just written"))
        .filter(move |step| (range.start..=range.end).contains(step))
}

/// An axis with a labelled line at each decade and fine lines between; less than two decades have
/// labels at 2 and 5 as well.
fn axis(range: Range<f64>) -> Axis {
    let narrow = range.end / range.start < 100.0;
    let labelled = multiples(range.clone(), if narrow { &[1, 2, 5] } else { &[1] }).collect();
    let fine: Vec<f64> = multiples(range.clone(), &[1, 2, 3, 4, 5, 6, 7, 8, 9]).collect();
    range.log_scale().with_key_points(labelled).with_light_points(fine)
}

fn draw_facet<'t>(
    area: &Canvas<'t>,
    scene: &SceneAnswer,
    reference: &str,
    series: &[Series],
    times: Range<f64>,
    errors: Range<f64>,
) -> Drawn<'t> {
    let mut chart = ChartBuilder::on(area)
        .caption(format!("{}, visibility {reference}", scene.scene), (FONT, 15, &TEXT))
        .margin(8)
        .margin_right(20)
        .x_label_area_size(42)
        .y_label_area_size(62)
        .build_cartesian_2d(axis(times.clone()), axis(errors))?;
    chart
        .configure_mesh()
        .x_desc("time of the work, ms")
        .y_desc("RMSE of sRGB values")
        .axis_desc_style((FONT, 13, &TEXT))
        .label_style((FONT, 12, &TEXT))
        .x_label_formatter(&|value| decade(*value))
        .y_label_formatter(&|value| decade(*value))
        .bold_line_style(GRID)
        .light_line_style(FINE_GRID)
        .axis_style(TEXT)
        .draw()?;
    if let Some(floor) = floor(scene, reference) {
        draw_floor(&mut chart, floor, times)?;
    }
    for curve in series {
        draw_curve(&mut chart, curve, points(scene, reference, &curve.variants))?;
    }
    Ok(())
}

/// Labels: plain where that is short.
fn decade(value: f64) -> String {
    if (1e-4..1e5).contains(&value) { format!("{value}") } else { format!("{value:e}") }
}

fn draw_floor<'t>(chart: &mut Plane<'_, 't>, floor: f64, times: Range<f64>) -> Drawn<'t> {
    let line = [(times.start, floor), (times.end, floor)];
    chart.draw_series(DashedLineSeries::new(line, 6, 4, FLOOR.stroke_width(1)))?;
    let style = (FONT, 12).into_font().color(&FLOOR).pos(Pos::new(HPos::Left, VPos::Bottom));
    let label = EmptyElement::at((times.start, floor))
        + Text::new(format!("noise floor {}", short(floor)), (5, -2), style);
    chart.draw_series([label])?;
    Ok(())
}

fn draw_curve<'t>(chart: &mut Plane<'_, 't>, curve: &Series, points: Vec<(f64, f64)>) -> Drawn<'t> {
    let (color, shape) = method_style(curve.method);
    let line = color.stroke_width(2);
    match dashes(curve.nth) {
        None => chart.draw_series(LineSeries::new(points.clone(), line))?,
        Some((dash, gap)) => {
            chart.draw_series(DashedLineSeries::new(points.clone(), dash, gap, line))?
        }
    };
    chart.draw_series(points.into_iter().map(|at| EmptyElement::at(at) + marker(shape, color)))?;
    Ok(())
}

/// A marker around (0, 0), in pixels.
fn marker<'t>(shape: Marker, color: RGBColor) -> DynElement<'static, SVGBackend<'t>, (i32, i32)> {
    let filled = color.filled();
    match shape {
        Marker::Circle => Circle::new((0, 0), 4, filled).into_dyn(),
        Marker::Square => Rectangle::new([(-4, -4), (4, 4)], filled).into_dyn(),
        Marker::Triangle => TriangleMarker::new((0, 0), 6, filled).into_dyn(),
        Marker::Diamond => Polygon::new(vec![(0, -6), (6, 0), (0, 6), (-6, 0)], filled).into_dyn(),
        Marker::Cross => Cross::new((0, 0), 4, color.stroke_width(2)).into_dyn(),
    }
}

fn draw_legend<'t>(area: &Canvas<'t>, series: &[Series], per_line: usize) -> Drawn<'t> {
    let place = |index: usize| {
        let x = 40 + (index % per_line) as i32 * LEGEND_COLUMN as i32;
        (x, 14 + (index / per_line) as i32 * LEGEND_LINE as i32)
    };
    let text = (FONT, 13).into_font().color(&TEXT).pos(Pos::new(HPos::Left, VPos::Center));
    for (index, curve) in series.iter().enumerate() {
        let (x, y) = place(index);
        let (color, shape) = method_style(curve.method);
        draw_sample(area, (x, y), dashes(curve.nth), color.stroke_width(2))?;
        area.draw(&(EmptyElement::at((x + 16, y)) + marker(shape, color)))?;
        area.draw(&Text::new(curve.name.clone(), (x + 40, y), text.clone()))?;
    }
    let (x, y) = place(series.len());
    draw_sample(area, (x, y), Some((6, 4)), FLOOR.stroke_width(1))?;
    area.draw(&Text::new("noise floor of the reference", (x + 40, y), text))
}

/// A short piece of a line of the legend.
fn draw_sample<'t>(
    area: &Canvas<'t>,
    (x, y): (i32, i32),
    dashes: Option<(u32, u32)>,
    style: ShapeStyle,
) -> Drawn<'t> {
    let (dash, gap) = dashes.map_or((32, 0), |(dash, gap)| (dash as i32, gap as i32));
    let mut start = x;
    while start < x + 32 {
        let end = (start + dash).min(x + 32);
        area.draw(&PathElement::new(vec![(start, y), (end, y)], style))?;
        start += dash + gap;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers() {
        assert_eq!(bounds(&[0.0043, 0.125]), 0.002..0.2);
        assert_eq!(bounds(&[7.0, 5300.0]), 5.0..10_000.0);
        assert_eq!(bounds(&[]), 0.1..1.0);
        let steps: Vec<f64> = multiples(0.02..1.0, &[1, 5]).collect();
        assert_eq!(steps, [0.05, 0.1, 0.5, 1.0]);
    }
}
