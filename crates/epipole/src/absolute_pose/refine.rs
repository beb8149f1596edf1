//! Nonlinear refinement of a camera pose: minimizes the reprojection error by Levenberg–Marquardt.

use super::local_pose::{LocalPose, Pivot};
use super::point_errors::{LensPoints, PinholePoints, PointErrors, Pose};
use crate::camera::{Camera, PosedCamera, RigidTransform};
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Rotation3, SMatrix, SVector, UnitQuaternion, Vector2, Vector3};

/// Computes the reprojection error, pixels; infinite behind the camera.
///
/// Source: Hartley & Zisserman 2004, §7.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::reprojection_error_px;
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use nalgebra::{Point2, Point3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let camera = PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::identity() };
/// // The point projects to (460, 170), at an offset of (3, 4).
/// let pixel = Point2::new(463.0, 174.0);
/// assert!((reprojection_error_px(&camera, &Point3::new(0.4, -0.2, 2.0), &pixel) - 5.0).abs() < 1e-12);
/// assert_eq!(reprojection_error_px(&camera, &Point3::new(0.4, -0.2, -2.0), &pixel), f64::INFINITY);
/// # Ok(()) }
/// ```
pub fn reprojection_error_px(
    camera: &PosedCamera,
    point_in_world: &Point3<f64>,
    pixel: &Point2<f64>,
) -> f64 {
    match camera.project(point_in_world) {
        Ok(observations) => (observations - pixel).norm(),
        Err(_) => f64::INFINITY,
    }
}

/// Refines a pose: minimizes `½ Σ ρ(‖pixel − projection‖²)`.
///
/// * `points_in_world`, `pixels`: points and their projections, at least 3
/// * `camera`: camera with any lens
/// * `loss`: width in pixels
///
/// Points initially behind the camera are left out. Neither the world's origin nor its unit of
/// length matters, since the search rotates the pose about a point amid the others, not about the
/// origin.
///
/// # Errors
/// [`Error::TooFew`] for fewer than 3 points in front of the camera, [`Error::SizeMismatch`] for
/// lists of different length, [`Error::NotFinite`] for NaN and infinities, [`Error::OutOfRange`]
/// for a loss that [`RobustLoss::check`] rejects, and as [`Camera::observe`] for a pixel of a lens.
///
/// Source: Hartley & Zisserman 2004, §7.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::refine_absolute_pose;
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.2, 0.3));
/// let (mut points, mut pixels) = (Vec::new(), Vec::new());
/// for i in 0..12 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, f64::from(i * i % 7) - 2.0);
///     points.push(x);
///     pixels.push(camera.project(&(cam_from_world * x))?);
/// }
/// // One wrong pixel, and an initial pose that is off by 0.1 and 0.02 rad.
/// pixels[3].x += 50.0;
/// let start = RigidTransform::new(Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 0.02, 0.0)) * cam_from_world;
/// let loss = RobustLoss::Cauchy { width: 1.0 };
/// let found = refine_absolute_pose(&start, &points, &pixels, &camera, loss)?;
/// assert!(found.rotation.angle_to(&cam_from_world.rotation) < 1e-3);
/// assert!((found.translation.vector - cam_from_world.translation.vector).norm() < 0.01);
/// # Ok(()) }
/// ```
pub fn refine_absolute_pose(
    cam_from_world: &RigidTransform,
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
    loss: RobustLoss,
) -> Result<RigidTransform> {
    if points_in_world.len() != pixels.len() {
        return Err(Error::SizeMismatch {
            what: "the list of points and that of their pixels",
            first: points_in_world.len(),
            second: pixels.len(),
        });
    }
    loss.check()?;
    let finite = |x: &f64| x.is_finite();
    if !points_in_world.iter().all(|p| p.iter().all(finite))
        || !pixels.iter().all(|p| p.iter().all(finite))
    {
        return Err(Error::NotFinite {
            what: "a point or its pixel",
        });
    }
    let start = (
        cam_from_world.rotation.to_rotation_matrix().into_inner(),
        cam_from_world.translation.vector,
    );
    if camera.is_pinhole() {
        let intrinsics = &camera.intrinsics;
        let errors = PinholePoints { pixels, intrinsics };
        return refine_all(points_in_world, errors, start, loss);
    }
    let observations: Result<Vec<_>> = pixels.iter().map(|pixel| camera.observe(pixel)).collect();
    refine_all(
        points_in_world,
        LensPoints {
            observations: &observations?,
        },
        start,
        loss,
    )
}

