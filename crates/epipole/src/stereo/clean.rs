//! Removal of speckles and interpolation of small gaps.

use super::DisparityImage;
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};

/// Removes the disparities of every connected set of fewer than `min_size` pixels; 4-neighbors are
/// connected if their disparities differ by at most `range_px`. The only stage is
/// [`Stage::DenseMatching`].
///
/// # Errors
/// [`Error::OutOfRange`] unless `range_px` is a number ≥ 0; [`Error::Canceled`] leaves the
/// disparities unchanged.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::{DisparityImage, remove_speckles};
/// let mut disparity = DisparityImage::from_raw(4, 1, vec![5.0, 5.5, 6.0, 20.0])?;
/// remove_speckles(&mut disparity, 2, 1.0, &mut ())?;
/// assert_eq!(disparity.get(2, 0), Some(6.0));
/// assert_eq!(disparity.get(3, 0), None);
/// # Ok(()) }
/// ```
pub fn remove_speckles(
    disparity: &mut DisparityImage,
    min_size: u32,
    range_px: f32,
    monitor: &mut dyn Monitor,
) -> Result<()> {
    if range_px.is_nan() || range_px < 0.0 {
        return Err(Error::OutOfRange {
            what: "the range of a speckle",
            requirement: "at least 0 pixels",
            value: f64::from(range_px),
        });
    }
    if min_size < 2 {
        return Ok(());
    }
    let width = disparity.width() as usize;
    let values = disparity.values_mut();
    // Pixels connected along their row are a run; runs connected across rows are a set.
    let mut run_of_pixel = vec![NO_RUN; values.len()];
    let mut runs = Sets::default();
    for i in 0..values.len() {
        if i % width == 0 {
            let fraction = 0.9 * i as f32 / values.len() as f32;
            report(monitor, Stage::DenseMatching, fraction)?;
        }
        // NaN compares as false, so it connects to nothing.
        if values[i].is_nan() {
            continue;
        }
        let is_first = i % width == 0 || !are_connected(values[i], values[i - 1], range_px);
        let run = if is_first {
            runs.add()
        } else {
            run_of_pixel[i - 1]
        };
        run_of_pixel[i] = run;
        runs.sizes[run as usize] += 1;
        if i >= width && are_connected(values[i], values[i - width], range_px) {
            let above = run_of_pixel[i - width];
            // Most pixels repeat the connection of the previous pixel.
            let repeats = !is_first
                && above == run_of_pixel[i - 1 - width]
                && are_connected(values[i - 1], values[i - 1 - width], range_px);
            if !repeats {
                runs.join(run, above);
            }
        }
    }
    report(monitor, Stage::DenseMatching, 0.9)?;
    let is_small = runs.smaller_than(min_size);
    for (value, &run) in values.iter_mut().zip(&run_of_pixel) {
        if run != NO_RUN && is_small[run as usize] {
            *value = f32::NAN;
        }
    }
    Ok(())
}

/// The run of a pixel without disparity.
const NO_RUN: u32 = u32::MAX;

fn are_connected(a: f32, b: f32, range_px: f32) -> bool {
    (a - b).abs() <= range_px
}

/// Disjoint sets of runs.
#[derive(Default)]
struct Sets {
    parents: Vec<u32>,
    /// Number of pixels of each run.
    sizes: Vec<u32>,
}

impl Sets {
    fn add(&mut self) -> u32 {
        let new = self.parents.len() as u32;
        self.parents.push(new);
        self.sizes.push(0);
        new
    }

