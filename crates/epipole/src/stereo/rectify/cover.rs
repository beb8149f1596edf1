//! Visible part of both images, and the resulting zoom.

use super::outline::Outline;
use super::rect::PixelRect;
use super::slanted::inscribed;
use crate::{Error, Result};
use nalgebra::Vector2;

/// Maximum extra magnification for keeping principal points in the middle and the content reaching
/// from side to side.
pub(super) const LARGEST_CROP: f64 = 2.0;

/// A focal length and its principal points.
pub(super) type Framing = (f64, [Vector2<f64>; 2]);

/// Keeps the principal points where they show the middles of the images, and scales the focal
/// length, initially `focal_px`, to the visible part given by alpha. `None` if a principal point is
/// outside the visible or covered part.
pub(super) fn around_principal_points(
    outlines: &[Outline; 2],
    centers: &[Vector2<f64>; 2],
    focal_px: f64,
    new_size: &Vector2<f64>,
    alpha: f64,
) -> Option<Framing> {
    let mut all_valid: f64 = 0.0;
    let mut all_shown = f64::INFINITY;
    for (outline, center) in outlines.iter().zip(centers) {
        // Distances from the principal point to each side: of the result, and of the camera's
        // coverage.
        let room = [
            center.x,
            center.y,
            new_size.x - 1.0 - center.x,
            new_size.y - 1.0 - center.y,
        ];
        let sides = |r: &PixelRect| [-r.u_min, -r.v_min, r.u_max, r.v_max].map(|x| x * focal_px);
        for (room, covered) in room.into_iter().zip(sides(&outline.inner)) {
            if covered <= 0.0 || room <= 0.0 {
                return None;
            }
            all_valid = all_valid.max(room / covered);
        }
        for (room, covered) in room.into_iter().zip(sides(&outline.outer)) {
            all_shown = all_shown.min(room / covered);
        }
    }
    let zoom = all_valid * (1.0 - alpha) + all_shown * alpha;
    Some((focal_px * zoom, *centers))
}

/// A framing of the rectified pair, and the part of it that each camera covers.
pub(super) struct Shown {
    pub(super) framing: Framing,
    /// For each image, a rectangle inside it, in units of the focal length.
    pub(super) inner: [PixelRect; 2],
}

/// Shows the middle of the cameras' coverage, wherever the principal points are: for a baseline far
/// from the image plane they are outside the results.
///
/// * `inner`: rectangles inside the images
/// * `is_shared`: whether both results show the same part along x, and along y
///
/// `None` if the rectangles do not overlap.
fn around_rectangles(
    inner: &[PixelRect; 2],
    outlines: &[Outline; 2],
    is_shared: [bool; 2],
    new_size: &Vector2<f64>,
    alpha: f64,
) -> Option<Framing> {
    let mut all_valid: f64 = 0.0;
    let mut all_shown = f64::INFINITY;
    let mut middles = [Vector2::zeros(); 2];
    for (axis, is_shared) in is_shared.into_iter().enumerate() {
        let mut inner = inner.each_ref().map(|rect| rect.range(axis));
        let mut outer = outlines.each_ref().map(|o| o.outer.range(axis));
        if is_shared {
            inner = [[inner[0][0].max(inner[1][0]), inner[0][1].min(inner[1][1])]; 2];
            outer = [[outer[0][0].min(outer[1][0]), outer[0][1].max(outer[1][1])]; 2];
        }
        for i in 0..2 {
            if inner[i][1] <= inner[i][0] {
                return None;
            }
            let room = new_size[axis] - 1.0;
            all_valid = all_valid.max(room / (inner[i][1] - inner[i][0]));
            all_shown = all_shown.min(room / (outer[i][1] - outer[i][0]));
            middles[i][axis] = 0.5
                * ((1.0 - alpha) * (inner[i][0] + inner[i][1])
                    + alpha * (outer[i][0] + outer[i][1]));
        }
    }
    let focal_px = all_valid * (1.0 - alpha) + all_shown * alpha;
    let middle = (new_size - Vector2::new(1.0, 1.0)) / 2.0;
    Some((
        focal_px,
        middles.map(|visible_center| middle - visible_center * focal_px),
    ))
}

/// Frames the cameras' coverage: between the innermost points of the images' sides, or, for slanted
/// images, in a rectangle that cuts off parts of the sides.
///
/// * `is_shared`: whether both results show the same part along x, and along y
///
/// # Errors
/// [`Error::Degenerate`] if the cameras' coverages do not overlap.
pub(super) fn around_visible(
    outlines: &[Outline; 2],
    is_shared: [bool; 2],
    new_size: &Vector2<f64>,
    alpha: f64,
) -> Result<Shown> {
    let shown = |inner: [PixelRect; 2], alpha: f64| {
        let framing = around_rectangles(&inner, outlines, is_shared, new_size, alpha)?;
        Some(Shown { framing, inner })
    };
    let simple = outlines.each_ref().map(|outline| outline.inner);
    let enlarged = |inner: [PixelRect; 2]| shown(inner, 0.0).map_or(f64::INFINITY, |s| s.framing.0);
    let slanted = inscribed(outlines, is_shared, new_size)
        .filter(|slanted| enlarged(simple) > LARGEST_CROP * enlarged(*slanted));
    shown(slanted.unwrap_or(simple), alpha).ok_or(Error::Degenerate {
        what: "a rectification",
        why: "the images hardly overlap after it",
    })
}
