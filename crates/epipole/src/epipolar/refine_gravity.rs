//! Nonlinear refinement of a relative pose whose rotation keeps gravity where it is.

use super::RelativePose;
use super::coordinates::Coordinates;
use super::refine::{flatten, project};
use super::refine_pose::{Pose, RaysInFrame, essential_derivatives, moved_pose, orthogonal};
use super::sampson::{cost, linearize};
use crate::camera::cross_matrix;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

struct UprightProblem<'a> {
    coordinates: &'a Coordinates,
    rays: &'a RaysInFrame,
    /// In the frame of camera 2, of length 1.
    gravity2: &'a Vector3<f64>,
    loss: RobustLoss,
}

impl UprightProblem<'_> {
    fn fundamental(&self, (rotation, direction): &Pose) -> Matrix3<f64> {
        self.rays.fundamental(&(cross_matrix(direction) * rotation))
    }

    /// The steps of a free pose: a turn about gravity, and two of the direction.
    fn free(&self) -> SMatrix<f64, 5, 3> {
        let g = self.gravity2;
        #[rustfmt::skip]
        let free = SMatrix::<f64, 5, 3>::new(
            g.x, 0.0, 0.0,
            g.y, 0.0, 0.0,
            g.z, 0.0, 0.0,
            0.0, 1.0, 0.0,
            0.0, 0.0, 1.0,
        );
        free
    }

    /// Of the entries of F.
    fn derivatives(&self, (rotation, direction): &Pose) -> SMatrix<f64, 9, 3> {
        let mut d = SMatrix::<f64, 9, 5>::zeros();
        let essentials = essential_derivatives(rotation, direction);
        for (i, essential) in essentials.iter().enumerate() {
            d.set_column(i, &flatten(&self.rays.fundamental(essential)));
        }
        d * self.free()
    }
}

impl FixedProblem<3> for UprightProblem<'_> {
    type Parameters = Pose;

    fn accumulate(&self, pose: &Pose, normal: &mut NormalEquations<3>) {
        let sums = linearize(self.coordinates, &self.fundamental(pose), &self.loss);
        project(&sums, &self.derivatives(pose), normal);
    }

    fn cost(&self, pose: &Pose) -> f64 {
        cost(self.coordinates, &self.fundamental(pose), &self.loss)
    }

    fn plus(&self, pose: &Pose, delta: &SVector<f64, 3>) -> Pose {
        moved_pose(pose, &(self.free() * delta))
    }
}

/// Refines a relative pose in the frame of the coordinates, and keeps what it makes of gravity.
pub(super) fn refine_upright_in_frame(
    coordinates: &Coordinates,
    rays: &RaysInFrame,
    start: &RelativePose,
    gravity2: &Vector3<f64>,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Pose> {
    let mut pose = (start.rotation, start.direction);
    let problem = UprightProblem {
        coordinates,
        rays,
        gravity2,
        loss,
    };
    minimize_fixed(&problem, &mut pose, options).ok()?;
    orthogonal(&pose)
}

#[cfg(test)]
mod tests {
    use super::super::coordinates::CommonFrame;
    use super::*;
    use crate::camera::Intrinsics;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use crate::robust::MatchSet;
    use nalgebra::{DMatrix, DVector, Point2, Rotation3};

    #[test]
    fn derivatives_agree_with_differences_and_gravity_stays() {
        let mut random = Random::new(5);
        for _ in 0..20 {
            let mut pixels = || -> Vec<_> {
                (0..20)
                    .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
                    .collect()
            };
            let matches = MatchSet::new(&pixels(), &pixels()).unwrap();
            let frame = CommonFrame::new(&matches);
            let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
            let gravity2 = Vector3::from_fn(|_, _| random.normal()).normalize();
            let problem = UprightProblem {
                coordinates: &Coordinates::pixels(&matches).mapped(&frame),
                rays: &RaysInFrame::new(&frame, &k, &k),
                gravity2: &gravity2,
                loss: RobustLoss::Trivial,
            };
            let turn = Vector3::from_fn(|_, _| random.normal());
            let rotation = Rotation3::from_scaled_axis(turn).into_inner();
            let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
            let pose = (rotation, direction);
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 3>::from_column_slice(delta.as_slice());
                let f = problem.fundamental(&problem.plus(&pose, &delta));
                DVector::from_column_slice(flatten(&f).as_slice())
            };
            let analytic = problem.derivatives(&pose);
            let analytic = DMatrix::from_column_slice(9, 3, analytic.as_slice());
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6 * (1.0 + analytic.amax()));
            let gravity1 = rotation.transpose() * gravity2;
            let moved = problem.plus(&pose, &SVector::<f64, 3>::new(0.3, -0.2, 0.1));
            assert!((moved.0 * gravity1 - gravity2).norm() < 1e-12);
        }
    }
}
