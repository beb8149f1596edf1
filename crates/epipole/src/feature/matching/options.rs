//! Options of matching.

use crate::{Error, Result};
use derive_setters::Setters;

/// Options of matching.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct MatchOptions {
    /// Maximum ratio of the distances of the nearest and second nearest, in (0, 1]; `None` disables
    /// the test. Lowe 2004, §7.1.
    pub max_ratio: Option<f32>,
    /// Require mutual nearest neighbors.
    pub mutual: bool,
    /// Maximum distance, ≥ 0; `None` for any.
    pub max_distance: Option<f32>,
    /// Keep only the closest match of each feature of the second image. Mutual matches are unique
    /// anyway.
    pub unique: bool,
}

impl Default for MatchOptions {
    /// Returns ratio 0.8, mutual, any distance.
    fn default() -> Self {
        Self {
            max_ratio: Some(0.8),
            mutual: true,
            max_distance: None,
            unique: true,
        }
    }
}

/// Rejects options outside their range.
pub(super) fn check(options: &MatchOptions) -> Result<()> {
    if let Some(ratio) = options.max_ratio.filter(|&r| !(r > 0.0 && r <= 1.0)) {
        return Err(Error::OutOfRange {
            what: "the largest ratio of distances",
            requirement: "greater than 0 and at most 1",
            value: f64::from(ratio),
        });
    }
    if let Some(distance) = options.max_distance.filter(|&d| d.is_nan() || d < 0.0) {
        return Err(Error::OutOfRange {
            what: "the largest distance of a match",
            requirement: "0 or more",
            value: f64::from(distance),
        });
    }
    Ok(())
}
