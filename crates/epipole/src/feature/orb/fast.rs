//! FAST corners: nine consecutive pixels on a circle, all brighter or all darker.

use crate::Result;
use crate::feature::Keypoint;
use crate::feature::nms::strongest_first;
use crate::math::monitored::Reporter;
use crate::math::simd::dispatched;
use image::GrayImage;
use std::cmp::Ordering;
use std::ops::Range;

/// Offsets of the circle of radius 3, clockwise from the top.
const CIRCLE: [(isize, isize); 16] = [
    (0, -3),
    (1, -3),
    (2, -2),
    (3, -1),
    (3, 0),
    (3, 1),
    (2, 2),
    (1, 3),
    (0, 3),
    (-1, 3),
    (-2, 2),
    (-3, 1),
    (-3, 0),
    (-3, -1),
    (-2, -2),
    (-1, -3),
];

/// The same as column and row of a 7×7 block.
const CIRCLE_AT: [(usize, usize); 16] = {
    let mut places = [(0, 0); 16];
    let mut k = 0;
    while k < 16 {
        let (x, y) = CIRCLE[k];
        places[k] = ((x + 3) as usize, (y + 3) as usize);
        k += 1;
    }
    places
};

/// Number of consecutive pixels that make a corner.
const ARC: usize = 9;

/// Finds the `limit` (≥ 1) strongest corners at least `margin` (≥ 5) pixels inside, sorted, each
/// the best of its 3×3 pixels, with the Harris measure as response.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn corners(
    image: &GrayImage,
    threshold: u8,
    margin: usize,
    limit: usize,
    reporter: &mut Reporter,
) -> Result<Vec<Keypoint>> {
    let mut found = whole_corners(image, threshold, margin, reporter)?;
    if found.len() > limit {
        // Keep ties with the last until their positions, which decide the order, are refined.
        let strength = |a: &Corner, b: &Corner| b.response.total_cmp(&a.response);
        let last = found.select_nth_unstable_by(limit - 1, strength).1.response;
        found.retain(|corner| corner.response.total_cmp(&last).is_ge());
    }
    let mut found: Vec<Keypoint> = found
        .iter()
        .map(|corner| refine_corner(image, corner))
        .collect();
    strongest_first(&mut found);
    found.truncate(limit);
    Ok(found)
}

/// A corner at an integer pixel.
struct Corner {
    x: usize,
    y: usize,
    response: f32,
}

/// Refines the corner to the peak of the scores around it.
fn refine_corner(image: &GrayImage, corner: &Corner) -> Keypoint {
    let width = image.width() as isize;
    let offsets = CIRCLE.map(|(x, y)| y * width + x);
    let center = corner.y as isize * width + corner.x as isize;
    let at = |offset: isize| f64::from(score(image.as_raw(), (center + offset) as usize, &offsets));
    let here = at(0);
    let u = corner.x as f64 + vertex(at(-1), here, at(1));
    let v = corner.y as f64 + vertex(at(-width), here, at(width));
    Keypoint::at(u, v, corner.response)
}

/// Finds the corners in reading order.
fn whole_corners(
    image: &GrayImage,
    threshold: u8,
    margin: usize,
    reporter: &mut Reporter,
) -> Result<Vec<Corner>> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width <= 2 * margin || height <= 2 * margin {
        return Ok(Vec::new());
    }
    let values = image.as_raw();
    // Scores of three rows; 0 for no corner.
    let mut scores = [vec![0u8; width], vec![0u8; width], vec![0u8; width]];
    let mut found = Vec::new();
    for y in margin - 1..height - margin + 1 {
        reporter.report(y, height)?;
        let seven = &values[(y - 3) * width..(y + 4) * width];
        let inside = margin - 1..width - margin + 1;
        score_row(seven, width, threshold, inside, &mut scores[y % 3]);
        if y < margin + 1 {
            continue;
        }
        let y = y - 1;
        let rows = [&scores[(y + 2) % 3], &scores[y % 3], &scores[(y + 1) % 3]];
        for (block, scores) in rows[1][margin..width - margin].chunks(LANES).enumerate() {
            if scores.iter().fold(0, |any, score| any | score) == 0 {
                continue;
            }
            for (i, &here) in scores.iter().enumerate().filter(|(_, score)| **score > 0) {
                let x = margin + block * LANES + i;
                // Ties of scores are common: the Harris measure decides, then reading order.
                let (mut beaten, mut equal) = (false, [false; 9]);
                for k in (0..9).filter(|&k| k != 4) {
                    let other = rows[k / 3][x + k % 3 - 1];
                    beaten |= other > here;
                    equal[k] = other == here;
                }
                if beaten {
                    continue;
                }
                let response = harris(values, width, x, y);
                let first = |k: usize| {
                    let other = harris(values, width, x + k % 3 - 1, y + k / 3 - 1);
                    match other.total_cmp(&response) {
                        Ordering::Greater => true,
                        Ordering::Equal => k < 4,
                        Ordering::Less => false,
                    }
                };
                if !(0..9).any(|k| equal[k] && first(k)) {
                    found.push(Corner { x, y, response });
                }
            }
        }
    }
    Ok(found)
}

