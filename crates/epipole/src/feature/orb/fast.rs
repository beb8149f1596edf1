//! FAST corners: nine neighbors in a row on a circle, all brighter or all darker.

use crate::feature::Keypoint;
use crate::math::simd::dispatched;
use image::GrayImage;
use std::cmp::Ordering;

/// The circle of radius 3, clockwise from above.
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

/// Neighbors in a row that make a corner.
const ARC: usize = 9;

/// Corners at least `margin` (≥ 5) pixels inside, the strongest of each 3×3 pixels, with Harris'
/// measure as their response.
pub(super) fn corners(image: &GrayImage, threshold: u8, margin: usize) -> Vec<Keypoint> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width <= 2 * margin || height <= 2 * margin {
        return Vec::new();
    }
    let values = image.as_raw();
    let offsets = CIRCLE.map(|(x, y)| y * width as isize + x);
    let mut flags = vec![0u8; width - 6];
    // Scores of three rows; 0 is no corner.
    let mut scores = [vec![0i16; width], vec![0i16; width], vec![0i16; width]];
    let mut found = Vec::new();
    for y in margin - 1..height - margin + 1 {
        let row = &mut scores[y % 3];
        row.fill(0);
        flag_row(
            &values[(y - 3) * width..(y + 4) * width],
            width,
            threshold,
            &mut flags,
        );
        for (k, &flag) in flags.iter().enumerate() {
            let x = k + 3;
            if flag != 0 && x + 1 >= margin && x < width - margin + 1 {
                let score = score(values, y * width + x, &offsets);
                if score > i16::from(threshold) {
                    row[x] = score;
                }
            }
        }
        if y < margin + 1 {
            continue;
        }
        let y = y - 1;
        let rows = [&scores[(y + 2) % 3], &scores[y % 3], &scores[(y + 1) % 3]];
        for x in margin..width - margin {
            let here = rows[1][x];
            let beaten = || {
                let strength = |x: usize, y: usize| harris(values, width, x, y);
                (0..9).filter(|&k| k != 4).any(|k| {
                    let (i, j) = (x + k % 3 - 1, y + k / 3 - 1);
                    let other = rows[k / 3][i];
                    // Equal scores are common: Harris' measure decides, then reading order.
                    other > here
                        || other == here
                            && match strength(i, j).total_cmp(&strength(x, y)) {
                                Ordering::Greater => true,
                                Ordering::Equal => k < 4,
                                Ordering::Less => false,
                            }
                })
            };
            if here > 0 && !beaten() {
                let at = |dx: isize, dy: isize| {
                    let center = (y as isize + dy) * width as isize + x as isize + dx;
                    f64::from(score(values, center as usize, &offsets))
                };
                let (left, right) = (at(-1, 0), at(1, 0));
                let (above, below) = (at(0, -1), at(0, 1));
                let u = x as f64 + vertex(left, f64::from(here), right);
                let v = y as f64 + vertex(above, f64::from(here), below);
                found.push(Keypoint::at(u, v, harris(values, width, x, y)));
            }
        }
    }
    found
}

/// Where a parabola through three values peaks, within half a sample of the middle one.
fn vertex(before: f64, middle: f64, after: f64) -> f64 {
    let curvature = before - 2.0 * middle + after;
    if curvature < 0.0 {
        (0.5 * (before - after) / curvature).clamp(-0.5, 0.5)
    } else {
        0.0
    }
}

dispatched! {
    /// Marks pixels for which two neighboring ones of the four compass points are brighter, or
    /// darker, by more than the threshold: every arc of nine holds two such. Flag k is that of
    /// column k + 3 in the middle of seven rows.
    fn flag_row(rows: &[u8], width: usize, threshold: u8, flags: &mut [u8]) {
        let n = flags.len();
        let center = &rows[3 * width + 3..][..n];
        let (north, south) = (&rows[3..][..n], &rows[6 * width + 3..][..n]);
        let (west, east) = (&rows[3 * width..][..n], &rows[3 * width + 6..][..n]);
        for k in 0..n {
            let high = center[k].saturating_add(threshold);
            let low = center[k].saturating_sub(threshold);
            let bright = ((north[k] > high) | (south[k] > high)) & ((west[k] > high) | (east[k] > high));
            let dark = ((north[k] < low) | (south[k] < low)) & ((west[k] < low) | (east[k] < low));
            flags[k] = u8::from(bright | dark);
        }
    }
}

/// The largest threshold for which the pixel is still a corner; negative if it is none at any.
fn score(values: &[u8], center: usize, offsets: &[isize; 16]) -> i16 {
    let middle = i16::from(values[center]);
    let ring: [i16; 16] =
        offsets.map(|offset| i16::from(values[(center as isize + offset) as usize]) - middle);
    let (mut bright, mut dark) = (i16::MIN, i16::MIN);
    // The least of nine in a row, from the least of three and of three times three.
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

/// Harris' measure with k = 0.04 over 7×7 pixels, on gray values in [0, 1].
fn harris(values: &[u8], width: usize, x: usize, y: usize) -> f32 {
    let (mut a, mut b, mut c) = (0i64, 0i64, 0i64);
    for row in y - 3..=y + 3 {
        for column in x - 3..=x + 3 {
            let at = |dx: isize, dy: isize| {
                let k = (row as isize + dy) * width as isize + column as isize + dx;
                i64::from(values[k as usize])
            };
            let du = at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1);
            let dv = at(-1, 1) + 2 * at(0, 1) + at(1, 1) - at(-1, -1) - 2 * at(0, -1) - at(1, -1);
            a += du * du;
            b += du * dv;
            c += dv * dv;
        }
    }
    // Sobel's gain of 8 and the 49 pixels are divided out.
    let scale = 1.0 / (255.0 * 255.0 * 64.0 * 49.0);
    let (a, b, c) = (a as f64 * scale, b as f64 * scale, c as f64 * scale);
    (a * c - b * b - 0.04 * (a + c) * (a + c)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

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
        // OpenCV drops both of two equal neighbors, we keep one.
        let ours: Vec<(usize, usize)> = corners(&image, 15, 5)
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
