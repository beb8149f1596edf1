//! Rotation-only motion between two views.

#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::camera::{Camera, Intrinsics, Observation};
use crate::homography::transfer_error_sq;
use crate::math::svd3;
use crate::progress::Monitor;
use crate::robust::{
    Data, Estimator, MatchSet, Problem, RansacOptions, RansacReport, Support, ransac,
};
use nalgebra::{Matrix3, Point2, Vector3};

/// Estimator of rotation-only motion from matches, for [`Ransac`](crate::robust::Ransac).
///
/// A sample is two matches; the error is the distance in image 2 from the projection of the rotated
/// ray, pixels, to first order through a lens; refinement aligns the rays of the inliers. Equal
/// matches count once, and matches that share a pixel have a limited weight together, as for
/// homographies.
///
/// Source: Kabsch 1976 (aligning directions by a singular value decomposition).
#[derive(Debug, Clone)]
pub struct RotationEstimator {
    matches: MatchSet,
    /// Unit rays; zero for pixels without a ray.
    rays: Vec<[Vector3<f64>; 2]>,
    geometry: Geometry,
}

/// Data for measuring errors.
#[derive(Debug, Clone)]
enum Geometry {
    /// K of both cameras.
    Pinhole([Intrinsics; 2]),
    /// Observation of each match by camera 2.
    Lens(Vec<Option<Observation>>),
}

impl RotationEstimator {
    /// Prepares the estimation from the matches of two cameras of any lens.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 2 matches.
    pub fn new(matches: MatchSet, cameras: [&Camera; 2]) -> Result<Self> {
        matches.at_least(2, "a rotation from matches")?;
        let pairs = (0..matches.len()).map(|i| matches.pair(i));
        let ray = |camera: &Camera, pixel| camera.unproject(&pixel).unwrap_or_default();
        let rays = (pairs.clone())
            .map(|(p1, p2)| [ray(cameras[0], p1), ray(cameras[1], p2)])
            .collect();
        let geometry = match Camera::are_pinholes(cameras) {
            true => Geometry::Pinhole(cameras.map(|camera| camera.intrinsics)),
            false => Geometry::Lens(pairs.map(|(_, p2)| cameras[1].observe(&p2).ok()).collect()),
        };
        Ok(Self {
            matches,
            rays,
            geometry,
        })
    }

    /// Returns the squared error of a match, by its index.
    fn errors_sq(&self, rotation: &Matrix3<f64>) -> impl Fn(usize) -> f64 {
        let homography = match &self.geometry {
            Geometry::Pinhole([k1, k2]) => k2.matrix() * rotation * k1.inverse_matrix(),
            Geometry::Lens(_) => Matrix3::zeros(),
        };
        let rotation = *rotation;
        move |index| {
            let rotated = rotation * self.rays[index][0];
            match &self.geometry {
                // A ray rotated behind the camera would also project to a pixel.
                Geometry::Pinhole(_) if rotated.z <= 0.0 => f64::INFINITY,
                Geometry::Pinhole(_) => {
                    let (x1, x2) = self.matches.pair(index);
                    transfer_error_sq(&homography, &x1, &x2)
                }
                Geometry::Lens(observations) => observations[index]
                    .map_or(f64::INFINITY, |observations| {
                        observations.error_sq(&rotated)
                    }),
            }
        }
    }

    fn align(&self, indices: &[usize]) -> Option<Matrix3<f64>> {
        align_rays(indices.iter().map(|&i| &self.rays[i]))
    }
}

/// Returns the rotation that best aligns the first unit ray of each pair with the second. `None` if
/// they do not determine it.
pub(crate) fn align_rays<'a>(
    pairs: impl Iterator<Item = &'a [Vector3<f64>; 2]>,
) -> Option<Matrix3<f64>> {
    let mut sum = Matrix3::zeros();
    for [r1, r2] in pairs {
        sum += r2 * r1.transpose();
    }
    let svd = svd3(&sum);
    // A single direction leaves the rotation about it open.
    if svd.singular_values[1] <= 1e-12 * svd.singular_values[0] {
        return None;
    }
    let sign = (svd.u * svd.v.transpose()).determinant();
    let flip = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign));
    Some(svd.u * flip * svd.v.transpose())
}

impl Estimator for RotationEstimator {
    /// R of `cam2_from_cam1`.
    type Model = Matrix3<f64>;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a rotation from matches",
            sample_size: 2,
            max_models: 1,
            codimension: 2,
            data: Data::Matches(&self.matches),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Matrix3<f64>>) {
        if !self.matches.have_shared_pixel(sample) {
            models.extend(self.align(sample));
        }
    }

    fn error_sq(&self, rotation: &Matrix3<f64>, index: usize) -> f64 {
        self.errors_sq(rotation)(index)
    }

    fn refine(&mut self, _: &Matrix3<f64>, inliers: &[usize], _: f64) -> Option<Matrix3<f64>> {
        self.align(inliers)
    }

    fn support(&self, rotation: &Matrix3<f64>, max_error_px: f64, cost_limit: f64) -> Support {
        (self.problem().data).support(self.errors_sq(rotation), max_error_px, cost_limit)
    }
}

