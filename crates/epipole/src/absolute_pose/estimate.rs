//! Robust estimation of a camera pose.

use super::p3p::solve;
use super::point_errors::{LensPoints, PinholePoints, Pose};
use super::refine::{PoseProblem, refine, rigid};
use crate::camera::{Camera, Intrinsics, Observation, RigidTransform};
use crate::optim::{LmOptions, RobustLoss, Subset};
use crate::progress::Monitor;
use crate::robust::{
    Data, Estimator, FARTHEST_PX, Problem, RansacOptions, RansacReport, Support, Unique, ransac,
};
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// Estimator of camera poses from points and their pixels, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is three points; the error is the reprojection error in pixels, infinite behind the
/// camera, and for lenses other than pinholes linearized about the ray of the pixel
/// ([`Observation::offset_px`]); refinement minimizes its truncated square. Equal data count once.
#[derive(Debug, Clone)]
pub struct AbsolutePoseEstimator {
    points: Vec<Point3<f64>>,
    pixels: Vec<Point2<f64>>,
    rays: Vec<Vector3<f64>>,
    sight: Sight,
    unique: Unique,
}

/// Source of the errors.
#[derive(Debug, Clone)]
enum Sight {
    Pinhole(Intrinsics),
    AnyLens(Vec<Observation>),
}

impl AbsolutePoseEstimator {
    /// Prepares the estimation.
    ///
    /// * `points_in_world`, `pixels`: points and their projections, in the same order
    /// * `camera`: camera with any lens
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN,
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 4 points, as three have up to
    /// four poses. Points at infinity are left out, and so are pixels at infinity, beyond 10⁹ or
    /// without a ray.
    pub fn new(
        points_in_world: &[Point3<f64>],
        pixels: &[Point2<f64>],
        camera: &Camera,
    ) -> Result<Self> {
        let observed: Option<Vec<_>> = (!camera.is_pinhole()).then(|| {
            pixels
                .iter()
                .map(|pixel| camera.observe(pixel).ok())
                .collect()
        });
        let is_observed = |i: usize| {
            observed
                .as_ref()
                .is_none_or(|observations| observations[i].is_some())
        };
        let unique = usable(points_in_world, pixels, is_observed)?;
        unique.at_least(4, "a camera pose from points")?;
        let unique_indices = unique.first_occurrences();
        let k = camera.intrinsics;
        let (sight, rays) = match observed {
            None => {
                let rays = unique_indices
                    .iter()
                    .map(|&i| k.ray(&pixels[i]).normalize());
                (Sight::Pinhole(k), rays.collect())
            }
            Some(observations) => {
                let observations: Vec<Observation> = unique_indices
                    .iter()
                    .filter_map(|&i| observations[i])
                    .collect();
                let rays = observations.iter().map(Observation::ray).collect();
                (Sight::AnyLens(observations), rays)
            }
        };
        Ok(Self {
            points: unique_indices.iter().map(|&i| points_in_world[i]).collect(),
            pixels: unique_indices.iter().map(|&i| pixels[i]).collect(),
            rays,
            sight,
            unique,
        })
    }

    fn pinhole<'a>(&'a self, intrinsics: &'a Intrinsics) -> PinholePoints<'a> {
        PinholePoints {
            pixels: &self.pixels,
            intrinsics,
        }
    }

    fn refined(&self, pose: &Pose, used: Subset<'_>, loss: RobustLoss) -> Option<Pose> {
        let (points, options) = (&self.points, LmOptions::few_steps(4));
        match &self.sight {
            Sight::Pinhole(k) => {
                let errors = self.pinhole(k);
                let problem = PoseProblem {
                    points,
                    errors,
                    used,
                    loss,
                };
                refine(&problem, *pose, &options)
            }
            Sight::AnyLens(observations) => {
                let errors = LensPoints { observations };
                let problem = PoseProblem {
                    points,
                    errors,
                    used,
                    loss,
                };
                refine(&problem, *pose, &options)
            }
        }
    }

    fn in_cam(&self, (rotation, t): &Pose, index: usize) -> Vector3<f64> {
        rotation * self.points[index].coords + t
    }
}

