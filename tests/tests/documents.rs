//! `scripts/splice` keeps the numbers of the documents those of the results.

use std::fs;
use std::path::Path;
use std::process::Command;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scripts/splice");
const FRESH: &str = "before\n<!-- splice result.md -->\nnew\n<!-- end -->\nafter\n";
const STALE: &str = "before\n<!-- splice result.md -->\nold\n<!-- end -->\nafter\n";

/// Runs the script where `README.md` is `document`. Returns whether it succeeded, what it said, and the
/// document after it.
fn splice(document: &str, result: Option<&str>, arguments: &[&str]) -> (bool, String, String) {
    let root = tempfile::tempdir().expect("a folder");
    let path = |name: &str| root.path().join(name);
    // It works in the folder above its own.
    fs::create_dir(path("scripts")).expect("a folder");
    fs::copy(Path::new(SCRIPT), path("scripts/splice")).expect("the script");
    fs::write(path("README.md"), document).expect("written");
    if let Some(result) = result {
        fs::write(path("result.md"), result).expect("written");
    }
    let output =
        Command::new("bash").arg(path("scripts/splice")).args(arguments).output().expect("bash");
    let said = String::from_utf8(output.stderr).expect("UTF-8");
    let after = fs::read_to_string(path("README.md")).expect("the document");
    (output.status.success(), said, after)
}

#[test]
fn documents_take_the_text_of_results() {
    let fresh = || FRESH.to_owned();
    assert_eq!(splice(STALE, Some("new\n"), &[]), (true, String::new(), fresh()));
    assert_eq!(splice(FRESH, Some("new\n"), &["--check"]), (true, String::new(), fresh()));
}

#[test]
fn a_check_of_a_stale_document_fails_and_changes_nothing() {
    let said = "README.md is out of date: run scripts/splice\n".to_owned();
    assert_eq!(splice(STALE, Some("new\n"), &["--check"]), (false, said, STALE.to_owned()));
}

#[test]
fn what_cannot_be_spliced_fails_in_one_line_and_changes_nothing() {
    let missing = "README.md: cannot read result.md: make it again, or take its splice out\n";
    let unfinished = "README.md: no <!-- end --> after <!-- splice result.md -->\n";
    let open = STALE.replace("<!-- end -->\n", "");
    let nested = STALE.replace("old", "<!-- splice result.md -->");
    for arguments in [&[][..], &["--check"]] {
        for (document, result, said) in [
            (STALE, None, missing),
            (&open, Some("new\n"), unfinished),
            (&nested, Some("new\n"), unfinished),
        ] {
            let expected = (false, said.to_owned(), document.to_owned());
            assert_eq!(splice(document, result, arguments), expected, "{arguments:?}");
        }
    }
}
