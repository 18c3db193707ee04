//! Measured reflectances: files of the RGL and MERL databases, isotropic.
//!
//! There is one instance of a measurement in the whole process, and it lives as long: a
//! [`Brdf`](crate::Brdf) with a measurement is as small a value as any other, and so are the records
//! made from it. Reading the same data again, also for another scene, finds the table that is there;
//! dropping a scene frees none.

mod estimate;
mod fault;
mod merl;
mod real;
mod rgl;
mod tensor;
mod values;

use std::fmt::{Debug, Formatter};
use std::path::Path;
use std::sync::{PoisonError, RwLock};

pub(crate) use self::estimate::Estimate;
use self::merl::Merl;
use self::real::Real;
use self::rgl::Rgl;
use self::values::Values;
use crate::LoadError;

/// Longest file that is read: a MERL material has 35 MB.
const MAX_FILE: u64 = 1 << 26;

/// All tables so far; a table's number is its index.
static TABLES: RwLock<Vec<&'static Table>> = RwLock::new(Vec::new());

/// A measured reflectance: which of the tables that this process has read.
#[derive(Clone, Copy)]
pub struct Measured(&'static Table);

struct Table {
    number: u32,
    values: Values,
    estimate: Estimate,
}

impl Measured {
    /// Reads a `.bsdf` file of the RGL database (isotropic, RGB) or a `.binary` file of MERL. Its memory
    /// (17 MB for MERL) stays in use until the process ends.
    ///
    /// # Errors
    /// One line with the file, what is wrong and how to mend it.
    pub fn load(path: &Path) -> Result<Self, LoadError> {
        Self::read(path).map_err(|error| error.within(path.display()))
    }

    fn read(path: &Path) -> Result<Self, LoadError> {
        let unreadable = |error| LoadError::new("cannot be read", error, "check the path");
        let size = std::fs::metadata(path).map_err(unreadable)?.len();
        if size > MAX_FILE {
            let remedy = "use an isotropic RGB measurement";
            return Err(LoadError::new("the file", format!("has {size} bytes"), remedy));
        }
        let bytes = || std::fs::read(path).map_err(unreadable);
        let extension = path.extension().and_then(|extension| extension.to_str());
        let values = match extension {
            Some("bsdf") => Values::Rgl(Rgl::read(&bytes()?)?),
            Some("binary") => Values::Merl(Merl::read(&bytes()?)?),
            _ => {
                let remedy = "use a .bsdf file of RGL or a .binary file of MERL";
                return Err(LoadError::new("the file", "is not a known measurement", remedy));
            }
        };
        Ok(Self::keep(values))
    }

    fn keep(values: Values) -> Self {
        let mut tables = TABLES.write().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = tables.iter().find(|table| table.values == values) {
            return Self(table);
        }
        let estimate = match &values {
            Values::Rgl(rgl) => Estimate::new(&values, |theta| rgl.distribution(theta)),
            Values::Merl(_) => {
                Estimate::new(&values, |theta| estimate::backscatter(&values, theta))
            }
        };
        let number = tables.len() as u32;
        let table = Box::leak(Box::new(Table { number, values, estimate }));
        tables.push(table);
        Self(table)
    }

    /// The table of this number.
    pub(crate) fn numbered(number: u32) -> Option<Self> {
        let tables = TABLES.read().unwrap_or_else(PoisonError::into_inner);
        tables.get(number as usize).map(|table| Self(table))
    }

    /// Its number in this process, from 0 in the order of reading: what records on the adapter hold.
    /// Another process may number otherwise: it is for no file.
    pub fn number(self) -> u32 {
        self.0.number
    }

    /// All its numbers as `shaders/measured.wesl` reads them: integers, and the bits of f32.
    pub fn words(self) -> Vec<u32> {
        self.0.values.words()
    }

    /// Lobes that share out its albedo.
    pub(crate) fn estimate(self) -> Estimate {
        self.0.estimate
    }

    /// f(v, l) n·l in sr⁻¹ for unit directions above the horizon, in a frame with the normal as z and
    /// v in the x-z plane, x ≥ 0. Measurements are not quite reciprocal: v is the viewer's side.
    pub(crate) fn eval<T: Real>(self, v: [T; 3], l: [T; 3]) -> [T; 3] {
        self.0.values.eval(v, l)
    }
}

/// The same data.
impl PartialEq for Measured {
    fn eq(&self, other: &Self) -> bool {
        self.0.number == other.0.number
    }
}

impl Debug for Measured {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Measured({} numbers)", self.words().len())
    }
}
