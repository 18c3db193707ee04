//! Tables by what they depend on: each is made once in a process.

use std::sync::{Arc, Mutex};

use crate::Damping;

/// GGX width as bits, bands, window.
type Key = (u32, usize, Damping);

/// A list: pictures have few materials.
pub(crate) struct Cache<T>(Mutex<Vec<(Key, Arc<T>)>>);

impl<T> Cache<T> {
    pub(crate) const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The table of this key, made where there is none yet.
    pub(crate) fn get(
        &self,
        (alpha, bands, damping): (f32, usize, Damping),
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        let key = (alpha.to_bits(), bands, damping);
        let mut tables = self.0.lock().unwrap_or_else(|poison| poison.into_inner());
        if let Some((_, table)) = tables.iter().find(|(known, _)| *known == key) {
            return table.clone();
        }
        let table = Arc::new(make());
        tables.push((key, table.clone()));
        table
    }
}
