//! Matches between two cameras with any lens, scored and refined by their rays.

use super::RelativePose;
use super::essential::signed_depths;
use super::observed_matches::ObservedMatches;
use super::refine::flatten;
use super::refine_pose::{SampsonErrors, Steps, refine_pose};
use super::sampson::EntrySums;
use super::sight::{Candidate, Sight};
use crate::camera::{Observation, RigidTransform};
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss, Subset};
use crate::robust::{Data, MatchSet, Support};
use nalgebra::{Matrix3, Matrix3x2, SMatrix, SVector, Vector2, Vector3};

/// Maximum distance of rays that may be parallel, pixels.
const PARALLEL_PX: f64 = 2.0;

/// A match: two unit rays and their derivatives by the pixels.
#[derive(Debug, Clone, Copy)]
struct RayPair {
    rays: [Vector3<f64>; 2],
    by_px: [Matrix3x2<f64>; 2],
    /// Squared sine of the angle below which the rays may be parallel.
    noise_sq: f64,
}

impl RayPair {
    fn new(observations: [&Observation; 2]) -> Self {
        let by_px = observations.map(Observation::ray_by_px);
        // Half of the squared Frobenius norm is the mean over directions.
        let pixel_sq = 0.5 * (by_px[0].norm_squared() + by_px[1].norm_squared());
        Self {
            rays: observations.map(Observation::ray),
            by_px,
            noise_sq: (PARALLEL_PX * PARALLEL_PX * pixel_sq).min(1.0),
        }
    }

    /// Returns `x2ᵀ E x1`, and its derivatives by the two pixels.
    fn algebraic(&self, essential: &Matrix3<f64>) -> (f64, [Vector2<f64>; 2]) {
        let [x1, x2] = &self.rays;
        let (line2, line1) = (essential * x1, essential.tr_mul(x2));
        (
            x2.dot(&line2),
            [self.by_px[0].tr_mul(&line1), self.by_px[1].tr_mul(&line2)],
        )
    }

    /// Returns the squared Sampson error, px²; infinite for a ray through both centers, which is no
    /// evidence.
    fn sampson_sq(&self, essential: &Matrix3<f64>) -> f64 {
        let (algebraic, [by1, by2]) = self.algebraic(essential);
        let slope_sq = by1.norm_squared() + by2.norm_squared();
        match slope_sq > 0.0 {
            true => algebraic * algebraic / slope_sq,
            false => f64::INFINITY,
        }
    }

    /// Returns the signed Sampson error, px, and its derivatives by the entries of E, row by row:
    /// `r = C/√D`, `∂r/∂E = (∂C/∂E − (C/D) ½ ∂D/∂E)/√D`. `None` for a ray through both centers.
    fn linearized(&self, essential: &Matrix3<f64>) -> Option<(f64, SVector<f64, 9>)> {
        let (algebraic, [by1, by2]) = self.algebraic(essential);
        let slope_sq = by1.norm_squared() + by2.norm_squared();
        if slope_sq <= 0.0 {
            return None;
        }
        let [x1, x2] = &self.rays;
        let along = x2 * (self.by_px[0] * by1).transpose() + (self.by_px[1] * by2) * x1.transpose();
        let by_entries = x2 * x1.transpose() - along * (algebraic / slope_sq);
        let slope = slope_sq.sqrt();
        Some((algebraic / slope, flatten(&by_entries) / slope))
    }

    /// Returns whether the rays may meet in front of both cameras.
    fn in_front(&self, pose: &RelativePose) -> bool {
        let [x1, x2] = &self.rays;
        let (d1, d2) = signed_depths(&pose.rotation, &pose.direction, x1, x2);
        if d1 > 0.0 && d2 > 0.0 {
            return true;
        }
        // Far away both rays are parallel, up to noise.
        let rotated = pose.rotation * x1;
        rotated.dot(x2) > 0.0 && rotated.cross(x2).norm_squared() <= self.noise_sq
    }
}

