//! Scenes by name. Alone in its binary: the test changes the current directory.

#[allow(dead_code, reason = "the rest is of the other tests")]
mod common;

use manylights_scene::builtin::BUILTINS;
use manylights_scene::{SceneKind, list, load};

#[test]
fn scene_files_below_the_current_directory_have_names() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::env::set_current_dir(folder.path()).expect("can enter");
    assert_eq!(list().len(), BUILTINS.len(), "no folder, no scene files");

    std::fs::create_dir("scenes").expect("can write");
    let hall = "about = \"a hall\"\nsource = \"builtin:atrium\"\nexposure = 3";
    std::fs::write("scenes/hall.toml", hall).expect("can write");
    std::fs::write("scenes/broken.toml", "about = 1").expect("can write");
    std::fs::write("scenes/notes.txt", "not a scene").expect("can write");

    let entries = list();
    let builtin = entries.iter().filter(|entry| entry.kind == SceneKind::Builtin);
    assert!(builtin.map(|entry| &entry.name).eq(BUILTINS.iter().map(|builtin| builtin.name)));
    let [broken, hall] = &entries[BUILTINS.len()..] else { panic!("{entries:?}") };
    assert_eq!((hall.name.as_str(), hall.about.as_str()), ("hall", "a hall"));
    assert_eq!((broken.kind, broken.name.as_str()), (SceneKind::File, "broken"));
    assert!(broken.about.contains("broken.toml:1: invalid type"), "{}", broken.about);

    let scene = load("hall", None).expect("by name");
    assert_eq!((scene.name.as_str(), scene.exposure), ("hall", 3.0));
    let line = common::check_line(&load("hal", None).expect_err("unknown"));
    assert!(line.contains("did you mean `hall`?"), "{line}");

    // A name that two have is neither's.
    std::fs::write("scenes/cornell.toml", "about = \"mine\"\nsource = \"builtin:trio\"")
        .expect("can write");
    let line = common::check_line(&load("cornell", None).expect_err("which?"));
    let file = std::path::Path::new("scenes").join("cornell.toml").display().to_string();
    assert!(
        line.contains(&format!("built-in scene and {file} too; say builtin:cornell or {file}")),
        "{line}"
    );
    let builtin = load("builtin:cornell", None).expect("by its full name");
    let mine = load(&file, None).expect("by its path");
    assert_eq!(
        builtin.triangles.len(),
        load("builtin:cornell-glossy", None).expect("is one").triangles.len()
    );
    assert_eq!(mine.triangles.len(), load("trio", None).expect("is one").triangles.len());
    assert_ne!(builtin.triangles.len(), mine.triangles.len());
    // The list calls each by a name that loads it.
    let names: Vec<String> = list().into_iter().map(|entry| entry.name).collect();
    assert!(names.contains(&"builtin:cornell".to_owned()) && names.contains(&file), "{names:?}");
    assert!(!names.contains(&"cornell".to_owned()), "{names:?}");
    let line = common::check_line(&load("builtin:cornel", None).expect_err("unknown"));
    assert!(line.contains("did you mean `cornell`?"), "{line}");
}
