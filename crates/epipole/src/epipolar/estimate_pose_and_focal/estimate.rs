//! Robust estimation of relative pose and focal length.

use super::focal_estimator::{FocalEstimator, NAME};
use super::pose_with_focal::PoseWithFocal;
use crate::Result;
use crate::camera::Intrinsics;
use crate::epipolar::coordinates::Coordinates;
use crate::epipolar::five_point::pose_in_front;
use crate::epipolar::focal_profile::FocalProfile;
use crate::epipolar::refine_focal::{refine_pose_and_focal_in_frame, relative_focal_deviation};
use crate::epipolar::six_point::{EssentialWithFocal, MAX_SOLUTIONS, solve};
use crate::epipolar::{RelativePose, decompose_essential, sampson, sampson_sq, select_pose};
use crate::math::random::Random;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::robust::{
    Data, Estimator, Evidence, MatchSet, Problem, RansacOptions, RansacReport, Support, ransac,
};
use arrayvec::ArrayVec;
use nalgebra::{Point2, Vector3};

impl FocalEstimator {
    fn refined(
        &self,
        model: &PoseWithFocal,
        coordinates: &Coordinates,
        loss: RobustLoss,
        max_iterations: usize,
    ) -> Option<PoseWithFocal> {
        let options = LmOptions::few_steps(max_iterations);
        let (pose, focal_px) = refine_pose_and_focal_in_frame(
            coordinates,
            &self.centers_in_frame,
            (&model.pose, model.focal_px),
            loss,
            &options,
        )?;
        let is_usable = self.is_usable(focal_px);
        is_usable.then(|| PoseWithFocal::new(pose, focal_px, &self.centers))?
    }

    /// Returns the standard deviation of the focal length of a model, from its inliers.
    fn focal_std_px(&self, model: &PoseWithFocal, max_error_px: f64) -> Option<f64> {
        let mut inliers = Vec::new();
        self.inliers(model, max_error_px, &mut inliers);
        let near = self.in_frame.weighted(&inliers, &vec![1.0; inliers.len()]);
        let deviation = relative_focal_deviation(
            &near,
            inliers.len(),
            &self.centers_in_frame,
            (&model.pose, model.focal_px),
        )?;
        let profile = FocalProfile::new(self, model, max_error_px, &mut Random::new(0));
        let elsewhere = profile.map_or(0.0, |profile| profile.relative_deviation(model));
        Some(deviation.max(elsewhere) * model.focal_px)
    }
}

impl Estimator for FocalEstimator {
    type Model = PoseWithFocal;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: NAME,
            sample_size: 6,
            max_models: MAX_SOLUTIONS,
            codimension: 1,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<PoseWithFocal>) {
        if self.matches.have_shared_pixel(sample) {
            return;
        }
        let pairs: [_; 6] = core::array::from_fn(|i| self.matches.pair(sample[i]));
        let about1 = pairs.map(|(p1, _)| p1 - self.centers[0].coords);
        let about2 = pairs.map(|(_, p2)| p2 - self.centers[1].coords);
        let mut found = ArrayVec::<EssentialWithFocal, MAX_SOLUTIONS>::new();
        solve(&about1, &about2, &mut found);
        for solution in &found {
            if !self.is_usable(solution.focal_px) {
                continue;
            }
            let ray = |p: Point2<f64>| Vector3::new(p.x, p.y, solution.focal_px).normalize();
            let (rays1, rays2) = (about1.map(ray), about2.map(ray));
            if let Some(pose) = pose_in_front(&solution.essential, &rays1, &rays2) {
                models.extend(PoseWithFocal::new(pose, solution.focal_px, &self.centers));
            }
        }
    }

    fn error_sq(&self, model: &PoseWithFocal, index: usize) -> f64 {
        let (x1, x2) = self.matches.pair(index);
        sampson_sq(&model.fundamental, &x1, &x2)
    }

    fn refine(
        &mut self,
        model: &PoseWithFocal,
        _: &[usize],
        max_error_px: f64,
    ) -> Option<PoseWithFocal> {
        let loss = RobustLoss::Truncated {
            width: max_error_px * self.frame.scale,
        };
        self.refined(model, &self.in_frame, loss, 2)
    }

    fn polish(
        &mut self,
        model: &PoseWithFocal,
        near: &[usize],
        weights: &[f64],
    ) -> Option<PoseWithFocal> {
        let near = self.in_frame.weighted(near, weights);
        self.refined(model, &near, RobustLoss::Trivial, 4)
    }

    fn alternative(
        &mut self,
        model: &PoseWithFocal,
        evidence: Evidence<'_>,
        max_error_px: f64,
        random: &mut Random,
    ) -> Option<PoseWithFocal> {
        let Evidence::Inliers(_) = evidence else {
            return None;
        };
        FocalProfile::new(self, model, max_error_px, random)?.better_than(model)
    }

    fn support(&self, model: &PoseWithFocal, max_error_px: f64, cost_limit: f64) -> Support {
        sampson::support(&self.pixels, &model.fundamental, max_error_px, cost_limit)
    }

    fn inliers(&self, model: &PoseWithFocal, max_error_px: f64, inliers: &mut Vec<usize>) {
        sampson::inliers(&self.pixels, &model.fundamental, max_error_px, inliers);
    }
}

