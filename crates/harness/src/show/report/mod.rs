//! `report.html`: one page with everything, which needs no network and no server.
//!
//! Style and scripts lie beside this file and are put into the page as they are; what they show is JSON
//! and base64 in `<script>` elements that no browser runs. A content security policy keeps the page
//! from loading anything.

mod data;
mod load;
mod pictures;
mod pixels;
mod template;

use std::path::Path;

use manylights_metrics::{METRICS, RadianceImage, false_color};

use crate::answer::error_column::ErrorColumn;
use crate::answer::rows::SceneAnswer;
use crate::error::Failure;
use crate::measurement::provenance::Provenance;
use crate::measurement::scene_cells::SceneCells;
use crate::output::{self, say};
use crate::question::experiment::Experiment;
use crate::show::curves::Figure;
use crate::show::table;
use crate::show::table::Table;
use pictures::Pictures;
pub(super) use template::escaped;
use template::{fill, in_script};

pub(crate) use load::{Loaded, load};

/// Its name.
pub(crate) const FILE: &str = "report.html";

const PAGE: &str = include_str!("page/page.html");
const STYLE: [&str; 2] = [include_str!("page/page.css"), include_str!("page/viewer.css")];
/// Each declares what the next ones use.
const SCRIPTS: [&str; 7] = [
    include_str!("page/data.js"),
    include_str!("page/pixels.js"),
    include_str!("page/viewer.js"),
    include_str!("page/gestures.js"),
    include_str!("page/crops.js"),
    include_str!("page/table.js"),
    include_str!("page/main.js"),
];

/// What a report is made of.
pub(crate) struct Report<'a> {
    /// The question.
    pub(crate) experiment: &'a Experiment,
    /// Cells and references of each scene.
    pub(crate) cells: &'a [SceneCells],
    /// The answer for each of them.
    pub(crate) answers: &'a [SceneAnswer],
    /// Program and machine.
    pub(crate) machine: &'a Provenance,
    /// What makes the results again.
    pub(crate) command: String,
    /// See [`Figure::new`].
    pub(crate) curves_error: Option<ErrorColumn>,
}

impl Report<'_> {
    /// Writes `report.html` into the folder that holds the pictures of the cells.
    ///
    /// # Errors
    /// One line where a picture cannot be read or the page cannot be written.
    pub(crate) fn write(&self, out: &Path) -> Result<(), Failure> {
        let path = out.join(FILE);
        output::write(&path, self.html(out)?.as_bytes())?;
        say(path.display());
        Ok(())
    }

    fn html(&self, out: &Path) -> Result<String, Failure> {
        let scenes = self.cells.iter().zip(self.answers);
        let pictures: Vec<Pictures<'_>> = scenes
            .map(|(cells, answer)| {
                Pictures::read(self.experiment, cells, answer, self.cells.len(), out)
            })
            .collect::<Result<_, _>>()?;
        let csv = table::csv(self.experiment, self.answers);
        let data = data::data(self, &pictures, csv).to_string();
        let curves = Figure::new(self.experiment, self.answers, self.curves_error).svg()?;
        // Part of an HTML document, an SVG needs no name of its language.
        let curves = curves.replace(" xmlns=\"http://www.w3.org/2000/svg\"", "");
        Ok(fill(
            PAGE,
            &[
                ("title", &escaped(&self.experiment.title)),
                ("question", &escaped(&self.experiment.question)),
                ("facts", &self.facts()),
                ("metrics", &metrics()),
                ("verdicts", &self.verdicts()),
                ("tables", &self.tables()),
                ("style", &STYLE.concat()),
                ("curves", &curves),
                ("data", &in_script(&data)),
                ("ramp", &ramp()),
                ("pictures", &picture_scripts(&pictures)),
                ("scripts", &SCRIPTS.concat()),
            ],
        ))
    }

    /// What the numbers say in sentences, and methods over all scenes.
    fn verdicts(&self) -> String {
        let sentences = table::verdicts(self.experiment, self.answers);
        let sentence = |text: &String| {
            let parts = text.split('`').map(escaped).enumerate();
            let part = |(index, part): (usize, String)| match index % 2 {
                0 => part,
                _ => format!("<code>{part}</code>"),
            };
            format!("<p>{}</p>\n", parts.map(part).collect::<String>())
        };
        let tables = table::across_scenes(self.experiment, self.answers);
        let table = |table: &Table| plain_table(&table.caption, table);
        let sentences: String = sentences.iter().map(sentence).collect();
        sentences + &tables.iter().map(table).collect::<String>()
    }

    /// Times to errors and published values.
    fn tables(&self) -> String {
        let times = self.answers.iter().filter_map(|scene| {
            let table = table::time_to_error(self.experiment, scene)?;
            Some((format!("{}: {}", scene.scene, table.caption), table))
        });
        let published = table::published(self.experiment, self.answers)
            .map(|table| (table.caption.clone(), table));
        times.chain(published).map(|(title, table)| plain_table(&title, &table)).collect()
    }

    /// What was run, and where: terms and descriptions.
    fn facts(&self) -> String {
        let Self { experiment, machine, .. } = self;
        let scale = &experiment.scale;
        let [width, height] = scale.resolution;
        let adapter = machine.adapter.as_ref().map_or("none needed".to_owned(), |adapter| {
            let field = |name: &str| adapter[name].as_str().unwrap_or_default().to_owned();
            format!("{} ({} {})", field("name"), field("driver"), field("driver_info"))
        });
        let facts = [
            (
                "Profile",
                format!(
                    "{}: {width}×{height} pixels, {} timed runs for each of {} seed(s)",
                    experiment.profile,
                    scale.repetitions,
                    scale.seeds.len()
                ),
            ),
            ("Light paths", experiment.transport.to_string()),
            (
                "Processor",
                format!("{}, {} threads, {}", machine.cpu, machine.threads, machine.system),
            ),
            ("Adapter", adapter),
            ("Program", format!("{}, {}", machine.program_name(), machine.rustc)),
        ];
        let facts = facts.map(|(term, text)| definition(term, &escaped(&text)));
        let command = format!("<code>{}</code>", escaped(&self.command));
        facts.concat() + &definition("Made by", &command)
    }
}

