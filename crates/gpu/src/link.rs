//! Shader linking: WESL modules to WGSL, in one place.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Mutex;

use wesl::syntax::{ModulePath, PathOrigin};
use wesl::{CompileOptions, EscapeMangler, Features, VirtualResolver};

use crate::Error;

/// A switch of conditional translation (`@if(name)`) and its position.
pub type Feature<'a> = (&'a str, bool);

/// A module made at run time, which a shader may import as `package::NAME`: its name and its text.
pub type Module<'a> = (&'a str, &'a str);

/// Modules that every shader may import as `package::NAME`.
const SHARED: [(&str, &str); 5] = [
    ("brdf", include_str!("shaders/brdf.wesl")),
    ("measured", include_str!("shaders/measured.wesl")),
    ("surface", include_str!("shaders/surface.wesl")),
    ("scene", include_str!("shaders/scene.wesl")),
    ("visible", include_str!("shaders/visible.wesl")),
];

/// The WGSL of the module `source`, with what it imports from the shared modules and from `modules`
/// and nothing that it does not reach: a pipeline for a scene without a lobe holds no code of that
/// lobe. Linked once in a process.
///
/// # Errors
/// A syntax error, an unknown import or a feature without a position, with the module's name.
pub fn link(
    name: &str,
    source: &str,
    modules: &[Module<'_>],
    features: &[Feature<'_>],
) -> Result<String, Error> {
    // Else a gather of a few pixels and twenty bands spends most of its time here.
    static LINKED: Mutex<BTreeMap<String, String>> = Mutex::new(BTreeMap::new());
    let key = format!("{name} {features:?} {modules:?} {source}");
    let linked = || LINKED.lock().unwrap_or_else(|poison| poison.into_inner());
    if let Some(wgsl) = linked().get(&key) {
        return Ok(wgsl.clone());
    }
    let wgsl = compile(name, source, modules, features)?;
    linked().insert(key, wgsl.clone());
    Ok(wgsl)
}

fn compile(
    name: &str,
    source: &str,
    modules: &[Module<'_>],
    features: &[Feature<'_>],
) -> Result<String, Error> {
    let mut resolver = VirtualResolver::new();
    for (imported, text) in SHARED.iter().chain(modules) {
        resolver.add_module(path(imported), Cow::Borrowed(text));
    }
    resolver.add_module(path(name), Cow::Borrowed(source));
    let flags = features.iter().map(|&(name, on)| (name.to_owned(), on.into())).collect();
    let options = CompileOptions {
        // A feature that nobody set is a mistake, not `false`.
        features: Features { default: wesl::Feature::Error, flags },
        ..Default::default()
    };
    wesl::compile(&path(name), &resolver, &EscapeMangler, &options)
        .map(|linked| linked.to_string())
        .map_err(|e| Error::new(format!("shader `{name}`: {e}")))
}

fn path(name: &str) -> ModulePath {
    ModulePath { origin: PathOrigin::Absolute, components: vec![name.to_owned()] }
}
