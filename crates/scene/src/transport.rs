//! Which light paths count.

use std::fmt;
use std::str::FromStr;

/// Whether the last segment of an `indirect-1` path (between the shaded point and the point that the
/// primary light hits) is tested for occlusion. Primary visibility always is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Visibility {
    /// As in nature.
    Traced,
    /// Every lit point contributes: the limit of virtual lights without visibility.
    Ignored,
}

/// The light paths of a picture. Emission seen directly by the camera belongs to `Direct` and `All`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Transport {
    /// Emission and one reflection.
    Direct,
    /// At least one and at most this many indirect bounces: two to K + 1 reflections.
    Indirect {
        /// K ≥ 1.
        bounces: u32,
        /// [`Visibility::Ignored`] for K = 1 only.
        visibility: Visibility,
    },
    /// Everything.
    All,
}

impl FromStr for Transport {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unknown =
            || format!("unknown transport `{text}`: use direct, indirect-1 (or another K), all");
        match text {
            "direct" => Ok(Self::Direct),
            "all" => Ok(Self::All),
            _ => {
                let bounces = text.strip_prefix("indirect-").ok_or_else(unknown)?;
                match bounces.parse() {
                    Ok(bounces @ 1..=64) => {
                        Ok(Self::Indirect { bounces, visibility: Visibility::Traced })
                    }
                    _ => Err(format!("transport `{text}`: K must be a whole number from 1 to 64")),
                }
            }
        }
    }
}

impl fmt::Display for Transport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Direct => f.write_str("direct"),
            Self::All => f.write_str("all"),
            Self::Indirect { bounces, .. } => write!(f, "indirect-{bounces}"),
        }
    }
}

impl FromStr for Visibility {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "traced" => Ok(Self::Traced),
            "ignored" => Ok(Self::Ignored),
            _ => Err(format!("unknown visibility `{text}`: use traced or ignored")),
        }
    }
}

impl fmt::Display for Visibility {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Traced => "traced",
            Self::Ignored => "ignored",
        })
    }
}
