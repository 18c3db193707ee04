//! `curves.svg` and `curves.png`: error against time and against the amount of work.

mod axes;
mod canvas;
mod facet;
mod raster;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::SceneAnswer;
use crate::answer::series::{self, Series};
use crate::error::Failure;
use crate::question::experiment::Experiment;
use crate::show::style::dashes;
use canvas::{Canvas, Drawn, FLOOR, FONT, TEXT};
use facet::{Against, Facet};
use raster::Raster;

const FACET: (u32, u32) = (460, 300);
const HEAD: u32 = 40;
const LEGEND_LINE: u32 = 24;
/// Of a sample, and of a letter of its name at most.
const LEGEND_SAMPLE: u32 = 56;
const LEGEND_LETTER: u32 = 9;

const FLOOR_NAME: &str = "noise floor of the reference";

/// The figure: for each scene a row, for each reference its error against time, then against the
/// amount of work.
pub(crate) struct Figure<'f> {
    experiment: &'f Experiment,
    scenes: &'f [SceneAnswer],
    series: Vec<Series>,
    error: Option<ErrorColumn>,
}

impl<'f> Figure<'f> {
    /// Of an answer: its RMSE of sRGB values, unless another `error` is asked for.
    pub(crate) fn new(
        experiment: &'f Experiment,
        scenes: &'f [SceneAnswer],
        error: Option<ErrorColumn>,
    ) -> Self {
        let series = series::of_experiment(experiment, scenes);
        Self { experiment, scenes, series, error }
    }

    /// For browsers and papers.
    ///
    /// # Errors
    /// Where nothing could be drawn.
    pub(crate) fn svg(&self) -> Result<String, Failure> {
        let mut text = String::new();
        let root = SVGBackend::with_string(&mut text, self.size()).into_drawing_area();
        self.draw(&root).map_err(|error| Failure::Failed(format!("curves.svg: {error}")))?;
        drop(root);
        Ok(text)
    }

    /// For what shows no SVG.
    ///
    /// # Errors
    /// Where nothing could be drawn.
    pub(crate) fn png(&self) -> Result<Vec<u8>, Failure> {
        let mut picture = Vec::new();
        let root = Raster::new(&mut picture, self.size()).into_drawing_area();
        self.draw(&root).map_err(|error| Failure::Failed(format!("curves.png: {error}")))?;
        drop(root);
        Ok(picture)
    }

    fn columns(&self) -> usize {
        Against::ALL.len() * self.experiment.references.len()
    }

    /// Width of a column of the legend: the longest name fits.
    fn legend_column(&self) -> u32 {
        let letters = self.series.iter().map(|curve| curve.name.chars().count());
        let longest = letters.max().unwrap_or(0).max(FLOOR_NAME.len());
        LEGEND_SAMPLE + LEGEND_LETTER * longest as u32
    }

    fn per_line(&self) -> usize {
        (self.columns() as u32 * FACET.0 / self.legend_column()).max(1) as usize
    }

    fn size(&self) -> (u32, u32) {
        let legend = (self.series.len() + 1).div_ceil(self.per_line()) as u32 + 1;
        let rows = self.scenes.len() as u32;
        (FACET.0 * self.columns() as u32, HEAD + FACET.1 * rows + LEGEND_LINE * legend)
    }

    fn draw<B: DrawingBackend>(&self, root: &Canvas<B>) -> Drawn<B> {
        let width = self.size().0;
        root.fill(&WHITE)?;
        let (head, rest) = root.split_vertically(HEAD);
        let style = (FONT, 18).into_font().color(&TEXT).pos(Pos::new(HPos::Center, VPos::Center));
        let title = self.experiment.title.clone();
        head.draw(&Text::new(title, (width as i32 / 2, HEAD as i32 / 2), style))?;
        let (plots, legend) = rest.split_vertically(FACET.1 * self.scenes.len() as u32);
        let areas = plots.split_evenly((self.scenes.len(), self.columns()));
        let facets = Facet::all(self.experiment, self.scenes, &self.series, self.error);
        for (area, facet) in areas.iter().zip(&facets) {
            facet.draw(area, &self.series)?;
        }
        self.draw_legend(&legend)?;
        root.present()
    }

    fn draw_legend<B: DrawingBackend>(&self, area: &Canvas<B>) -> Drawn<B> {
        let per_line = self.per_line();
        let place = |index: usize| {
            let x = 40 + (index % per_line) as i32 * self.legend_column() as i32;
            (x, 14 + (index / per_line) as i32 * LEGEND_LINE as i32)
        };
        let text = (FONT, 13).into_font().color(&TEXT).pos(Pos::new(HPos::Left, VPos::Center));
        for (index, curve) in self.series.iter().enumerate() {
            let (x, y) = place(index);
            let (color, shape) = curve.style();
            draw_sample(area, (x, y), dashes(curve.nth), color.stroke_width(2))?;
            area.draw(&(EmptyElement::at((x + 16, y)) + facet::marker(shape, color)))?;
            area.draw(&Text::new(curve.name.clone(), (x + 40, y), text.clone()))?;
        }
        if self.error.is_some() {
            return Ok(());
        }
        let (x, y) = place(self.series.len());
        draw_sample(area, (x, y), Some((6, 4)), FLOOR.stroke_width(1))?;
        area.draw(&Text::new(FLOOR_NAME, (x + 40, y), text))
    }
}

/// A short piece of a line of the legend.
fn draw_sample<B: DrawingBackend>(
    area: &Canvas<B>,
    (x, y): (i32, i32),
    dashes: Option<(u32, u32)>,
    style: ShapeStyle,
) -> Drawn<B> {
    let (dash, gap) = dashes.map_or((32, 0), |(dash, gap)| (dash as i32, gap as i32));
    let mut start = x;
    while start < x + 32 {
        let end = (start + dash).min(x + 32);
        area.draw(&PathElement::new(vec![(start, y), (end, y)], style))?;
        start += dash + gap;
    }
    Ok(())
}