/// Estimates the rotation R of `cam2_from_cam1` on which most matches agree, for a camera with any
/// lens that did not move; for pinholes, `x2 ∝ K2 R K1⁻¹ x1`.
///
/// * `pixels1`, `pixels2`: matching pixels, outliers included
/// * `cameras`: the two cameras
/// * `options`: [`RansacOptions::max_error_px`] bounds the distance of an inlier in image 2
///
/// # Errors
/// As [`MatchSet::new`], [`RotationEstimator::new`] and [`ransac`].
///
/// Source: Hartley & Zisserman 2004, §8.4 (pixels under rotation); as [`RotationEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::robust::RansacOptions;
/// use epipole::two_view::estimate_rotation;
/// use nalgebra::{Matrix3, Point2};
/// // Rolled by 90° about the optical axis: (x, y) from the middle maps to (−y, x).
/// let camera = Camera::pinhole(Intrinsics::new(600.0, 600.0, 300.0, 300.0)?, 601, 601);
/// let p1: Vec<_> = (0..40).map(|i| Point2::new(f64::from(i * 37 % 600), f64::from(i * 71 % 600))).collect();
/// let mut p2: Vec<_> = p1.iter().map(|p| Point2::new(600.0 - p.y, p.x)).collect();
/// // Every fourth match is wrong.
/// for i in (0..40).step_by(4) {
///     p2[i].x += 90.0;
/// }
/// let report = estimate_rotation(&p1, &p2, [&camera; 2], &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 30);
/// let quarter = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
/// assert!((report.model - quarter).norm() < 1e-9);
/// # Ok(()) }
/// ```
pub fn estimate_rotation(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    ransac(RotationEstimator::new(matches, cameras)?, options, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Fisheye, Lens};
    use crate::math::random::Random;
    use nalgebra::Rotation3;

    #[test]
    fn a_rotation_of_a_fisheye_is_found_among_outliers() {
        let mut random = Random::new(2);
        let camera = Camera {
            lens: Lens::Fisheye(Fisheye::default()),
            ..Camera::pinhole(Intrinsics::centered(250.0, 800, 800).unwrap(), 800, 800)
        };
        let truth = Rotation3::from_scaled_axis(Vector3::new(0.1, 0.5, -0.2));
        let (p1, p2): (Vec<_>, Vec<_>) = (0..120)
            .map(|i| {
                // Up to 100° off the axis.
                let angle = random.uniform(0.0, 1.7);
                let (sin, cos) = libm::sincos(random.uniform(0.0, core::f64::consts::TAU));
                let (away, along) = libm::sincos(angle);
                let ray = Vector3::new(away * cos, away * sin, along);
                let project = |ray: Vector3<f64>| camera.project(&ray.into()).unwrap();
                let off = if i % 3 == 0 { 50.0 } else { 0.0 };
                let p2 = project(truth * ray);
                (project(ray), Point2::new(p2.x + off, p2.y - 0.5 * off))
            })
            .unzip();
        let options = RansacOptions::default();
        let report = estimate_rotation(&p1, &p2, [&camera; 2], &options, &mut ()).unwrap();
        assert!((report.model - truth.matrix()).norm() < 1e-8);
        assert_eq!(report.num_inliers, 80);
    }

    #[test]
    fn a_rotation_is_found_among_outliers() {
        let mut random = Random::new(1);
        let k = Intrinsics::centered(600.0, 640, 480).unwrap();
        let camera = Camera::pinhole(k, 640, 480);
        let truth = Rotation3::from_scaled_axis(Vector3::new(0.05, 0.2, -0.1)).into_inner();
        let h = k.matrix() * truth * k.inverse_matrix();
        let (p1, p2): (Vec<_>, Vec<_>) = (0..100)
            .map(|i| {
                let p = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
                let q = crate::homography::transfer(&h, &p).unwrap();
                let off = if i % 3 == 0 { 50.0 } else { 0.0 };
                (p, Point2::new(q.x + off, q.y - 0.5 * off))
            })
            .unzip();
        let report =
            estimate_rotation(&p1, &p2, [&camera; 2], &RansacOptions::default(), &mut ()).unwrap();
        assert!((report.model - truth).norm() < 1e-9);
        assert_eq!(report.num_inliers, 66);
        // Many matches with the same pixel have limited weight, as for a homography.
        let (mut p1, mut p2) = (p1, p2);
        for _ in 0..200 {
            p1.push(Point2::new(
                random.uniform(0.0, 640.0),
                random.uniform(0.0, 480.0),
            ));
            p2.push(Point2::new(317.0, 211.0));
        }
        let options = RansacOptions {
            max_error_px: 60.0,
            ..RansacOptions::default()
        };
        let report = estimate_rotation(&p1, &p2, [&camera; 2], &options, &mut ()).unwrap();
        let h = crate::homography::estimate_homography(&p1, &p2, &options, &mut ()).unwrap();
        assert!((report.model - truth).norm() < 0.05, "{}", report.model);
        let in_crowd = report.inliers[100..].iter().filter(|is| **is).count();
        assert!(in_crowd > 1);
        let of_h = h.num_inliers - h.num_unique_inliers;
        let num_repeated = report.num_inliers - report.num_unique_inliers;
        assert!(
            num_repeated + 1 == in_crowd || num_repeated == in_crowd,
            "{num_repeated} {of_h} {in_crowd}"
        );
        assert!(
            estimate_rotation(
                &p1[..1],
                &p2[..1],
                [&camera; 2],
                &RansacOptions::default(),
                &mut ()
            )
            .is_err()
        );
    }
}
