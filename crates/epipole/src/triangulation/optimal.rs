//! Two-view triangulation that minimizes the reprojection error.

use super::dlt::triangulate_dlt;
use crate::camera::Camera;
use crate::epipolar::fundamental_from_cameras;
use crate::{Error, Result};
use nalgebra::{Matrix2, Matrix3, Point2, Point3, Vector2};

/// The nearest pair of pixels that satisfies `x2ᵀ F x1 = 0` exactly, minimizing
/// `‖x1' − x1‖² + ‖x2' − x2‖²`.
///
/// Two steps of a fixed scheme, each of closed form, bring the result to the optimum within far less
/// than any measurement error, also for large corrections.
///
/// * `fundamental`: F, of any scale
///
/// # Errors
/// [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if a pixel is an epipole.
///
/// Source: Lindström 2010, "Triangulation made easy", the `niter2` method.
pub fn correct_matches(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> Result<(Point2<f64>, Point2<f64>)> {
    // The paper's x and x' are our x2 and x1, since its constraint is xᵀ E x' = 0.
    let (x2, x1) = (pixel2.to_homogeneous(), pixel1.to_homogeneous());
    let upper: Matrix2<f64> = fundamental.fixed_view::<2, 2>(0, 0).into_owned();
    let n2: Vector2<f64> = (fundamental * x1).xy();
    let n1: Vector2<f64> = (fundamental.transpose() * x2).xy();
    let a = n2.dot(&(upper * n1));
    let b = 0.5 * (n2.norm_squared() + n1.norm_squared());
    let c = x2.dot(&(fundamental * x1));
    let d = (b * b - a * c).max(0.0).sqrt();
    let lambda = c / (b + d);
    let (step2, step1) = (n2 * lambda, n1 * lambda);
    // The lines turn as the points move.
    let (n2, n1) = (n2 - upper * step1, n1 - upper.transpose() * step2);
    let factor = 2.0 * d / (n2.norm_squared() + n1.norm_squared());
    let lambda = lambda * factor;
    let (moved2, moved1) = (pixel2 - n2 * lambda, pixel1 - n1 * lambda);
    if [moved1.x, moved1.y, moved2.x, moved2.y]
        .into_iter()
        .all(f64::is_finite)
    {
        return Ok((moved1, moved2));
    }
    if x1
        .iter()
        .chain(x2.iter())
        .chain(fundamental.iter())
        .all(|x| x.is_finite())
    {
        Err(Error::Degenerate {
            what: "the nearest match on an epipolar line",
            why: "both pixels are epipoles",
        })
    } else {
        Err(Error::NotFinite {
            what: "a pixel or the fundamental matrix",
        })
    }
}

/// The point whose images are nearest to the two pixels, minimizing the reprojection error.
///
/// * `cam1`, `cam2`: the cameras
/// * `pixel1`, `pixel2`: where the point is seen
///
/// The optimum if pixel errors are normal and equal in both images. The pixels are first moved onto
/// epipolar lines by [`correct_matches`]; then their rays meet.
///
/// # Errors
/// [`Error::Degenerate`] if the cameras are at the same place, [`Error::PointAtInfinity`] for
/// parallel rays, [`Error::PointBehindCamera`] if they diverge, [`Error::NotFinite`] for NaN and
/// infinities.
///
/// Source: Lindström 2010, "Triangulation made easy"; Hartley & Sturm 1997, "Triangulation".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::triangulation::triangulate_optimal;
/// use nalgebra::{Point2, Point3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let left = Camera { intrinsics, cam_from_world: RigidTransform::identity() };
/// let right = Camera { intrinsics, cam_from_world: RigidTransform::translation(-0.12, 0.0, 0.0) };
/// // Disparity 30, but rows that differ by 2: the true row is between them.
/// let point = triangulate_optimal(&left, &right, &Point2::new(350.0, 241.0), &Point2::new(320.0, 239.0))?;
/// assert!((point - Point3::new(0.12, 0.0, 2.8)).norm() < 1e-9);
/// # Ok(()) }
/// ```
pub fn triangulate_optimal(
    cam1: &Camera,
    cam2: &Camera,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> Result<Point3<f64>> {
    let fundamental = fundamental_from_cameras(cam1, cam2)?;
    let (x1, x2) = correct_matches(&fundamental, pixel1, pixel2)?;
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
    use crate::camera::{Intrinsics, look_at};
    use crate::epipolar::sampson_px;
    use crate::math::random::Random;
    use nalgebra::Vector3;

    fn rig(random: &mut Random) -> (Camera, Camera) {
        let mut camera = || {
            let center = Point3::from(Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)));
            Camera {
                intrinsics: Intrinsics::new(600.0, 620.0, 320.0, 240.0).unwrap(),
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

    /// The correction satisfies the constraint, and no other point of space projects nearer.
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
        assert!(triangulate_optimal(&cam1, &cam1, &o, &o).is_err());
        assert!(triangulate_optimal(&cam1, &cam2, &o, &nan).is_err());
        assert!(correct_matches(&Matrix3::zeros(), &o, &o).is_err());
    }
}
