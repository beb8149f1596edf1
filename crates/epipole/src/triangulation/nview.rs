//! Triangulation from many views.

use super::nview_problem::{Problem, baseline_unit};
use super::starts::robust_minimum;
use super::{BEYOND_NUMBERS, NO_BASELINE};
use crate::camera::PosedCamera;
use crate::epipolar::have_same_center;
use crate::math::null_space::right_singular_vectors;
use crate::math::scaling::power_of_two;
use crate::optim::RobustLoss;
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

/// Triangulates a point from many views, minimizing the algebraic error `Σ ‖x × P X‖²`.
///
/// * `cameras`, `pixels`: at least two cameras, and the point's projection in each
///
/// Rows are scaled by the focal length, so that high-resolution views do not outweigh others.
/// Lengths are measured from the first camera in units of about its longest baseline, so neither
/// the world's origin nor its unit of length matters.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two views, [`Error::SizeMismatch`], [`Error::Degenerate`] if
/// all cameras are at the same place, [`Error::NotFinite`] for NaN and infinities,
/// [`Error::PointAtInfinity`] for parallel rays, [`Error::PointBehindCamera`] if a camera would not
/// see the point, and as [`Camera::unproject`](crate::camera::Camera::unproject).
///
/// Source: Hartley & Zisserman 2004, §12.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::triangulation::triangulate_nview_dlt;
/// use nalgebra::{Point2, Point3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// // Three cameras side by side, 0.1 apart.
/// let cameras = [0.0, 0.1, 0.2].map(|x| PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::translation(-x, 0.0, 0.0) });
/// // A disparity of 35 for each step: Z = f B / d = 2.
/// let pixels = [355.0, 320.0, 285.0].map(|u| Point2::new(u, 240.0));
/// let point = triangulate_nview_dlt(&cameras, &pixels)?;
/// assert!((point - Point3::new(0.1, 0.0, 2.0)).norm() < 1e-9);
/// # Ok(()) }
/// ```
pub fn triangulate_nview_dlt(
    cameras: &[PosedCamera],
    pixels: &[Point2<f64>],
) -> Result<Point3<f64>> {
    if cameras.len() != pixels.len() {
        return Err(Error::SizeMismatch {
            what: "the list of cameras and that of pixels",
            first: cameras.len(),
            second: pixels.len(),
        });
    }
    if cameras.len() < 2 {
        return Err(Error::TooFew {
            what: "a triangulated point from views",
            needed: 2,
            got: cameras.len(),
        });
    }
    if cameras[1..]
        .iter()
        .all(|c| have_same_center(&cameras[0], c))
    {
        return Err(NO_BASELINE);
    }
    // Measured from the first camera, so that a distant world origin costs no precision, and in
    // units of the baseline, so that the world's unit of length does not matter.
    let origin = cameras[0].center_in_world().coords;
    let unit = baseline_unit(cameras);
    let rays: Vec<Vector3<f64>> = (cameras.iter().zip(pixels))
        .map(|(camera, pixel)| camera.camera.ray(pixel))
        .collect::<Result<_>>()?;
    let (values, vectors) = right_singular_vectors(2 * cameras.len(), |row| {
        let camera = &cameras[row / 2];
        let ray = &rays[row / 2];
        let r = camera.cam_from_world.rotation.to_rotation_matrix();
        let t = (camera.cam_from_world * Point3::from(origin)).coords / unit;
        let (axis, value) = if row % 2 == 0 { (0, ray.x) } else { (1, ray.y) };
        let m = r.matrix();
        [
            value * m[(2, 0)] - ray.z * m[(axis, 0)],
            value * m[(2, 1)] - ray.z * m[(axis, 1)],
            value * m[(2, 2)] - ray.z * m[(axis, 2)],
            value * t.z - ray.z * t[axis],
        ]
    });
    if !values.iter().chain(&vectors[3]).all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a pixel or a camera",
        });
    }
    let x = vectors[3];
    let in_space = Vector3::new(x[0], x[1], x[2]);
    if x[3].abs() <= 1e-12 * in_space.norm() || values[2] <= 1e-12 * values[0] {
        return Err(Error::PointAtInfinity);
    }
    let point = Point3::from(in_space / x[3] * unit + origin);
    if !point.iter().all(|x| x.is_finite()) {
        return Err(BEYOND_NUMBERS);
    }
    for camera in cameras {
        camera.project(&point)?;
    }
    Ok(point)
}

/// Result of [`triangulate_nview`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NviewPoint {
    /// The point.
    pub point_in_world: Point3<f64>,
    /// Root-mean-square distance between projections and pixels.
    pub rms_error_px: f64,
}

