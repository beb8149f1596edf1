//! Options of texturing.

use crate::{Error, Result};
use derive_setters::Setters;

/// Options of [`texture_mesh`](crate::mvs::texture_mesh).
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct TextureOptions {
    /// Maximum width and height of the image, pixels, 64 to 16384; larger ones are downscaled.
    /// 8192.
    pub max_size_px: u32,
    /// Cost of a seam along an edge, relative to the worst view of a triangle, 0 to 10: larger
    /// values give fewer and larger pieces. 0.5.
    pub seam_cost: f64,
}

impl Default for TextureOptions {
    fn default() -> Self {
        Self {
            max_size_px: 8192,
            seam_cost: 0.5,
        }
    }
}

impl TextureOptions {
    /// # Errors
    /// [`Error::OutOfRange`] for the first option outside its range.
    pub(super) fn check(&self) -> Result<()> {
        let (size_px, seam_cost) = (self.max_size_px, self.seam_cost);
        Error::check_rules(&[
            (
                "the maximum size of a texture",
                "64 to 16384 pixels",
                f64::from(size_px),
                (64..=16384).contains(&size_px),
            ),
            (
                "the cost of a seam",
                "0 to 10",
                seam_cost,
                (0.0..=10.0).contains(&seam_cost),
            ),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_outside_their_ranges_are_refused() {
        let of = TextureOptions::default;
        assert_eq!(of().check(), Ok(()));
        for options in [
            of().with_max_size_px(63),
            of().with_max_size_px(20_000),
            of().with_seam_cost(-0.1),
            of().with_seam_cost(f64::NAN),
        ] {
            assert!(options.check().is_err(), "{options:?}");
        }
    }
}
