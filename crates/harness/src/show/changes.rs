//! The page of `manylights check --page`: what moved, before and after.

use std::collections::BTreeSet;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use manylights_metrics::{RadianceImage, false_color};

use crate::answer::error_scale::scale_of;
use crate::answer::regression::Moved;
use crate::error::Failure;
use crate::show::report::escaped;

/// The picture of a cell in the baseline and now, where there is one.
pub(crate) struct Change {
    /// Scene and variant, as [`Moved::cell`].
    pub(crate) cell: String,
    pub(crate) exposure: f32,
    pub(crate) before: Option<RadianceImage>,
    pub(crate) now: Option<RadianceImage>,
}

const HEAD: &str = "<!doctype html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<meta name=\"color-scheme\" content=\"light dark\">
<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">
<title>What moved</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; margin: 1.5rem auto; max-width: 60rem; padding: 0 1rem; }
table { border-collapse: collapse; margin: .5rem 0; }
td, th { padding: .1rem .8rem .1rem 0; text-align: left; vertical-align: top; }
figure { display: inline-block; margin: 0 1rem .5rem 0; }
img { image-rendering: pixelated; width: 17rem; max-width: 100%; display: block; background: #000; }
.scroll { overflow-x: auto; }
</style>
</head>
<body>
<h1>What moved</h1>
";

/// A section for each cell that moved, with its quantities and pictures.
///
/// # Errors
/// Where a picture cannot be encoded.
pub(crate) fn page(moved: &[Moved], changes: &[Change]) -> Result<String, Failure> {
    let mut text = HEAD.to_owned();
    text += &format!("<p>{} quantities moved.</p>\n", moved.len());
    // Times of a cell may follow those of others.
    let mut seen = BTreeSet::new();
    let mut cells: Vec<&str> = moved.iter().map(|moved| moved.cell.as_str()).collect();
    cells.retain(|cell| seen.insert(*cell));
    for cell in cells {
        let own = moved.iter().filter(|moved| moved.cell == cell);
        text += &format!("<h2>{}</h2>\n{}", escaped(cell), table(own));
        if let Some(change) = changes.iter().find(|change| change.cell == cell) {
            text += &pictures(change)?;
        }
    }
    Ok(text + "</body>\n</html>\n")
}

fn table<'m>(moved: impl Iterator<Item = &'m Moved>) -> String {
    let row = |moved: &Moved| {
        let cells = [&moved.quantity, &moved.before, &moved.now, &moved.why];
        let cells = cells.map(|text| format!("<td>{}</td>", escaped(text)));
        format!("<tr>{}</tr>\n", cells.concat())
    };
    format!(
        "<div class=\"scroll\"><table><tr><th>quantity</th><th>before</th><th>now</th><th>why it counts</th></tr>\n\
         {}</table></div>\n",
        moved.map(row).collect::<String>()
    )
}

fn pictures(change: &Change) -> Result<String, Failure> {
    let figure = |image: &RadianceImage, exposure: f32, caption: &str| {
        let png = image.png(exposure).map_err(Failure::input)?;
        Ok::<_, Failure>(format!(
            "<figure><img alt=\"{caption}\" src=\"data:image/png;base64,{}\"><figcaption>{caption}</figcaption></figure>\n",
            BASE64_STANDARD.encode(png)
        ))
    };
    let mut text = String::new();
    for (image, caption) in [(&change.before, "before"), (&change.now, "now")] {
        text += &match image {
            Some(image) => figure(image, change.exposure, caption)?,
            None => format!("<p>No picture {caption}.</p>\n"),
        };
    }
    let (Some(before), Some(now)) = (&change.before, &change.now) else { return Ok(text) };
    if (before.width, before.height) == (now.width, now.height) {
        let scale = scale_of(&[now], &[before]);
        let caption = format!("difference, white at {scale} W·m⁻²·sr⁻¹");
        text += &figure(&false_color(now, before, scale), 1.0, &caption)?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_holds_quantities_and_pictures() {
        let text = |text: &str| text.to_owned();
        let moved = Moved {
            cell: text("s <m>"),
            quantity: text("RMSE"),
            before: text("1"),
            now: text("2"),
            why: text("a fault"),
        };
        let image = |value| RadianceImage { width: 2, height: 1, pixels: vec![[value; 3]; 2] };
        let (before, now) = (Some(image(0.25)), Some(image(0.5)));
        let change = Change { cell: text("s <m>"), exposure: 1.0, before, now };
        let html = page(&[moved], &[change]).expect("a page");
        assert!(html.contains("<h2>s &lt;m&gt;</h2>"), "{html}");
        assert_eq!(html.matches("data:image/png;base64,").count(), 3, "{html}");
        assert!(html.contains("white at 0.5 W"), "{html}");
    }
}
