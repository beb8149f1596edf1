//! Optimal two-view triangulation: minimizes the reprojection error.

use super::NO_BASELINE;
use super::dlt::triangulate_dlt;
use crate::camera::PosedCamera;
use crate::epipolar::{fundamental_from_cameras, have_same_center};
use crate::math::scaling::power_of_two;
use crate::{Error, Result};
use nalgebra::{Matrix2, Matrix3, Point2, Point3, Vector2, Vector3};

/// Corrects a match to the nearest pair of pixels that satisfies `x2ᵀ F x1 = 0` exactly, minimizing
/// `‖x1' − x1‖² + ‖x2' − x2‖²`.
///
/// Two closed-form steps bring the result far closer to the optimum than any measurement error,
/// even for large corrections.
///
/// * `fundamental`: F at any scale
/// * `pixel1`, `pixel2`: the match
///
/// A match that satisfies the constraint is unchanged, and so is a match with one pixel at an
/// epipole, which satisfies the constraint with any other pixel.
///
/// # Errors
/// [`Error::Degenerate`] if both pixels are epipoles, to within 10⁻¹² of the terms of their lines,
/// if both lines are at infinity, or if F is zero; [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Lindström 2010, "Triangulation made easy", the `niter2` method.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::essential_from_motion;
/// use epipole::triangulation::correct_matches;
/// use nalgebra::Point2;
/// // A step to the right: rows must agree. Both pixels move to the row between them.
/// let f = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let (x1, x2) = correct_matches(&f, &Point2::new(5.0, 3.0), &Point2::new(1.0, 4.0))?;
/// assert!((x1 - Point2::new(5.0, 3.5)).norm() < 1e-12);
/// assert!((x2 - Point2::new(1.0, 3.5)).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn correct_matches(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> Result<(Point2<f64>, Point2<f64>)> {
    let what = "the nearest match on epipolar lines";
    let finite = |x: &f64| x.is_finite();
    if !(fundamental.iter().all(finite) && pixel1.iter().chain(pixel2.iter()).all(finite)) {
        return Err(Error::NotFinite {
            what: "a pixel or the fundamental matrix",
        });
    }
    if *fundamental == Matrix3::zeros() {
        return Err(Error::Degenerate {
            what,
            why: "the fundamental matrix is zero",
        });
    }
    // The scale of F does not matter. For pixels in units of their size s, the last row and column
    // of F are smaller by s.
    let size = power_of_two(pixel1.coords.amax().max(pixel2.coords.amax()).max(1.0));
    let shrink = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1.0 / size));
    let f = shrink * (fundamental / power_of_two(fundamental.amax())) * shrink;
    let f = f / power_of_two(f.amax());
    let (x1, x2) = (pixel1.coords / size, pixel2.coords / size);
    let (h1, h2) = (x1.push(1.0), x2.push(1.0));
    let (line2, line1) = (f * h1, f.transpose() * h2);
    let negligible = |line: &Vector3<f64>, rounding: Vector3<f64>, rows: usize| {
        (0..rows).all(|row| line[row].abs() <= 1e-12 * rounding[row])
    };
    let rounding = [f.abs() * h1.abs(), f.transpose().abs() * h2.abs()];
    let flat =
        |rows| negligible(&line2, rounding[0], rows) && negligible(&line1, rounding[1], rows);
    if flat(2) {
        return Err(Error::Degenerate {
            what,
            why: if flat(3) {
                "both pixels are epipoles"
            } else {
                "both epipolar lines are infinitely far away"
            },
        });
    }
    let [moved1, moved2] = moved(&f, &h1, &h2).map(|x| Point2::from(x * size));
    if moved1.iter().chain(moved2.iter()).all(finite) {
        Ok((moved1, moved2))
    } else {
        Err(Error::NotFinite {
            what: "the corrected match",
        })
    }
}

/// Computes the correction.
#[inline]
fn moved(f: &Matrix3<f64>, x1: &Vector3<f64>, x2: &Vector3<f64>) -> [Vector2<f64>; 2] {
    // The paper's x and x' are our x2 and x1, since its constraint is xᵀ E x' = 0.
    let upper: Matrix2<f64> = f.fixed_view::<2, 2>(0, 0).into_owned();
    let n2: Vector2<f64> = (f * x1).xy();
    let n1: Vector2<f64> = (f.transpose() * x2).xy();
    let a = n2.dot(&(upper * n1));
    let b = 0.5 * (n2.norm_squared() + n1.norm_squared());
    let c = x2.dot(&(f * x1));
    let d = (b * b - a * c).max(0.0).sqrt();
    let lambda = c / (b + d);
    let (step2, step1) = (n2 * lambda, n1 * lambda);
    // The lines rotate as the points move.
    let (n2, n1) = (n2 - upper * step1, n1 - upper.transpose() * step2);
    let factor = 2.0 * d / (n2.norm_squared() + n1.norm_squared());
    let lambda = lambda * factor;
    [x1.xy() - n1 * lambda, x2.xy() - n2 * lambda]
}

