//! Robust estimation of H for the rays of calibrated cameras.

use super::estimate_homography;
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Camera, Observation};
use crate::epipolar::ObservedMatches;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use crate::progress::Monitor;
use crate::robust::{Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, ransac};
use nalgebra::{Matrix3, Point2, SMatrix, SVector, Vector3};

/// Estimator of homographies of rays: four matches per sample, errors in the pixels of image 2.
struct RayHomographyEstimator {
    matches: MatchSet,
    rays1: Vec<Vector3<f64>>,
    observations2: Vec<Observation>,
}

/// Returns three rays scaled so that their sum is the fourth; `None` if three of the four lie in a
/// plane.
fn basis(rays: &[Vector3<f64>; 4]) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let columns = Matrix3::from_columns(&[rays[0], rays[1], rays[2]]);
    let lengths = columns.try_inverse()? * rays[3];
    let is_sound = lengths.iter().all(|x| x.abs() > 1e-9 && x.is_finite());
    is_sound.then(|| (columns * Matrix3::from_diagonal(&lengths), lengths))
}

/// Solves for H with `ray2 ∝ H ray1`, with positive factors, for all four.
fn solve(rays1: &[Vector3<f64>; 4], rays2: &[Vector3<f64>; 4]) -> Option<Matrix3<f64>> {
    let ((basis1, lengths1), (basis2, lengths2)) = (basis(rays1)?, basis(rays2)?);
    // If both cameras see a plane from the same side, all factors are positive.
    let keeps_sides = lengths1.zip_map(&lengths2, |a, b| a * b).min() > 0.0;
    let homography = basis2 * basis1.try_inverse()?;
    keeps_sides.then(|| unit(&homography))?
}

fn unit(homography: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let norm = homography.norm();
    (norm.is_finite() && norm > 0.0).then(|| homography / norm)
}

impl RayHomographyEstimator {
    fn refined(
        &self,
        homography: &Matrix3<f64>,
        used: Subset<'_>,
        loss: RobustLoss,
    ) -> Option<Matrix3<f64>> {
        let problem = RayHomographyProblem {
            rays1: &self.rays1,
            observations2: &self.observations2,
            used,
            loss,
        };
        let mut refined = *homography;
        minimize_fixed(&problem, &mut refined, &LmOptions::few_steps(4)).ok()?;
        unit(&refined)
    }
}

impl Estimator for RayHomographyEstimator {
    type Model = Matrix3<f64>;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a homography of rays",
            sample_size: 4,
            max_models: 1,
            codimension: 2,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Matrix3<f64>>) {
        let rays1 = core::array::from_fn(|i| self.rays1[sample[i]]);
        let rays2 = core::array::from_fn(|i| self.observations2[sample[i]].ray());
        models.extend(solve(&rays1, &rays2));
    }

    fn error_sq(&self, homography: &Matrix3<f64>, index: usize) -> f64 {
        self.observations2[index].error_sq(&(homography * self.rays1[index]))
    }

    fn refine(
        &mut self,
        homography: &Matrix3<f64>,
        inliers: &[usize],
        max_error_px: f64,
    ) -> Option<Matrix3<f64>> {
        let loss = RobustLoss::Truncated {
            width: max_error_px,
        };
        self.refined(homography, Subset::alike(inliers), loss)
    }

    fn polish(
        &mut self,
        homography: &Matrix3<f64>,
        near: &[usize],
        weights: &[f64],
    ) -> Option<Matrix3<f64>> {
        let near = Subset::weighted(near, weights);
        self.refined(homography, near, RobustLoss::Trivial)
    }
}

/// All nine entries of H are free. Its norm, which does not affect errors, is held by damping.
struct RayHomographyProblem<'a> {
    rays1: &'a [Vector3<f64>],
    observations2: &'a [Observation],
    used: Subset<'a>,
    loss: RobustLoss,
}

