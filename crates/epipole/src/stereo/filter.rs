//! Which answers of a dense matcher are kept.

use super::DisparityImage;
use super::clean::{close_gaps, remove_speckles};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;

/// Share of a dense matcher's time until its answers are filtered.
pub(super) const SEARCH_SHARE: f32 = 0.9;

/// Tests that an answer of a dense matcher must pass.
///
/// ```
/// use epipole::stereo::{DisparityFilter, StereoSgm};
/// let filter = DisparityFilter::default().with_speckle_size(0);
/// let matcher = StereoSgm::default().with_filter(filter);
/// assert_eq!(matcher.filter.left_right_max_px, Some(1));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct DisparityFilter {
    /// Percent by which the costs of all disparities two or more away from the best must be
    /// higher, 0 to 99; 0: no such test.
    pub uniqueness_percent: u32,
    /// The largest difference between the disparities seen from the left and from the right,
    /// pixels; none: no such test.
    pub left_right_max_px: Option<u32>,
    /// Answers that hang together in fewer pixels than this are removed; 0 or 1: none.
    pub speckle_size: u32,
    /// Neighbors whose disparities differ by no more than this hang together, pixels.
    pub speckle_range_px: f32,
    /// The longest gap along a row or a column, pixels, that is closed by interpolation where
    /// the answers at its two ends hang together; 0: none.
    pub max_gap_px: u32,
}

impl Default for DisparityFilter {
    /// The filter of [`StereoSgm`](super::StereoSgm).
    fn default() -> Self {
        Self {
            uniqueness_percent: 3,
            left_right_max_px: Some(1),
            speckle_size: 100,
            speckle_range_px: 2.0,
            max_gap_px: 16,
        }
    }
}

impl DisparityFilter {
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range.
    pub(super) fn check(&self) -> Result<()> {
        match self.uniqueness_percent {
            0..100 => Ok(()),
            percent => Err(Error::OutOfRange {
                what: "the uniqueness",
                requirement: "from 0 to 99 percent",
                value: f64::from(percent),
            }),
        }
    }

    /// Removes speckles and closes gaps.
    ///
    /// # Errors
    /// As [`remove_speckles`].
    pub(super) fn clean(
        &self,
        mut disparity: DisparityImage,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage> {
        let (size, range_px) = (self.speckle_size, self.speckle_range_px);
        let part = &mut Part::new(monitor, 0.0, 0.7);
        remove_speckles(&mut disparity, size, range_px, part)?;
        report(monitor, Stage::DenseMatching, 0.7)?;
        close_gaps(
            &mut disparity,
            self.max_gap_px as usize,
            self.speckle_range_px,
        );
        Ok(disparity)
    }
}
