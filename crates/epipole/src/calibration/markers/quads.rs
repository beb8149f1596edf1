//! Detection of dark quadrilaterals on a brighter background.

use crate::Result;
use crate::imaging::{Border, GrayImage32, box_filter};
use crate::progress::{Monitor, Part, Stage, report};
use nalgebra::Point2;

/// Side of the surroundings with which a pixel is compared, pixels.
const SURROUNDINGS_PX: usize = 15;
/// Minimum difference between dark pixels and the mean of their surroundings, of a range of 1.
const LEAST_CONTRAST: f32 = 0.03;
/// Minimum ratio of the areas of quadrilateral and convex hull.
const LEAST_FILLED: f64 = 0.82;
/// Maximum ratio of the longest side to the shortest.
const MOST_SLANTED: f64 = 6.0;

/// Range of the sides of quadrilaterals, pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    pub(super) least: f64,
    pub(super) most: f64,
}

/// Finds the outlines of dark spots that are nearly quadrilaterals, to about a pixel. Corners are
/// clockwise in the image.
///
/// # Errors
/// [`Error::Canceled`](crate::Error::Canceled).
pub(super) fn find_quads(
    image: &GrayImage32,
    sides: Sides,
    monitor: &mut dyn Monitor,
) -> Result<Vec<[Point2<f64>; 4]>> {
    let stage = Stage::FeatureDetection;
    let (width, height) = (image.width() as usize, image.height() as usize);
    if width < 5 || height < 5 {
        return Ok(Vec::new());
    }
    let part = &mut Part::new(monitor, 0.0, 0.3).of_stage(stage);
    let mean = box_filter(image, SURROUNDINGS_PX, Border::Replicate, part)?;
    let pairs = image.as_raw().iter().zip(mean.as_raw());
    let mut is_dark: Vec<bool> = pairs.map(|(v, mean)| mean - v > LEAST_CONTRAST).collect();
    let mut quads = Vec::new();
    let mut stack = Vec::new();
    let mut rows: Vec<[usize; 2]> = Vec::new();
    for start in 0..is_dark.len() {
        if start % width == 0 {
            let fraction = 0.3 + 0.7 * start as f32 / is_dark.len() as f32;
            report(monitor, stage, fraction)?;
        }
        if !core::mem::take(&mut is_dark[start]) {
            continue;
        }
        // First and last column of each row of the spot. The start is in the top row.
        let top = start / width;
        rows.clear();
        stack.push(start);
        let mut at_border = false;
        while let Some(at) = stack.pop() {
            let (u, v) = (at % width, at / width);
            at_border |= u == 0 || v == 0 || u + 1 == width || v + 1 == height;
            if rows.len() <= v - top {
                rows.resize(v - top + 1, [usize::MAX, 0]);
            }
            let ends = &mut rows[v - top];
            *ends = [ends[0].min(u), ends[1].max(u)];
            // Diagonal neighbors are not connected: black squares that touch at corners are
            // separate.
            let ways = [
                (u > 0).then(|| at - 1),
                (u + 1 < width).then(|| at + 1),
                (v > 0).then(|| at - width),
                (v + 1 < height).then(|| at + width),
            ];
            for next in ways.into_iter().flatten() {
                if core::mem::take(&mut is_dark[next]) {
                    stack.push(next);
                }
            }
        }
        if !at_border && rows.len() as f64 >= sides.least / 2.0 {
            quads.extend(as_quad(&rows, top, sides));
        }
    }
    Ok(quads)
}

/// Returns the quadrilateral of a spot, given by the ends of its rows.
fn as_quad(rows: &[[usize; 2]], top: usize, sides: Sides) -> Option<[Point2<f64>; 4]> {
    let hull = hull_of_rows(rows, top);
    let quad = largest_quad(&hull)?;
    let lengths = [0, 1, 2, 3].map(|i| (quad[(i + 1) % 4] - quad[i]).norm() + 1.0);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let is_sized =
        shortest >= sides.least && longest <= sides.most && longest <= MOST_SLANTED * shortest;
    (is_sized && area(&quad) >= LEAST_FILLED * area(&hull)).then_some(quad)
}