impl FixedProblem<9> for RayHomographyProblem<'_> {
    type Parameters = Matrix3<f64>;

    fn accumulate(&self, homography: &Matrix3<f64>, normal: &mut NormalEquations<9>) {
        for (index, root) in self.used.iter() {
            let ray1 = &self.rays1[index];
            let offset = self.observations2[index].offset_with_derivative(&(homography * ray1));
            let Some((off, by_point)) = offset else {
                normal.cost = f64::INFINITY;
                continue;
            };
            let mut jacobian = SMatrix::<f64, 2, 9>::zeros();
            for column in 0..3 {
                let by_column = by_point * ray1[column];
                (jacobian.fixed_view_mut::<2, 3>(0, 3 * column)).copy_from(&by_column);
            }
            normal.add(&(off * root), &(jacobian * root), &self.loss);
        }
    }

    fn cost(&self, homography: &Matrix3<f64>) -> f64 {
        let mut total = 0.0;
        for (index, root) in self.used.iter() {
            let error_sq = self.observations2[index].error_sq(&(homography * self.rays1[index]));
            if error_sq.is_infinite() {
                return f64::INFINITY;
            }
            total += 0.5 * self.loss.rho(root * root * error_sq);
        }
        total
    }

    fn plus(&self, homography: &Matrix3<f64>, delta: &SVector<f64, 9>) -> Matrix3<f64> {
        let moved = homography + Matrix3::from_column_slice(delta.as_slice());
        unit(&moved).unwrap_or(moved)
    }
}

