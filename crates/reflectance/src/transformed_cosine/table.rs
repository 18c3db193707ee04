//! Transformed cosines over roughness and view.

use std::sync::LazyLock;

use rayon::prelude::*;

use super::fit::{EXPONENT, NODES, Target};
use super::{TransformedCosine, TransformedLobe};

/// Roughnesses of the table, equally spaced from the smallest.
pub(super) const ROUGHNESSES: usize = 64;
/// Views of the table, equally spaced in √(1 − n·v).
pub const VIEWS: usize = 64;
/// [`manylights_scene::material::MIN_ROUGHNESS`].
const SMALLEST: f64 = 0.03;
/// Cosine of the last view: at the horizon itself the lobe does not fall to zero there.
const GRAZING: f64 = 1e-3;
/// Of the fit: raised whenever it gives another table.
const VERSION: u32 = 1;
/// What a table was fitted from, its first line.
pub static FINGERPRINT: LazyLock<String> = LazyLock::new(|| {
    format!(
        "transformed cosines of GGX: fit {VERSION}, {ROUGHNESSES} roughnesses from {SMALLEST}, {VIEWS} views to \
         cosine {GRAZING}, nodes {NODES:?}, exponent {EXPONENT}\n"
    )
});
/// Numbers a node: M⁻¹'s x-row, its z-row over α, magnitudes.
const NUMBERS: usize = 6;

static SHARED: LazyLock<Table> = LazyLock::new(|| {
    Table::from_bytes(include_bytes!("table.bin")).expect("the table that this fit makes")
});

/// The roughness of a row.
pub fn roughness(row: usize) -> f64 {
    SMALLEST + (1.0 - SMALLEST) * row as f64 / (ROUGHNESSES - 1) as f64
}

/// The cosine between normal and view of a column.
pub fn view_cosine(column: usize) -> f64 {
    let root = column as f64 / (VIEWS - 1) as f64;
    ((1.0 - root) * (1.0 + root)).max(GRAZING)
}

/// The place of a view between the columns.
pub fn view_place(cosine: f64) -> f64 {
    (1.0 - cosine).clamp(0.0, 1.0).sqrt() * (VIEWS - 1) as f64
}

/// All nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Row by row.
    values: Vec<[f32; NUMBERS]>,
}

impl Table {
    /// That of the repository.
    pub fn shared() -> &'static Self {
        &SHARED
    }

    /// All rows anew, from the middle of the hemisphere to its edge.
    pub fn fit() -> Self {
        let rows = (0..ROUGHNESSES).into_par_iter().flat_map_iter(Self::fit_row);
        Self { values: rows.collect() }
    }

    /// One row.
    pub fn fit_row(row: usize) -> Vec<[f32; NUMBERS]> {
        let alpha = roughness(row).powi(2);
        let mut near = None;
        let node = |column: usize| {
            let target = Target::new(alpha as f32, view_cosine(column), NODES);
            let lobe = target.nearest(near);
            near = Some(lobe.cosine);
            let TransformedCosine { across: [xx, xz], along: [zx, zz] } = lobe.cosine;
            let [a, b] = lobe.magnitudes;
            [xx, xz, zx / alpha, zz / alpha, a, b].map(|value| value as f32)
        };
        (0..VIEWS).map(node).collect()
    }

    /// One row of this table.
    pub fn row(&self, row: usize) -> &[[f32; NUMBERS]] {
        &self.values[row * VIEWS..][..VIEWS]
    }

    /// The file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let numbers = self.values.as_flattened().iter().flat_map(|value| value.to_le_bytes());
        FINGERPRINT.bytes().chain(numbers).collect()
    }

    /// Of a file; `None` unless it is what this fit makes.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let numbers = bytes.strip_prefix(FINGERPRINT.as_bytes())?;
        let (numbers, rest) = numbers.as_chunks::<4>();
        let numbers: Vec<_> = numbers.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        let (nodes, others) = numbers.as_chunks::<NUMBERS>();
        let whole = nodes.len() == ROUGHNESSES * VIEWS && others.is_empty() && rest.is_empty();
        whole.then(|| Self { values: nodes.to_vec() })
    }

    /// The lobes of a GGX width at all views, linear between roughnesses; beyond the smallest and largest one
    /// those of it, but for their width.
    pub fn lobes(&self, alpha: f64) -> Vec<TransformedLobe> {
        let place = (alpha.sqrt() - SMALLEST) / (1.0 - SMALLEST) * (ROUGHNESSES - 1) as f64;
        let place = place.clamp(0.0, (ROUGHNESSES - 1) as f64);
        let lower = (place as usize).min(ROUGHNESSES - 2);
        let fraction = place - lower as f64;
        let mix = |(low, high): (&[f32; NUMBERS], &[f32; NUMBERS])| {
            let [xx, xz, zx, zz, a, b] = std::array::from_fn(|i| {
                let [low, high] = [low[i], high[i]].map(f64::from);
                low + fraction * (high - low)
            });
            let cosine = TransformedCosine { across: [xx, xz], along: [zx * alpha, zz * alpha] };
            TransformedLobe { cosine, magnitudes: [a, b] }
        };
        self.row(lower).iter().zip(self.row(lower + 1)).map(mix).collect()
    }
}

/// The lobe for a view, linear between those of [`Table::lobes`].
pub fn at(lobes: &[TransformedLobe], cosine: f64) -> TransformedLobe {
    let place = view_place(cosine);
    let lower = (place as usize).min(VIEWS - 2);
    let fraction = place - lower as f64;
    let [low, high] = [lobes[lower], lobes[lower + 1]];
    let mix =
        |low: [f64; 2], high: [f64; 2]| [0, 1].map(|i| low[i] + fraction * (high[i] - low[i]));
    let cosine = TransformedCosine {
        across: mix(low.cosine.across, high.cosine.across),
        along: mix(low.cosine.along, high.cosine.along),
    };
    TransformedLobe { cosine, magnitudes: mix(low.magnitudes, high.magnitudes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows where lobes are narrow, in the middle, and widest: as the command made them.
    #[test]
    fn the_table_is_what_the_fit_makes() {
        for row in [0, 21, ROUGHNESSES - 1] {
            for (made, kept) in Table::fit_row(row).iter().zip(Table::shared().row(row)) {
                for (made, kept) in made.iter().zip(kept) {
                    // What libraries round differently moves the end of a search.
                    let error = (made - kept).abs() / kept.abs().max(1.0);
                    assert!(error < 1e-3, "{row}: {made} for {kept}");
                }
            }
        }
    }

    #[test]
    fn another_fit_or_size_is_refused() {
        let bytes = Table::shared().to_bytes();
        assert_eq!(Table::from_bytes(&bytes).as_ref(), Some(Table::shared()));
        let text = String::from_utf8_lossy(&bytes[..FINGERPRINT.len()]).replace("fit 1", "fit 0");
        let older = [text.as_bytes(), &bytes[FINGERPRINT.len()..]].concat();
        assert!(Table::from_bytes(&older).is_none());
        for wrong in [&bytes[..bytes.len() - 4], &bytes[..bytes.len() - 1], &[]] {
            assert!(Table::from_bytes(wrong).is_none());
        }
        assert!(Table::from_bytes(&[&bytes[..], &[0; 24]].concat()).is_none());
    }
}