/// Returns the convex hull of the ends of rows, clockwise in the image.
fn hull_of_rows(rows: &[[usize; 2]], top: usize) -> Vec<Point2<f64>> {
    let end = |row: usize, side: usize| Point2::new(rows[row][side] as f64, (top + row) as f64);
    let mut hull: Vec<Point2<f64>> = Vec::new();
    let mut add = |first: usize, points: &mut dyn Iterator<Item = Point2<f64>>| {
        for point in points {
            while hull.len() >= first + 2 {
                let [a, b] = [hull[hull.len() - 2], hull[hull.len() - 1]];
                if (b - a).perp(&(point - b)) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        }
        hull.len()
    };
    // Down along the right ends, up along the left ones.
    let half = add(0, &mut (0..rows.len()).map(|row| end(row, 1)));
    add(half, &mut (0..rows.len()).rev().map(|row| end(row, 0)));
    hull.dedup();
    hull
}

/// Returns the area of a polygon; positive if clockwise in the image.
fn area(polygon: &[Point2<f64>]) -> f64 {
    let num = polygon.len();
    let twice = |i: usize| polygon[i].coords.perp(&polygon[(i + 1) % num].coords);
    0.5 * (0..num).map(twice).sum::<f64>()
}

/// Returns the quadrilateral of maximum area with corners of a convex polygon.
fn largest_quad(hull: &[Point2<f64>]) -> Option<[Point2<f64>; 4]> {
    let num = hull.len();
    if num < 4 {
        return None;
    }
    let twice = |a: usize, b: usize, c: usize| {
        let at = |i: usize| hull[i % num];
        (at(b) - at(a)).perp(&(at(c) - at(a)))
    };
    let mut best = (0.0, [0; 4]);
    // For each diagonal, the farthest corners on both sides, which advance with its end.
    for first in 0..num - 2 {
        let (mut right, mut left) = (first + 1, first + 3);
        for across in first + 2..num {
            while right + 1 < across
                && twice(first, right + 1, across) > twice(first, right, across)
            {
                right += 1;
            }
            left = left.max(across + 1);
            while left + 1 < first + num
                && twice(first, across, left + 1) > twice(first, across, left)
            {
                left += 1;
            }
            if left >= first + num {
                break;
            }
            let sum = twice(first, right, across) + twice(first, across, left);
            if sum > best.0 {
                best = (sum, [first, right, across, left % num]);
            }
        }
    }
    (best.0 > 0.0).then(|| best.1.map(|i| hull[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    const SIDES: Sides = Sides {
        least: 8.0,
        most: 80.0,
    };

    /// A dark quadrilateral on a bright background.
    fn draw_quad(corners: [[f64; 2]; 4]) -> GrayImage32 {
        let corners = corners.map(Point2::from);
        GrayImage32::from_fn(100, 90, |u, v| {
            let p = Point2::new(f64::from(u), f64::from(v));
            let is_inside =
                (0..4).all(|k| (corners[(k + 1) % 4] - corners[k]).perp(&(p - corners[k])) >= 0.0);
            Luma([if is_inside { 0.1 } else { 0.8 }])
        })
    }

    #[test]
    fn a_slanted_square_is_found() {
        let corners = [[30.0, 20.0], [65.0, 28.0], [58.0, 66.0], [22.0, 55.0]];
        let found = find_quads(&draw_quad(corners), SIDES, &mut ()).unwrap();
        assert_eq!(found.len(), 1);
        let first = (0..4)
            .min_by(|&a, &b| found[0][a].y.total_cmp(&found[0][b].y))
            .unwrap();
        for (k, corner) in corners.into_iter().enumerate() {
            let off = found[0][(first + k) % 4] - Point2::from(corner);
            assert!(off.norm() < 1.6, "{k}: {off}");
        }
    }

    #[test]
    fn other_shapes_are_none() {
        let thin = draw_quad([[10.0, 40.0], [90.0, 40.0], [90.0, 44.0], [10.0, 44.0]]);
        let at_border = draw_quad([[-5.0, 10.0], [30.0, 10.0], [30.0, 45.0], [-5.0, 45.0]]);
        let disk = GrayImage32::from_fn(100, 90, |u, v| {
            let (x, y) = (f64::from(u) - 50.0, f64::from(v) - 45.0);
            Luma([if x * x + y * y < 400.0 { 0.1 } else { 0.8 }])
        });
        for image in [thin, at_border, disk, GrayImage32::new(3, 90)] {
            assert_eq!(
                find_quads(&image, SIDES, &mut ()).unwrap(),
                Vec::<[_; 4]>::new()
            );
        }
    }
}
