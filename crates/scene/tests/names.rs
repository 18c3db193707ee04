//! Scenes by name. Alone in its binary: the test changes the current directory.

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
}
