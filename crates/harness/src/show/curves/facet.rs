//! One plot of the figure: a scene, a reference, an axis.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::{Axis, axis, bounds, label};
use super::canvas::{Canvas, Drawn, FLOOR, FONT, TEXT};
use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::SceneAnswer;
use crate::answer::series::{Point, Series};
use crate::question::experiment::Experiment;
use crate::show::numbers::short;
use crate::show::style::{Marker, dashes};

const GRID: RGBColor = RGBColor(200, 200, 200);
const FINE_GRID: RGBColor = RGBColor(236, 236, 236);

type Plane<'a, B> = ChartContext<'a, B, Cartesian2d<Axis, Axis>>;

/// What errors are drawn against.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Against {
    Time,
    Amount,
}

impl Against {
    pub(super) const ALL: [Self; 2] = [Self::Time, Self::Amount];

    fn title(self) -> &'static str {
        match self {
            Self::Time => "time of the work, ms",
            Self::Amount => "amount of work (lights, samples a pixel)",
        }
    }

    /// Value with lower and upper end of its bar, where a point has one.
    fn of(self, point: &Point) -> Option<[f64; 3]> {
        match self {
            Self::Time => Some(point.seconds.map(|seconds| 1e3 * seconds)),
            Self::Amount => Some([point.amount?; 3]),
        }
    }
}

/// A plot with its curves.
pub(super) struct Facet {
    title: String,
    /// Of the axis of errors.
    error_title: String,
    against: Against,
    floor: Option<f64>,
    /// One for each series.
    curves: Vec<Vec<Mark>>,
    /// Of each series the bias that more work leaves, where it is known.
    plateaus: Vec<Option<f64>>,
    width: Range<f64>,
    height: Range<f64>,
}

/// A point with its bars: value, lower end, upper end.
struct Mark {
    x: [f64; 3],
    y: [f64; 3],
}

impl Facet {
    /// All plots, row by row. Those of one quantity share their axes.
    pub(super) fn all(
        experiment: &Experiment,
        scenes: &[SceneAnswer],
        series: &[Series],
        error: Option<ErrorColumn>,
    ) -> Vec<Self> {
        let mut facets = Vec::new();
        for scene in scenes {
            for reference in experiment.references.iter().map(|reference| &reference.name) {
                for against in Against::ALL {
                    facets.push(Self::new(scene, reference, series, error, against));
                }
            }
        }
        let errors = |facet: &Self| {
            let marks = facet.curves.iter().flatten().flat_map(|mark| mark.y);
            let lines = facet.plateaus.iter().copied().flatten();
            marks.chain(lines).chain(facet.floor).collect::<Vec<_>>()
        };
        let height = bounds(facets.iter().flat_map(errors));
        for against in Against::ALL {
            let alike = |facet: &&Self| facet.against == against;
            let marks = facets.iter().filter(alike).flat_map(|facet| facet.curves.iter().flatten());
            let width = bounds(marks.flat_map(|mark| mark.x));
            for facet in facets.iter_mut().filter(|facet| facet.against == against) {
                (facet.width, facet.height) = (width.clone(), height.clone());
            }
        }
        facets
    }

    fn new(
        scene: &SceneAnswer,
        reference: &str,
        series: &[Series],
        error: Option<ErrorColumn>,
        against: Against,
    ) -> Self {
        let curve = |series: &Series| {
            let points = match error {
                Some(column) => series.points_by(scene, reference, column),
                None => series.points(scene, reference),
            };
            // Zero has no place on a logarithmic axis: a bar that would reach it ends a decade below.
            let mark = |point: Point| {
                let [error, lower, upper] = point.error;
                Some(Mark { x: against.of(&point)?, y: [error, lower.max(0.1 * error), upper] })
            };
            let marks = points.into_iter().filter_map(mark);
            marks
                .filter(|mark| mark.x[1] > 0.0 && mark.y[1] > 0.0 && mark.y[2].is_finite())
                .collect()
        };
        // Both are of the RMSE of sRGB values alone.
        let is_rmse = error.is_none();
        let floor = scene.floor(reference).map(|(_, display)| display).filter(|_| is_rmse);
        let plateau = |series: &Series| series.plateau(scene, reference).filter(|_| is_rmse);
        Self {
            title: format!("{}, against {reference}", scene.scene),
            error_title: error.map_or_else(|| "RMSE of sRGB values".to_owned(), ErrorColumn::title),
            against,
            floor: floor.filter(|&floor| floor > 0.0),
            curves: series.iter().map(curve).collect(),
            plateaus: series.iter().map(plateau).collect(),
            width: 0.1..1.0,
            height: 0.1..1.0,
        }
    }

