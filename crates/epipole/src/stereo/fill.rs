//! Filling of gaps with the background disparity beside them.

use super::DisparityImage;
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use image::GrayImage;

/// Half the side of the window that refines a filled pixel.
const RADIUS: usize = 7;
/// Difference of gray values at which a neighbor's weight falls to 1/e.
const GRAY_SCALE: f64 = 8.0;

/// Fills all gaps with the disparity of the background beside them, along edges of the left image.
///
/// A pixel that one camera does not see lies behind the occluding object, so a gap first takes the
/// smaller of the nearest disparities to its left and right in the row (empty rows take those of
/// the nearest row). Then each filled pixel takes the median of the disparities in a 15×15 window,
/// weighted by the similarity of the left image's gray values (`exp(−|ΔI| / 8)`). Given disparities
/// do not change. Without any disparity nothing is filled. The only stage is
/// [`Stage::DenseMatching`].
///
/// * `left`: image of the disparities
///
/// # Errors
/// [`Error::SizeMismatch`] if the sizes differ, [`Error::Canceled`].
///
/// Sources: Hirschmüller 2008, §2.6 (background interpolation); Ma, He, Wei, Sun & Wu 2013,
/// "Constant time weighted median filtering for stereo matching and beyond".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityImage, fill_gaps};
/// use image::GrayImage;
/// let row = vec![2.0, 2.0, f32::NAN, 9.0, 9.0];
/// let disparity = DisparityImage::from_raw(5, 1, row)?;
/// let filled = fill_gaps(&disparity, &GrayImage::new(5, 1), &mut ())?;
/// assert_eq!(filled.get(2, 0), Some(2.0));
/// # Ok(()) }
/// ```
pub fn fill_gaps(
    disparity: &DisparityImage,
    left: &GrayImage,
    monitor: &mut dyn Monitor,
) -> Result<DisparityImage> {
    for (what, first, second) in [
        (
            "the rows of the disparities and the picture",
            disparity.width(),
            left.width(),
        ),
        (
            "the columns of the disparities and the picture",
            disparity.height(),
            left.height(),
        ),
    ] {
        if first != second {
            return Err(Error::SizeMismatch {
                what,
                first: first as usize,
                second: second as usize,
            });
        }
    }
    let width = disparity.width() as usize;
    let gaps: Vec<usize> = (0..disparity.as_raw().len())
        .filter(|&i| disparity.as_raw()[i].is_nan())
        .collect();
    let mut filled = disparity.clone();
    if width == 0 || gaps.len() == disparity.as_raw().len() {
        return Ok(filled);
    }
    for row in filled.values_mut().chunks_exact_mut(width) {
        take_background(row);
    }
    copy_to_empty_rows(filled.values_mut(), width);
    let votes: [u32; 256] = std::array::from_fn(|difference| {
        1 + (65535.0 * libm::exp(-(difference as f64) / GRAY_SCALE)) as u32
    });
    let refined = monitored::map(&gaps, Stage::DenseMatching, monitor, |&i| {
        weighted_median(&filled, left, &votes, i % width, i / width)
    })?;
    for (&i, value) in gaps.iter().zip(refined) {
        filled.values_mut()[i] = value;
    }
    Ok(filled)
}

/// Fills the gaps of a row with the smaller of the disparities at their ends.
fn take_background(row: &mut [f32]) {
    let mut begin = 0;
    while begin < row.len() {
        if !row[begin].is_nan() {
            begin += 1;
            continue;
        }
        let end = (begin..row.len())
            .find(|&u| !row[u].is_nan())
            .unwrap_or(row.len());
        let before = begin.checked_sub(1).map_or(f32::NAN, |u| row[u]);
        let after = row.get(end).copied().unwrap_or(f32::NAN);
        // The smaller of two numbers, or the only number.
        row[begin..end].fill(before.min(after));
        begin = end;
    }
}

