//! Nonlinear refinement of a relative pose: minimizes the Sampson error by Levenberg–Marquardt.

use super::coordinates::{CommonFrame, Coordinates};
use super::refine::{flatten, project};
use super::sampson::{EntrySums, cost, linearize};
use crate::camera::{Intrinsics, cross_matrix};
use crate::math::nearest_orthogonal;
use crate::math::svd3::perpendicular;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Vector3};

/// Sampson errors of some matches, as functions of a matrix.
pub(super) trait SampsonErrors {
    /// Returns the matrix for the errors of a motion; linear in its essential matrix.
    fn matrix(&self, essential: &Matrix3<f64>) -> Matrix3<f64>;

    /// Returns the errors and their derivatives by the entries of the matrix.
    fn linearize(&self, matrix: &Matrix3<f64>) -> EntrySums;

    /// Returns `½ Σ ρ(e²)`.
    fn cost(&self, matrix: &Matrix3<f64>) -> f64;
}

/// Map from rays to coordinates of the common frame: `F = A2ᵀ E A1`.
#[derive(Debug, Clone)]
pub(crate) struct RaysInFrame {
    a1: Matrix3<f64>,
    a2t: Matrix3<f64>,
}

impl RaysInFrame {
    pub(crate) fn new(frame: &CommonFrame, k1: &Intrinsics, k2: &Intrinsics) -> Self {
        Self {
            a1: k1.inverse_matrix() * frame.frame_to_pixels(0),
            a2t: (k2.inverse_matrix() * frame.frame_to_pixels(1)).transpose(),
        }
    }

    /// Converts a homography of the frame to rays.
    pub(super) fn ray_homography(&self, in_frame: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        Some(self.a2t.transpose() * in_frame * self.a1.try_inverse()?)
    }
}

/// The errors of pinhole cameras, in the common frame.
pub(super) struct ErrorsInFrame<'a> {
    pub(super) coordinates: &'a Coordinates,
    pub(super) rays: &'a RaysInFrame,
    pub(super) loss: RobustLoss,
}

impl SampsonErrors for ErrorsInFrame<'_> {
    fn matrix(&self, essential: &Matrix3<f64>) -> Matrix3<f64> {
        self.rays.a2t * essential * self.rays.a1
    }

    fn linearize(&self, fundamental: &Matrix3<f64>) -> EntrySums {
        linearize(self.coordinates, fundamental, &self.loss)
    }

    fn cost(&self, fundamental: &Matrix3<f64>) -> f64 {
        cost(self.coordinates, fundamental, &self.loss)
    }
}

/// Rotation and direction of a motion.
pub(super) type Pose = (Matrix3<f64>, Vector3<f64>);

/// Returns two unit vectors that span the plane perpendicular to a unit vector.
fn tangent_plane(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = perpendicular(direction);
    [first, direction.cross(&first)]
}

/// Returns the derivatives of E = [t]ₓR by a rotation from the left, `R ← exp([δ]ₓ) R`, and by
/// steps of t in its tangent plane.
pub(crate) fn essential_derivatives(
    rotation: &Matrix3<f64>,
    direction: &Vector3<f64>,
) -> [Matrix3<f64>; 5] {
    let t = cross_matrix(direction);
    let [b1, b2] = tangent_plane(direction);
    [
        t * cross_matrix(&Vector3::x()) * rotation,
        t * cross_matrix(&Vector3::y()) * rotation,
        t * cross_matrix(&Vector3::z()) * rotation,
        cross_matrix(&b1) * rotation,
        cross_matrix(&b2) * rotation,
    ]
}

/// Free directions of a pose in refinement.
#[derive(Debug, Clone, Copy)]
pub(super) enum Steps {
    /// All five.
    Free,
    /// Rotation about gravity, a unit vector in the frame of camera 2, and the direction of t.
    AboutGravity(Vector3<f64>),
}

impl Steps {
    fn about_gravity(g: &Vector3<f64>) -> SMatrix<f64, 5, 3> {
        #[rustfmt::skip]
        let steps = SMatrix::<f64, 5, 3>::new(
            g.x, 0.0, 0.0,
            g.y, 0.0, 0.0,
            g.z, 0.0, 0.0,
            0.0, 1.0, 0.0,
            0.0, 0.0, 1.0,
        );
        steps
    }
}

/// A pose with steps along N directions, the columns of `steps`.
struct PoseProblem<'a, E, const N: usize> {
    errors: &'a E,
    steps: SMatrix<f64, 5, N>,
}

