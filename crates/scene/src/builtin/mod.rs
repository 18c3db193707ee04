//! Scenes made by code: no downloads. Y is up, lengths are metres.

mod atrium;
mod cornell;
pub mod integrating_sphere;
mod receivers;
mod trio;

use crate::{LoadError, Material, Scene};

/// A scene made by code.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// Its name on the command line.
    pub name: &'static str,
    /// One line for `list scenes`.
    pub about: &'static str,
    /// Makes it; always the same scene.
    pub make: fn() -> Scene,
}

/// All of them.
pub const BUILTINS: &[Builtin] = &[
    Builtin {
        name: "integrating-sphere",
        about: "closed Lambertian sphere around a point light; every bounce is known in closed form",
        make: integrating_sphere::make,
    },
    Builtin {
        name: "cornell",
        about: "Lambertian Cornell box with two blocks under a spot light",
        make: cornell::lambertian,
    },
    Builtin {
        name: "cornell-glossy",
        about: "the same box with a glossy back wall (Křivánek et al. 2004, figure 7)",
        make: cornell::glossy,
    },
    Builtin {
        name: "atrium",
        about: "hall of columns and arches over a glossy floor, lit by one spot light",
        make: atrium::make,
    },
    Builtin {
        name: "trio",
        about: "sphere, torus and rounded cube of different gloss before a wall, one spot light",
        make: trio::make,
    },
    Builtin {
        name: "receivers",
        about: "seven spheres of roughness 0.1 to 1 and a Lambertian one under five spheres of light",
        make: receivers::make,
    },
];

/// What a name starts with that can mean nothing else.
pub(crate) const PREFIX: &str = "builtin:";

/// The scene of that name; `place` asks for it.
///
/// # Errors
/// Where there is none (the nearest is suggested).
pub(crate) fn named(name: &str, place: impl std::fmt::Display) -> Result<Scene, LoadError> {
    match BUILTINS.iter().find(|builtin| builtin.name == name) {
        Some(builtin) => Ok((builtin.make)()),
        None => {
            let names = BUILTINS.iter().map(|builtin| builtin.name);
            Err(LoadError::unknown(place, "built-in scene", name, names))
        }
    }
}

/// Appends a material and returns its index.
fn add(scene: &mut Scene, material: Material) -> u32 {
    scene.materials.push(material);
    scene.materials.len() as u32 - 1
}
