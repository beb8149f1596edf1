//! Sub-pixel refinement of a corner of four squares.

use super::crossing::{Insets, fit_crossing};
use crate::Result;
use crate::feature::{RefineOptions, refine_corners};
use crate::imaging::GrayImage32;
use nalgebra::{Point2, Vector2};

const WINDOWS: (usize, usize) = (2, 15);
const DISKS_PX: (f64, f64) = (3.0, 15.0);
/// Maximum difference of the two refinements, relative to the distance to the nearest mark; if
/// larger, another object is in the disk.
const AGREEMENT: f64 = 0.05;
const LEAST_AGREEMENT_PX: f64 = 0.5;

/// Image regions of a refinement, relative to the distance to the nearest mark.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// Half the side of the window of the gradient-based refinement.
    window: f64,
    /// Radius of the disk in which the edges are fitted.
    disk: f64,
    /// Maximum distance from the start.
    stay: f64,
}

/// Reach around marks with nothing but four squares: the disk stays within them.
pub(super) const CLEAR_SQUARES: Reach = Reach {
    window: 0.3,
    disk: 0.45,
    stay: 0.25,
};

/// Radius of a disk relative to the distance of what must stay outside, as blur widens it.
const OF_CLEAR: f64 = 0.75;

impl Reach {
    /// Returns the reach around marks beside markers.
    ///
    /// * `clear`: distance from a mark to the nearest edge other than its own two, relative to the
    ///   distance to the nearest mark
    /// * `clear_beside_insets`: the same if the edges of insets do not count
    pub(super) fn within(clear: f64, clear_beside_insets: f64) -> Self {
        let disk = |clear: f64| (OF_CLEAR * clear).min(CLEAR_SQUARES.disk);
        Self {
            // A window is wider at its corners.
            window: (0.8 * disk(clear)).min(CLEAR_SQUARES.window),
            disk: disk(clear_beside_insets),
            stay: clear.min(CLEAR_SQUARES.stay),
        }
    }

    /// Returns the radius of the disk, pixels.
    pub(super) fn disk_px(&self, spacing: f64) -> f64 {
        (self.disk * spacing).clamp(DISKS_PX.0, DISKS_PX.1)
    }
}

/// Refines the corner near a pixel: by gradients, unless there are insets, and from there by two
/// edges fitted to the gray values. `None` if there is none, or another object is near.
///
/// * `edges`: approximate directions of the two edges
/// * `spacing`: distance to the nearest mark, pixels
pub(super) fn refine_mark(
    image: &GrayImage32,
    pixel: &Point2<f64>,
    edges: [Vector2<f64>; 2],
    spacing: f64,
    reach: &Reach,
    insets: Option<Insets>,
) -> Result<Option<Point2<f64>>> {
    // Gradients at insets, which blur blends with the edges, would pull the start away.
    let start = match insets {
        Some(_) => Some(*pixel),
        None => by_gradients(image, pixel, spacing, reach)?,
    };
    // A corner that the edges do not confirm may be the rim of an occluder.
    Ok(start.and_then(|start| {
        let agreement = match insets {
            Some(_) => reach.stay,
            None => AGREEMENT,
        };
        let agreement_px = (agreement * spacing).max(LEAST_AGREEMENT_PX);
        fit_crossing(image, &start, edges, reach.disk_px(spacing), insets)
            .filter(|place| (place - start).norm() <= agreement_px)
    }))
}

/// Refines the corner near a pixel by gradients.
fn by_gradients(
    image: &GrayImage32,
    pixel: &Point2<f64>,
    spacing: f64,
    reach: &Reach,
) -> Result<Option<Point2<f64>>> {
    let options = RefineOptions {
        half_window: ((reach.window * spacing) as usize).clamp(WINDOWS.0, WINDOWS.1),
        max_iterations: 60,
        tolerance_px: 1e-4,
    };
    let refined = refine_corners(image, &[*pixel], &options, &mut ())?[0];
    Ok(refined.filter(|refined| (refined - pixel).norm() < reach.stay * spacing))
}