/// Returns the peak of the parabola through three values, within half a sample of the middle.
fn vertex(before: f64, middle: f64, after: f64) -> f64 {
    let curvature = before - 2.0 * middle + after;
    if curvature < 0.0 {
        (0.5 * (before - after) / curvature).clamp(-0.5, 0.5)
    } else {
        0.0
    }
}

/// Number of pixels whose scores are computed at once.
const LANES: usize = 32;

dispatched! {
    /// Computes the scores of some columns of the middle of seven rows; 0 unless above the
    /// threshold.
    fn score_row(
        rows: &[u8],
        width: usize,
        threshold: u8,
        columns: Range<usize>,
        scores: &mut [u8],
    ) {
        let mut x = columns.start;
        while x < columns.end {
            if x + LANES + 3 <= width {
                let values = score_block::<LANES>(rows, width, threshold, x);
                scores[x..x + LANES].copy_from_slice(&values);
                x += LANES;
            } else {
                scores[x] = score_block::<1>(rows, width, threshold, x)[0];
                x += 1;
            }
        }
        // A block may extend beyond the requested columns.
        scores[columns.end..].fill(0);
    }
}

#[inline(always)]
fn pixels<const L: usize>(rows: &[u8], from: usize) -> &[u8; L] {
    rows[from..from + L]
        .try_into()
        .expect("the slice has this length")
}

/// Returns the pixels at one position of the circle for part of the middle row.
#[inline(always)]
fn ring<const L: usize>(rows: &[u8], width: usize, x: usize, k: usize) -> &[u8; L] {
    let (u, v) = CIRCLE_AT[k];
    pixels(rows, v * width + x + u - 3)
}

#[inline(always)]
fn score_block<const L: usize>(rows: &[u8], width: usize, threshold: u8, x: usize) -> [u8; L] {
    let center = pixels::<L>(rows, 3 * width + x);
    // Every arc of nine contains two adjacent ones of the four compass points.
    let (north, south) = (ring::<L>(rows, width, x, 0), ring::<L>(rows, width, x, 8));
    let (east, west) = (ring::<L>(rows, width, x, 4), ring::<L>(rows, width, x, 12));
    let mut any = 0;
    for i in 0..L {
        let high = center[i].saturating_add(threshold);
        let low = center[i].saturating_sub(threshold);
        let bright = north[i].max(south[i]).min(east[i].max(west[i])) > high;
        let dark = north[i].min(south[i]).max(east[i].min(west[i])) < low;
        any |= u8::from(bright | dark);
    }
    if any == 0 {
        return [0; L];
    }
    // Brightness above and below the center for each pixel of the circle, at least 0.
    let (mut bright, mut dark) = ([[0u8; L]; 16], [[0u8; L]; 16]);
    for k in 0..16 {
        let ring = ring::<L>(rows, width, x, k);
        for i in 0..L {
            bright[k][i] = ring[i].saturating_sub(center[i]);
            dark[k][i] = center[i].saturating_sub(ring[i]);
        }
    }
    let mut scores = [0u8; L];
    best_arcs(&bright, &mut scores);
    best_arcs(&dark, &mut scores);
    for score in &mut scores {
        *score = if *score > threshold { *score } else { 0 };
    }
    scores
}

/// Raises each score to the maximum over all arcs of nine of the minimum in the arc.
#[inline(always)]
fn best_arcs<const L: usize>(ring: &[[u8; L]; 16], scores: &mut [u8; L]) {
    let mut three = [[0u8; L]; 16];
    for k in 0..16 {
        let (a, b, c) = (&ring[k], &ring[(k + 1) % 16], &ring[(k + 2) % 16]);
        for i in 0..L {
            three[k][i] = a[i].min(b[i]).min(c[i]);
        }
    }
    for k in 0..16 {
        let (a, b, c) = (&three[k], &three[(k + 3) % 16], &three[(k + ARC - 3) % 16]);
        for i in 0..L {
            scores[i] = scores[i].max(a[i].min(b[i]).min(c[i]));
        }
    }
}

