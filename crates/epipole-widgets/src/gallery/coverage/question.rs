//! The job of `coverage`: a camera calibrated from the boards, and from the same boards with fresh
//! noise.

use super::boards::{self, Arrangement, FOCAL_PX, LENS, MIDDLE_PX, SIZE, noisy};
use crate::contract::{Problem, Progress};
use crate::kit::question::{self, tell};
use epipole::Error;
use epipole::calibration::{Board, BoardView, Calibration, CalibrationOptions, calibrate};
use epipole::camera::{Distortion, Lens};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Number of calibrations with fresh noise.
pub(super) const NUM_AGAIN: u64 = 8;
/// Number of radii of the distortion curve, from the principal point to the farthest corner.
pub(super) const NUM_RADII: usize = 41;

/// All inputs of the calibration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) boards: Arrangement,
    pub(super) seed: u64,
}

/// A calibrated camera.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    pub(super) focal_px: f64,
    /// One standard deviation of the focal length, as reported by the calibration, pixels.
    pub(super) focal_std_px: f64,
    /// Standard deviation of the focal length over the calibrations with fresh noise, pixels.
    pub(super) focal_scatter_px: f64,
    pub(super) rms_px: f64,
    /// Fraction of the image inside some board.
    pub(super) coverage: f64,
    /// For each radius: radial displacement by the lens, and its standard deviation over the
    /// calibrations with fresh noise, pixels.
    pub(super) curve: Vec<[f64; 2]>,
    /// Distance between the true and the estimated image of the ray in the farthest corner: root
    /// mean square over all calibrations, pixels. A single one may be right by luck.
    pub(super) corner_px: f64,
}

impl question::Question for Question {
    type Answer = Result<Found, String>;
    const LABEL: &'static str = "Calibrating";
    const FAILED: &'static str = "There is no camera";

    fn answer(&self, progress: Progress<'_>) -> Result<Self::Answer, Problem> {
        let (board, marks) = (boards::board()?, self.boards.marks()?);
        let first = match calibrated(&board, &noisy(&marks, self.seed_of(0))) {
            Ok(first) => first,
            Err(error) => return Ok(Err(error.to_string())),
        };
        let last = true_rays()[NUM_RADII - 1];
        let off_px = |found: &Calibration| seen_px(found, last) - FOCAL_PX * bent(&LENS, last);
        let (mut focals, mut curves) = (Vec::new(), Vec::new());
        let mut corners = vec![off_px(&first)];
        for again in 1..=NUM_AGAIN {
            tell(progress, again as f64 / (NUM_AGAIN + 1) as f64)?;
            if let Ok(other) = calibrated(&board, &noisy(&marks, self.seed_of(again))) {
                focals.push(other.camera.intrinsics.fu_px());
                curves.push(curve(&other));
                corners.push(off_px(&other));
            }
        }
        let sum_sq: f64 = corners.iter().map(|px| px * px).sum();
        let of_radius = |(index, px): (usize, f64)| {
            let others: Vec<f64> = curves.iter().map(|curve| curve[index]).collect();
            [px, deviation(&others)]
        };
        Ok(Ok(Found {
            focal_px: first.camera.intrinsics.fu_px(),
            focal_std_px: first.std_dev_k[0],
            focal_scatter_px: deviation(&focals),
            rms_px: first.rms_px,
            coverage: first.coverage,
            curve: curve(&first)
                .into_iter()
                .enumerate()
                .map(of_radius)
                .collect(),
            corner_px: (sum_sq / corners.len() as f64).sqrt(),
        }))
    }

    fn fits(&self, answer: &Self::Answer) -> bool {
        let is_sound = |found: &Found| {
            let numbers = [
                found.focal_px,
                found.focal_std_px,
                found.focal_scatter_px,
                found.rms_px,
                found.corner_px,
            ];
            let curve = found.curve.as_flattened();
            curve.len() == 2 * NUM_RADII && numbers.iter().chain(curve).all(|px| px.is_finite())
        };
        answer.as_ref().map_or(true, is_sound)
    }
}

