//! Sample values that become black and white.

use crate::Result;
use epipole::Error;

/// Fraction of the samples that may be outside each end of a robust range.
const BEYOND: f64 = 0.001;
/// Maximum ratio of the full to the robust range at which the full range is used.
const MAX_STRETCH: f64 = 2.0;

/// Sample values of a file that become black and white.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub enum PixelRange {
    /// 0 to 255 in 8 bits; otherwise the values in use, because few sensors use the full range of a
    /// file. Values beyond the percentiles 0.1 and 99.9 are cut off if they would more than double
    /// the range, as hot pixels do.
    #[default]
    Auto,
    /// Full range of a file's integers; 0 to 1 for floats.
    Full,
    /// From the first value to the second, in the file's own numbers, 8 bits included.
    Between(f64, f64),
}

impl PixelRange {
    /// # Errors
    /// [`Invalid`](crate::Error::Invalid) for an empty range.
    pub(super) fn check(self) -> Result<()> {
        match self {
            Self::Between(low, high) if !low.is_finite() || !high.is_finite() => {
                Err(Error::NotFinite {
                    what: "the range of pixels",
                }
                .into())
            }
            Self::Between(low, high) if low >= high => Err(Error::OutOfRange {
                what: "the upper end of the range of pixels",
                requirement: "greater than the lower end",
                value: high,
            }
            .into()),
            _ => Ok(()),
        }
    }
}

/// Selects the full or the robust range.
fn select_range([least, most]: [f64; 2], [low, high]: [f64; 2]) -> [f64; 2] {
    match most - least > MAX_STRETCH * (high - low) && high > low {
        true => [low, high],
        false => [least, most],
    }
}

/// Returns the number of samples beyond each percentile.
fn beyond(count: u64) -> u64 {
    (count as f64 * BEYOND) as u64
}

/// Returns the range in use; `None` if all values are equal.
pub(super) fn of_words(samples: impl Iterator<Item = u16>) -> Option<[f64; 2]> {
    let mut histogram = vec![0_u64; 1 << 16];
    samples.for_each(|sample| histogram[usize::from(sample)] += 1);
    let each = beyond(histogram.iter().sum());
    // First value with a cumulative number of samples above `count`.
    fn first_above(counts: impl Iterator<Item = (usize, u64)>, count: u64) -> Option<f64> {
        let mut sum = 0;
        let reaches = |(value, here): (usize, u64)| {
            sum += here;
            (sum > count).then_some(value as f64)
        };
        { counts }.find_map(reaches)
    }
    let up = |count| first_above(histogram.iter().copied().enumerate(), count);
    let down = |count| first_above(histogram.iter().copied().enumerate().rev(), count);
    let [low, high] = select_range([up(0)?, down(0)?], [up(each)?, down(each)?]);
    (low < high).then_some([low, high])
}

/// Returns the range in use of the finite floats.
pub(super) fn of_floats(samples: impl Iterator<Item = f32>) -> Option<[f64; 2]> {
    let mut finite: Vec<f32> = samples.filter(|sample| sample.is_finite()).collect();
    let last = finite.len().checked_sub(1)?;
    let each = beyond(finite.len() as u64) as usize;
    let mut at = |index: usize| f64::from(*finite.select_nth_unstable_by(index, f32::total_cmp).1);
    let [low, high] = select_range([at(0), at(last)], [at(each), at(last - each)]);
    (low < high).then_some([low, high])
}

/// Maps a range to 0 to 1, and NaN to 0.
pub(super) fn to_unit(value: f64, [low, high]: [f64; 2]) -> f64 {
    let fraction = (value - low) / (high - low);
    if fraction > 0.0 {
        fraction.min(1.0)
    } else {
        0.0
    }
}

/// Maps a range to 8 bits.
pub(super) fn to_byte(value: f64, range: [f64; 2]) -> u8 {
    (255.0 * to_unit(value, range) + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_in_use_is_taken_whole_but_for_far_outliers() {
        let ramp = || (0..10_000).map(|k| 5000 + k / 100);
        assert_eq!(of_words(ramp()), Some([5000.0, 5099.0]));
        assert_eq!(of_floats(ramp().map(f32::from)), Some([5000.0, 5099.0]));
        // A moderately bright spot counts; hot and dead pixels do not.
        let bright = ramp().chain([5120]);
        assert_eq!(of_words(bright), Some([5000.0, 5120.0]));
        let hot = || ramp().chain([65535; 5]).chain([0; 5]);
        assert_eq!(of_words(hot()), Some([5000.0, 5099.0]));
        let floats = hot().map(f32::from).chain([f32::NAN, f32::INFINITY]);
        assert_eq!(of_floats(floats), Some([5000.0, 5099.0]));
    }

    #[test]
    fn one_value_is_no_range() {
        assert_eq!(of_words([7; 100].into_iter()), None);
        assert_eq!(of_floats([7.0; 100].into_iter()), None);
        assert_eq!(of_floats([f32::NAN; 100].into_iter()), None);
        // Two values, one of them rare: the range must keep both.
        let mask = [0; 5000].into_iter().chain([9]);
        assert_eq!(of_words(mask), Some([0.0, 9.0]));
    }

    #[test]
    fn values_are_mapped_linearly_and_cut_off() {
        let range = [100.0, 300.0];
        let unit = |value| to_unit(value, range);
        assert_eq!([unit(150.0), unit(99.0), unit(1e9)], [0.25, 0.0, 1.0]);
        assert_eq!(unit(f64::NAN), 0.0);
        assert_eq!(to_byte(300.0, range), 255);
        // Words in their full range: v / 257, rounded.
        for v in [0_u16, 128, 129, 385, 386, 40_000, 65_406, 65_407, 65_535] {
            let nearest = ((u32::from(v) + 128) / 257) as u8;
            assert_eq!(to_byte(f64::from(v), [0.0, 65_535.0]), nearest, "{v}");
        }
    }

    #[test]
    fn an_empty_range_is_refused() {
        for (low, high) in [
            (5.0, 5.0),
            (5.0, 4.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            assert!(PixelRange::Between(low, high).check().is_err());
        }
        assert!(PixelRange::Between(-1.0, 4.5).check().is_ok());
    }
}
