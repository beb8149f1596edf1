//! Straight strokes, disks and rings, with coverage by distance.
//!
//! The coverage of a pixel follows from the distance of its center to the middle of the line. This
//! needs no outline, edges or samples, so hundreds of lines fit into a frame.

use super::coverage::{Coverage, greater, lesser, parts};
use super::place::At;

/// End of a stroke.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Cap {
    /// Half a disk around the end.
    Round,
    /// Cut at the end.
    Flat,
}

/// Returns the coverage of a pixel by a band of half-width `half`, for a pixel center at `distance`
/// from the band's middle.
#[inline]
fn band(distance: f32, half: f32) -> f32 {
    let end = lesser(distance + 0.5, half);
    let start = greater(distance - 0.5, -half);
    lesser(greater(end - start, 0.0), 1.0)
}

/// Covers part of a row with a function of the pixel's index.
#[inline]
fn cover(part: &mut [u8], coverage: impl Fn(f32) -> f32) {
    for (index, alpha) in part.iter_mut().enumerate() {
        *alpha = (*alpha).max(parts(coverage(index as i32 as f32)));
    }
}

impl Coverage {
    /// Adds a straight line of a width. A round one of length 0 is a disk.
    pub(super) fn add_segment(&mut self, from: At, to: At, width: f32, cap: Cap) {
        let half = width / 2.0;
        let reach = half + 0.5;
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = (dx * dx + dy * dy).sqrt();
        if !length.is_finite() || (length == 0.0 && cap == Cap::Flat) {
            return;
        }
        let (ux, uy) = match length > 0.0 {
            true => (dx / length, dy / length),
            false => (1.0, 0.0),
        };
        let overhang = if cap == Cap::Flat { 0.5 } else { 0.0 };
        for row in self.rows_within(from.1.min(to.1) - reach, from.1.max(to.1) + reach) {
            let y = row as f32 + 0.5 - from.1;
            // Intersect the row with the rectangle around the line, columns relative to its start …
            let along = within(ux, uy * y, -overhang, length + overhang);
            let across = within(-uy, ux * y, -reach, reach);
            let (mut low, mut high) = (greater(along.0, across.0), lesser(along.1, across.1));
            if low > high {
                (low, high) = (f32::INFINITY, f32::NEG_INFINITY);
            }
            // … and the disks around its ends.
            if cap == Cap::Round {
                for (x_end, y_end) in [(0.0, y), (dx, y - dy)] {
                    let square = reach * reach - y_end * y_end;
                    if square >= 0.0 {
                        let room = square.sqrt();
                        low = lesser(low, x_end - room);
                        high = greater(high, x_end + room);
                    }
                }
            }
            if low > high {
                continue;
            }
            let columns = self.columns_within(from.0 + low, from.0 + high);
            let first = columns.start as f32 + 0.5 - from.0;
            let part = self.part(row, columns);
            let (s0, d0) = (ux * first + uy * y, ux * y - uy * first);
            match cap {
                Cap::Round => cover(part, |index| {
                    let (s, d) = (s0 + ux * index, d0 - uy * index);
                    let beyond = s - lesser(greater(s, 0.0), length);
                    band((d * d + beyond * beyond).sqrt(), half)
                }),
                Cap::Flat => cover(part, |index| {
                    let (s, d) = (s0 + ux * index, d0 - uy * index);
                    band(d, half) * band(s - length / 2.0, length / 2.0)
                }),
            }
        }
    }

    /// Adds a filled disk.
    pub(super) fn add_disk(&mut self, center: At, radius: f32) {
        self.add_segment(center, center, 2.0 * radius, Cap::Round);
    }

