//! Filled polygons with exact-area coverage.

use super::coverage::{Coverage, greater, lesser, parts};
use super::edge::Edge;
use super::place::At;
use std::ops::Range;

/// Number of pixels checked together.
const AT_ONCE: usize = 16;

impl Coverage {
    /// Adds the interior of a polygon, by its winding number.
    pub(super) fn add_polygon(&mut self, corners: &[At]) {
        self.add_contours(&[corners]);
    }

    /// Adds the interior of closed contours by their winding number; a contour of opposite
    /// orientation cuts a hole. Clipped to the picture.
    ///
    /// Source: signed-area accumulation of font rasterizers, e.g. R. Levien's `font-rs` (2016).
    /// Each edge adds the change of the area to its right to each pixel, and a running sum along
    /// the row gives the coverage.
    pub(super) fn add_contours(&mut self, contours: &[&[At]]) {
        let corners = || contours.iter().copied().flatten();
        let (mut low, mut high) = ((f32::INFINITY, f32::INFINITY), (0.0_f32, 0.0_f32));
        if corners().any(|at| !at.0.is_finite() || !at.1.is_finite()) {
            return;
        }
        for &(x, y) in corners() {
            low = (lesser(low.0, x), lesser(low.1, y));
            high = (greater(high.0, x), greater(high.1, y));
        }
        // The casts saturate negative values at 0.
        let right = (high.0.ceil() as usize).min(self.width());
        let left = (low.0 as usize).min(right);
        let bottom = (high.1.ceil() as usize).min(self.height());
        let (mut sums, mut edges) = (
            std::mem::take(&mut self.sums),
            std::mem::take(&mut self.edges),
        );
        if sums.len() < right - left + 2 {
            sums.resize(right - left + 2, 0.0);
        }
        edges.clear();
        for corners in contours {
            let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
            edges.extend(pairs.map(|(&from, &to)| Edge::new(from, to)));
        }
        for row in low.1 as usize..bottom {
            let (above, below) = (row as f32, row as f32 + 1.0);
            // Columns in which the area changes within this row.
            let (mut start, mut end) = (usize::MAX, 0);
            for edge in &edges {
                let (y0, y1) = (greater(edge.upper.1, above), lesser(edge.lower.1, below));
                if y0 >= y1 {
                    continue;
                }
                let x = |y: f32| {
                    let x = edge.upper.0 + (y - edge.upper.1) * edge.slope - left as f32;
                    lesser(greater(x, 0.0), (right - left) as f32)
                };
                let changed = accumulate(&mut sums, x(y0), x(y1), edge.sign * (y1 - y0));
                (start, end) = (start.min(changed.start), end.max(changed.end));
            }
            if start >= end {
                continue;
            }
            let changes = &mut sums[start..end];
            let columns = (left + start).min(right)..(left + end).min(right);
            let (mut area, mut covered) = (0.0_f32, 0);
            let part = self.part(row, columns);
            for (alphas, changes) in part.chunks_mut(AT_ONCE).zip(changes.chunks(AT_ONCE)) {
                // Nothing changes inside and outside, which is true of most pixels.
                let any = changes.iter().fold(0, |any, change| any | change.to_bits());
                if any == 0 {
                    alphas.fill(covered);
                    continue;
                }
                for (alpha, change) in alphas.iter_mut().zip(changes) {
                    area += change;
                    covered = parts(lesser(area.abs(), 1.0));
                    *alpha = covered;
                }
            }
            changes.fill(0.0);
        }
        (self.sums, self.edges) = (sums, edges);
    }
}

