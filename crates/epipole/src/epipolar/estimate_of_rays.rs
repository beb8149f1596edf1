//! The motion between two cameras from rays: for lenses that no pinhole camera stands for.

use super::essential::signed_depths;
use super::five_point::{pose_in_front, solve};
use super::refine_pose::{Pose, essential_derivatives, moved_pose, orthogonal};
use crate::camera::{Observation, RigidTransform, cross_matrix};
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use crate::progress::Monitor;
use crate::robust::{Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, ransac};
use crate::{Error, Result};
use nalgebra::{
    Matrix3, Matrix3x2, Point2, Rotation3, SVector, Translation3, UnitQuaternion, Vector2, Vector3,
};

/// A match: two rays, and how they move with their pixels.
#[derive(Debug, Clone, Copy)]
struct RayPair {
    rays: [Vector3<f64>; 2],
    by_px: [Matrix3x2<f64>; 2],
    /// So large an angle between the rays is noise, its squared sine.
    noise_sq: f64,
}

/// Rays that pass each other by the errors of so many pixels may be parallel.
const PARALLEL_PX: f64 = 2.0;

impl RayPair {
    /// `None` at the fold of a lens.
    fn new(seen: [&Observation; 2]) -> Option<Self> {
        let by_px = [seen[0].ray_by_px()?, seen[1].ray_by_px()?];
        // Half of the squared Frobenius norm is the mean over directions.
        let pixel_sq = 0.5 * (by_px[0].norm_squared() + by_px[1].norm_squared());
        Some(Self {
            rays: seen.map(Observation::ray),
            by_px,
            noise_sq: (PARALLEL_PX * PARALLEL_PX * pixel_sq).min(1.0),
        })
    }

    /// `x2ᵀ E x1`, and its derivatives by the two pixels.
    fn residual(&self, essential: &Matrix3<f64>) -> (f64, [Vector2<f64>; 2]) {
        let [x1, x2] = &self.rays;
        let (line2, line1) = (essential * x1, essential.tr_mul(x2));
        (
            x2.dot(&line2),
            [self.by_px[0].tr_mul(&line1), self.by_px[1].tr_mul(&line2)],
        )
    }

    /// The squared Sampson error, px²; infinite for a ray through both centers, which says nothing.
    fn sampson_sq(&self, essential: &Matrix3<f64>) -> f64 {
        let (residual, [by1, by2]) = self.residual(essential);
        let slope_sq = by1.norm_squared() + by2.norm_squared();
        match slope_sq > 0.0 {
            true => residual * residual / slope_sq,
            false => f64::INFINITY,
        }
    }

    /// Whether the rays may meet in front of both cameras.
    fn in_front(&self, (rotation, t): &Pose) -> bool {
        let [x1, x2] = &self.rays;
        let (d1, d2) = signed_depths(rotation, t, x1, x2);
        if d1 > 0.0 && d2 > 0.0 {
            return true;
        }
        // Far away both rays have one direction, up to noise.
        let turned = rotation * x1;
        turned.dot(x2) > 0.0 && turned.cross(x2).norm_squared() <= self.noise_sq
    }
}

/// Relative poses of cameras from rays, for RANSAC: five matches a sample, Sampson errors in the pixels of the
/// photographs.
#[derive(Debug, Clone)]
struct RayMotionEstimator {
    matches: MatchSet,
    pairs: Vec<RayPair>,
}

/// A pose with its essential matrix.
#[derive(Debug, Clone, Copy)]
struct Motion {
    pose: Pose,
    essential: Matrix3<f64>,
}

impl Motion {
    fn to_transform(self) -> RigidTransform {
        let (rotation, direction) = self.pose;
        RigidTransform::from_parts(
            Translation3::from(direction),
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)),
        )
    }
}

impl From<Pose> for Motion {
    fn from(pose: Pose) -> Self {
        Self {
            pose,
            essential: cross_matrix(&pose.1) * pose.0,
        }
    }
}

impl RayMotionEstimator {
    fn refined(&self, motion: &Motion, used: Subset<'_>, loss: RobustLoss) -> Option<Motion> {
        let problem = MotionProblem {
            pairs: &self.pairs,
            used,
            loss,
        };
        let mut pose = motion.pose;
        minimize_fixed(&problem, &mut pose, &LmOptions::few_steps(4)).ok()?;
        orthogonal(&pose).map(Motion::from)
    }
}