    /// Adds a circle of a line width.
    pub(super) fn add_ring(&mut self, center: At, radius: f32, width: f32) {
        let half = width / 2.0;
        let (outer, inner) = (radius + half + 0.5, (radius - half - 0.5).max(0.0));
        if !(outer.is_finite() && center.0.is_finite() && center.1.is_finite()) {
            return;
        }
        for row in self.rows_within(center.1 - outer, center.1 + outer) {
            let y = row as f32 + 0.5 - center.1;
            let room = |radius: f32| (radius * radius - y * y).max(0.0).sqrt();
            let (far, near) = (room(outer), room(inner));
            let left = self.columns_within(center.0 - far, center.0 - near);
            let right = self.columns_within(center.0 + near, center.0 + far);
            // Above and below the hole both ranges are the same.
            let right = right.start.max(left.end)..right.end.max(left.end);
            for columns in [left, right] {
                let first = columns.start as f32 + 0.5 - center.0;
                cover(self.part(row, columns), |index| {
                    let x = first + index;
                    band((x * x + y * y).sqrt() - radius, half)
                });
            }
        }
    }
}

/// Returns the x with `low ≤ slope · x + offset ≤ high`.
fn within(slope: f32, offset: f32, low: f32, high: f32) -> (f32, f32) {
    if slope.abs() < 1e-6 {
        return match (low..=high).contains(&offset) {
            true => (f32::NEG_INFINITY, f32::INFINITY),
            false => (f32::INFINITY, f32::NEG_INFINITY),
        };
    }
    let (a, b) = ((low - offset) / slope, (high - offset) / slope);
    (lesser(a, b), greater(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the covered area, pixels, and the picture itself.
    fn covered(draw: impl FnOnce(&mut Coverage)) -> (f64, Vec<u8>) {
        let mut coverage = Coverage::default().sized(100, 80);
        draw(&mut coverage);
        let mut pixels = vec![0; 4 * 100 * 80];
        coverage.blend(&mut pixels, [255, 255, 255], 1.0);
        let area = pixels
            .chunks(4)
            .map(|pixel| f64::from(pixel[0]))
            .sum::<f64>()
            / 255.0;
        (area, pixels)
    }

    #[test]
    fn a_line_covers_its_length_times_its_width() {
        for (from, to) in [
            ((10.0, 20.0), (80.0, 20.0)),
            ((20.3, 10.0), (20.3, 70.0)),
            ((90.0, 70.0), (12.0, 15.0)),
            ((15.0, 40.2), (88.0, 44.9)),
        ] {
            for width in [0.5, 1.0, 3.0, 9.0] {
                let length = f64::from(libm::hypotf(to.0 - from.0, to.1 - from.1));
                let (area, _) = covered(|it| it.add_segment(from, to, width, Cap::Flat));
                let expected = length * f64::from(width);
                assert!(
                    (area / expected - 1.0).abs() < 0.03,
                    "{from:?} {to:?} {width}: {area}"
                );
                let (round, _) = covered(|it| it.add_segment(from, to, width, Cap::Round));
                let ends = std::f64::consts::PI * f64::from(width * width) / 4.0;
                let least = expected + 0.9 * ends - 1.0;
                assert!(
                    round > least && round < 1.05 * (expected + ends) + 1.5,
                    "{round}"
                );
            }
        }
    }

    #[test]
    fn disks_and_rings_have_their_areas() {
        let (disk, _) = covered(|it| it.add_disk((50.2, 39.7), 20.0));
        assert!(
            (disk / (std::f64::consts::PI * 400.0) - 1.0).abs() < 0.002,
            "{disk}"
        );
        let (ring, pixels) = covered(|it| it.add_ring((50.2, 39.7), 20.0, 3.0));
        assert!(
            (ring / (std::f64::consts::TAU * 60.0) - 1.0).abs() < 0.005,
            "{ring}"
        );
        assert_eq!(pixels[4 * (39 * 100 + 50)], 0);
        let (dot, _) = covered(|it| it.add_ring((50.0, 40.0), 1.0, 4.0));
        assert!(
            (dot / (std::f64::consts::PI * 9.0) - 1.0).abs() < 0.03,
            "{dot}"
        );
    }

    #[test]
    fn what_is_outside_or_no_number_covers_nothing() {
        let (area, _) = covered(|it| {
            for place in [-500.0, 1e9, f32::NAN, f32::INFINITY] {
                it.add_segment((place, 10.0), (place, 30.0), 3.0, Cap::Round);
                it.add_segment((place, -10.0), (20.0, place), 3.0, Cap::Flat);
                it.add_ring((place, place), 4.0, 2.0);
            }
        });
        assert!(area < 100.0, "{area}");
    }
}