impl<E: SampsonErrors, const N: usize> PoseProblem<'_, E, N> {
    fn matrix(&self, (rotation, direction): &Pose) -> Matrix3<f64> {
        self.errors.matrix(&(cross_matrix(direction) * rotation))
    }

    /// Returns the derivatives of the matrix's entries.
    fn derivatives(&self, (rotation, direction): &Pose) -> SMatrix<f64, 9, N> {
        let mut free = SMatrix::<f64, 9, 5>::zeros();
        for (i, essential) in essential_derivatives(rotation, direction)
            .iter()
            .enumerate()
        {
            free.set_column(i, &flatten(&self.errors.matrix(essential)));
        }
        free * self.steps
    }
}

impl<E: SampsonErrors, const N: usize> FixedProblem<N> for PoseProblem<'_, E, N> {
    type Parameters = Pose;

    fn accumulate(&self, pose: &Pose, normal: &mut NormalEquations<N>) {
        let sums = self.errors.linearize(&self.matrix(pose));
        project(&sums, &self.derivatives(pose), normal);
    }

    fn cost(&self, pose: &Pose) -> f64 {
        self.errors.cost(&self.matrix(pose))
    }

    fn plus(&self, pose: &Pose, delta: &SVector<f64, N>) -> Pose {
        moved_pose(pose, &(self.steps * delta))
    }
}

/// Moves a pose; parameters as in [`essential_derivatives`].
pub(super) fn moved_pose((rotation, direction): &Pose, delta: &SVector<f64, 5>) -> Pose {
    let delta_rotation = Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
    let [b1, b2] = tangent_plane(direction);
    (
        delta_rotation.into_inner() * rotation,
        (direction + b1 * delta[3] + b2 * delta[4]).normalize(),
    )
}

/// Refines an initial pose; `None` if its cost is not finite.
pub(super) fn refine_pose(
    errors: &impl SampsonErrors,
    start: Pose,
    steps: &Steps,
    options: &LmOptions,
) -> Option<Pose> {
    match steps {
        Steps::Free => minimize_pose(errors, start, SMatrix::<f64, 5, 5>::identity(), options),
        Steps::AboutGravity(g) => minimize_pose(errors, start, Steps::about_gravity(g), options),
    }
}

fn minimize_pose<const N: usize>(
    errors: &impl SampsonErrors,
    start: Pose,
    steps: SMatrix<f64, 5, N>,
    options: &LmOptions,
) -> Option<Pose> {
    let mut pose = start;
    minimize_fixed(&PoseProblem { errors, steps }, &mut pose, options).ok()?;
    orthogonal(&pose)
}

/// Restores orthogonality, which products of many rotations lose.
pub(super) fn orthogonal((rotation, direction): &Pose) -> Option<Pose> {
    let rotation = nearest_orthogonal(rotation);
    let mut entries = rotation.iter().chain(direction.iter());
    entries
        .all(|x| x.is_finite())
        .then_some((rotation, *direction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use crate::robust::MatchSet;
    use nalgebra::{DMatrix, DVector, Point2};

    fn check_derivatives<const N: usize>(
        errors: &ErrorsInFrame<'_>,
        steps: SMatrix<f64, 5, N>,
        pose: &Pose,
    ) -> Pose {
        let problem = PoseProblem { errors, steps };
        let at = |delta: &DVector<f64>| {
            let delta = SVector::<f64, N>::from_column_slice(delta.as_slice());
            let f = problem.matrix(&problem.plus(pose, &delta));
            DVector::from_column_slice(flatten(&f).as_slice())
        };
        let analytic = DMatrix::from_column_slice(9, N, problem.derivatives(pose).as_slice());
        assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6 * (1.0 + analytic.amax()));
        problem.plus(pose, &SVector::from_fn(|i, _| 0.3 - 0.2 * i as f64))
    }

    #[test]
    fn derivatives_agree_with_differences_and_gravity_stays() {
        let mut random = Random::new(2);
        for _ in 0..20 {
            let mut pixels = || -> Vec<_> {
                (0..20)
                    .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
                    .collect()
            };
            let matches = MatchSet::new(&pixels(), &pixels()).unwrap();
            let frame = CommonFrame::new(&matches);
            let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
            let errors = ErrorsInFrame {
                coordinates: &Coordinates::pixels(&matches).mapped(&frame),
                rays: &RaysInFrame::new(&frame, &k, &k),
                loss: RobustLoss::Trivial,
            };
            let axis = Vector3::from_fn(|_, _| random.normal());
            let rotation = Rotation3::from_scaled_axis(axis).into_inner();
            let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
            let pose = (rotation, direction);
            check_derivatives(&errors, SMatrix::<f64, 5, 5>::identity(), &pose);
            let gravity2 = Vector3::from_fn(|_, _| random.normal()).normalize();
            let moved = check_derivatives(&errors, Steps::about_gravity(&gravity2), &pose);
            let gravity1 = rotation.transpose() * gravity2;
            assert!((moved.0 * gravity1 - gravity2).norm() < 1e-12);
        }
    }
}