    pub(super) fn draw<B: DrawingBackend>(&self, area: &Canvas<B>, series: &[Series]) -> Drawn<B> {
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, 15, &TEXT))
            .margin(8)
            .margin_right(20)
            .x_label_area_size(42)
            .y_label_area_size(62)
            .build_cartesian_2d(axis(self.width.clone()), axis(self.height.clone()))?;
        chart
            .configure_mesh()
            .x_desc(self.against.title())
            .y_desc(self.error_title.as_str())
            .axis_desc_style((FONT, 13, &TEXT))
            .label_style((FONT, 12, &TEXT))
            .x_label_formatter(&|value| label(*value))
            .y_label_formatter(&|value| label(*value))
            .bold_line_style(GRID)
            .light_line_style(FINE_GRID)
            .axis_style(TEXT)
            .draw()?;
        if let Some(floor) = self.floor {
            self.draw_floor(&mut chart, floor)?;
        }
        for ((curve, marks), plateau) in series.iter().zip(&self.curves).zip(&self.plateaus) {
            draw_curve(&mut chart, curve, marks)?;
            if let (Some(plateau), Some(first)) = (*plateau, marks.first()) {
                let line = [(first.x[0], plateau), (self.width.end, plateau)];
                let style = curve.style().0.stroke_width(1);
                chart.draw_series(DashedLineSeries::new(line, 1, 3, style))?;
            }
        }
        Ok(())
    }

    fn draw_floor<B: DrawingBackend>(&self, chart: &mut Plane<'_, B>, floor: f64) -> Drawn<B> {
        let line = [(self.width.start, floor), (self.width.end, floor)];
        chart.draw_series(DashedLineSeries::new(line, 6, 4, FLOOR.stroke_width(1)))?;
        let style = (FONT, 12).into_font().color(&FLOOR).pos(Pos::new(HPos::Left, VPos::Bottom));
        let label = EmptyElement::at((self.width.start, floor))
            + Text::new(format!("noise floor {}", short(floor)), (5, -2), style);
        chart.draw_series([label])?;
        Ok(())
    }
}

fn draw_curve<B: DrawingBackend>(
    chart: &mut Plane<'_, B>,
    curve: &Series,
    marks: &[Mark],
) -> Drawn<B> {
    let (color, shape) = curve.style();
    let points: Vec<_> = marks.iter().map(|mark| (mark.x[0], mark.y[0])).collect();
    let line = color.stroke_width(2);
    match dashes(curve.nth) {
        None => chart.draw_series(LineSeries::new(points.clone(), line))?,
        Some((dash, gap)) => {
            chart.draw_series(DashedLineSeries::new(points.clone(), dash, gap, line))?
        }
    };
    let bars = marks.iter().flat_map(|mark| {
        let ([x, left, right], [y, low, high]) = (mark.x, mark.y);
        [vec![(left, y), (right, y)], vec![(x, low), (x, high)]]
    });
    let bars = bars.filter(|ends| ends[0] != ends[1]);
    chart.draw_series(bars.map(|ends| PathElement::new(ends, color.stroke_width(1))))?;
    chart.draw_series(points.into_iter().map(|at| EmptyElement::at(at) + marker(shape, color)))?;
    Ok(())
}

/// A marker around (0, 0), in pixels.
pub(super) fn marker<B: DrawingBackend>(
    shape: Marker,
    color: RGBColor,
) -> DynElement<'static, B, (i32, i32)> {
    let filled = color.filled();
    match shape {
        Marker::Circle => Circle::new((0, 0), 4, filled).into_dyn(),
        Marker::Square => Rectangle::new([(-4, -4), (4, 4)], filled).into_dyn(),
        Marker::Triangle => TriangleMarker::new((0, 0), 6, filled).into_dyn(),
        Marker::Diamond => Polygon::new(vec![(0, -6), (6, 0), (0, 6), (-6, 0)], filled).into_dyn(),
        Marker::Cross => Cross::new((0, 0), 4, color.stroke_width(2)).into_dyn(),
    }
}