/// Triangulates a point from many views, minimizing the reprojection error
/// `½ Σ ρ(‖pixel − projection‖²)`: [`triangulate_nview_dlt`], then Levenberg–Marquardt.
///
/// * `cameras`, `pixels`: at least two cameras, and the point's projection in each
/// * `loss`: width in pixels
///
/// An outlier spoils the linear solution, which may even end up behind a camera. So with a robust
/// loss, three or more views, and a minimum at which some view has less than half its weight, the
/// points of pairs of views are tried as well: all pairs of up to 12 views, 66 pairs of more. The
/// one with the least cost is a second initial value, and the lower of both minima is returned.
///
/// # Errors
/// As [`triangulate_nview_dlt`], and [`Error::OutOfRange`] for a loss that [`RobustLoss::check`]
/// rejects. With a robust loss, [`Error::PointAtInfinity`] and [`Error::PointBehindCamera`] mean
/// that no pair of views gives a point in front of all cameras.
///
/// Source: Hartley & Zisserman 2004, §12.3; initial values from minimal sets of views, as in
/// Fischler & Bolles 1981.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::optim::RobustLoss;
/// use epipole::triangulation::triangulate_nview;
/// use nalgebra::{Point2, Point3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// // Three cameras side by side, 0.1 apart.
/// let cameras = [0.0, 0.1, 0.2].map(|x| PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::translation(-x, 0.0, 0.0) });
/// // A disparity of 35 per step, Z = f B / d = 2, and rows that differ: 1 above, 2 below, 1 above.
/// let pixels = [(355.0, 239.0), (320.0, 242.0), (285.0, 239.0)].map(|(u, v)| Point2::new(u, v));
/// let found = triangulate_nview(&cameras, &pixels, RobustLoss::Trivial)?;
/// assert!((found.point_in_world - Point3::new(0.1, 0.0, 2.0)).norm() < 1e-6);
/// // √((1² + 2² + 1²) / 3)
/// assert!((found.rms_error_px - 2.0_f64.sqrt()).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn triangulate_nview(
    cameras: &[PosedCamera],
    pixels: &[Point2<f64>],
    loss: RobustLoss,
) -> Result<NviewPoint> {
    loss.check()?;
    let linear = triangulate_nview_dlt(cameras, pixels);
    if let Err(
        error @ (Error::SizeMismatch { .. } | Error::TooFew { .. } | Error::Degenerate { .. }),
    ) = linear
    {
        return Err(error);
    }
    let problem = Problem {
        cameras,
        pixels,
        loss,
        unit: baseline_unit(cameras),
    };
    let point = if loss == RobustLoss::Trivial || cameras.len() < 3 {
        problem.refined(linear?)?
    } else {
        robust_minimum(&problem, linear)?
    };
    let mut errors = Vec::with_capacity(cameras.len());
    for (camera, pixel) in cameras.iter().zip(pixels) {
        errors.push(camera.project(&point)? - pixel);
    }
    // With a robust loss an outlier may be so far off that its square overflows.
    let largest = errors.iter().fold(0.0, |most: f64, e| most.max(e.amax()));
    let size = power_of_two(largest);
    let total_sq: f64 = errors.iter().map(|e| (e / size).norm_squared()).sum();
    let rms_error_px = (total_sq / cameras.len() as f64).sqrt() * size;
    if !rms_error_px.is_finite() {
        return Err(Error::NotFinite {
            what: "the distance between a projection and its pixel",
        });
    }
    Ok(NviewPoint {
        point_in_world: point,
        rms_error_px,
    })
}

#[cfg(test)]
mod tests {
    use super::super::quality::projection_jacobian;
    use super::*;
    use crate::camera::{Camera, Intrinsics, RigidTransform, look_at};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use crate::triangulation::triangulate_optimal;
    use nalgebra::{DMatrix, DVector};

