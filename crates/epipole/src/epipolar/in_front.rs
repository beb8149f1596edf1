//! Scoring of relative poses: matches near their epipolar lines and in front of both cameras.

use super::coordinates::{Coordinates, LANES, Lanes, entries};
use super::judge::{self, LaneErrors};
use super::sampson::Sampson;
use super::sight::Candidate;
use crate::camera::Intrinsics;
use crate::math::simd::dispatched;
use crate::robust::Support;
use nalgebra::Matrix3;

/// Pixels to rays: K⁻¹ of both images, and the angle of a pixel.
#[derive(Debug, Clone)]
pub(crate) struct Lenses {
    inverse1: Matrix3<f64>,
    inverse2: Matrix3<f64>,
    /// Root of the sum of squares over both images, radians per pixel, in the middle of the image.
    pixel_rad: f64,
}

impl Lenses {
    pub(crate) fn new(k1: &Intrinsics, k2: &Intrinsics) -> Self {
        let pixel_sq = |k: &Intrinsics| 1.0 / (k.fu_px() * k.fv_px());
        Self {
            inverse1: k1.inverse_matrix(),
            inverse2: k2.inverse_matrix(),
            pixel_rad: (pixel_sq(k1) + pixel_sq(k2)).sqrt(),
        }
    }

    /// Prepares a pose and its F for scoring matches with a threshold.
    pub(crate) fn judge(&self, (pose, fundamental): &Candidate, max_error_px: f64) -> PoseJudge {
        let margin_rad = max_error_px * self.pixel_rad;
        PoseJudge {
            sampson: Sampson(entries(fundamental)),
            rotated1: entries(&(pose.rotation * self.inverse1)),
            ray2: entries(&self.inverse2),
            direction: [pose.direction.x, pose.direction.y, pose.direction.z],
            margin_sq: (margin_rad * margin_rad).min(1.0),
        }
    }
}

/// Scores a relative pose by the errors of pixels.
///
/// With a = R K₁⁻¹ x₁ and b = K₂⁻¹ x₂, both in the frame of camera 2, the rays meet in front of
/// both cameras if b lies between a and t: rotated from a towards t, but not beyond. Far away a and
/// b are equal up to noise, so b may be outside by the angle of the threshold.
pub(crate) struct PoseJudge {
    sampson: Sampson,
    rotated1: [f64; 9],
    ray2: [f64; 9],
    direction: [f64; 3],
    margin_sq: f64,
}

impl PoseJudge {
    /// Returns, for each of eight matches, whether the rays may meet in front of both cameras.
    #[inline(always)]
    fn in_front(&self, [u1, v1, u2, v2]: &[Lanes; 4]) -> [bool; LANES] {
        let (m, k, t) = (&self.rotated1, &self.ray2, &self.direction);
        let mut in_front = [false; LANES];
        for l in 0..LANES {
            let a = [0, 3, 6].map(|row| m[row] * u1[l] + m[row + 1] * v1[l] + m[row + 2]);
            let b = [k[0] * u2[l] + k[1] * v2[l] + k[2], k[4] * v2[l] + k[5], 1.0];
            let (aa, bb, ab) = (dot(&a, &a), dot(&b, &b), dot(&a, &b));
            let (at, bt) = (dot(&a, t), dot(&b, t));
            // |a|²|b| times the sine of the angle from a to b, positive towards t, and times the
            // sine of the angle between a and t; and the same from b to a, away from t.
            let (from_a, from_b) = (aa * bt - ab * at, ab * bt - bb * at);
            let within = self.margin_sq * aa * bb;
            // |t| = 1.
            let a_in_front = from_a > 0.0 || from_a * from_a <= within * (aa - at * at);
            let b_in_front = from_b > 0.0 || from_b * from_b <= within * (bb - bt * bt);
            in_front[l] = a_in_front && b_in_front;
        }
        in_front
    }
}

#[inline(always)]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl LaneErrors for PoseJudge {
    /// Errors of points behind a camera are infinite.
    #[inline(always)]
    fn relative_errors(&self, lanes: &[Lanes; 4], per_threshold_sq: f64) -> Lanes {
        let mut errors = self.sampson.relative_errors(lanes, per_threshold_sq);
        if errors.iter().any(|error| *error < 1.0) {
            for (error, in_front) in errors.iter_mut().zip(self.in_front(lanes)) {
                *error = if in_front { *error } else { f64::INFINITY };
            }
        }
        errors
    }
}

dispatched! {
    /// Returns the support of a pose among the matches, in pixels; stops once the cost exceeds the
    /// limit.
    pub(crate) fn support(
        coordinates: &Coordinates,
        pose: &PoseJudge,
        max_error_px: f64,
        cost_limit: f64,
    ) -> Support {
        judge::support(pose, coordinates, max_error_px, cost_limit)
    }
}

dispatched! {
    /// Fills `inliers` with the matches within the threshold and in front of both cameras.
    pub(crate) fn inliers(
        coordinates: &Coordinates,
        pose: &PoseJudge,
        max_error_px: f64,
        inliers: &mut Vec<usize>,
    ) {
        judge::inliers(pose, coordinates, max_error_px, inliers);
    }
}

dispatched! {
    /// Fills `factors` with 1 for each match in front of both cameras and 0 for the others; returns
    /// whether there are any others.
    pub(crate) fn mark(
        coordinates: &Coordinates,
        pose: &PoseJudge,
        factors: &mut Vec<f64>,
    ) -> bool {
        factors.clear();
        for start in (0..coordinates.len()).step_by(LANES) {
            let (lanes, count) = coordinates.lanes(start);
            let in_front = pose.in_front(lanes);
            factors.extend(in_front[..count].iter().map(|is| f64::from(u8::from(*is))));
        }
        factors.contains(&0.0)
    }
}