/// Finds the usable data, without repetitions.
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::NotFinite`] for NaN.
pub(super) fn usable(
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    is_observed: impl Fn(usize) -> bool,
) -> Result<Unique> {
    if points_in_world.len() != pixels.len() {
        return Err(Error::SizeMismatch {
            what: "the list of points and that of their pixels",
            first: points_in_world.len(),
            second: pixels.len(),
        });
    }
    let is_nan = |x: &f64| x.is_nan();
    if points_in_world.iter().any(|p| p.iter().any(is_nan))
        || pixels.iter().any(|p| p.iter().any(is_nan))
    {
        return Err(Error::NotFinite {
            what: "a point or its pixel",
        });
    }
    Ok(Unique::of_usable(pixels.len(), |i| {
        let (x, p) = (&points_in_world[i], &pixels[i]);
        let values = [x.x, x.y, x.z, p.x, p.y];
        let usable = values.iter().all(|x| x.is_finite()) && p.coords.amax() <= FARTHEST_PX;
        (usable && is_observed(i)).then_some(values)
    }))
}

impl Estimator for AbsolutePoseEstimator {
    /// R and t of `cam_from_world`.
    type Model = (Matrix3<f64>, Vector3<f64>);

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

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        let rays = core::array::from_fn(|i| self.rays[sample[i]]);
        let points = core::array::from_fn(|i| self.points[sample[i]].coords);
        let mut solutions = [(Matrix3::zeros(), Vector3::zeros()); 4];
        let count = solve(&rays, &points, &mut solutions);
        models.extend_from_slice(&solutions[..count]);
    }

    fn error_sq(&self, pose: &Self::Model, index: usize) -> f64 {
        let x = self.in_cam(pose, index);
        match &self.sight {
            Sight::Pinhole(k) => self.pinhole(k).error_sq(&x, index),
            Sight::AnyLens(observations) => observations[index].error_sq(&x),
        }
    }

    fn support(&self, pose: &Pose, max_error_px: f64, cost_limit: f64) -> Support {
        let data = self.problem().data;
        match &self.sight {
            Sight::Pinhole(k) => {
                let errors = self.pinhole(k);
                let error_sq = |i| errors.error_sq(&self.in_cam(pose, i), i);
                data.support(error_sq, max_error_px, cost_limit)
            }
            Sight::AnyLens(_) => {
                let error_sq = |i| self.error_sq(pose, i);
                data.support(error_sq, max_error_px, cost_limit)
            }
        }
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

/// Estimates the pose `cam_from_world` on which most points agree.
///
/// * `points_in_world`, `pixels`: points and their projections, outliers included
/// * `camera`: camera with any lens
/// * `options`: [`RansacOptions::max_error_px`] bounds the reprojection error of an inlier
///
/// # Errors
/// As [`AbsolutePoseEstimator::new`] and [`ransac`]; points on one line give
/// [`Error::NoConsensus`].
///
/// Source: Fischler & Bolles 1981, with P3P as the minimal solver.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::absolute_pose::estimate_absolute_pose;
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let camera = Camera::pinhole(Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, 640, 480);
/// let cam_from_world = RigidTransform::new(Vector3::new(0.1, -0.2, 6.0), Vector3::new(0.1, 0.2, 0.3));
/// let (mut points, mut pixels) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, f64::from(i * i % 7) - 2.0);
///     points.push(x);
///     pixels.push(camera.project(&(cam_from_world * x))?);
/// }
/// // Every fourth pixel belongs to another object.
/// for pixel in pixels.iter_mut().step_by(4) {
///     pixel.x = 640.0 - pixel.y;
/// }
/// let report = estimate_absolute_pose(&points, &pixels, &camera, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 30);
/// assert!(report.model.rotation.angle_to(&cam_from_world.rotation) < 1e-6);
/// assert!((report.model.translation.vector - cam_from_world.translation.vector).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_absolute_pose(
    points_in_world: &[Point3<f64>],
    pixels: &[Point2<f64>],
    camera: &Camera,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RigidTransform>> {
    let estimator = AbsolutePoseEstimator::new(points_in_world, pixels, camera)?;
    let report = ransac(estimator, options, monitor)?;
    // Keep the projection of an inlier fixed; there are at least three.
    let inlier = report.inliers.iter().position(|&inlier| inlier);
    let fixed = points_in_world[inlier.unwrap_or(0)].coords;
    Ok(report.map(|pose| rigid(&pose, &fixed)))
}
