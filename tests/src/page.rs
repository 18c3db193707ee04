//! Pages of results that examples write and people comment.

use std::path::Path;

/// Where what people write begins.
const COMMENT: &str = "## What it says\n";

/// Writes a page, but for what people wrote of an earlier one under "What it says", which stays at its end.
pub fn write(path: &str, text: &str) {
    let path = Path::new(path);
    let earlier = std::fs::read_to_string(path).unwrap_or_default();
    let comment = earlier.find(COMMENT).map_or("", |start| &earlier[start..]);
    let gap = if comment.is_empty() { "" } else { "\n" };
    std::fs::create_dir_all(path.parent().expect("in a folder")).expect("it can be made");
    std::fs::write(path, format!("{text}{gap}{comment}")).expect("the page can be written");
    print!("{text}");
}