    fn root(&mut self, run: u32) -> u32 {
        let mut run = run;
        while self.parents[run as usize] != run {
            let parent = self.parents[run as usize];
            let grandparent = self.parents[parent as usize];
            self.parents[run as usize] = grandparent;
            run = grandparent;
        }
        run
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Returns, for each run, whether its set has fewer pixels.
    fn smaller_than(&mut self, min_size: u32) -> Vec<bool> {
        let roots: Vec<u32> = (0..self.parents.len() as u32)
            .map(|r| self.root(r))
            .collect();
        let mut totals = vec![0; roots.len()];
        for (&root, &size) in roots.iter().zip(&self.sizes) {
            totals[root as usize] += size;
        }
        let is_small = |&root: &u32| totals[root as usize] < min_size;
        roots.iter().map(is_small).collect()
    }
}

/// Closes gaps of at most `max_gap` pixels along rows, then along columns, by linear interpolation
/// between the disparities at both ends, if these differ by at most `range_px`. Otherwise one end
/// occludes the other surface, and the gap remains.
pub(super) fn close_gaps(disparity: &mut DisparityImage, max_gap: usize, range_px: f32) {
    if max_gap == 0 {
        return;
    }
    let (width, height) = (disparity.width() as usize, disparity.height() as usize);
    let values = disparity.values_mut();
    for v in 0..height {
        close_gaps_of_line(values, v * width, 1, width, max_gap, range_px);
    }
    for u in 0..width {
        close_gaps_of_line(values, u, width, height, max_gap, range_px);
    }
}

/// Closes the gaps of `len` pixels at intervals of `step`.
fn close_gaps_of_line(
    values: &mut [f32],
    first: usize,
    step: usize,
    len: usize,
    max_gap: usize,
    range_px: f32,
) {
    let mut before: Option<usize> = None;
    for k in 0..len {
        let end = values[first + k * step];
        if end.is_nan() {
            continue;
        }
        if let Some(j) = before {
            let begin = values[first + j * step];
            if k - j > 1 && k - j - 1 <= max_gap && (end - begin).abs() <= range_px {
                for i in j + 1..k {
                    let fraction = (i - j) as f32 / (k - j) as f32;
                    values[first + i * step] = begin + (end - begin) * fraction;
                }
            }
        }
        before = Some(k);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    const NAN: f32 = f32::NAN;

    /// Reference implementation that grows each set pixel by pixel.
    fn grown(disparity: &DisparityImage, min_size: usize, range_px: f32) -> DisparityImage {
        let (width, height) = (disparity.width() as usize, disparity.height() as usize);
        let values = disparity.as_raw();
        let mut out = values.to_vec();
        let mut visited = vec![false; values.len()];
        for start in 0..values.len() {
            let mut set = vec![start];
            let mut next = 0;
            if visited[start] || values[start].is_nan() {
                continue;
            }
            visited[start] = true;
            while next < set.len() {
                let i = set[next];
                next += 1;
                let (u, v) = (i % width, i / width);
                for (inside, j) in [
                    (u > 0, i.wrapping_sub(1)),
                    (u + 1 < width, i + 1),
                    (v > 0, i.wrapping_sub(width)),
                    (v + 1 < height, i + width),
                ] {
                    if inside && !visited[j] && are_connected(values[i], values[j], range_px) {
                        visited[j] = true;
                        set.push(j);
                    }
                }
            }
            if set.len() < min_size {
                set.iter().for_each(|&i| out[i] = NAN);
            }
        }
        DisparityImage::new(disparity.width(), disparity.height(), out)
    }

    #[test]
    fn sets_of_runs_are_the_sets_that_grow_pixel_by_pixel() {
        let mut random = Random::new(2);
        for (width, height) in [(1, 40), (40, 1), (23, 17), (64, 48)] {
            for levels in [2, 4, 9] {
                let values = (0..width * height)
                    .map(|_| match random.below(levels + 1) {
                        0 => NAN,
                        level => level as f32 * 1.5,
                    })
                    .collect();
                let disparity = DisparityImage::from_raw(width, height, values).unwrap();
                for (min_size, range_px) in [(2, 0.0), (5, 0.0), (5, 1.5), (200, 1.5)] {
                    let mut found = disparity.clone();
                    remove_speckles(&mut found, min_size, range_px, &mut ()).unwrap();
                    assert_eq!(found, grown(&disparity, min_size as usize, range_px));
                }
            }
        }
    }

    #[test]
    fn only_short_gaps_between_equals_are_closed() {
        let row = vec![1.0, NAN, NAN, 2.5, NAN, 9.0, NAN, NAN, NAN, 9.0, NAN];
        let mut disparity = DisparityImage::from_raw(11, 1, row.clone()).unwrap();
        close_gaps(&mut disparity, 2, 2.0);
        assert_eq!(disparity.as_raw()[..4], [1.0, 1.5, 2.0, 2.5]);
        assert!(
            [4, 6, 7, 8, 10]
                .iter()
                .all(|&u| disparity.get(u, 0).is_none())
        );
        // Also along a column.
        let mut disparity = DisparityImage::from_raw(1, 11, row).unwrap();
        close_gaps(&mut disparity, 3, 2.0);
        assert_eq!(disparity.get(0, 7), Some(9.0));
        assert_eq!(disparity.get(0, 4), None);
        assert_eq!(disparity.get(0, 10), None);
    }
}
