//! Sub-pixel outline of a quadrilateral: a line fitted to the edge points of each side.

use crate::imaging::{Border, GrayImage32, sample_bilinear};
use nalgebra::{Matrix2, Point2, Vector2};

/// Fraction of a side, at each end, that the adjacent side blurs.
const ENDS: f64 = 0.12;
/// Range of the number of edge points along a side.
const POINTS: core::ops::Range<usize> = 8..40;
/// Step of the profiles across an edge, pixels.
const STEP_PX: f64 = 0.5;
/// Minimum difference of bright and dark across an edge, of a range of 1.
const LEAST_CONTRAST: f64 = 0.05;
/// Minimum fraction of a side with a visible edge.
const LEAST_VISIBLE: f64 = 0.6;
/// Maximum distance of edge points from the line, in multiples of the median.
const FAR: f64 = 3.0;

/// A line through `point` along the unit vector `direction`.
struct Line {
    point: Point2<f64>,
    direction: Vector2<f64>,
}

/// Refines the corners of a dark quadrilateral, by lines through the edge points of its sides;
/// `None` if a side shows no edge.
///
/// * `corners`: clockwise in the image
/// * `reach_px`: half the length of the profiles, at most the width of the dark border
pub(super) fn refine_outline(
    image: &GrayImage32,
    corners: &[Point2<f64>; 4],
    reach_px: f64,
) -> Option<[Point2<f64>; 4]> {
    let mut lines = Vec::with_capacity(4);
    for k in 0..4 {
        lines.push(fit_side(
            image,
            [corners[k], corners[(k + 1) % 4]],
            reach_px,
        )?);
    }
    let mut refined = *corners;
    for (k, corner) in refined.iter_mut().enumerate() {
        let moved = crossing(&lines[(k + 3) % 4], &lines[k])?;
        // Also false for NaN.
        let is_near = (moved - *corner).norm() <= 2.0 * reach_px;
        if !is_near {
            return None;
        }
        *corner = moved;
    }
    Some(refined)
}

fn fit_side(image: &GrayImage32, [a, b]: [Point2<f64>; 2], reach_px: f64) -> Option<Line> {
    let side = b - a;
    let length = side.norm();
    let along = side / length;
    // The outside is to the left of a clockwise outline.
    let outward = Vector2::new(along.y, -along.x);
    let count = (length as usize).clamp(POINTS.start, POINTS.end);
    let points: Vec<Point2<f64>> = (0..count)
        .filter_map(|k| {
            let fraction = ENDS + (1.0 - 2.0 * ENDS) * (k as f64 + 0.5) / count as f64;
            edge_point(image, &(a + side * fraction), &outward, reach_px)
        })
        .collect();
    if (points.len() as f64) < LEAST_VISIBLE * count as f64 {
        return None;
    }
    let line = fit_line(&points)?;
    let off = |p: &Point2<f64>| line.direction.perp(&(p - line.point)).abs();
    let mut offs: Vec<f64> = points.iter().map(off).collect();
    offs.sort_by(f64::total_cmp);
    let most = FAR * offs[offs.len() / 2].max(0.02);
    let near: Vec<Point2<f64>> = points.iter().filter(|p| off(p) <= most).copied().collect();
    fit_line(&near)
}

/// Returns the position across an edge where its gray value rises: the mean weighted by slopes.
fn edge_point(
    image: &GrayImage32,
    near: &Point2<f64>,
    outward: &Vector2<f64>,
    reach_px: f64,
) -> Option<Point2<f64>> {
    let half = (reach_px / STEP_PX).ceil() as i32;
    let gray = |step: i32| {
        let p = near + outward * (f64::from(step) * STEP_PX);
        f64::from(sample_bilinear(image, p.x, p.y, Border::Replicate))
    };
    let mut before = gray(-half);
    let (mut sum, mut moment) = (0.0, 0.0);
    for step in 1 - half..=half {
        let here = gray(step);
        let rise = (here - before).max(0.0);
        sum += rise;
        moment += rise * (f64::from(step) - 0.5) * STEP_PX;
        before = here;
    }
    (sum >= LEAST_CONTRAST).then(|| near + outward * (moment / sum))
}

/// Fits a line by least squares of distances.
fn fit_line(points: &[Point2<f64>]) -> Option<Line> {
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let sum: Vector2<f64> = points.iter().map(|p| p.coords).sum();
    let point = Point2::from(sum / count);
    let spread = points.iter().fold(Matrix2::zeros(), |sum, p| {
        sum + (p - point) * (p - point).transpose()
    });
    // Major eigenvector of a symmetric 2 × 2 matrix.
    let angle_rad = 0.5 * libm::atan2(2.0 * spread[(0, 1)], spread[(0, 0)] - spread[(1, 1)]);
    let (sine, cosine) = libm::sincos(angle_rad);
    Some(Line {
        point,
        direction: Vector2::new(cosine, sine),
    })
}

fn crossing(a: &Line, b: &Line) -> Option<Point2<f64>> {
    let sine = a.direction.perp(&b.direction);
    let along = (b.point - a.point).perp(&b.direction) / sine;
    (sine.abs() > 0.1).then(|| a.point + a.direction * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::gaussian_blur;
    use image::Luma;

    #[test]
    fn corners_are_exact() {
        let truth = [[30.3, 20.4], [65.1, 28.2], [58.6, 66.9], [22.7, 55.3]].map(Point2::from);
        let is_inside = |p: &Point2<f64>| {
            (0..4).all(|k| (truth[(k + 1) % 4] - truth[k]).perp(&(p - truth[k])) >= 0.0)
        };
        let sharp = GrayImage32::from_fn(100, 90, |u, v| {
            let inside = (0..64)
                .filter(|k| {
                    let x = f64::from(u) + (f64::from(k % 8) - 3.5) / 8.0;
                    let y = f64::from(v) + (f64::from(k / 8) - 3.5) / 8.0;
                    is_inside(&Point2::new(x, y))
                })
                .count();
            Luma([0.9 - 0.8 * inside as f32 / 64.0])
        });
        for (sigma_px, reach_px) in [(0.5, 3.0), (1.5, 4.0)] {
            let image = gaussian_blur(&sharp, sigma_px, Border::Replicate, &mut ()).unwrap();
            let start = truth.map(|p| p + Vector2::new(0.9, -0.7));
            let nearer = refine_outline(&image, &start, reach_px).unwrap();
            let found = refine_outline(&image, &nearer, reach_px).unwrap();
            for (found, truth) in found.iter().zip(&truth) {
                assert!(
                    (found - truth).norm() < 0.05,
                    "{sigma_px}: {}",
                    found - truth
                );
            }
        }
    }

    #[test]
    fn a_flat_image_has_no_outline() {
        let image = GrayImage32::from_pixel(60, 60, Luma([0.5]));
        let square = [[20.0, 20.0], [40.0, 20.0], [40.0, 40.0], [20.0, 40.0]].map(Point2::from);
        assert_eq!(refine_outline(&image, &square, 3.0), None);
    }
}