/// The command line that runs an experiment in its profile.
pub(crate) fn command(file: &Path, experiment: &Experiment, out: Option<&Path>) -> String {
    let mut words = vec![
        "manylights run".to_owned(),
        file.display().to_string(),
        format!("--profile {}", experiment.profile),
    ];
    words.extend(out.map(|out| format!("--out {}", out.display())));
    words.join(" ")
}

/// A table that neither sorts nor changes.
fn plain_table(title: &str, table: &Table) -> String {
    let class = |column: usize| if table.heading[column].1 { "" } else { " class=\"text\"" };
    let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
        let cell = |(column, text): (usize, &str)| {
            format!("<{tag}{}>{}</{tag}>", class(column), escaped(text))
        };
        format!("<tr>{}</tr>\n", cells.enumerate().map(cell).collect::<String>())
    };
    let title = escaped(title);
    let head = row("th", &mut table.heading.iter().map(|(title, _)| *title));
    let body: String =
        table.lines.iter().map(|line| row("td", &mut line.iter().map(String::as_str))).collect();
    format!(
        "<h3>{title}</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{title}\">\
         <table class=\"plain\">\n<thead>{head}</thead>\n<tbody>\n{body}</tbody>\n</table></div>\n"
    )
}

fn definition(term: &str, html: &str) -> String {
    format!("<div><dt>{term}</dt><dd>{html}</dd></div>\n")
}

/// The formula of each metric.
fn metrics() -> String {
    METRICS.iter().map(|metric| definition(metric.id, &escaped(metric.formula))).collect()
}

/// The colours of absolute errors from zero to the end of the scale: 256 times R, G, B, 8 bits of sRGB.
fn ramp() -> String {
    let steps = 256_u16;
    let pixels = (0..steps).map(|step| [f32::from(step) / f32::from(steps - 1); 3]).collect();
    let levels = RadianceImage { width: steps.into(), height: 1, pixels };
    let black = RadianceImage::black(steps.into(), 1);
    let colors = false_color(&levels, &black, 1.0).display(1.0);
    let bytes = colors.pixels.iter().flatten().map(|value| (255.0 * value).round() as u8);
    serde_json::to_string(&bytes.collect::<Vec<_>>()).expect("numbers are plain data")
}

fn picture_scripts(scenes: &[Pictures<'_>]) -> String {
    let mut text = String::new();
    for (scene, pictures) in scenes.iter().enumerate() {
        for (index, encoded) in pictures.encoded().enumerate() {
            text.push_str(&format!(
                "<script type=\"text/plain\" id=\"picture-{scene}-{index}\">{encoded}</script>\n"
            ));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_plain_tables_are_text() {
        let table = Table {
            caption: String::new(),
            heading: vec![("method", false), ("ms", true)],
            lines: vec![vec!["<b>".into(), "1.5".into()]],
        };
        let html = plain_table("A & B", &table);
        assert!(html.contains("<h3>A &amp; B</h3>"), "{html}");
        assert!(html.contains("<td class=\"text\">&lt;b&gt;</td><td>1.5</td>"), "{html}");
    }

    #[test]
    fn the_ramp_runs_from_black_to_light() {
        let colors: Vec<u8> = serde_json::from_str(&ramp()).expect("JSON");
        assert_eq!(colors.len(), 768);
        assert_eq!(colors[..3], [0, 0, 0]);
        assert!(colors[765..].iter().all(|&component| component > 128), "{:?}", &colors[765..]);
    }
}
