//! Nonlinear refinement of a relative pose with the common focal length of both cameras.

use super::RelativePose;
use super::coordinates::{CommonFrame, Coordinates};
use super::refine::{flatten, project};
use super::refine_pose::{Pose, essential_derivatives, moved_pose, orthogonal};
use super::sampson::{cost, linearize};
use crate::camera::cross_matrix;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Matrix3, Point2, SMatrix, SVector, Vector3};

/// Map from rays of cameras with a common focal length to coordinates of the common frame.
#[derive(Debug, Clone)]
pub(crate) struct FocalCenters {
    /// Maps from the frame to pixels about the principal point, for images 1 and 2.
    about: [Matrix3<f64>; 2],
}

impl FocalCenters {
    pub(crate) fn new(frame: &CommonFrame, centers: &[Point2<f64>; 2]) -> Self {
        let about = |image: usize| {
            let c = &centers[image];
            let shift = Matrix3::new(1.0, 0.0, -c.x, 0.0, 1.0, -c.y, 0.0, 0.0, 1.0);
            shift * frame.frame_to_pixels(image)
        };
        Self {
            about: [0, 1].map(about),
        }
    }

    /// Computes `F = A2ᵀ D E D A1`, D = diag(1, 1, f): K⁻¹ times f, since the scale of F is
    /// arbitrary.
    fn fundamental(&self, essential: &Matrix3<f64>, focal_px: f64) -> Matrix3<f64> {
        let d = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, focal_px));
        self.about[1].transpose() * (d * essential * d) * self.about[0]
    }

    /// Returns its derivative by log f.
    fn by_log_focal(&self, essential: &Matrix3<f64>, focal_px: f64) -> Matrix3<f64> {
        let d = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, focal_px));
        let slope = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, focal_px));
        let inner = slope * essential * d + d * essential * slope;
        self.about[1].transpose() * inner * self.about[0]
    }
}

struct FocalProblem<'a> {
    coordinates: &'a Coordinates,
    centers: &'a FocalCenters,
    loss: RobustLoss,
}

impl FocalProblem<'_> {
    fn fundamental(&self, ((rotation, direction), focal_px): &(Pose, f64)) -> Matrix3<f64> {
        let essential = cross_matrix(direction) * rotation;
        self.centers.fundamental(&essential, *focal_px)
    }

    /// Returns the derivatives of F's entries with respect to the five parameters of the pose and
    /// log f.
    fn derivatives(&self, ((rotation, direction), focal_px): &(Pose, f64)) -> SMatrix<f64, 9, 6> {
        let mut d = SMatrix::<f64, 9, 6>::zeros();
        for (i, essential) in essential_derivatives(rotation, direction)
            .iter()
            .enumerate()
        {
            d.set_column(i, &flatten(&self.centers.fundamental(essential, *focal_px)));
        }
        let essential = cross_matrix(direction) * rotation;
        d.set_column(
            5,
            &flatten(&self.centers.by_log_focal(&essential, *focal_px)),
        );
        d
    }
}

impl FixedProblem<6> for FocalProblem<'_> {
    type Parameters = (Pose, f64);

    fn accumulate(&self, model: &(Pose, f64), normal: &mut NormalEquations<6>) {
        let sums = linearize(self.coordinates, &self.fundamental(model), &self.loss);
        project(&sums, &self.derivatives(model), normal);
    }

    fn cost(&self, model: &(Pose, f64)) -> f64 {
        cost(self.coordinates, &self.fundamental(model), &self.loss)
    }

    fn plus(&self, (pose, focal_px): &(Pose, f64), delta: &SVector<f64, 6>) -> (Pose, f64) {
        let moved = moved_pose(pose, &delta.fixed_rows::<5>(0).into_owned());
        (moved, focal_px * libm::exp(delta[5]))
    }
}

/// Returns the relative standard deviation of the focal length, from the errors and their
/// dependence on all six parameters. `None` if they do not determine it.
///
/// * `num_matches`: number of matches in the coordinates, all inliers
pub(crate) fn relative_focal_deviation(
    coordinates: &Coordinates,
    num_matches: usize,
    centers: &FocalCenters,
    (pose, focal_px): (&RelativePose, f64),
) -> Option<f64> {
    let problem = FocalProblem {
        coordinates,
        centers,
        loss: RobustLoss::Trivial,
    };
    let mut normal = NormalEquations::new();
    problem.accumulate(&((pose.rotation, pose.direction), focal_px), &mut normal);
    let variance = 2.0 * normal.cost / num_matches.checked_sub(6).filter(|n| *n > 0)? as f64;
    let inverse = normal.hessian.cholesky()?.inverse();
    let deviation = (variance * inverse[(5, 5)]).sqrt();
    deviation.is_finite().then_some(deviation)
}

/// Refines a relative pose together with the common focal length of both cameras.
pub(crate) fn refine_pose_and_focal_in_frame(
    coordinates: &Coordinates,
    centers: &FocalCenters,
    (start, focal_px): (&RelativePose, f64),
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<(Pose, f64)> {
    let mut model = ((start.rotation, start.direction), focal_px);
    let problem = FocalProblem {
        coordinates,
        centers,
        loss,
    };
    minimize_fixed(&problem, &mut model, options).ok()?;
    Some((orthogonal(&model.0)?, model.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use crate::robust::MatchSet;
    use nalgebra::{DMatrix, DVector, Rotation3};

    #[test]
    fn derivatives_by_pose_and_log_focal_agree_with_differences() {
        let mut random = Random::new(5);
        for _ in 0..20 {
            let mut pixels = || -> Vec<_> {
                (0..20)
                    .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
                    .collect()
            };
            let matches = MatchSet::new(&pixels(), &pixels()).unwrap();
            let frame = CommonFrame::new(&matches);
            let middles = [Point2::new(310.0, 245.0), Point2::new(330.0, 236.0)];
            let problem = FocalProblem {
                coordinates: &Coordinates::pixels(&matches).mapped(&frame),
                centers: &FocalCenters::new(&frame, &middles),
                loss: RobustLoss::Trivial,
            };
            let rotation_vector = Vector3::from_fn(|_, _| 0.3 * random.normal());
            let rotation = Rotation3::from_scaled_axis(rotation_vector).into_inner();
            let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
            let model = ((rotation, direction), random.uniform(300.0, 1500.0));
            // F has entries of millions of px²: scale to 1 for finite differences.
            let scale = 1.0 / problem.fundamental(&model).amax();
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 6>::from_column_slice(delta.as_slice());
                let f = problem.fundamental(&problem.plus(&model, &delta)) * scale;
                DVector::from_column_slice(flatten(&f).as_slice())
            };
            let analytic = problem.derivatives(&model) * scale;
            let analytic = DMatrix::from_column_slice(9, 6, analytic.as_slice());
            // The focal length must have an effect, or its column would prove nothing.
            assert!(analytic.column(5).amax() > 1e-3);
            let off = check_jacobian(&analytic, &at, 1e-6);
            assert!(off < 1e-7, "{off:e}");
        }
    }
}