/// Body of [`refine_absolute_pose`].
fn refine_all(
    points: &[Point3<f64>],
    errors: impl PointErrors,
    start: Pose,
    loss: RobustLoss,
) -> Result<RigidTransform> {
    let in_front = |&i: &usize| errors.depth(&(start.0 * points[i].coords + start.1), i) > 0.0;
    let used: Vec<usize> = (0..points.len()).filter(in_front).collect();
    if used.len() < 3 {
        return Err(Error::TooFew {
            what: "the refinement of a pose from points in front of the camera",
            needed: 3,
            got: used.len(),
        });
    }
    let problem = PoseProblem {
        points,
        errors,
        used: Subset::alike(&used),
        loss,
    };
    let refined = refine(&problem, start, &LmOptions::default()).ok_or(Error::NotFinite {
        what: "the reprojection error of the start",
    })?;
    Ok(rigid(&refined, &points[used[0]].coords))
}

/// Makes the R of a pose, a rotation up to small errors, an exact rotation.
///
/// * `fixed`: a world point whose projection does not change
///
/// Errors of R are multiplied by the distance from the fixed point. Without one, this would be the
/// world's origin, which may be anywhere.
pub(super) fn rigid((rotation, t): &Pose, fixed: &Vector3<f64>) -> RigidTransform {
    let unit = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    let t = (rotation * fixed + t) - unit * fixed;
    RigidTransform::from_parts(t.into(), unit)
}

/// Reprojection errors of points as functions of a pose.
pub(super) struct PoseProblem<'a, E> {
    pub(super) points: &'a [Point3<f64>],
    pub(super) errors: E,
    pub(super) used: Subset<'a>,
    pub(super) loss: RobustLoss,
}

impl<E: PointErrors> PoseProblem<'_, E> {
    pub(super) fn pivot(&self, pose: &Pose) -> Pivot {
        let used = self.used.indices.iter().map(|&index| {
            let x = self.points[index].coords;
            (x, self.errors.depth(&(pose.0 * x + pose.1), index))
        });
        Pivot::new(used, pose)
    }
}

/// A problem whose pose rotates about a pivot.
struct LocalProblem<'a, E> {
    problem: &'a PoseProblem<'a, E>,
    pivot: Pivot,
}

impl<E: PointErrors> LocalProblem<'_, E> {
    fn linearized(
        &self,
        pose: &LocalPose,
        index: usize,
    ) -> Option<(Vector2<f64>, SMatrix<f64, 2, 6>)> {
        let problem = self.problem;
        let [x, from_pivot] = self.pivot.places(pose, &problem.points[index].coords);
        let (residual, by_point) = problem.errors.linearized(&x, index)?;
        Some((residual, self.pivot.jacobian(&by_point, &from_pivot)))
    }
}

impl<E: PointErrors> FixedProblem<6> for LocalProblem<'_, E> {
    type Parameters = LocalPose;

    fn accumulate(&self, pose: &LocalPose, normal: &mut NormalEquations<6>) {
        for (index, root) in self.problem.used.iter() {
            match self.linearized(pose, index) {
                Some((residual, jacobian)) => {
                    normal.add(&(residual * root), &(jacobian * root), &self.problem.loss);
                }
                None => normal.cost = f64::INFINITY,
            }
        }
    }

    fn cost(&self, pose: &LocalPose) -> f64 {
        let problem = self.problem;
        let mut total = 0.0;
        for (index, root) in problem.used.iter() {
            let [x, _] = self.pivot.places(pose, &problem.points[index].coords);
            match problem.errors.residual(&x, index) {
                Some(residual) => total += 0.5 * problem.loss.rho((residual * root).norm_squared()),
                None => return f64::INFINITY,
            }
        }
        total
    }

    fn plus(&self, pose: &LocalPose, delta: &SVector<f64, 6>) -> LocalPose {
        self.pivot.moved(pose, delta)
    }
}

/// Refines an initial pose; `None` if its cost is not finite.
pub(super) fn refine(
    problem: &PoseProblem<'_, impl PointErrors>,
    start: Pose,
    options: &LmOptions,
) -> Option<Pose> {
    let pivot = problem.pivot(&start);
    let local = LocalProblem { problem, pivot };
    let mut pose = local.pivot.local(&start);
    minimize_fixed(&local, &mut pose, options).ok()?;
    local.pivot.in_world(&pose)
}

