//! All tables of some reflectances.

use std::sync::Arc;

use crate::cache::Cache;
use crate::lobes::{LobeTable, NODES};
use crate::mirror::MirrorTable;
use crate::zonal::ZonalTable;
use crate::{Damping, LobeShape};

/// Tables, each made where it is first asked for. A bake has its own, so that it makes, by its clock, all
/// that it needs; oracles and tests share one ([`LobeTable::of`], [`ZonalTable::of`]).
pub struct Tables {
    /// One a shape of the reflectance.
    plain: Cache<Vec<Arc<LobeTable>>>,
    windowed: Cache<LobeTable>,
    zonal: Cache<ZonalTable>,
    /// As `plain`.
    mirror: Cache<Vec<Arc<MirrorTable>>>,
}

impl Default for Tables {
    fn default() -> Self {
        Self::new()
    }
}

impl Tables {
    /// Nothing made yet.
    pub const fn new() -> Self {
        Self {
            plain: Cache::new(),
            windowed: Cache::new(),
            zonal: Cache::new(),
            mirror: Cache::new(),
        }
    }

    /// The one that lasts as long as the process.
    pub fn shared() -> &'static Self {
        static SHARED: Tables = Tables::new();
        &SHARED
    }

    /// The specular lobes of a shape, for a number of bands and a window.
    pub fn lobes(&self, shape: LobeShape, bands: usize, damping: Damping) -> Arc<LobeTable> {
        let (first, place) = shape.place();
        let all = self.plain.get((first, bands, Damping::None), || {
            LobeTable::integrate(first, bands, NODES).into_iter().map(Arc::new).collect()
        });
        let plain = all[place].clone();
        if damping == Damping::None {
            return plain;
        }
        self.windowed.get((shape, bands, damping), || plain.damped(shape, damping))
    }

    /// The nearest circular lobes to these.
    pub fn zonal(&self, shape: LobeShape, bands: usize, damping: Damping) -> Arc<ZonalTable> {
        let make = || ZonalTable::new(&self.lobes(shape, bands, damping));
        self.zonal.get((shape, bands, damping), make)
    }

    /// The circular lobes about the mirror direction, without the cosine.
    pub fn mirror(&self, shape: LobeShape, bands: usize) -> Arc<MirrorTable> {
        let (first, place) = shape.place();
        let all = self.mirror.get((first, bands, Damping::None), || {
            MirrorTable::integrate(first, bands).into_iter().map(Arc::new).collect()
        });
        all[place].clone()
    }

    /// How many were made; those of all shapes of a reflectance are made together and are one.
    pub fn count(&self) -> u64 {
        self.plain.count() + self.windowed.count() + self.zonal.count() + self.mirror.count()
    }
}

impl LobeTable {
    /// Those of [`Tables::shared`].
    pub fn of(shape: impl Into<LobeShape>, bands: usize, damping: Damping) -> Arc<Self> {
        Tables::shared().lobes(shape.into(), bands, damping)
    }
}

impl ZonalTable {
    /// Those of [`Tables::shared`].
    pub fn of(shape: impl Into<LobeShape>, bands: usize, damping: Damping) -> Arc<Self> {
        Tables::shared().zonal(shape.into(), bands, damping)
    }
}

impl MirrorTable {
    /// Those of [`Tables::shared`].
    pub fn of(shape: impl Into<LobeShape>, bands: usize) -> Arc<Self> {
        Tables::shared().mirror(shape.into(), bands)
    }
}