/// Estimates the homography of rays, `ray2 ∝ H ray1` with positive factors, on which most matches
/// of two calibrated cameras agree: of a plane, or of a camera that only rotated. H has unit
/// Frobenius norm.
///
/// * `pixels1`, `pixels2`: matching pixels, in the same order, outliers included
/// * `cameras`: the two cameras, with any lens
/// * `options`: [`RansacOptions::max_error_px`] bounds the error of an inlier in image 2, pixels
///
/// Between pinhole cameras it equals `K2⁻¹ H K1` with H from [`estimate_homography`].
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::TooFew`] for fewer than 4 unique
/// matches that both lenses see, and as [`estimate_homography`] and [`ransac`].
///
/// Source: as [`homography_4point`](super::homography_4point), with rays instead of homogeneous
/// points.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
/// use epipole::homography::estimate_homography_calibrated;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let lens = Lens::Fisheye(Fisheye::default());
/// let camera = Camera { lens, ..Camera::pinhole(Intrinsics::centered(200.0, 640, 640)?, 640, 640) };
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-0.5, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     // The floor, 1 below the camera; some of it is beside and behind the camera.
///     let x = Point3::new(f64::from(i * 7 % 11) - 5.0, 1.0, 4.0 - 0.1 * f64::from(i * 3 % 43));
///     p1.push(camera.project(&x)?);
///     p2.push(camera.project(&(cam2_from_cam1 * x))?);
/// }
/// let report = estimate_homography_calibrated(&p1, &p2, [&camera; 2], &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 40);
/// // As from `homography_from_motion`, with n = −y and d = 1.
/// let h = cam2_from_cam1.rotation.to_rotation_matrix().matrix()
///     + cam2_from_cam1.translation.vector * Vector3::y().transpose();
/// assert!((report.model - h / h.norm()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_homography_calibrated(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    if Camera::are_pinholes(cameras) {
        let report = estimate_homography(pixels1, pixels2, options, monitor)?;
        let [k1, k2] = cameras.map(|camera| camera.intrinsics);
        let of_rays = k2.inverse_matrix() * report.model * k1.matrix();
        // A plane is in front of both cameras, so the factor of an inlier determines the sign.
        let inlier = report.inliers.iter().position(|&is| is);
        let is_in_front = inlier.is_none_or(|i| (of_rays * k1.ray(&pixels1[i])).z > 0.0);
        let signed = if is_in_front { of_rays } else { -of_rays };
        return Ok(report.map(|_| signed / signed.norm()));
    }
    let ObservedMatches {
        matches,
        observations,
    } = ObservedMatches::new(pixels1, pixels2, cameras)?;
    matches.at_least(4, "a homography of rays")?;
    let [observations1, observations2] = observations;
    let estimator = RayHomographyEstimator {
        matches,
        rays1: observations1.iter().map(Observation::ray).collect(),
        observations2,
    };
    ransac(estimator, options, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector, Point3, Vector2};

    fn pinhole() -> Camera {
        Camera::pinhole(Intrinsics::centered(250.0, 800, 800).unwrap(), 800, 800)
    }

    fn fisheye() -> Camera {
        Camera {
            lens: Lens::Fisheye(Fisheye::default()),
            ..pinhole()
        }
    }

    /// A wall with noise, every fourth match wrong.
    fn wall(
        camera: &Camera,
        num: usize,
        sigma_px: f64,
        seed: u64,
    ) -> ([Vec<Point2<f64>>; 2], Matrix3<f64>) {
        let mut random = Random::new(seed);
        let motion =
            RigidTransform::new(Vector3::new(-0.4, 0.1, 0.2), Vector3::new(0.1, 0.3, -0.2));
        let mut observe = |x: &Point3<f64>, off_px: f64| -> Option<Point2<f64>> {
            let projected = camera.project(x).ok()?;
            let is_inside = projected.iter().all(|x| (0.0..800.0).contains(x));
            is_inside.then(|| projected + Vector2::from_fn(|_, _| off_px * random.normal()))
        };
        let mut places = Random::new(seed + 1);
        let mut projected = [Vec::new(), Vec::new()];
        while projected[0].len() < num {
            let x = Point3::new(3.0 * places.normal(), 3.0 * places.normal(), 1.5);
            let is_wrong = projected[0].len().is_multiple_of(4);
            let off_px = if is_wrong { 60.0 } else { sigma_px };
            if let (Some(one), Some(two)) = (observe(&x, sigma_px), observe(&(motion * x), off_px))
            {
                projected[0].push(one);
                projected[1].push(two);
            }
        }
        let rotation = motion.rotation.to_rotation_matrix().into_inner();
        let h = rotation + motion.translation.vector * Vector3::z().transpose() / 1.5;
        (projected, h / h.norm())
    }

    #[test]
    fn a_wall_is_found_among_wrong_matches() {
        for camera in [fisheye(), pinhole()] {
            let ([p1, p2], truth) = wall(&camera, 200, 0.5, 1);
            let options = RansacOptions::default().within(3.0);
            let report =
                estimate_homography_calibrated(&p1, &p2, [&camera; 2], &options, &mut ()).unwrap();
            assert!(
                (148..156).contains(&report.num_inliers),
                "{}",
                report.num_inliers
            );
            let off = (report.model - truth).norm();
            assert!(off < 0.005, "{off}");
        }
    }

    #[test]
    fn derivatives_are_differences() {
        let (pixels, truth) = wall(&fisheye(), 12, 0.5, 3);
        let observed = pixels.map(|pixels| -> Vec<_> {
            let observe = |pixel| fisheye().observe(pixel).unwrap();
            pixels.iter().map(observe).collect()
        });
        let rays1: Vec<_> = observed[0].iter().map(Observation::ray).collect();
        for i in (0..12usize).filter(|i| i % 4 != 0) {
            let used = [i];
            let problem = RayHomographyProblem {
                rays1: &rays1,
                observations2: &observed[1],
                used: Subset::alike(&used),
                loss: RobustLoss::Trivial,
            };
            let at = |delta: &DVector<f64>| {
                let moved = truth + Matrix3::from_column_slice(delta.as_slice());
                DVector::from_element(1, problem.cost(&moved))
            };
            let mut normal = NormalEquations::<9>::new();
            problem.accumulate(&truth, &mut normal);
            let analytic = DMatrix::from_row_slice(1, 9, normal.gradient.as_slice());
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-4);
        }
    }

    #[test]
    fn bad_input_is_refused() {
        for camera in [fisheye(), pinhole()] {
            let ([p1, p2], _) = wall(&camera, 8, 0.5, 5);
            let run = |num1: usize, num2: usize| {
                let options = RansacOptions::default();
                let (p1, p2) = (&p1[..num1], &p2[..num2]);
                estimate_homography_calibrated(p1, p2, [&camera; 2], &options, &mut ())
            };
            assert!(matches!(run(3, 3), Err(Error::TooFew { .. })));
            assert!(matches!(run(8, 7), Err(Error::SizeMismatch { .. })));
        }
        // Rays in one plane through the center give no homography.
        let flat = [0.1, 0.2, 0.4, 0.8, 0.9].map(|x| Vector3::new(x, 0.0, 1.0));
        let of_four = core::array::from_fn(|i| flat[i]);
        assert!(solve(&of_four, &of_four).is_none());
    }
}