#[cfg(test)]
mod tests {
    use super::super::p3p::tests::problem;
    use super::*;
    use crate::camera::{Intrinsics, Lens, LensKind};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    fn camera() -> Camera {
        let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0).unwrap();
        Camera::pinhole(k, 640, 480)
    }

    fn fisheye() -> Camera {
        let coefficients = [-0.02, 0.004, -0.001, 0.0002];
        Camera {
            lens: Lens::from_coefficients(LensKind::Fisheye, &coefficients).unwrap(),
            ..camera()
        }
    }

    fn check_derivatives(points: &[Point3<f64>], errors: impl PointErrors, truth: &RigidTransform) {
        let used: Vec<usize> = (0..8).collect();
        let problem = PoseProblem {
            points,
            errors,
            used: Subset::alike(&used),
            loss: RobustLoss::Trivial,
        };
        let start = (
            truth.rotation.to_rotation_matrix().into_inner(),
            truth.translation.vector,
        );
        let problem = LocalProblem {
            pivot: problem.pivot(&start),
            problem: &problem,
        };
        let pose = problem.pivot.local(&start);
        let at = |pose: &LocalPose, i: usize| problem.linearized(pose, i).unwrap();
        let residuals = |delta: &DVector<f64>| {
            let delta = SVector::<f64, 6>::from_column_slice(delta.as_slice());
            let moved = problem.plus(&pose, &delta);
            DVector::from_fn(16, |row, _| at(&moved, row / 2).0[row % 2])
        };
        let analytic =
            DMatrix::from_fn(16, 6, |row, column| at(&pose, row / 2).1[(row % 2, column)]);
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
    }

    #[test]
    fn jacobians_agree_with_differences() {
        let mut random = Random::new(1);
        for _ in 0..20 {
            let (truth, rays, points) = problem::<8>(&mut random);
            let pixels = rays.map(|r| camera().project(&r.into()).unwrap());
            let errors = PinholePoints {
                pixels: &pixels,
                intrinsics: &camera().intrinsics,
            };
            check_derivatives(&points, errors, &truth);
            let observations = rays.map(|r| {
                let pixel = fisheye().project(&r.into()).unwrap();
                let off = Vector2::from_fn(|_, _| random.normal());
                fisheye().observe(&(pixel + off)).unwrap()
            });
            check_derivatives(
                &points,
                LensPoints {
                    observations: &observations,
                },
                &truth,
            );
        }
    }

    #[test]
    fn refinement_returns_from_a_disturbed_pose() {
        let mut random = Random::new(2);
        for camera in [camera(), fisheye()].into_iter().cycle().take(50) {
            let (truth, rays, points) = problem::<30>(&mut random);
            let mut pixels = rays.map(|r| camera.project(&r.into()).unwrap());
            pixels[7].x += 200.0;
            let disturbed = RigidTransform::new(
                Vector3::new(0.01, -0.01, 0.005),
                Vector3::new(0.01, 0.0, -0.01),
            ) * truth;
            let loss = RobustLoss::Cauchy { width: 1.0 };
            let found = refine_absolute_pose(&disturbed, &points, &pixels, &camera, loss).unwrap();
            assert!(found.rotation.angle_to(&truth.rotation) < 1e-3);
            assert!((found.translation.vector - truth.translation.vector).norm() < 5e-3);
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let camera = camera();
        let identity = RigidTransform::identity();
        let behind = vec![Point3::new(0.0, 0.0, -1.0); 5];
        let pixels = vec![Point2::new(0.0, 0.0); 5];
        let refine = |points: &[Point3<f64>], pixels: &[Point2<f64>]| {
            refine_absolute_pose(&identity, points, pixels, &camera, RobustLoss::Trivial)
        };
        assert!(refine(&behind, &pixels).is_err());
        assert!(refine(&behind, &pixels[..2]).is_err());
        assert!(refine(&[Point3::new(f64::NAN, 0.0, 1.0); 5], &pixels).is_err());
    }

    #[test]
    fn a_loss_without_width_is_refused() {
        let camera = camera();
        let (truth, rays, points) = problem::<8>(&mut Random::new(3));
        let pixels = rays.map(|r| camera.project(&r.into()).unwrap());
        for width in [0.0, -1.0, f64::NAN] {
            let loss = RobustLoss::Truncated { width };
            let refined = refine_absolute_pose(&truth, &points, &pixels, &camera, loss);
            assert!(
                matches!(refined, Err(Error::OutOfRange { .. })),
                "{refined:?}"
            );
        }
    }
}
