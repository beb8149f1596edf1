//! The pose of a camera with any lens from points of which many are wrongly matched.

use super::estimate::usable;
use super::p3p::solve;
use super::refine::{Pose, rigid};
use crate::camera::{Observation, RigidTransform};
use crate::math::nearest_orthogonal;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use crate::progress::Monitor;
use crate::robust::{Data, Estimator, Problem, RansacOptions, RansacReport, Unique, ransac};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Point3, Rotation3, SMatrix, SVector, Vector3};

/// Poses from points and the rays on which they are seen, for RANSAC: three points a sample, errors in the pixels of
/// the photograph.
struct RayPoseEstimator {
    points: Vec<Vector3<f64>>,
    seen: Vec<Observation>,
    pixels: Vec<Point2<f64>>,
    unique: Unique,
}

impl RayPoseEstimator {
    fn refined(&self, pose: &Pose, used: Subset<'_>, loss: RobustLoss) -> Option<Pose> {
        let problem = RayPoseProblem {
            points: &self.points,
            seen: &self.seen,
            used,
            loss,
        };
        let mut pose = *pose;
        minimize_fixed(&problem, &mut pose, &LmOptions::few_steps(4)).ok()?;
        let rotation = nearest_orthogonal(&pose.0);
        let finite = rotation.iter().chain(pose.1.iter()).all(|x| x.is_finite());
        finite.then_some((rotation, pose.1))
    }
}

impl Estimator for RayPoseEstimator {
    /// R and t of `cam_from_world`.
    type Model = Pose;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a camera pose from points",
            sample_size: 3,
            max_models: 4,
            codimension: 2,
            data: Data::Pixels {
                pixels: &self.pixels,
                unique: &self.unique,
            },
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Pose>) {
        let rays = core::array::from_fn(|i| self.seen[sample[i]].ray());
        let points = core::array::from_fn(|i| self.points[sample[i]]);
        let mut solutions = [(Matrix3::zeros(), Vector3::zeros()); 4];
        let count = solve(&rays, &points, &mut solutions);
        models.extend_from_slice(&solutions[..count]);
    }

    fn error_sq(&self, (rotation, t): &Pose, index: usize) -> f64 {
        self.seen[index].error_sq(&(rotation * self.points[index] + t))
    }

    fn refine(&mut self, pose: &Pose, inliers: &[usize], max_error_px: f64) -> Option<Pose> {
        let loss = RobustLoss::Truncated {
            width: max_error_px,
        };
        self.refined(pose, Subset::alike(inliers), loss)
    }

    fn polish(&mut self, pose: &Pose, near: &[usize], weights: &[f64]) -> Option<Pose> {
        self.refined(pose, Subset::weighted(near, weights), RobustLoss::Trivial)
    }
}

/// The camera turns about its own center, and then moves.
struct RayPoseProblem<'a> {
    points: &'a [Vector3<f64>],
    seen: &'a [Observation],
    used: Subset<'a>,
    loss: RobustLoss,
}

impl FixedProblem<6> for RayPoseProblem<'_> {
    type Parameters = Pose;

    fn accumulate(&self, (rotation, t): &Pose, normal: &mut NormalEquations<6>) {
        for (index, root) in self.used.iter() {
            let x = rotation * self.points[index] + t;
            let Some((off, by_point)) = self.seen[index].offset_with_derivative(&x) else {
                normal.cost = f64::INFINITY;
                continue;
            };
            let mut jacobian = SMatrix::<f64, 2, 6>::zeros();
            let by_turn = by_point * -x.cross_matrix();
            jacobian.fixed_view_mut::<2, 3>(0, 0).copy_from(&by_turn);
            jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&by_point);
            normal.add(&(off * root), &(jacobian * root), &self.loss);
        }
    }

    fn cost(&self, (rotation, t): &Pose) -> f64 {
        let mut total = 0.0;
        for (index, root) in self.used.iter() {
            let error_sq = self.seen[index].error_sq(&(rotation * self.points[index] + t));
            if error_sq.is_infinite() {
                return f64::INFINITY;
            }
            total += 0.5 * self.loss.rho(root * root * error_sq);
        }
        total
    }

    fn plus(&self, (rotation, t): &Pose, delta: &SVector<f64, 6>) -> Pose {
        let turn = Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
        let shift = Vector3::new(delta[3], delta[4], delta[5]);
        (turn.into_inner() * rotation, turn * t + shift)
    }
}

