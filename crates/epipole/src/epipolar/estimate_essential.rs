//! Robust estimation of E and the relative pose.

use super::essential::most_in_front;
use super::essential_estimator::EssentialEstimator;
use super::{RelativePose, decompose_essential};
use crate::Result;
use crate::camera::Camera;
use crate::progress::Monitor;
use crate::robust::{RansacOptions, RansacReport, ransac};
use nalgebra::{Matrix3, Point2};

/// Estimates the relative pose of two calibrated cameras on which most matches agree.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `cameras`: the two cameras, with any lens
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, pixels;
///   inliers are also in front of both cameras, or so far away that noise hides it
///
/// For lenses other than pinholes, rays may point sideways and backwards, and the error is the
/// [tangent Sampson error](super::tangent_sampson_px), in the pixels of the distorted images.
///
/// Of the four motions that the essential matrix allows, returns the one with the most inliers in
/// front of both cameras. If the camera hardly moved, the direction is meaningless;
/// [`find_explaining_rotation`](crate::two_view::find_explaining_rotation) detects this.
///
/// # Errors
/// As [`EssentialEstimator::new`] and [`ransac`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point2, Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(camera.project(&x)?);
///     p2.push(camera.project(&(cam2_from_cam1 * x))?);
/// }
/// // Every fifth match is wrong.
/// for i in (0..40).step_by(5) {
///     p2[i] = Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
/// }
/// let report = estimate_relative_pose(&p1, &p2, [&camera; 2], &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 32);
/// // This yields the direction of t; its length is not observable.
/// let found = report.model.cam2_from_cam1();
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// assert!((found.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "recoverPose")]
pub fn estimate_relative_pose(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RelativePose>> {
    let mut estimator = EssentialEstimator::new(pixels1, pixels2, cameras)?;
    let report = ransac(&mut estimator, options, monitor)?;
    let motions = decompose_essential(&report.model.0.essential())?;
    let chosen = most_in_front(&motions, estimator.rays_among(&report.inliers)).cam2_from_cam1;
    Ok(report.map(|_| RelativePose {
        rotation: chosen.rotation.to_rotation_matrix().into_inner(),
        direction: chosen.translation.vector,
    }))
}

/// Estimates the essential matrix on which most matches agree, unit Frobenius norm; as
/// [`estimate_relative_pose`].
///
/// # Errors
/// As [`estimate_relative_pose`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::epipolar::{essential_from_motion, estimate_essential};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(camera.project(&x)?);
///     p2.push(camera.project(&(cam2_from_cam1 * x))?);
/// }
/// let report = estimate_essential(&p1, &p2, [&camera; 2], &RansacOptions::default(), &mut ())?;
/// let truth = essential_from_motion(&cam2_from_cam1)?;
/// assert_eq!(report.num_inliers, 40);
/// assert!((report.model - truth).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "findEssentialMat")]
pub fn estimate_essential(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    estimate_relative_pose(pixels1, pixels2, cameras, options, monitor)
        .map(|report| report.map(|pose| pose.essential()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::camera::{Intrinsics, Lens, LensKind, RigidTransform};
    use crate::math::random::Random;
    use nalgebra::{Point3, Vector2, Vector3};

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
    fn world(num: usize, sigma_px: f64, seed: u64) -> ([Vec<Point2<f64>>; 2], RigidTransform) {
        let mut random = Random::new(seed);
        let camera = fisheye();
        let motion =
            RigidTransform::new(Vector3::new(-0.9, 0.1, 0.4), Vector3::new(0.1, 0.3, -0.2));
        let mut pixels = [Vec::new(), Vec::new()];
        while pixels[0].len() < num {
            let x = Point3::from(4.0 * Vector3::from_fn(|_, _| random.normal()));
            let in_both = [x, motion * x];
            if in_both
                .iter()
                .any(|x| x.z < -0.2 * x.coords.norm() || x.coords.norm() < 1.0)
            {
                continue;
            }
            let is_wrong = pixels[0].len().is_multiple_of(4);
            let mut observe = |x: &Point3<f64>, is_wrong: bool| {
                let noise = Vector2::from_fn(|_, _| sigma_px * random.normal());
                let off = match is_wrong {
                    true => Vector2::from_fn(|_, _| random.uniform(-150.0, 150.0)),
                    false => noise,
                };
                camera.project(x).unwrap() + off
            };
            let pair = [observe(&in_both[0], false), observe(&in_both[1], is_wrong)];
            pixels[0].push(pair[0]);
            pixels[1].push(pair[1]);
        }
        (pixels, motion)
    }

    #[test]
    fn a_fisheye_finds_its_motion_among_wrong_matches() {
        let ([pixels1, pixels2], truth) = world(400, 0.5, 3);
        let (camera, options) = (fisheye(), RansacOptions::default().within(2.0));
        let report =
            estimate_relative_pose(&pixels1, &pixels2, [&camera; 2], &options, &mut ()).unwrap();
        assert!(
            report.num_inliers >= 295 && report.num_inliers < 315,
            "{}",
            report.num_inliers
        );
        let found = report.model.cam2_from_cam1();
        let rotation_deg = found.rotation.angle_to(&truth.rotation).to_degrees();
        let direction = truth.translation.vector;
        let off_deg = found.translation.vector.angle(&direction).to_degrees();
        assert!(
            rotation_deg < 0.05 && off_deg < 0.2,
            "{rotation_deg} {off_deg}"
        );
    }

    #[test]
    fn bad_input_of_any_lens_is_refused() {
        let ([pixels1, pixels2], _) = world(8, 0.5, 5);
        let pinhole = Camera::pinhole(fisheye().intrinsics, 800, 780);
        for camera in [fisheye(), pinhole] {
            let run = |num1: usize, num2: usize| {
                let (p1, p2) = (&pixels1[..num1], &pixels2[..num2]);
                let options = RansacOptions::default();
                estimate_relative_pose(p1, p2, [&camera; 2], &options, &mut ())
            };
            assert!(matches!(run(4, 4), Err(Error::TooFew { .. })));
            assert!(matches!(run(8, 7), Err(Error::SizeMismatch { .. })));
        }
    }
}
