//! A scene file's text: what its places are called, and what the names in it mean.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::error::suggestion;
use crate::{LoadError, Scene, builtin, gltf};

pub(super) struct Document<'a> {
    path: &'a Path,
    text: String,
    assets: Option<&'a Path>,
}

impl<'a> Document<'a> {
    pub(super) fn read(path: &'a Path, assets: Option<&'a Path>) -> Result<Self, LoadError> {
        let text = std::fs::read_to_string(path)
            .map_err(|error| LoadError::new(path.display(), error, "check the path"))?;
        Ok(Self { path, text, assets })
    }

    pub(super) fn parse<T: DeserializeOwned>(&self) -> Result<T, LoadError> {
        toml::from_str(&self.text).map_err(|error| {
            let place = match error.span() {
                Some(span) => self.place(span),
                None => self.path.display().to_string(),
            };
            LoadError::new(place, error.message(), remedy(error.message()))
        })
    }

    /// File and line of what stands at these bytes.
    pub(super) fn place(&self, span: Range<usize>) -> String {
        let line = self.text[..span.start].matches('\n').count() + 1;
        format!("{}:{line}", self.path.display())
    }

    /// What `name` stands for: `builtin:NAME`, or a glTF file as [`Self::located`] finds it.
    pub(super) fn source(&self, name: &str, keep_lights: bool) -> Result<Scene, LoadError> {
        match name.strip_prefix(builtin::PREFIX) {
            Some(name) => builtin::named(name, self.path.display()),
            None => gltf::load(&self.located(name)?, keep_lights),
        }
    }

    /// The path of a file that this one names: `asset:PATH`, or relative to it.
    pub(super) fn located(&self, name: &str) -> Result<PathBuf, LoadError> {
        match name.strip_prefix("asset:") {
            Some(asset) => self.asset_path(asset),
            None => Ok(self.path.parent().unwrap_or(Path::new("")).join(name)),
        }
    }

    fn asset_path(&self, asset: &str) -> Result<PathBuf, LoadError> {
        let remedy = "set MANYLIGHTS_ASSETS or --assets to a folder that has it; the models come \
                      from the archives that README.md lists under Scenes";
        let Some(assets) = self.assets else {
            let problem = format!("needs the asset `{asset}`, and no assets folder is set");
            return Err(LoadError::new(self.path.display(), problem, remedy));
        };
        let path = assets.join(asset);
        if path.is_file() {
            return Ok(path);
        }
        let problem = format!("needs the asset `{asset}`, which {} lacks", assets.display());
        Err(LoadError::new(self.path.display(), problem, remedy))
    }
}

/// The nearest key where serde says "unknown field `a`, expected one of `b`, `c`" (or "variant").
fn remedy(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    match quoted.next() {
        Some(word) if message.starts_with("unknown ") => suggestion(word, quoted),
        _ => "correct the scene file".to_owned(),
    }
}
