//! Tables by what they depend on.

use std::sync::{Arc, Mutex, MutexGuard};

use crate::{Damping, LobeShape};

/// Shape as bits, bands, window.
type Key = ([u32; 3], usize, Damping);

/// Each is made once. A list: pictures have few materials.
pub struct Cache<T>(Mutex<Vec<(Key, Arc<T>)>>);

impl<T> Default for Cache<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Cache<T> {
    /// Nothing made yet.
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The table of this key, made where there is none yet. Nothing is locked meanwhile: a table is
    /// made on rayon's threads, which may come back here. Of two made at once the first stays.
    pub fn get(
        &self,
        (shape, bands, damping): (LobeShape, usize, Damping),
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        let key = (shape.bits(), bands, damping);
        if let Some(table) = find(&self.lock(), &key) {
            return table;
        }
        let table = Arc::new(make());
        let mut tables = self.lock();
        find(&tables, &key).unwrap_or_else(|| {
            tables.push((key, table.clone()));
            table
        })
    }

    /// How many were made.
    pub fn count(&self) -> u64 {
        self.lock().len() as u64
    }

    fn lock(&self) -> MutexGuard<'_, Vec<(Key, Arc<T>)>> {
        self.0.lock().unwrap_or_else(|poison| poison.into_inner())
    }
}

fn find<T>(tables: &[(Key, Arc<T>)], key: &Key) -> Option<Arc<T>> {
    tables.iter().find(|(known, _)| known == key).map(|(_, table)| table.clone())
}