impl Question {
    /// Returns the seed of a calibration's noise; no two seeds of the figure share one.
    fn seed_of(&self, again: u64) -> u64 {
        self.seed * (NUM_AGAIN + 1) + again
    }
}

fn calibrated(board: &Board, views: &[Option<BoardView>]) -> Result<Calibration, Error> {
    calibrate(board, views, SIZE, &CalibrationOptions::default(), &mut ())
}

/// Returns the distance from the principal point to the farthest corner, pixels.
pub(super) fn farthest_px() -> f64 {
    let corner = Point2::new(-0.5, f64::from(SIZE.1) - 0.5);
    (corner - Point2::from(MIDDLE_PX)).norm()
}

/// Returns the radii of the curve in the image, pixels.
pub(super) fn radii_px() -> [f64; NUM_RADII] {
    std::array::from_fn(|index| farthest_px() * index as f64 / (NUM_RADII - 1) as f64)
}

/// Returns the tangents of the angles from the axis of the rays that appear at these radii.
fn true_rays() -> [f64; NUM_RADII] {
    radii_px().map(|px| {
        let ray = LENS.undistort(&Point2::new(px / FOCAL_PX, 0.0));
        ray.map_or(px / FOCAL_PX, |ray| ray.x)
    })
}

/// Returns the distorted radius of a ray, by the radial coefficients alone.
fn bent(lens: &Distortion, radius: f64) -> f64 {
    let radial = Distortion {
        p1: 0.0,
        p2: 0.0,
        ..*lens
    };
    radial.distort(&Point2::new(radius, 0.0)).x
}

/// Returns the estimated distance of a ray's image from the principal point, pixels.
fn seen_px(found: &Calibration, radius: f64) -> f64 {
    let focal_px = found.camera.intrinsics.fu_px();
    match &found.camera.lens {
        Lens::Brown(lens) => focal_px * bent(lens, radius),
        _ => focal_px * radius,
    }
}

/// Returns the radial displacement by the estimated lens of each true ray, pixels.
fn curve(found: &Calibration) -> [f64; NUM_RADII] {
    let focal_px = found.camera.intrinsics.fu_px();
    true_rays().map(|radius| seen_px(found, radius) - focal_px * radius)
}

/// Returns the radial displacement by the true lens, pixels.
pub(super) fn true_curve() -> [f64; NUM_RADII] {
    true_rays().map(|radius| FOCAL_PX * (bent(&LENS, radius) - radius))
}

/// Returns the standard deviation of a sample; 0 for fewer than two values.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count.max(1.0);
    let sum_sq: f64 = values
        .iter()
        .map(|value| (value - mean) * (value - mean))
        .sum();
    (sum_sq / (count - 1.0).max(1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::Question as _;
    use std::ops::ControlFlow;

    #[test]
    fn the_true_curve_follows_the_lens_formula() {
        let (radii, curve) = (radii_px(), true_curve());
        for (px, moved_px) in radii.into_iter().zip(curve) {
            // The ray appears at `px`; without the lens it would appear this far from the middle.
            let straight = (px - moved_px) / FOCAL_PX;
            let squared = straight * straight;
            let factor = 1.0 - 0.25 * squared + 0.08 * squared * squared;
            assert!((FOCAL_PX * straight * factor - px).abs() < 1e-6, "{px}");
        }
    }

    #[test]
    fn the_scatter_of_calibrations_is_what_each_reports() {
        let boards = Arrangement {
            place: [320.0, 240.0],
            spread: 1.0,
            tilt_deg: 30.0,
            one_way: false,
            num_views: 6,
        };
        let question = Question { boards, seed: 2 };
        let answer = question.answer(&mut |_| ControlFlow::Continue(())).unwrap();
        assert!(question.fits(&answer));
        let found = answer.unwrap();
        let ratio = found.focal_scatter_px / found.focal_std_px;
        assert!((0.5..1.8).contains(&ratio), "{ratio}");
    }
}
