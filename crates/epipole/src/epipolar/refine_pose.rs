//! Nonlinear refinement of a relative pose: the Sampson error by Levenberg–Marquardt.

use super::RelativePose;
use super::coordinates::{CommonFrame, Coordinates};
use super::refine::{NO_ERROR_AT_THE_START, flatten, project, scaled};
use super::sampson::{cost, linearize};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Intrinsics, cross_matrix};
use crate::math::nearest_orthogonal;
use crate::math::svd3::perpendicular;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use crate::robust::MatchSet;
use nalgebra::{Matrix3, Point2, Rotation3, SMatrix, SVector, Vector3};

/// The relative pose near `pose` that minimizes `½ Σ ρ(e²)` over the matches, where e is the Sampson
/// error in pixels.
///
/// The rotation and the direction of the translation, five parameters, are refined.
///
/// # Errors
/// [`Error::TooFew`] for fewer than 5 different matches, [`Error::OutOfRange`] for a loss that
/// [`RobustLoss::check`] refuses, [`Error::NotFinite`] for a start whose error is not a number at some
/// match, and as [`MatchSet::new`]; infinities and coordinates beyond 10⁹ pixels are refused, as every match
/// counts.
///
/// Source: Hartley & Zisserman 2004, §11.4.3, with `E = [t]ₓR` instead of F.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{RelativePose, refine_relative_pose};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // A start that is off by 0.05 rad and looks straight to the side.
/// let start = RigidTransform::new(Vector3::new(-1.0, 0.0, 0.0), Vector3::new(0.0, 0.05, 0.0));
/// let start = RelativePose::from_motion(&start, &k, &k)?;
/// let refined = refine_relative_pose(&start, &p1, &p2, &k, &k, RobustLoss::Trivial)?.cam2_from_cam1();
/// assert!(refined.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-6);
/// assert!((refined.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn refine_relative_pose(
    pose: &RelativePose,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    loss: RobustLoss,
) -> Result<RelativePose> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    matches.at_least(5, "a refined relative pose")?;
    loss.check()?;
    let frame = CommonFrame::new(&matches);
    let coordinates = Coordinates::pixels(&matches).mapped(&frame);
    let rays = RaysInFrame::new(&frame, k1, k2);
    let (rotation, direction) = refine_pose_in_frame(
        &coordinates,
        &rays,
        pose,
        scaled(loss, frame.scale),
        &LmOptions::default(),
    )
    .ok_or(NO_ERROR_AT_THE_START)?;
    RelativePose::checked(rotation, direction, k1, k2)
}

/// How rays become coordinates of the common frame: `F = A2ᵀ E A1`.
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

    /// A homography of the frame as one of rays.
    pub(crate) fn homography_of_rays(&self, in_frame: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        Some(self.a2t.transpose() * in_frame * self.a1.try_inverse()?)
    }

    pub(crate) fn fundamental(&self, essential: &Matrix3<f64>) -> Matrix3<f64> {
        self.a2t * essential * self.a1
    }
}

/// Rotation and direction of a motion.
pub(super) type Pose = (Matrix3<f64>, Vector3<f64>);

/// Two unit vectors that span the plane perpendicular to a unit vector.
fn tangent_plane(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = perpendicular(direction);
    [first, direction.cross(&first)]
}

/// The derivatives of E = [t]ₓR with respect to a rotation from the left, `R ← exp([δ]ₓ) R`, and
/// to steps of t along its tangent plane.
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

struct PoseProblem<'a> {
    coordinates: &'a Coordinates,
    rays: &'a RaysInFrame,
    loss: RobustLoss,
}

impl PoseProblem<'_> {
    fn fundamental(&self, (rotation, direction): &Pose) -> Matrix3<f64> {
        self.rays.fundamental(&(cross_matrix(direction) * rotation))
    }
}

impl FixedProblem<5> for PoseProblem<'_> {
    type Parameters = Pose;

    fn accumulate(&self, pose: &Pose, normal: &mut NormalEquations<5>) {
        let sums = linearize(self.coordinates, &self.fundamental(pose), &self.loss);
        let mut d = SMatrix::<f64, 9, 5>::zeros();
        for (i, essential) in essential_derivatives(&pose.0, &pose.1).iter().enumerate() {
            d.set_column(i, &flatten(&self.rays.fundamental(essential)));
        }
        project(&sums, &d, normal);
    }

    fn cost(&self, pose: &Pose) -> f64 {
        cost(self.coordinates, &self.fundamental(pose), &self.loss)
    }

    fn plus(&self, pose: &Pose, delta: &SVector<f64, 5>) -> Pose {
        moved_pose(pose, delta)
    }
}

/// As [`essential_derivatives`] has the parameters.
pub(super) fn moved_pose((rotation, direction): &Pose, delta: &SVector<f64, 5>) -> Pose {
    let turn = Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
    let [b1, b2] = tangent_plane(direction);
    (
        turn.into_inner() * rotation,
        (direction + b1 * delta[3] + b2 * delta[4]).normalize(),
    )
}

/// Refines a relative pose in the frame of the coordinates.
pub(crate) fn refine_pose_in_frame(
    coordinates: &Coordinates,
    rays: &RaysInFrame,
    start: &RelativePose,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Pose> {
    let mut pose = (start.rotation, start.direction);
    let problem = PoseProblem {
        coordinates,
        rays,
        loss,
    };
    minimize_fixed(&problem, &mut pose, options).ok()?;
    orthogonal(&pose)
}

/// Products of many rotations drift from orthogonality.
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
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn pose_derivatives_agree_with_differences() {
        let mut random = Random::new(2);
        for _ in 0..20 {
            let axis = Vector3::from_fn(|_, _| random.normal());
            let rotation = Rotation3::from_scaled_axis(axis).into_inner();
            let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
            let (coordinates, rays) = (
                Coordinates::pixels(&MatchSet::new(&[], &[]).unwrap()),
                RaysInFrame {
                    a1: Matrix3::identity(),
                    a2t: Matrix3::identity(),
                },
            );
            let problem = PoseProblem {
                coordinates: &coordinates,
                rays: &rays,
                loss: RobustLoss::Trivial,
            };
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 5>::from_column_slice(delta.as_slice());
                let e = problem.fundamental(&problem.plus(&(rotation, direction), &delta));
                DVector::from_column_slice(flatten(&e).as_slice())
            };
            let columns = essential_derivatives(&rotation, &direction).map(|e| flatten(&e));
            let analytic = DMatrix::from_fn(9, 5, |i, j| columns[j][i]);
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6);
        }
    }
}
