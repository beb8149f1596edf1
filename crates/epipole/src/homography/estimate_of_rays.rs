//! H of a plane from rays of which many are wrongly matched: for lenses that no pinhole camera stands for.

#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::Observation;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, Subset, minimize_fixed};
use crate::progress::Monitor;
use crate::robust::{Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, ransac};
use nalgebra::{Matrix3, Point2, SMatrix, SVector, Vector3};

/// Homographies of rays, for RANSAC: four matches a sample, errors in the pixels of image 2.
struct RayHomographyEstimator {
    matches: MatchSet,
    rays1: Vec<Vector3<f64>>,
    seen2: Vec<Observation>,
}

/// The three rays, each so long that together they are the fourth: `None` if three of the four lie in a plane.
fn basis(rays: &[Vector3<f64>; 4]) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let columns = Matrix3::from_columns(&[rays[0], rays[1], rays[2]]);
    let lengths = columns.try_inverse()? * rays[3];
    let is_sound = lengths.iter().all(|x| x.abs() > 1e-9 && x.is_finite());
    is_sound.then(|| (columns * Matrix3::from_diagonal(&lengths), lengths))
}

/// H with `ray2 ∝ H ray1`, by a positive factor, for all four.
fn solve(rays1: &[Vector3<f64>; 4], rays2: &[Vector3<f64>; 4]) -> Option<Matrix3<f64>> {
    let ((basis1, lengths1), (basis2, lengths2)) = (basis(rays1)?, basis(rays2)?);
    // A plane that both cameras see from one side keeps the sides of its rays.
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
            seen2: &self.seen2,
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
        let rays2 = core::array::from_fn(|i| self.seen2[sample[i]].ray());
        models.extend(solve(&rays1, &rays2));
    }

    fn error_sq(&self, homography: &Matrix3<f64>, index: usize) -> f64 {
        self.seen2[index].error_sq(&(homography * self.rays1[index]))
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

/// All nine numbers of H are free. Its length, which no error depends on, is held by the damping.
struct RayHomographyProblem<'a> {
    rays1: &'a [Vector3<f64>],
    seen2: &'a [Observation],
    used: Subset<'a>,
    loss: RobustLoss,
}