/// Triangulates the point that minimizes the reprojection error.
///
/// * `cam1`, `cam2`: the cameras
/// * `pixel1`, `pixel2`: projections of the point
///
/// Optimal if pixel errors are Gaussian and equal in both images. Pixels are undistorted by
/// [`Camera::pinhole_pixel`](crate::camera::Camera::pinhole_pixel) and moved onto epipolar lines by
/// [`correct_matches`]; then their rays meet.
///
/// # Errors
/// [`Error::Degenerate`] if the cameras are at the same place, or both pixels are epipoles, so that
/// both rays are along the baseline; [`Error::PointAtInfinity`] for parallel rays,
/// [`Error::PointBehindCamera`] if they diverge, or meet in the center of a camera because one
/// pixel is an epipole; [`Error::NotFinite`] for NaN and infinities; as `Camera::pinhole_pixel`.
///
/// Source: Lindström 2010, "Triangulation made easy"; Hartley & Sturm 1997, "Triangulation".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::triangulation::triangulate_optimal;
/// use nalgebra::{Point2, Point3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let left = PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::identity() };
/// let right = PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::translation(-0.12, 0.0, 0.0) };
/// // Disparity 30, but rows that differ by 2: the true row is between them.
/// let point = triangulate_optimal(&left, &right, &Point2::new(350.0, 241.0), &Point2::new(320.0, 239.0))?;
/// assert!((point - Point3::new(0.12, 0.0, 2.8)).norm() < 1e-9);
/// # Ok(()) }
/// ```
pub fn triangulate_optimal(
    cam1: &PosedCamera,
    cam2: &PosedCamera,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> Result<Point3<f64>> {
    if have_same_center(cam1, cam2) {
        return Err(NO_BASELINE);
    }
    let fundamental = fundamental_from_cameras(cam1, cam2)?;
    let (pixel1, pixel2) = (
        cam1.camera.pinhole_pixel(pixel1)?,
        cam2.camera.pinhole_pixel(pixel2)?,
    );
    let (x1, x2) = correct_matches(&fundamental, &pixel1, &pixel2)?;
    triangulate_dlt(
        &cam1.projection_matrix(),
        &cam2.projection_matrix(),
        &x1,
        &x2,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Intrinsics, RigidTransform, look_at};
    use crate::epipolar::{Epipole, enforce_rank2, epipoles, essential_from_motion, sampson_px};
    use crate::math::random::Random;

    fn rig(random: &mut Random) -> (PosedCamera, PosedCamera) {
        let mut camera = || {
            let center = Point3::from(Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)));
            PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::new(600.0, 620.0, 320.0, 240.0).unwrap(),
                    640,
                    480,
                ),
                cam_from_world: look_at(
                    &center,
                    &Point3::new(0.0, 0.0, 5.0),
                    &Vector3::new(0.0, -1.0, 0.0),
                )
                .unwrap(),
            }
        };
        (camera(), camera())
    }

    /// The correction satisfies the constraint, and no other scene point projects closer.
    #[test]
    fn no_point_nearby_is_better() {
        let mut random = Random::new(1);
        let mut worst: f64 = 0.0;
        for _ in 0..200 {
            let (cam1, cam2) = rig(&mut random);
            let truth = Point3::new(
                random.uniform(-1.0, 1.0),
                random.uniform(-1.0, 1.0),
                random.uniform(4.0, 6.0),
            );
            let mut noisy = |p: Point2<f64>| {
                Point2::new(p.x + 2.0 * random.normal(), p.y + 2.0 * random.normal())
            };
            let x1 = noisy(cam1.project(&truth).unwrap());
            let x2 = noisy(cam2.project(&truth).unwrap());
            let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
            let (m1, m2) = correct_matches(&f, &x1, &x2).unwrap();
            worst = worst.max(sampson_px(&f, &m1, &m2));
            let point = triangulate_optimal(&cam1, &cam2, &x1, &x2).unwrap();
            let cost = |p: &Point3<f64>| {
                (cam1.project(p).unwrap() - x1).norm_squared()
                    + (cam2.project(p).unwrap() - x2).norm_squared()
            };
            let best = cost(&point);
            let moved = (m1 - x1).norm_squared() + (m2 - x2).norm_squared();
            assert!((best - moved).abs() < 1e-6 * (1.0 + best));
            for step in [1e-3, -1e-3] {
                for axis in 0..3 {
                    let other = point + Vector3::ith(axis, step);
                    assert!(cost(&other) > best - 1e-9);
                }
            }
        }
        // Pixels; the corrections are around 2.
        assert!(worst < 1e-5, "{worst}");
    }

    #[test]
    fn degenerate_input_is_refused() {
        let (cam1, cam2) = rig(&mut Random::new(3));
        let (o, nan) = (Point2::new(320.0, 240.0), Point2::new(f64::NAN, 0.0));
        let other = Point2::new(300.0, 240.0);
        assert_eq!(triangulate_optimal(&cam1, &cam1, &o, &o), Err(NO_BASELINE));
        assert_eq!(
            triangulate_optimal(&cam1, &cam1, &o, &other),
            Err(NO_BASELINE)
        );
        assert!(triangulate_optimal(&cam1, &cam2, &o, &nan).is_err());
    }

    fn why(result: Result<(Point2<f64>, Point2<f64>)>) -> &'static str {
        match result {
            Err(Error::Degenerate { why, .. }) => why,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn matches_without_a_correction_are_marked() {
        let (o, off) = (Point2::origin(), Point2::new(3.0, 1.0));
        let ahead = essential_from_motion(&RigidTransform::translation(0.0, 0.0, 1.0)).unwrap();
        assert_eq!(
            why(correct_matches(&ahead, &o, &o)),
            "both pixels are epipoles"
        );
        assert_eq!(
            why(correct_matches(&Matrix3::zeros(), &o, &off)),
            "the fundamental matrix is zero"
        );
        let at_infinity = Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0));
        assert_eq!(
            why(correct_matches(&at_infinity, &o, &o)),
            "both epipolar lines are infinitely far away"
        );
        let nan = correct_matches(&ahead, &Point2::new(f64::NAN, 0.0), &o);
        assert!(matches!(nan, Err(Error::NotFinite { .. })));
        // With one epipole the constraint already holds.
        assert_eq!(correct_matches(&ahead, &o, &off), Ok((o, off)));
        assert_eq!(correct_matches(&ahead, &off, &o), Ok((off, o)));
    }

    /// The ray of an epipole passes through the other camera, where it meets every ray of that
    /// camera.
    #[test]
    fn epipoles_give_no_point() {
        let mut random = Random::new(4);
        for _ in 0..100 {
            let (cam1, cam2) = rig(&mut random);
            let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
            let (Epipole::Finite(e1), Epipole::Finite(e2)) = epipoles(&f).unwrap() else {
                continue;
            };
            let pixel = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
            for (p1, p2) in [(e1, pixel), (pixel, e2)] {
                let found = triangulate_optimal(&cam1, &cam2, &p1, &p2);
                assert_eq!(found, Err(Error::PointBehindCamera));
            }
            let found = triangulate_optimal(&cam1, &cam2, &e1, &e2);
            assert!(matches!(found, Err(Error::Degenerate { .. })), "{found:?}");
        }
    }

    #[test]
    fn images_and_matrices_of_any_size() {
        let f = Matrix3::new(0.1, 0.5, 3.0, -0.4, 0.2, -2.0, -2.5, 1.5, 7.0);
        let f = enforce_rank2(&f).unwrap();
        let (x1, x2) = (Point2::new(3.0, 1.0), Point2::new(-2.0, 4.0));
        let (m1, m2) = correct_matches(&f, &x1, &x2).unwrap();
        for size in [1e-9, 1e9, 1e100] {
            let undo = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, size));
            for scale in [1e-90, 1.0, 1e90] {
                let large = undo * (f * scale / size) * undo / size;
                let (l1, l2) = correct_matches(&large, &(x1 * size), &(x2 * size)).unwrap();
                assert!((l1 / size - m1).norm() < 1e-9, "{size} {scale}: {l1}");
                assert!((l2 / size - m2).norm() < 1e-9, "{size} {scale}: {l2}");
            }
        }
    }
}
