//! Filter of the disparities of a dense matcher.

use super::DisparityImage;
use super::clean::{close_gaps, remove_speckles};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;

/// Progress of a dense matcher when the filter starts.
pub(super) const SEARCH_FRACTION: f32 = 0.9;

/// Tests of the disparities of a dense matcher.
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
    /// Minimum percentage by which the costs of all disparities two or more away must exceed the
    /// best, 0 to 99; 0 disables this test.
    pub uniqueness_percent: u32,
    /// Maximum difference between the disparities from the left and from the right, pixels; `None`
    /// disables this test.
    pub left_right_max_px: Option<u32>,
    /// Minimum number of connected pixels: smaller sets are removed; 0 or 1 disables this test.
    pub speckle_size: u32,
    /// Maximum difference of disparities between connected neighbors, pixels.
    pub speckle_range_px: f32,
    /// Maximum length of a gap along a row or column, pixels, to close by interpolation if the
    /// disparities at its ends are connected; 0 disables this.
    pub max_gap_px: u32,
}

impl Default for DisparityFilter {
    /// Returns the filter of [`StereoSgm`](super::StereoSgm).
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
