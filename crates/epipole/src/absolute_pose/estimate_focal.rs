//! Robust estimation of a camera pose with its focal length.

use super::estimate::usable;
use super::p4pf::{MAX_SOLUTIONS, solve};
use super::point_errors::PinholePoints;
use super::pose_with_focal::{AbsolutePoseWithFocal, PoseFocal};
use super::refine::{PoseProblem, rigid};
use super::refine_focal::{refine_with_focal, relative_focal_deviation};
use crate::camera::{Intrinsics, plausible_focals_px};
use crate::optim::{LmOptions, RobustLoss, Subset};
use crate::progress::Monitor;
use crate::robust::{Data, Estimator, Problem, RansacOptions, RansacReport, Unique, ransac};
use crate::{Error, Result};
use arrayvec::ArrayVec;
use core::ops::Range;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// Relative standard deviation above which a focal length is no better than a guess.
const TELLING: f64 = 0.1;

const NAME: &str = "a camera pose with a focal length from points";

impl AbsolutePoseWithFocal {
    /// Returns whether the points determine the focal length to within a tenth.
    pub fn constrains_focal(&self) -> bool {
        self.focal_std_px
            .is_some_and(|std_px| std_px < TELLING * self.focal_px)
    }
}

/// Estimator of camera poses with an unknown focal length from points and their pixels.
///
/// A sample is four points, and only solutions with a plausible focal length are scored: at least a
/// fifth of the distance from the principal point within which three quarters of the pixels are,
/// and at most twenty times the distance of the farthest. The error is the reprojection error in
/// pixels, infinite behind the camera; refinement minimizes its truncated square over the pose and
/// the focal length. Equal data count once.
///
/// Source: as [`pose_p4pf`](super::pose_p4pf).
#[derive(Debug, Clone)]
struct AbsolutePoseFocalEstimator {
    points: Vec<Point3<f64>>,
    /// Pixels relative to the principal point.
    pixels: Vec<Point2<f64>>,
    focals_px: Range<f64>,
    centered: Intrinsics,
    unique: Unique,
}

impl AbsolutePoseFocalEstimator {
    /// Prepares the estimation.
    ///
    /// * `points_in_world`, `pixels`: points and their projections, in the same order
    /// * `principal`: principal point, pixels
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN and for
    /// a principal point that is not finite, [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer
    /// than 5 points, as four may have several poses. Points at infinity are left out, and so are
    /// pixels at infinity or beyond 10⁹.
    fn new(
        points_in_world: &[Point3<f64>],
        pixels: &[Point2<f64>],
        principal: &Point2<f64>,
    ) -> Result<Self> {
        if !(principal.x.is_finite() && principal.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the principal point",
            });
        }
        let unique = usable(points_in_world, pixels, |_| true)?;
        unique.at_least(5, NAME)?;
        let unique_indices = unique.first_occurrences();
        let pixels: Vec<_> =
            (unique_indices.iter().map(|&i| pixels[i] - principal.coords)).collect();
        let mut far: Vec<_> = pixels.iter().map(|p| p.coords.norm()).collect();
        Ok(Self {
            points: unique_indices.iter().map(|&i| points_in_world[i]).collect(),
            focals_px: plausible_focals_px(&mut far),
            pixels,
            // The focal length is not used.
            centered: Intrinsics::new(1.0, 1.0, 0.0, 0.0)?,
            unique,
        })
    }

    fn reprojection<'a>(
        &'a self,
        used: Subset<'a>,
        loss: RobustLoss,
    ) -> PoseProblem<'a, PinholePoints<'a>> {
        PoseProblem {
            points: &self.points,
            errors: PinholePoints {
                pixels: &self.pixels,
                intrinsics: &self.centered,
            },
            used,
            loss,
        }
    }

    fn refined(
        &self,
        model: &PoseFocal,
        problem: &PoseProblem<'_, PinholePoints<'_>>,
    ) -> Option<PoseFocal> {
        let options = LmOptions::few_steps(4);
        refine_with_focal(problem, model, &options).filter(|found| self.is_usable(found.2))
    }

    fn is_usable(&self, focal_px: f64) -> bool {
        self.focals_px.contains(&focal_px)
    }

    /// Returns the standard deviation of the focal length of a model, from its inliers.
    fn focal_std_px(&self, model: &PoseFocal, max_error_px: f64) -> Option<f64> {
        let mut inliers = Vec::new();
        self.inliers(model, max_error_px, &mut inliers);
        let problem = self.reprojection(Subset::alike(&inliers), RobustLoss::Trivial);
        Some(relative_focal_deviation(&problem, model)? * model.2)
    }
}