/// Matches between two cameras with any lens. Errors are tangent Sampson errors, in the pixels of
/// the distorted images.
#[derive(Debug, Clone)]
pub(super) struct LensMatches {
    matches: MatchSet,
    pairs: Vec<RayPair>,
}

impl LensMatches {
    pub(super) fn new(observed: &ObservedMatches) -> Self {
        let [observations1, observations2] = &observed.observations;
        let both = observations1.iter().zip(observations2);
        Self {
            pairs: both.map(|(one, two)| RayPair::new([one, two])).collect(),
            matches: observed.matches.clone(),
        }
    }

    /// Returns the pose that minimizes the errors of some matches.
    pub(super) fn minimize(
        &self,
        used: Subset<'_>,
        start: &RelativePose,
        loss: RobustLoss,
        steps: &Steps,
        options: &LmOptions,
    ) -> Option<RelativePose> {
        let errors = RayErrors {
            pairs: &self.pairs,
            used,
            loss,
        };
        let pose = refine_pose(&errors, (start.rotation, start.direction), steps, options)?;
        Some(pose.into())
    }
}

impl Sight for LensMatches {
    fn candidate(&self, pose: RelativePose) -> Candidate {
        (pose, pose.essential())
    }

    fn error_sq(&self, (pose, essential): &Candidate, index: usize) -> f64 {
        let pair = &self.pairs[index];
        match pair.in_front(pose) {
            true => pair.sampson_sq(essential),
            false => f64::INFINITY,
        }
    }

    fn support(&self, candidate: &Candidate, max_error_px: f64, cost_limit: f64) -> Support {
        let error_sq = |i| self.error_sq(candidate, i);
        Data::Matches(&self.matches).support(error_sq, max_error_px, cost_limit)
    }

    fn inliers(&self, candidate: &Candidate, max_error_px: f64, inliers: &mut Vec<usize>) {
        let max_error_sq = max_error_px * max_error_px;
        inliers.clear();
        inliers
            .extend((0..self.pairs.len()).filter(|&i| self.error_sq(candidate, i) < max_error_sq));
    }

    fn refine(
        &mut self,
        (start, _): &Candidate,
        inliers: &[usize],
        max_error_px: f64,
        steps: &Steps,
    ) -> Option<Candidate> {
        let loss = RobustLoss::Truncated {
            width: max_error_px,
        };
        let used = Subset::alike(inliers);
        let pose = self.minimize(used, start, loss, steps, &LmOptions::few_steps(4))?;
        Some(self.candidate(pose))
    }

    fn polish(
        &self,
        (start, _): &Candidate,
        near: &[usize],
        weights: &[f64],
        steps: &Steps,
    ) -> Option<Candidate> {
        let (used, loss) = (Subset::weighted(near, weights), RobustLoss::Trivial);
        let pose = self.minimize(used, start, loss, steps, &LmOptions::few_steps(4))?;
        Some(self.candidate(pose))
    }

    /// Not implemented for these lenses.
    fn dominant_plane(
        &mut self,
        _: &Candidate,
        _: &[usize],
        _: f64,
        _: &mut Random,
    ) -> Option<Matrix3<f64>> {
        None
    }
}

/// The errors of some matches.
struct RayErrors<'a> {
    pairs: &'a [RayPair],
    used: Subset<'a>,
    loss: RobustLoss,
}

impl SampsonErrors for RayErrors<'_> {
    fn matrix(&self, essential: &Matrix3<f64>) -> Matrix3<f64> {
        *essential
    }

    fn linearize(&self, essential: &Matrix3<f64>) -> EntrySums {
        let mut sums = EntrySums {
            hessian: SMatrix::zeros(),
            gradient: SVector::zeros(),
            cost: 0.0,
        };
        for (index, root) in self.used.iter() {
            let Some((error_px, by_entries)) = self.pairs[index].linearized(essential) else {
                continue;
            };
            let (residual, row) = (error_px * root, by_entries * root);
            let weight = self.loss.weight(residual * residual);
            sums.cost += 0.5 * self.loss.rho(residual * residual);
            if weight > 0.0 {
                let weighted = row * weight;
                sums.gradient += weighted * residual;
                sums.hessian += weighted * row.transpose();
            }
        }
        sums
    }

    fn cost(&self, essential: &Matrix3<f64>) -> f64 {
        let mut total = 0.0;
        for (index, root) in self.used.iter() {
            let error_sq = self.pairs[index].sampson_sq(essential);
            if error_sq.is_finite() {
                total += 0.5 * self.loss.rho(root * root * error_sq);
            }
        }
        total
    }
}