impl FixedProblem<9> for RayHomographyProblem<'_> {
    type Parameters = Matrix3<f64>;

    fn accumulate(&self, homography: &Matrix3<f64>, normal: &mut NormalEquations<9>) {
        for (index, root) in self.used.iter() {
            let ray1 = &self.rays1[index];
            let seen = self.seen2[index].offset_with_derivative(&(homography * ray1));
            let Some((off, by_point)) = seen else {
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
            let error_sq = self.seen2[index].error_sq(&(homography * self.rays1[index]));
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

/// The homography of rays, `ray2 ∝ H ray1` by a positive factor, that most matches agree on, whatever lenses saw them:
/// of a plane, or of a camera that only turned. H has unit Frobenius norm.
///
/// * `seen1`, `seen2`: matching pixels with their rays, in the same order; wrong matches are expected
/// * `options`: [`RansacOptions::max_error_px`] bounds the error of an inlier in image 2, in the pixels of the photograph
///
/// # Errors
/// [`Error::SizeMismatch`] for lists of different length, [`Error::TooFew`] for fewer than 4 different matches, and as
/// [`ransac`].
///
/// Source: as [`homography_4point`](super::homography_4point), with rays in the place of homogeneous points.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, RigidTransform};
/// use epipole::homography::estimate_homography_of_rays;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point2, Point3, Vector3};
/// let lens = Lens::Fisheye(Fisheye::default());
/// let camera = Camera { lens, ..Camera::pinhole(Intrinsics::centered(200.0, 640, 640)?, 640, 640) };
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-0.5, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let see = |x: &Point3<f64>| camera.observe(&camera.project(x)?);
/// let (mut seen1, mut seen2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     // The floor, 1 below the camera; some of it is beside and behind.
///     let x = Point3::new(f64::from(i * 7 % 11) - 5.0, 1.0, 4.0 - 0.1 * f64::from(i * 3 % 43));
///     seen1.push(see(&x)?);
///     seen2.push(see(&(cam2_from_cam1 * x))?);
/// }
/// let report = estimate_homography_of_rays(&seen1, &seen2, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 40);
/// // As `homography_from_motion` has it, with n = −y and d = 1.
/// let h = cam2_from_cam1.rotation.to_rotation_matrix().matrix()
///     + cam2_from_cam1.translation.vector * Vector3::y().transpose();
/// assert!((report.model - h / h.norm()).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn estimate_homography_of_rays(
    seen1: &[Observation],
    seen2: &[Observation],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    let pixels = [seen1, seen2]
        .map(|seen| -> Vec<Point2<f64>> { seen.iter().map(Observation::pixel).collect() });
    let matches = MatchSet::new(&pixels[0], &pixels[1])?;
    matches.at_least(4, "a homography of rays")?;
    let kept = matches.unique().first_occurrences();
    let rays1 = kept.iter().map(|&i| seen1[i].ray()).collect();
    let seen2 = kept.iter().map(|&i| seen2[i]).collect();
    let estimator = RayHomographyEstimator {
        matches,
        rays1,
        seen2,
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

    /// A wall seen by a fisheye with noise, every fourth match wrong.
    fn wall(num: usize, sigma_px: f64, seed: u64) -> ([Vec<Observation>; 2], Matrix3<f64>) {
        let mut random = Random::new(seed);
        let camera = Camera {
            lens: Lens::Fisheye(Fisheye::default()),
            ..Camera::pinhole(Intrinsics::centered(250.0, 800, 800).unwrap(), 800, 800)
        };
        let motion =
            RigidTransform::new(Vector3::new(-0.4, 0.1, 0.2), Vector3::new(0.1, 0.3, -0.2));
        let mut see = |x: &Vector3<f64>, off_px: f64| {
            let seen = camera.project(&Point3::from(*x)).unwrap();
            let off = Vector2::from_fn(|_, _| off_px * random.normal());
            camera.observe(&(seen + off)).unwrap()
        };
        let mut places = Random::new(seed + 1);
        let mut seen = [Vec::new(), Vec::new()];
        for n in 0..num {
            let x = Point3::new(3.0 * places.normal(), 3.0 * places.normal(), 1.5);
            seen[0].push(see(&x.coords, sigma_px));
            let off_px = if n % 4 == 0 { 60.0 } else { sigma_px };
            seen[1].push(see(&(motion * x).coords, off_px));
        }
        let rotation = motion.rotation.to_rotation_matrix().into_inner();
        let h = rotation + motion.translation.vector * Vector3::z().transpose() / 1.5;
        (seen, h / h.norm())
    }

    #[test]
    fn a_wall_is_found_among_wrong_matches() {
        let (seen, truth) = wall(200, 0.5, 1);
        let options = RansacOptions::default().within(3.0);
        let report = estimate_homography_of_rays(&seen[0], &seen[1], &options, &mut ()).unwrap();
        assert!(
            (148..156).contains(&report.num_inliers),
            "{}",
            report.num_inliers
        );
        let off = (report.model - truth).norm();
        assert!(off < 0.005, "{off}");
    }

    #[test]
    fn derivatives_are_differences() {
        let (seen, truth) = wall(12, 0.5, 3);
        let rays1: Vec<_> = seen[0].iter().map(Observation::ray).collect();
        for i in (0..12usize).filter(|i| i % 4 != 0) {
            let used = [i];
            let problem = RayHomographyProblem {
                rays1: &rays1,
                seen2: &seen[1],
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
        let (seen, _) = wall(8, 0.5, 5);
        let options = RansacOptions::default();
        let few = estimate_homography_of_rays(&seen[0][..3], &seen[1][..3], &options, &mut ());
        assert!(matches!(few, Err(Error::TooFew { .. })));
        let unlike = estimate_homography_of_rays(&seen[0], &seen[1][..7], &options, &mut ());
        assert!(matches!(unlike, Err(Error::SizeMismatch { .. })));
        // Rays of one plane through the center give none.
        let flat = [0.1, 0.2, 0.4, 0.8, 0.9].map(|x| Vector3::new(x, 0.0, 1.0));
        let of_four = core::array::from_fn(|i| flat[i]);
        assert!(solve(&of_four, &of_four).is_none());
    }
}