impl Estimator for AbsolutePoseFocalEstimator {
    /// R and t of `cam_from_world`, and the focal length.
    type Model = (Matrix3<f64>, Vector3<f64>, f64);

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: NAME,
            sample_size: 4,
            max_models: MAX_SOLUTIONS,
            codimension: 2,
            data: Data::Pixels {
                pixels: &self.pixels,
                unique: &self.unique,
            },
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        let pixels = core::array::from_fn(|i| self.pixels[sample[i]]);
        let points = core::array::from_fn(|i| self.points[sample[i]].coords);
        let mut solutions = ArrayVec::new();
        solve(&pixels, &points, &mut solutions);
        models.extend(
            solutions
                .into_iter()
                .filter(|found| self.is_usable(found.2)),
        );
    }

    fn error_sq(&self, (rotation, t, focal_px): &Self::Model, index: usize) -> f64 {
        let x = rotation * self.points[index].coords + t;
        let projected = x.xy() * (focal_px / x.z);
        if x.z > 0.0 {
            (projected - self.pixels[index].coords).norm_squared()
        } else {
            f64::INFINITY
        }
    }

    fn refine(
        &mut self,
        model: &PoseFocal,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<PoseFocal> {
        let loss = RobustLoss::Truncated {
            width: max_error_px,
        };
        self.refined(model, &self.reprojection(Subset::alike(inliers), loss))
    }

    fn polish(&mut self, model: &PoseFocal, near: &[usize], weights: &[f64]) -> Option<PoseFocal> {
        self.refined(
            model,
            &self.reprojection(Subset::weighted(near, weights), RobustLoss::Trivial),
        )
    }
}

/// Estimates the pose `cam_from_world` and the focal length on which most points agree.
///
/// * `points_in_world`, `pixels`: points and their projections, outliers included
/// * `principal`: principal point, pixels: for most cameras the image center. Pixels are square
/// * `options`: [`RansacOptions::max_error_px`] bounds the reprojection error of an inlier
///
/// The points may lie on a plane, unless it faces the camera: then every focal length fits nearly
/// as well, at a suitable distance, and [`AbsolutePoseWithFocal::constrains_focal`] is false. The
/// same holds for points with nearly equal depths.
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN and for a
/// principal point that is not finite, [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than
/// 5 points, as four may have several poses, and as [`ransac`]; points on one line give
/// [`Error::NoConsensus`]. Points at infinity are left out, and so are pixels at infinity or beyond
/// 10⁹.
///
/// Source: Fischler & Bolles 1981, with [`pose_p4pf`](super::pose_p4pf) as the minimal solver.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::estimate_absolute_pose_and_focal;
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.2, 0.3));
/// let (mut points, mut pixels) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, f64::from(i * i % 7) - 2.0);
///     points.push(x);
///     pixels.push(k.project(&(cam_from_world * x))?);
/// }
/// // Every fourth pixel belongs to another object.
/// for pixel in pixels.iter_mut().step_by(4) {
///     pixel.x = 640.0 - pixel.y;
/// }
/// let options = RansacOptions::default();
/// let report = estimate_absolute_pose_and_focal(&points, &pixels, &k.principal_point(), &options, &mut ())?;
/// assert_eq!(report.num_inliers, 30);
/// assert!((report.model.focal_px - 700.0).abs() < 1e-3 && report.model.constrains_focal());
/// assert!(report.model.cam_from_world.rotation.angle_to(&cam_from_world.rotation) < 1e-6);
/// # Ok(()) }
/// ```
#[doc(alias = "solvePnP")]
pub fn estimate_absolute_pose_and_focal(
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    principal: &Point2<f64>,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<AbsolutePoseWithFocal>> {
    let estimator = AbsolutePoseFocalEstimator::new(points_in_world, pixels, principal)?;
    let all = estimator.clone();
    let report = ransac(estimator, options, monitor)?;
    // Keep the projection of an inlier fixed; there are at least four.
    let inlier = report.inliers.iter().position(|&inlier| inlier);
    let fixed = points_in_world[inlier.unwrap_or(0)].coords;
    let focal_std_px = all.focal_std_px(&report.model, report.max_error_px);
    Ok(report.map(|(rotation, t, focal_px)| AbsolutePoseWithFocal {
        cam_from_world: rigid(&(rotation, t), &fixed),
        focal_px,
        focal_std_px,
    }))
}