/// Computes the tangent Sampson error of a match between cameras with any lens, pixels of both
/// images; infinite if the rays cannot meet in front of both cameras.
///
/// * `cam2_from_cam1`: the length of its translation does not matter
/// * `observation1`, `observation2`: observations of both cameras
///
/// Between pinhole cameras it is [`sampson_px`](super::sampson_px) up to terms of second order.
///
/// Source: Terekhov & Larsson 2023, "Tangent Sampson error: fast approximate two-view reprojection
/// error for central camera models".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::epipolar::tangent_sampson_px;
/// use nalgebra::Point2;
/// let camera = Camera::pinhole(Intrinsics::new(100.0, 100.0, 0.0, 0.0)?, 640, 480);
/// let right = RigidTransform::translation(-1.0, 0.0, 0.0);
/// let observation1 = camera.observe(&Point2::new(0.0, 0.0))?;
/// // A pixel that is too low by 2: each image is off by half of that.
/// let observation2 = camera.observe(&Point2::new(-5.0, 2.0))?;
/// assert!((tangent_sampson_px(&right, &observation1, &observation2) - 2.0_f64.sqrt()).abs() < 0.01);
/// // A point moves to the left when its camera moves to the right.
/// let observation2 = camera.observe(&Point2::new(50.0, 0.0))?;
/// assert_eq!(tangent_sampson_px(&right, &observation1, &observation2), f64::INFINITY);
/// # Ok(()) }
/// ```
pub fn tangent_sampson_px(
    cam2_from_cam1: &RigidTransform,
    observation1: &Observation,
    observation2: &Observation,
) -> f64 {
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
    let pose = RelativePose::from((rotation, cam2_from_cam1.translation.vector));
    let pair = RayPair::new([observation1, observation2]);
    match pair.in_front(&pose) {
        true => pair.sampson_sq(&pose.essential()).sqrt(),
        false => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, Lens, LensKind};
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector, Point2, Point3};

    #[test]
    fn derivatives_are_differences() {
        let camera = Camera {
            intrinsics: Intrinsics::new(250.0, 252.0, 400.0, 390.0).unwrap(),
            lens: Lens::from_coefficients(LensKind::Fisheye, &[-0.02, 0.004, -0.001, 0.0002])
                .unwrap(),
            width: 800,
            height: 780,
        };
        let truth = RigidTransform::new(Vector3::new(-0.9, 0.1, 0.4), Vector3::new(0.1, 0.3, -0.2));
        let essential = RelativePose::from_motion(&truth).unwrap().essential();
        let mut random = Random::new(4);
        for _ in 0..20 {
            let x = Point3::from(Vector3::from_fn(|_, _| random.normal()) + 2.0 * Vector3::z());
            let observations = [x, truth * x].map(|x| {
                let off = Vector2::from_fn(|_, _| random.normal());
                let pixel: Point2<f64> = camera.project(&x).unwrap() + off;
                camera.observe(&pixel).unwrap()
            });
            let pair = RayPair::new([&observations[0], &observations[1]]);
            let at = |delta: &DVector<f64>| {
                let moved = essential + Matrix3::from_row_slice(delta.as_slice());
                DVector::from_element(1, pair.linearized(&moved).unwrap().0)
            };
            let (error_px, by_entries) = pair.linearized(&essential).unwrap();
            assert!((error_px * error_px - pair.sampson_sq(&essential)).abs() < 1e-12);
            let analytic = DMatrix::from_row_slice(1, 9, by_entries.as_slice());
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-5 * (1.0 + analytic.amax()));
        }
    }
}