/// Estimates the relative pose and the common focal length of two cameras on which most matches
/// agree.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `principal1`, `principal2`: principal points, pixels: for most cameras the image centers
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier
///
/// Of the four motions that the essential matrix allows, returns the one with the most inliers in
/// front of both cameras. If the optical axes are nearly parallel, or meet at the same distance
/// from both cameras, as when both look at one object from the same distance, any focal length fits
/// nearly as well: then [`PoseWithFocal::constrains_focal`] is false, and rotation and direction
/// are less accurate.
///
/// # Errors
/// As [`MatchSet::new`] and [`ransac`]; [`Error::TooFew`](crate::Error::TooFew),
/// [`Error::TooFewDistinct`](crate::Error::TooFewDistinct) for fewer than 6 matches,
/// [`Error::Degenerate`](crate::Error::Degenerate) if all pixels of an image are equal or on one
/// line, [`Error::NotFinite`](crate::Error::NotFinite) for principal points that are not finite.
///
/// Source: as [`essential_6point`](crate::epipolar::essential_6point), the minimal solver.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose_and_focal;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.6), Vector3::new(0.2, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// let middle = k.principal_point();
/// let report = estimate_relative_pose_and_focal(&p1, &p2, &middle, &middle, &RansacOptions::default(), &mut ())?;
/// assert!((report.model.focal_px - 700.0).abs() < 0.1);
/// let found = report.model.pose.cam2_from_cam1();
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-4);
/// # Ok(()) }
/// ```
pub fn estimate_relative_pose_and_focal(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    principal1: &Point2<f64>,
    principal2: &Point2<f64>,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<PoseWithFocal>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    let estimator = FocalEstimator::new(matches, principal1, principal2)?;
    let all = estimator.clone();
    let mut report = ransac(estimator, options, monitor)?;
    report.model.focal_std_px = all.focal_std_px(&report.model, report.max_error_px);
    let focal_px = report.model.focal_px;
    let [k1, k2] = [principal1, principal2].map(|c| Intrinsics::new(focal_px, focal_px, c.x, c.y));
    let (k1, k2) = (k1?, k2?);
    let inliers_of = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        let inliers = pixels.iter().zip(&report.inliers).filter(|(_, is)| **is);
        inliers.map(|(pixel, _)| *pixel).collect()
    };
    let (inliers1, inliers2) = (inliers_of(pixels1), inliers_of(pixels2));
    let motions = decompose_essential(&report.model.pose.essential())?;
    let chosen = select_pose(&motions, &inliers1, &inliers2, &k1, &k2)?;
    report.model.pose = RelativePose::from_motion(&chosen.cam2_from_cam1)?;
    report.model.fundamental = report.model.pose.fundamental(&k1, &k2)?;
    Ok(report)
}