/// Adds the change by an edge within one row: the area to its right grows by `rise`. Returns the
/// range of columns.
fn accumulate(sums: &mut [f32], x0: f32, x1: f32, rise: f32) -> Range<usize> {
    let (low, high) = (lesser(x0, x1), greater(x0, x1));
    let first = low as usize;
    let last = high as usize;
    if first == last {
        // Within one pixel: the part of it right of the edge, and all of the next.
        let right = 1.0 - (0.5 * (low + high) - first as f32);
        sums[first] += rise * right;
        sums[first + 1] += rise * (1.0 - right);
        return first..first + 2;
    }
    // Across several pixels: each gets the rise of its own piece of the edge.
    let per_pixel = rise / (high - low);
    for pixel in first..=last {
        let left = greater(low, pixel as f32);
        let piece = lesser(high, pixel as f32 + 1.0) - left;
        let right = 1.0 - (left + 0.5 * piece - pixel as f32);
        let part = per_pixel * piece;
        sums[pixel] += part * right;
        sums[pixel + 1] += part * (1.0 - right);
    }
    first..last + 2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(corners: &[At]) -> Vec<u8> {
        let mut coverage = Coverage::default().sized(60, 40);
        coverage.add_polygon(corners);
        let mut pixels = vec![0; 4 * 60 * 40];
        coverage.blend(&mut pixels, [255, 255, 255], 1.0);
        pixels.chunks(4).map(|pixel| pixel[0]).collect()
    }

    fn area(corners: &[At]) -> f64 {
        covered(corners)
            .iter()
            .map(|&byte| f64::from(byte))
            .sum::<f64>()
            / 255.0
    }

    #[test]
    fn a_polygon_covers_its_area() {
        let square = [(3.25, 4.5), (13.25, 4.5), (13.25, 9.0), (3.25, 9.0)];
        assert!((area(&square) - 45.0).abs() < 0.1);
        let pixels = covered(&square);
        assert_eq!(
            [pixels[5 * 60 + 3], pixels[4 * 60 + 8], pixels[6 * 60 + 8]],
            [191, 128, 255]
        );
        let backwards: Vec<At> = square.iter().rev().copied().collect();
        assert_eq!(covered(&backwards), pixels);
        let sliver = [(2.0, 3.0), (58.0, 30.0), (58.0, 30.4)];
        assert!(
            (area(&sliver) - 0.5 * 56.0 * 0.4).abs() < 0.6,
            "{}",
            area(&sliver)
        );
        let arrow = [(5.0, 5.0), (50.0, 20.0), (5.0, 35.0), (20.0, 20.0)];
        assert!((area(&arrow) - 450.0).abs() < 0.6, "{}", area(&arrow));
        let whole = [(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)];
        assert!((area(&whole) - 2400.0).abs() < 1e-9);
    }

    #[test]
    fn a_reversed_contour_is_a_hole() {
        let outer = [(5.0, 5.0), (35.0, 5.0), (35.0, 35.0), (5.0, 35.0)];
        let inner = [(10.0, 10.0), (10.0, 20.0), (20.0, 20.0), (20.0, 10.0)];
        let mut coverage = Coverage::default().sized(60, 40);
        coverage.add_contours(&[&outer, &inner]);
        let alpha = coverage.into_alpha();
        assert_eq!([alpha[15 * 60 + 15], alpha[25 * 60 + 25]], [0, 255]);
        let sum: u32 = alpha.iter().map(|&alpha| u32::from(alpha)).sum();
        assert_eq!(sum, 255 * 800);
    }

    #[test]
    fn without_an_area_nothing_is_covered() {
        assert_eq!(area(&[]), 0.0);
        assert_eq!(area(&[(5.0, 5.0)]), 0.0);
        assert_eq!(area(&[(5.0, 5.0), (30.0, 20.0)]), 0.0);
        assert_eq!(area(&[(90.0, 5.0), (120.0, 20.0), (95.0, 30.0)]), 0.0);
        assert_eq!(
            area(&[(f32::NAN, 5.0), (f32::INFINITY, 20.0), (5.0, f32::NAN)]),
            0.0
        );
    }

    #[test]
    fn what_is_outside_is_cut_off() {
        let around = [
            (-1000.0, -300.0),
            (900.0, -300.0),
            (900.0, 500.0),
            (-1000.0, 500.0),
        ];
        assert_eq!(area(&around), 2400.0);
        let half = [(-20.0, 10.0), (30.0, 10.0), (30.0, 300.0), (-20.0, 300.0)];
        assert_eq!(area(&half), 900.0);
    }
}
