//! Images that are slanted after rectification, because of a diagonal baseline.

use super::outline::Outline;
use super::rect::PixelRect;
use nalgebra::Vector2;

/// Number of lines across the images to try as bounds of the visible part.
const NUM_LEVELS: usize = 97;

/// Returns the rectangles inside both images that need the least magnification to fill the results.
/// `None` if there are none.
///
/// The rectangle between the innermost points of the four sides, [`Outline::inner`], vanishes when
/// an image of 4 : 3 is rotated by 37°. One that may cut off parts of the sides keeps some 40 % of
/// the size.
///
/// * `is_shared`: whether both have the same range along x, and along y; at least one is true
/// * `new_size`: size of the results, pixels
pub(super) fn inscribed(
    outlines: &[Outline; 2],
    is_shared: [bool; 2],
    new_size: &Vector2<f64>,
) -> Option<[PixelRect; 2]> {
    // Levels are shared, and each crosses the images.
    let along = usize::from(is_shared[1]);
    let across = 1 - along;
    let ends = outlines
        .each_ref()
        .map(|outline| outline.outer.range(along));
    let low = ends[0][0].max(ends[1][0]);
    let high = ends[0][1].min(ends[1][1]);
    let level = |k: usize| low + (high - low) * k as f64 / (NUM_LEVELS - 1) as f64;
    let crossed: Vec<[[f64; 2]; 2]> = (0..NUM_LEVELS)
        .map(|k| {
            let both = outlines
                .each_ref()
                .map(|outline| outline.crossed(along, level(k)));
            match is_shared[across] {
                true => [common(both[0], both[1]); 2],
                false => both,
            }
        })
        .collect();
    let mut best = (0.0, None);
    for first in 0..NUM_LEVELS {
        let mut ranges = crossed[first];
        for last in first + 1..NUM_LEVELS {
            ranges = [0, 1].map(|i| common(ranges[i], crossed[last][i]));
            let narrowest = (ranges.iter())
                .map(|r| r[1] - r[0])
                .fold(f64::INFINITY, f64::min);
            if narrowest <= 0.0 {
                break;
            }
            let tall = level(last) - level(first);
            let ratio = (narrowest / (new_size[across] - 1.0)).min(tall / (new_size[along] - 1.0));
            if ratio > best.0 {
                let levels = [level(first), level(last)];
                best = (ratio, Some((levels, ranges)));
            }
        }
    }
    let (levels, ranges) = best.1?;
    Some(ranges.map(|range| match along {
        0 => PixelRect::of(levels, range),
        _ => PixelRect::of(range, levels),
    }))
}

/// Returns the intersection of two ranges; its end may be before its begin.
fn common(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].min(b[1])]
}

impl Outline {
    /// Returns the part of the line at a level of one axis that is inside, as a range along the
    /// other. Its end is before its begin if the line misses the image.
    fn crossed(&self, along: usize, level: f64) -> [f64; 2] {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for (k, from) in self.border.iter().enumerate() {
            let to = &self.border[(k + 1) % self.border.len()];
            let (before, after) = (from[along] - level, to[along] - level);
            if before * after > 0.0 || before == after {
                continue;
            }
            let fraction = before / (before - after);
            let at = from[1 - along] + fraction * (to[1 - along] - from[1 - along]);
            range = [range[0].min(at), range[1].max(at)];
        }
        range
    }
}