impl Estimator for RayMotionEstimator {
    type Model = Motion;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a relative pose from rays",
            sample_size: 5,
            max_models: 10,
            codimension: 1,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Motion>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        let rays = |image: usize| core::array::from_fn(|i| self.pairs[sample[i]].rays[image]);
        let (rays1, rays2) = (rays(0), rays(1));
        let mut solutions = [Matrix3::zeros(); 10];
        let count = solve(&rays1, &rays2, &mut solutions);
        for essential in &solutions[..count] {
            if let Some(pose) = pose_in_front(essential, &rays1, &rays2) {
                models.push(pose.into());
            }
        }
    }

    fn error_sq(&self, motion: &Motion, index: usize) -> f64 {
        let pair = &self.pairs[index];
        match pair.in_front(&motion.pose) {
            true => pair.sampson_sq(&motion.essential),
            false => f64::INFINITY,
        }
    }

    fn refine(&mut self, motion: &Motion, inliers: &[usize], max_error_px: f64) -> Option<Motion> {
        let loss = RobustLoss::Truncated {
            width: max_error_px,
        };
        self.refined(motion, Subset::alike(inliers), loss)
    }

    fn polish(&mut self, motion: &Motion, near: &[usize], weights: &[f64]) -> Option<Motion> {
        self.refined(motion, Subset::weighted(near, weights), RobustLoss::Trivial)
    }
}

/// The Sampson errors of matches as functions of the pose.
struct MotionProblem<'a> {
    pairs: &'a [RayPair],
    used: Subset<'a>,
    loss: RobustLoss,
}

impl FixedProblem<5> for MotionProblem<'_> {
    type Parameters = Pose;

    fn accumulate(&self, pose: &Pose, normal: &mut NormalEquations<5>) {
        let essential = Motion::from(*pose).essential;
        let derivatives = essential_derivatives(&pose.0, &pose.1);
        for (pair, root) in self.used.iter().map(|(i, root)| (&self.pairs[i], root)) {
            let (residual, by_px) = pair.residual(&essential);
            let slope_sq = by_px[0].norm_squared() + by_px[1].norm_squared();
            if slope_sq <= 0.0 {
                continue;
            }
            let slope = slope_sq.sqrt();
            let mut jacobian = SVector::<f64, 5>::zeros();
            for (entry, derivative) in jacobian.iter_mut().zip(&derivatives) {
                let (by, moved) = pair.residual(derivative);
                let along = by_px[0].dot(&moved[0]) + by_px[1].dot(&moved[1]);
                *entry = (by - residual * along / slope_sq) / slope;
            }
            normal.add_scalar(root * residual / slope, &(jacobian * root), &self.loss);
        }
    }

    fn cost(&self, pose: &Pose) -> f64 {
        let essential = Motion::from(*pose).essential;
        let mut total = 0.0;
        for (index, root) in self.used.iter() {
            let error_sq = self.pairs[index].sampson_sq(&essential);
            if error_sq.is_finite() {
                total += 0.5 * self.loss.rho(root * root * error_sq);
            }
        }
        total
    }

    fn plus(&self, pose: &Pose, delta: &SVector<f64, 5>) -> Pose {
        moved_pose(pose, delta)
    }
}

