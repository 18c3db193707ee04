//! Which light paths count.

use std::fmt;
use std::str::FromStr;

/// Whether the last segment of a path is tested for occlusion: of `direct` that between the shaded point
/// and the light, of `indirect-1` that between the shaded point and the point that the light hits. All
/// other segments always are tested, the camera's among them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Visibility {
    /// As in nature.
    Traced,
    /// Everything lets light through: the limit of virtual lights and of lights of a shape without
    /// shadows. What may reflect is bounded by the shading normal of the shaded point alone, and
    /// what may shine by the side on which it is lit or emits: backs of lights stay dark, and neither
    /// other surfaces nor other parts of the light itself, nor the plane of the shaded triangle, hide
    /// anything.
    Ignored,
}

/// The light paths of a picture.
///
/// Emission that the camera sees directly belongs to [`All`](Self::All) alone, for methods on the
/// adapter never see it: `direct` + `indirect-1` + seen emission is a picture of one bounce.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Transport {
    /// One reflection of what lights send.
    Direct {
        /// Between the shaded point and the light.
        visibility: Visibility,
    },
    /// At least one and at most this many indirect bounces: two to K + 1 reflections.
    Indirect {
        /// K ≥ 1.
        bounces: u32,
        /// [`Visibility::Ignored`] for K = 1 only.
        visibility: Visibility,
    },
    /// What the pictures of the papers hold: the direct light of point-like lights, which is exact and
    /// always casts shadows, and one indirect bounce.
    DirectAndIndirect {
        /// Of the indirect part.
        visibility: Visibility,
    },
    /// Everything, and the emission that the camera sees.
    All,
}

impl Transport {
    /// The visibility of the last segment, where it is a choice.
    pub fn visibility(self) -> Option<Visibility> {
        match self {
            Self::Direct { visibility }
            | Self::Indirect { bounces: 1, visibility }
            | Self::DirectAndIndirect { visibility } => Some(visibility),
            Self::Indirect { .. } | Self::All => None,
        }
    }

    /// The same light paths with another visibility of the last segment, where it is a choice.
    #[must_use]
    pub fn with_visibility(self, visibility: Visibility) -> Self {
        match self {
            Self::Direct { .. } => Self::Direct { visibility },
            Self::Indirect { bounces: 1, .. } => Self::Indirect { bounces: 1, visibility },
            Self::DirectAndIndirect { .. } => Self::DirectAndIndirect { visibility },
            Self::Indirect { .. } | Self::All => self,
        }
    }

    /// What is left to estimate once the direct light of `direct+indirect-1`, which is exact and the
    /// same for all methods, is set apart; all other transports as they are.
    #[must_use]
    pub fn estimated(self) -> Self {
        match self {
            Self::DirectAndIndirect { visibility } => Self::Indirect { bounces: 1, visibility },
            other => other,
        }
    }
}

impl FromStr for Transport {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unknown = || {
            format!(
                "unknown transport `{text}`: use direct, indirect-1 (or another K), \
                 direct+indirect-1, all"
            )
        };
        let visibility = Visibility::Traced;
        match text {
            "direct" => Ok(Self::Direct { visibility }),
            "direct+indirect-1" => Ok(Self::DirectAndIndirect { visibility }),
            "all" => Ok(Self::All),
            _ => {
                let bounces = text.strip_prefix("indirect-").ok_or_else(unknown)?;
                match bounces.parse() {
                    Ok(bounces @ 1..=64) => Ok(Self::Indirect { bounces, visibility }),
                    _ => Err(format!("transport `{text}`: K must be a whole number from 1 to 64")),
                }
            }
        }
    }
}

impl fmt::Display for Transport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Direct { .. } => f.write_str("direct"),
            Self::Indirect { bounces, .. } => write!(f, "indirect-{bounces}"),
            Self::DirectAndIndirect { .. } => f.write_str("direct+indirect-1"),
            Self::All => f.write_str("all"),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in ["direct", "indirect-1", "indirect-64", "direct+indirect-1", "all"] {
            let transport: Transport = name.parse().expect("a transport");
            assert_eq!(transport.to_string(), name);
            assert_ne!(transport.visibility(), Some(Visibility::Ignored), "as in nature at first");
        }
        for name in ["", "indirect", "indirect-0", "indirect-65", "direct+indirect-2", "direct+all"]
        {
            let reason = name.parse::<Transport>().expect_err(name);
            assert!(reason.contains(&format!("`{name}`")), "{reason}");
        }
    }

    #[test]
    fn visibility_is_a_choice_of_the_last_segment_alone() {
        for (name, choice) in [
            ("direct", true),
            ("indirect-1", true),
            ("direct+indirect-1", true),
            ("indirect-2", false),
            ("all", false),
        ] {
            let transport: Transport = name.parse().expect("a transport");
            let ignored = transport.with_visibility(Visibility::Ignored);
            assert_eq!(ignored.visibility(), choice.then_some(Visibility::Ignored), "{name}");
            assert_eq!(ignored.to_string(), name);
            assert_eq!(ignored.estimated().visibility(), ignored.visibility());
        }
        let both: Transport = "direct+indirect-1".parse().expect("a transport");
        assert_eq!(both.estimated().to_string(), "indirect-1");
    }
}