/// Fills empty rows from the nearest nonempty row above, or else below.
fn copy_to_empty_rows(values: &mut [f32], width: usize) {
    let height = values.len() / width;
    let is_empty = |values: &[f32], v: usize| values[v * width].is_nan();
    for v in 1..height {
        if is_empty(values, v) {
            values.copy_within((v - 1) * width..v * width, v * width);
        }
    }
    for v in (0..height.saturating_sub(1)).rev() {
        if is_empty(values, v) {
            values.copy_within((v + 1) * width..(v + 2) * width, v * width);
        }
    }
}

/// Returns the median of the disparities around (u, v), weighted by similarity to the center.
fn weighted_median(
    disparity: &DisparityImage,
    left: &GrayImage,
    votes: &[u32; 256],
    u: usize,
    v: usize,
) -> f32 {
    let (width, height) = (disparity.width() as usize, disparity.height() as usize);
    let (values, grays) = (disparity.as_raw(), left.as_raw());
    let center = grays[v * width + u];
    let mut candidates = [(0.0f32, 0u32); (2 * RADIUS + 1) * (2 * RADIUS + 1)];
    let mut count = 0;
    let mut total = 0u64;
    let columns = u.saturating_sub(RADIUS)..(u + RADIUS + 1).min(width);
    for row in v.saturating_sub(RADIUS)..(v + RADIUS + 1).min(height) {
        let begin = row * width;
        for i in begin + columns.start..begin + columns.end {
            let vote = votes[usize::from(grays[i].abs_diff(center))];
            candidates[count] = (values[i], vote);
            count += 1;
            total += u64::from(vote);
        }
    }
    let candidates = &mut candidates[..count];
    candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut counted = 0u64;
    for &(value, vote) in candidates.iter() {
        counted += u64::from(vote);
        if 2 * counted >= total {
            return value;
        }
    }
    values[v * width + u]
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    const NAN: f32 = f32::NAN;

    #[test]
    fn a_gap_takes_the_background() {
        let mut row = [NAN, 7.0, NAN, NAN, 3.0, NAN];
        take_background(&mut row);
        assert_eq!(row, [7.0, 7.0, 3.0, 3.0, 3.0, 3.0]);
    }

    #[test]
    fn empty_rows_and_empty_pictures() {
        let values = vec![NAN, NAN, 4.0, NAN, NAN, NAN];
        let disparity = DisparityImage::from_raw(2, 3, values).unwrap();
        let filled = fill_gaps(&disparity, &GrayImage::new(2, 3), &mut ()).unwrap();
        assert_eq!(filled.as_raw(), &[4.0; 6]);
        let nothing = DisparityImage::from_raw(2, 3, vec![NAN; 6]).unwrap();
        let still = fill_gaps(&nothing, &GrayImage::new(2, 3), &mut ()).unwrap();
        assert_eq!(still.density(), 0.0);
        let none = DisparityImage::from_raw(0, 0, vec![]).unwrap();
        assert!(fill_gaps(&none, &GrayImage::new(0, 0), &mut ()).is_ok());
        assert!(fill_gaps(&none, &GrayImage::new(1, 0), &mut ()).is_err());
        assert!(fill_gaps(&nothing, &GrayImage::new(2, 4), &mut ()).is_err());
    }

    /// The surfaces meet at the edge in the image, not in the middle of the gap, and given
    /// disparities do not change.
    #[test]
    fn filling_follows_the_edges_of_the_picture() {
        let (width, height, edge) = (40, 30, 20);
        let left = GrayImage::from_fn(width, height, |u, _| {
            Luma([if u < edge { 40 } else { 200 }])
        });
        let truth = |u: u32| if u < edge { 10.0 } else { 4.0 };
        let values = (0..width * height)
            .map(|i| match i % width {
                // Alternate rows lack different parts, so only the weighted median finds the edge.
                u if (15..25).contains(&u) && !(i / width).is_multiple_of(3) => NAN,
                u => truth(u),
            })
            .collect();
        let disparity = DisparityImage::from_raw(width, height, values).unwrap();
        let filled = fill_gaps(&disparity, &left, &mut ()).unwrap();
        for v in 0..height {
            for u in 0..width {
                assert_eq!(filled.get(u, v), Some(truth(u)), "at {u}, {v}");
            }
        }
    }
}
