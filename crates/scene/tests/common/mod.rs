//! What several test files share.

pub(crate) mod triangle;

use std::path::PathBuf;

use manylights_scene::{LoadError, Scene, load};
use tempfile::TempDir;

/// The folder of real scenes.
pub(crate) fn assets() -> PathBuf {
    let folder = std::env::var_os("MANYLIGHTS_ASSETS")
        .expect("set MANYLIGHTS_ASSETS to the folder with the shared assets");
    PathBuf::from(folder)
}

/// A scene file `hall.toml` in a folder that lives as long as what is returned.
pub(crate) fn write(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("hall.toml");
    std::fs::write(&path, text).expect("can write");
    (folder, path)
}

pub(crate) fn load_text(text: &str) -> Result<Scene, LoadError> {
    let (_folder, path) = write(text);
    load(path.to_str().expect("UTF-8"), None)
}

/// What every loaded scene promises to renderers.
pub(crate) fn check_invariants(scene: &Scene, what: &str) {
    for vertex in &scene.vertices {
        assert!(vertex.position.is_finite() && vertex.uv.is_finite(), "{what}: {vertex:?}");
        // Normalising rounds each component by half a unit in the last place: 1e-6 is ample.
        assert!((vertex.normal.length() - 1.0).abs() < 1e-6, "{what}: {vertex:?}");
    }
    for (i, triangle) in scene.triangles.iter().enumerate() {
        assert!((triangle.material as usize) < scene.materials.len(), "{what}: {triangle:?}");
        assert!(triangle.vertices.iter().all(|&v| (v as usize) < scene.vertices.len()), "{what}");
        assert!(scene.geometric_normal(i as u32).is_finite(), "{what}: triangle {i} has no area");
    }
    for material in &scene.materials {
        let texture = material.base_color_texture;
        assert!(texture.is_none_or(|t| (t as usize) < scene.textures.len()), "{what}");
        let brdf = material.brdf(material.base_color);
        assert!(brdf.diffuse.is_finite() && brdf.f0.is_finite() && brdf.alpha > 0.0, "{what}");
    }
    for texture in &scene.textures {
        assert_eq!(texture.texels.len(), (texture.width * texture.height) as usize, "{what}");
    }
    assert!(scene.camera(None).is_ok(), "{what} has no camera");
    assert!(scene.exposure > 0.0 && scene.exposure.is_finite(), "{what}");
}

/// One line of the form `place: problem; remedy`.
pub(crate) fn check_line(error: &LoadError) -> String {
    let line = error.to_string();
    assert!(!line.chars().any(char::is_control), "more than a line: {line:?}");
    let (problem, remedy) = line.rsplit_once("; ").expect("has a remedy");
    assert!(problem.contains(": ") && remedy.len() > 5, "{line}");
    line
}