    fn ring(random: &mut Random, count: usize) -> Vec<PosedCamera> {
        (0..count)
            .map(|_| PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::new(600.0, 620.0, 320.0, 240.0).unwrap(),
                    640,
                    480,
                ),
                cam_from_world: look_at(
                    &Point3::from(Vector3::from_fn(|_, _| random.uniform(-2.0, 2.0))),
                    &Point3::new(0.0, 0.0, 8.0),
                    &Vector3::new(0.0, -1.0, 0.0),
                )
                .unwrap(),
            })
            .collect()
    }

    #[test]
    fn exact_pixels_give_the_point() {
        let mut random = Random::new(1);
        for count in 2..8 {
            let cameras = ring(&mut random, count);
            let truth = Point3::new(0.3, -0.4, 7.5);
            let pixels: Vec<_> = cameras.iter().map(|c| c.project(&truth).unwrap()).collect();
            let point = triangulate_nview_dlt(&cameras, &pixels).unwrap();
            assert!((point - truth).norm() < 1e-10);
            let fine = triangulate_nview(&cameras, &pixels, RobustLoss::Trivial).unwrap();
            assert!((fine.point_in_world - truth).norm() < 1e-10 && fine.rms_error_px < 1e-8);
        }
    }

    #[test]
    fn two_views_agree_with_the_optimal_method() {
        let mut random = Random::new(2);
        for _ in 0..50 {
            let cameras = ring(&mut random, 2);
            let truth = Point3::new(0.3, -0.4, 7.5);
            let pixels: Vec<_> = cameras
                .iter()
                .map(|c| {
                    let p = c.project(&truth).unwrap();
                    Point2::new(p.x + random.normal(), p.y + random.normal())
                })
                .collect();
            let by_lm = triangulate_nview(&cameras, &pixels, RobustLoss::Trivial).unwrap();
            let closed =
                triangulate_optimal(&cameras[0], &cameras[1], &pixels[0], &pixels[1]).unwrap();
            assert!((by_lm.point_in_world - closed).norm() < 1e-4);
        }
    }

    #[test]
    fn jacobian_agrees_with_differences() {
        let cameras = ring(&mut Random::new(3), 1);
        let point = Point3::new(0.3, -0.4, 7.5);
        let at = |delta: &DVector<f64>| {
            let p = cameras[0]
                .project(&(point + Vector3::new(delta[0], delta[1], delta[2])))
                .unwrap();
            DVector::from_vec(vec![p.x, p.y])
        };
        let analytic = projection_jacobian(&cameras[0], &point);
        let analytic = DMatrix::from_fn(2, 3, |i, j| analytic[(i, j)]);
        assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6);
    }

    #[test]
    fn bad_views_are_refused() {
        let intrinsics = Intrinsics::new(600.0, 600.0, 0.0, 0.0).unwrap();
        let camera = |x: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: RigidTransform::translation(-x, 0.0, 0.0),
        };
        let o = Point2::origin();
        let pair = [camera(0.0), camera(1.0)];
        let nview = |cameras: &[PosedCamera], pixels: &[Point2<f64>]| {
            triangulate_nview(cameras, pixels, RobustLoss::Trivial).map(|p| p.point_in_world)
        };
        assert_eq!(nview(&pair, &[o, o]), Err(Error::PointAtInfinity));
        assert_eq!(
            nview(&pair, &[o, Point2::new(60.0, 0.0)]),
            Err(Error::PointBehindCamera)
        );
        assert!(nview(&pair[..1], &[o]).is_err());
        assert!(nview(&pair, &[o]).is_err());
        assert!(nview(&pair, &[o, Point2::new(f64::NAN, 0.0)]).is_err());
        for pixel in [o, Point2::new(60.0, 0.0)] {
            assert_eq!(nview(&[pair[0]; 3], &[o, pixel, o]), Err(NO_BASELINE));
            assert_eq!(
                triangulate_nview_dlt(&[pair[0]; 2], &[o, pixel]),
                Err(NO_BASELINE)
            );
        }
    }

    #[test]
    fn a_loss_without_width_is_refused() {
        let cameras = ring(&mut Random::new(4), 3);
        let pixels: Vec<_> = cameras
            .iter()
            .map(|c| c.project(&Point3::new(0.3, -0.4, 7.5)).unwrap())
            .collect();
        for width in [0.0, -1.0, f64::NAN] {
            let found = triangulate_nview(&cameras, &pixels, RobustLoss::Truncated { width });
            assert!(matches!(found, Err(Error::OutOfRange { .. })), "{found:?}");
        }
    }

    #[test]
    fn an_outlier_at_the_end_of_the_world_has_a_finite_error() {
        let cameras = ring(&mut Random::new(5), 3);
        let truth = Point3::new(0.3, -0.4, 7.5);
        let mut pixels: Vec<_> = cameras.iter().map(|c| c.project(&truth).unwrap()).collect();
        pixels[2].x = 1e200;
        let loss = RobustLoss::Truncated { width: 2.0 };
        match triangulate_nview(&cameras, &pixels, loss) {
            Ok(found) => assert!(found.rms_error_px.is_finite()),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}