/// The motion `cam2_from_cam1`, its step of length 1, that most matches agree on, whatever lenses saw them.
///
/// * `seen1`, `seen2`: matching pixels with their rays, in the same order; wrong matches are expected
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, in the pixels of the photographs
///
/// The same as [`estimate_relative_pose`](super::estimate_relative_pose) but for lenses without a pinhole camera that
/// could stand for them: rays may point to the side and backwards.
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::TooFew`] for fewer than 5 different matches, and as
/// [`ransac`].
///
/// Source: Nistér 2004, "An efficient solution to the five-point relative pose problem"; Sampson's error through the
/// derivative of each lens.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose_of_rays;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera {
///     intrinsics: Intrinsics::centered(200.0, 640, 640)?,
///     lens: Lens::Fisheye(Fisheye::default()),
///     width: 640,
///     height: 640,
/// };
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut seen1, mut seen2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     // All around, some of them beside the camera.
///     let x = Point3::new(f64::from(i * 7 % 11) - 5.0, f64::from(i * 3 % 7) - 3.0, 0.5 + f64::from(i * i % 5));
///     seen1.push(camera.observe(&camera.project(&x)?)?);
///     seen2.push(camera.observe(&camera.project(&(cam2_from_cam1 * x))?)?);
/// }
/// let report = estimate_relative_pose_of_rays(&seen1, &seen2, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 40);
/// assert!(report.model.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// let direction = cam2_from_cam1.translation.vector.normalize();
/// assert!((report.model.translation.vector - direction).norm() < 1e-5);
/// # Ok(()) }
/// ```
pub fn estimate_relative_pose_of_rays(
    seen1: &[Observation],
    seen2: &[Observation],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RigidTransform>> {
    let pixels = [seen1, seen2]
        .map(|seen| -> Vec<Point2<f64>> { seen.iter().map(Observation::pixel).collect() });
    let matches = MatchSet::new(&pixels[0], &pixels[1])?;
    matches.at_least(5, "a relative pose from rays")?;
    let kept = matches.unique().first_occurrences();
    let pairs: Option<Vec<RayPair>> = kept
        .iter()
        .map(|&i| RayPair::new([&seen1[i], &seen2[i]]))
        .collect();
    let pairs = pairs.ok_or(Error::Degenerate {
        what: "a relative pose from rays",
        why: "a lens folds where a pixel was seen",
    })?;
    let estimator = RayMotionEstimator { matches, pairs };
    let report = ransac(estimator, options, monitor)?;
    Ok(report.map(|motion| motion.to_transform()))
}

/// The Sampson error of two matching rays and a motion, in the pixels of both photographs; infinite where they cannot
/// meet in front of both cameras.
///
/// * `cam2_from_cam1`: the length of its step means nothing
/// * `seen1`, `seen2`: what both cameras saw
///
/// Source: Hartley & Zisserman 2004, §11.4.3, through the derivative of each lens.
///
/// ```
/// use epipole::camera::{RigidTransform, Observation};
/// use epipole::epipolar::sampson_px_of_rays;
/// use nalgebra::{Matrix2x3, Point2, Vector3};
/// // Pinhole cameras with 100 pixels, and rays straight ahead; the step is to the right.
/// let by_ray = Matrix2x3::new(100.0, 0.0, 0.0, 0.0, 100.0, 0.0);
/// let seen1 = Observation::new(Point2::new(0.0, 0.0), Vector3::z(), by_ray).unwrap();
/// let step = RigidTransform::translation(-1.0, 0.0, 0.0);
/// // A pixel that is too low by 2: each photograph is off by half of it.
/// let seen2 = Observation::new(Point2::new(-5.0, 2.0), Vector3::new(-0.05, 0.02, 1.0), by_ray).unwrap();
/// assert!((sampson_px_of_rays(&step, &seen1, &seen2) - 2.0_f64.sqrt()).abs() < 0.01);
/// // It would have to be left of where it was.
/// let seen2 = Observation::new(Point2::new(50.0, 0.0), Vector3::new(0.5, 0.0, 1.0), by_ray).unwrap();
/// assert_eq!(sampson_px_of_rays(&step, &seen1, &seen2), f64::INFINITY);
/// ```
pub fn sampson_px_of_rays(
    cam2_from_cam1: &RigidTransform,
    seen1: &Observation,
    seen2: &Observation,
) -> f64 {
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
    let motion = Motion::from((rotation, cam2_from_cam1.translation.vector));
    match RayPair::new([seen1, seen2]) {
        Some(pair) if pair.in_front(&motion.pose) => pair.sampson_sq(&motion.essential).sqrt(),
        _ => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, Lens, LensKind};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector, Point3};

    fn fisheye() -> Camera {
        Camera {
            intrinsics: Intrinsics::new(250.0, 252.0, 400.0, 390.0).unwrap(),
            lens: Lens::from_coefficients(LensKind::Fisheye, &[-0.02, 0.004, -0.001, 0.0002])
                .unwrap(),
            width: 800,
            height: 780,
        }
    }

    /// Matches all around both cameras with noise, the first of every four wrong.
    fn world(num: usize, sigma_px: f64, seed: u64) -> ([Vec<Observation>; 2], RigidTransform) {
        let mut random = Random::new(seed);
        let camera = fisheye();
        let motion =
            RigidTransform::new(Vector3::new(-0.9, 0.1, 0.4), Vector3::new(0.1, 0.3, -0.2));
        let (mut seen1, mut seen2) = (Vec::new(), Vec::new());
        while seen1.len() < num {
            let x = Point3::from(4.0 * Vector3::from_fn(|_, _| random.normal()));
            let in_both = [x, motion * x];
            if in_both
                .iter()
                .any(|x| x.z < -0.2 * x.coords.norm() || x.coords.norm() < 1.0)
            {
                continue;
            }
            let is_wrong = seen1.len().is_multiple_of(4);
            let mut see = |x: &Point3<f64>, is_wrong: bool| {
                let noise = Vector2::from_fn(|_, _| sigma_px * random.normal());
                let off = match is_wrong {
                    true => Vector2::from_fn(|_, _| random.uniform(-150.0, 150.0)),
                    false => noise,
                };
                camera.observe(&(camera.project(x).unwrap() + off)).unwrap()
            };
            let pair = [see(&in_both[0], false), see(&in_both[1], is_wrong)];
            seen1.push(pair[0]);
            seen2.push(pair[1]);
        }
        ([seen1, seen2], motion)
    }

    #[test]
    fn a_fisheye_finds_its_motion_among_wrong_matches() {
        let (seen, truth) = world(400, 0.5, 3);
        let options = RansacOptions::default().within(2.0);
        let report = estimate_relative_pose_of_rays(&seen[0], &seen[1], &options, &mut ()).unwrap();
        assert!(
            report.num_inliers >= 295 && report.num_inliers < 315,
            "{}",
            report.num_inliers
        );
        let turned_deg = report.model.rotation.angle_to(&truth.rotation).to_degrees();
        let direction = truth.translation.vector.normalize();
        let off_deg = report
            .model
            .translation
            .vector
            .angle(&direction)
            .to_degrees();
        assert!(turned_deg < 0.05 && off_deg < 0.2, "{turned_deg} {off_deg}");
    }

    #[test]
    fn derivatives_are_differences() {
        let (seen, truth) = world(20, 0.5, 4);
        let pairs: Vec<RayPair> = (0..20)
            .map(|i| RayPair::new([&seen[0][i], &seen[1][i]]).unwrap())
            .collect();
        let pose: Pose = (
            truth.rotation.to_rotation_matrix().into_inner(),
            truth.translation.vector.normalize(),
        );
        for i in 0..20 {
            let used = [i];
            let problem = MotionProblem {
                pairs: &pairs,
                used: Subset::alike(&used),
                loss: RobustLoss::Trivial,
            };
            let at = |delta: &DVector<f64>| {
                let moved = problem.plus(&pose, &SVector::from_column_slice(delta.as_slice()));
                let (residual, by) = pairs[i].residual(&Motion::from(moved).essential);
                let slope = (by[0].norm_squared() + by[1].norm_squared()).sqrt();
                DVector::from_element(1, residual / slope)
            };
            let mut normal = NormalEquations::<5>::new();
            problem.accumulate(&pose, &mut normal);
            // The gradient of ½ r² is r times the row.
            let row = normal.gradient / at(&DVector::zeros(5))[0];
            let analytic = DMatrix::from_row_slice(1, 5, row.as_slice());
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-5);
            let residual = at(&DVector::zeros(5))[0];
            let cost = 0.5 * residual * residual;
            assert!((problem.cost(&pose) - cost).abs() < 1e-9 * (1.0 + cost));
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let (seen, _) = world(8, 0.5, 5);
        let options = RansacOptions::default();
        let few = estimate_relative_pose_of_rays(&seen[0][..4], &seen[1][..4], &options, &mut ());
        assert!(matches!(few, Err(Error::TooFew { .. })));
        let unlike = estimate_relative_pose_of_rays(&seen[0], &seen[1][..7], &options, &mut ());
        assert!(matches!(unlike, Err(Error::SizeMismatch { .. })));
    }
}