/// The pose `cam_from_world` that most points agree on, whatever lens saw them.
///
/// * `points_in_world`, `seen`: points, and the pixels with their rays where they are seen; wrong pairs are expected
/// * `options`: [`RansacOptions::max_error_px`] bounds the error of an inlier, in the pixels of the photograph
///
/// The same as [`estimate_absolute_pose`](super::estimate_absolute_pose) but for lenses without a pinhole camera that
/// could stand for them.
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN, [`Error::TooFew`] for fewer than
/// 4 different data, and as [`ransac`].
///
/// Source: Fischler & Bolles 1981, with P3P as the minimal solver.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::estimate_absolute_pose_of_rays;
/// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera {
///     intrinsics: Intrinsics::centered(200.0, 640, 640)?,
///     lens: Lens::Fisheye(Fisheye::default()),
///     width: 640,
///     height: 640,
/// };
/// let cam_from_world = RigidTransform::new(Vector3::new(0.3, -0.1, 0.2), Vector3::new(0.0, 0.4, 0.1));
/// let (mut points, mut seen) = (Vec::new(), Vec::new());
/// for i in 0..30 {
///     // All around, some of them beside the camera.
///     let x = Point3::new(f64::from(i * 7 % 11) - 5.0, f64::from(i * 3 % 7) - 3.0, 0.5 + f64::from(i * i % 5));
///     seen.push(camera.observe(&camera.project(&(cam_from_world * x))?)?);
///     points.push(x);
/// }
/// let report = estimate_absolute_pose_of_rays(&points, &seen, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 30);
/// assert!((report.model.to_matrix() - cam_from_world.to_matrix()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_absolute_pose_of_rays(
    points_in_world: &[Point3<f64>],
    seen: &[Observation],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RigidTransform>> {
    let pixels: Vec<Point2<f64>> = seen.iter().map(Observation::pixel).collect();
    let unique = usable(points_in_world, &pixels)?;
    if unique.len() < 4 {
        return Err(Error::TooFew {
            what: "a camera pose from points",
            needed: 4,
            got: unique.len(),
        });
    }
    let kept = unique.first_occurrences();
    let estimator = RayPoseEstimator {
        points: kept.iter().map(|&i| points_in_world[i].coords).collect(),
        pixels: kept.iter().map(|&i| pixels[i]).collect(),
        seen: kept.iter().map(|&i| seen[i]).collect(),
        unique: unique.clone(),
    };
    let fixed = estimator.points[0];
    Ok(ransac(estimator, options, monitor)?.map(|pose| rigid(&pose, &fixed)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, Lens, LensKind};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector, Vector2};

    fn world(num: usize, seed: u64) -> (Vec<Point3<f64>>, Vec<Observation>, RigidTransform) {
        let mut random = Random::new(seed);
        let camera = Camera {
            intrinsics: Intrinsics::new(250.0, 252.0, 400.0, 390.0).unwrap(),
            lens: Lens::from_coefficients(LensKind::Fisheye, &[-0.02, 0.004, -0.001, 0.0002])
                .unwrap(),
            width: 800,
            height: 780,
        };
        let pose = RigidTransform::new(Vector3::new(-0.9, 0.1, 0.4), Vector3::new(0.1, 0.3, -0.2));
        let (mut points, mut seen) = (Vec::new(), Vec::new());
        while points.len() < num {
            let x = Point3::from(4.0 * Vector3::from_fn(|_, _| random.normal()));
            let in_cam = pose * x;
            if in_cam.z < -0.2 * in_cam.coords.norm() || in_cam.coords.norm() < 1.0 {
                continue;
            }
            let width = if points.len().is_multiple_of(3) {
                80.0
            } else {
                0.4
            };
            let off = Vector2::from_fn(|_, _| width * random.normal());
            let pixel = camera.project(&in_cam).unwrap() + off;
            if let Ok(ray) = camera.observe(&pixel) {
                seen.push(ray);
                points.push(x);
            }
        }
        (points, seen, pose)
    }

    #[test]
    fn a_fisheye_finds_its_place_among_wrong_matches() {
        let (points, seen, truth) = world(300, 1);
        let options = RansacOptions::default().within(3.0);
        let report = estimate_absolute_pose_of_rays(&points, &seen, &options, &mut ()).unwrap();
        assert!(report.num_inliers >= 198 && report.num_inliers < 210);
        let off = report.model.to_matrix() - truth.to_matrix();
        assert!(off.norm() < 0.005, "{off}");
    }

    #[test]
    fn derivatives_are_differences() {
        let (points, seen, truth) = world(20, 2);
        let points: Vec<Vector3<f64>> = points.iter().map(|x| x.coords).collect();
        let pose: Pose = (
            truth.rotation.to_rotation_matrix().into_inner(),
            truth.translation.vector,
        );
        for i in (0..20usize).filter(|i| !i.is_multiple_of(3)) {
            let used = [i];
            let problem = RayPoseProblem {
                points: &points,
                seen: &seen,
                used: Subset::alike(&used),
                loss: RobustLoss::Trivial,
            };
            let at = |delta: &DVector<f64>| {
                let moved = problem.plus(&pose, &SVector::from_column_slice(delta.as_slice()));
                DVector::from_element(1, problem.cost(&moved))
            };
            let mut normal = NormalEquations::<6>::new();
            problem.accumulate(&pose, &mut normal);
            let analytic = DMatrix::from_row_slice(1, 6, normal.gradient.as_slice());
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-4);
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let (points, seen, _) = world(8, 3);
        let options = RansacOptions::default();
        let few = estimate_absolute_pose_of_rays(&points[..3], &seen[..3], &options, &mut ());
        assert!(matches!(few, Err(Error::TooFew { .. })));
        let unlike = estimate_absolute_pose_of_rays(&points, &seen[..7], &options, &mut ());
        assert!(matches!(unlike, Err(Error::SizeMismatch { .. })));
        let nowhere = vec![Point3::new(f64::NAN, 0.0, 1.0); 8];
        let refused = estimate_absolute_pose_of_rays(&nowhere, &seen, &options, &mut ());
        assert!(matches!(refused, Err(Error::NotFinite { .. })));
    }
}