/// Returns the maximum threshold for which the pixel is a corner; negative if there is none.
fn score(values: &[u8], center: usize, offsets: &[isize; 16]) -> i16 {
    let middle = i16::from(values[center]);
    let ring: [i16; 16] =
        offsets.map(|offset| i16::from(values[(center as isize + offset) as usize]) - middle);
    let (mut bright, mut dark) = (i16::MIN, i16::MIN);
    // The minimum of nine in a row, from minima of three and of three times three.
    let three = |f: fn(i16, i16) -> i16| -> [i16; 16] {
        std::array::from_fn(|k| f(f(ring[k], ring[(k + 1) % 16]), ring[(k + 2) % 16]))
    };
    let (low, high) = (three(i16::min), three(i16::max));
    for k in 0..16 {
        let (a, b) = ((k + 3) % 16, (k + ARC - 3) % 16);
        bright = bright.max(low[k].min(low[a]).min(low[b]));
        dark = dark.max(-(high[k].max(high[a]).max(high[b])));
    }
    bright.max(dark)
}

dispatched! {
    /// Computes the Harris measure with k = 0.04 over 7×7 pixels, on gray values in [0, 1].
    fn harris(values: &[u8], width: usize, x: usize, y: usize) -> f32 {
        // Sums by column; the eighth is dropped at the end, as vectors have eight numbers. Each
        // product is at most 1020², and 49 of them do not overflow.
        let (mut a, mut b, mut c) = ([0i32; 8], [0i32; 8], [0i32; 8]);
        let ten = |row: usize| pixels::<10>(values, row * width + x - 4).map(i16::from);
        let mut nine_rows = [[0i16; 10]; 9];
        for (k, row) in nine_rows.iter_mut().enumerate() {
            *row = ten(y + k - 4);
        }
        for three in nine_rows.windows(3) {
            let (above, here, below) = (&three[0], &three[1], &three[2]);
            for k in 0..8 {
                let smooth = |k: usize| above[k] + 2 * here[k] + below[k];
                let slope = |k: usize| below[k] - above[k];
                let du = i32::from(smooth(k + 2) - smooth(k));
                let dv = i32::from(slope(k) + 2 * slope(k + 1) + slope(k + 2));
                a[k] += du * du;
                b[k] += du * dv;
                c[k] += dv * dv;
            }
        }
        // Divides by Sobel's gain of 8 and the 49 pixels.
        let scale = 1.0 / (255.0 * 255.0 * 64.0 * 49.0);
        let [a, b, c] = [a, b, c].map(|sums| f64::from(sums[..7].iter().sum::<i32>()) * scale);
        (a * c - b * b - 0.04 * (a + c) * (a + c)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;
    use crate::progress::Stage;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn corners_equal_those_of_opencv() {
        let image = fixture::gray8("fast_image.npy");
        let list = |name| -> Vec<(usize, usize)> {
            let values = fixture::floats(name).values;
            let mut list: Vec<_> = values
                .chunks_exact(2)
                .map(|p| (p[0] as usize, p[1] as usize))
                .filter(|&(u, v)| (5..91).contains(&u) && (5..75).contains(&v))
                .collect();
            list.sort_unstable();
            list
        };
        let offsets = CIRCLE.map(|(x, y)| y * 96 + x);
        let mut all = Vec::new();
        for u in 5..91 {
            for v in 5..75 {
                if score(image.as_raw(), v * 96 + u, &offsets) > 15 {
                    all.push((u, v));
                }
            }
        }
        assert_eq!(all, list("fast_all.npy"));
        // OpenCV drops both of two equal neighbors; this code keeps one.
        let canceled = AtomicBool::new(false);
        let mut reporter = Reporter::of_other(Stage::FeatureDetection, &canceled);
        let ours: Vec<(usize, usize)> = corners(&image, 15, 5, usize::MAX, &mut reporter)
            .unwrap()
            .iter()
            .map(|k| (k.u.round() as usize, k.v.round() as usize))
            .collect();
        let theirs = list("fast_corners.npy");
        let whole = |p: &&(usize, usize)| {
            ours.iter()
                .any(|q| p.0.abs_diff(q.0) <= 1 && p.1.abs_diff(q.1) <= 1)
        };
        assert!(theirs.len() > 40);
        assert_eq!(theirs.iter().filter(whole).count(), theirs.len());
        assert!(
            ours.len() < theirs.len() * 3 / 2,
            "{} {}",
            ours.len(),
            theirs.len()
        );
    }
}
