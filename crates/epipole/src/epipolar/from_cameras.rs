//! F and E of known cameras.

use crate::camera::{Intrinsics, PosedCamera, RigidTransform, cross_matrix, relative_motion};
use crate::math::scaling::{power_of_two, unit};
use crate::{Error, Result};
use nalgebra::Matrix3;

/// Computes the essential matrix of a motion, `E = [t]ₓ R`, with unit Frobenius norm.
///
/// * `cam2_from_cam1`: R and t; only the direction of t matters
///
/// Matching rays satisfy `x2ᵀ E x1 = 0`. The sign is that of `[t]ₓ R`.
///
/// # Errors
/// [`Error::Degenerate`] if t = 0: without a baseline every pair of rays meets.
/// [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Longuet-Higgins 1981; Hartley & Zisserman 2004, §9.6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::essential_from_motion;
/// // A step along x: E ∝ [0 0 0; 0 0 −1; 0 1 0], whose norm is √2.
/// let e = essential_from_motion(&RigidTransform::translation(3.0, 0.0, 0.0))?;
/// assert!((e[(2, 1)] - 0.5_f64.sqrt()).abs() < 1e-15 && e[(1, 2)] == -e[(2, 1)]);
/// # Ok(()) }
/// ```
pub fn essential_from_motion(cam2_from_cam1: &RigidTransform) -> Result<Matrix3<f64>> {
    let t = cam2_from_cam1.translation.vector;
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix();
    if !(t.iter().all(|x| x.is_finite()) && rotation.matrix().iter().all(|x| x.is_finite())) {
        return Err(Error::NotFinite {
            what: "the motion between two cameras",
        });
    }
    let direction = unit(&t).ok_or(NO_BASELINE)?;
    unit_norm(&(cross_matrix(&direction) * rotation.matrix()))
}

/// Computes the fundamental matrix of two cameras, `F = K2⁻ᵀ [t]ₓ R K1⁻¹` with R and t of
/// `cam2_from_cam1`, with unit Frobenius norm. It relates undistorted pixels, such as those of
/// [`Camera::pinhole_pixel`](crate::camera::Camera::pinhole_pixel).
///
/// # Errors
/// [`Error::Degenerate`] if the cameras' centers coincide, [`Error::NotFinite`] for NaN and
/// infinities.
///
/// Source: Hartley & Zisserman 2004, §9.6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
/// use epipole::epipolar::fundamental_from_cameras;
/// use nalgebra::{Point3, Vector3};
/// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let left = PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::identity() };
/// let right = PosedCamera { camera: Camera::pinhole(intrinsics, 640, 480), cam_from_world: RigidTransform::translation(-0.1, 0.0, 0.0) };
/// let f = fundamental_from_cameras(&left, &right)?;
/// let x_in_world = Point3::new(0.3, 0.2, 2.0);
/// let (x1, x2) = (left.project(&x_in_world)?, right.project(&x_in_world)?);
/// assert!(x2.to_homogeneous().dot(&(f * x1.to_homogeneous())).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn fundamental_from_cameras(cam1: &PosedCamera, cam2: &PosedCamera) -> Result<Matrix3<f64>> {
    if have_same_center(cam1, cam2) {
        return Err(NO_BASELINE);
    }
    let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
    fundamental_from_essential(
        &essential_from_motion(&motion)?,
        &cam1.camera.intrinsics,
        &cam2.camera.intrinsics,
    )
}

/// Returns whether two cameras have the same center up to rounding, which would give a baseline in
/// a random direction.
pub(crate) fn have_same_center(cam1: &PosedCamera, cam2: &PosedCamera) -> bool {
    let (c1, c2) = (cam1.center_in_world().coords, cam2.center_in_world().coords);
    let (c1, c2) = {
        let scale = power_of_two(c1.amax().max(c2.amax()));
        (c1 / scale, c2 / scale)
    };
    (c1 - c2).norm() <= 1e-13 * (c1.norm() + c2.norm())
}

/// Computes `F = K2⁻ᵀ E K1⁻¹`, with unit Frobenius norm.
///
/// # Errors
/// [`Error::Degenerate`] if E is zero, [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, equation 9.12.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{epipolar_line2, essential_from_motion, fundamental_from_essential};
/// use nalgebra::Point2;
/// let (k1, k2) = (Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, Intrinsics::new(350.0, 350.0, 160.0, 120.0)?);
/// let e = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let f = fundamental_from_essential(&e, &k1, &k2)?;
/// // Rays keep their row, so pixels keep theirs relative to the principal point: image 2 is half
/// // the size.
/// let line2 = epipolar_line2(&f, &Point2::new(0.0, 340.0))?;
/// assert!(line2.signed_distance(&Point2::new(77.0, 170.0)).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn fundamental_from_essential(
    essential: &Matrix3<f64>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> Result<Matrix3<f64>> {
    product(
        &k2.inverse_matrix().transpose(),
        essential,
        &k1.inverse_matrix(),
    )
}

/// Computes `E = K2ᵀ F K1`, with unit Frobenius norm.
///
/// With inexact intrinsics, E has unequal singular values.
///
/// # Errors
/// [`Error::Degenerate`] if F is zero, [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, equation 9.12.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{essential_from_fundamental, essential_from_motion, fundamental_from_essential};
/// let (k1, k2) = (Intrinsics::new(700.0, 700.0, 320.0, 240.0)?, Intrinsics::new(350.0, 350.0, 160.0, 120.0)?);
/// let e = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let f = fundamental_from_essential(&e, &k1, &k2)?;
/// let back = essential_from_fundamental(&f, &k1, &k2)?;
/// assert!((back - e).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn essential_from_fundamental(
    fundamental: &Matrix3<f64>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> Result<Matrix3<f64>> {
    product(&k2.matrix().transpose(), fundamental, &k1.matrix())
}

/// Computes `A B C` with unit Frobenius norm. Scale is arbitrary, so it is removed from each factor
/// to avoid overflow and underflow.
fn product(a: &Matrix3<f64>, b: &Matrix3<f64>, c: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    let [a, b, c] = [a, b, c].map(|m| m / power_of_two(m.amax()));
    unit_norm(&(a * b * c))
}

pub(super) const NO_BASELINE: Error = Error::Degenerate {
    what: "the epipolar geometry",
    why: "the two cameras are at the same place",
};

/// Scales a matrix to unit Frobenius norm and keeps its sign.
pub(crate) fn unit_norm(matrix: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    let largest = matrix.amax();
    if !matrix.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a fundamental or essential matrix",
        });
    }
    if largest <= f64::MIN_POSITIVE {
        return Err(Error::Degenerate {
            what: "a fundamental or essential matrix",
            why: "it is zero",
        });
    }
    let scaled = matrix / largest;
    Ok(scaled / scaled.norm())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::camera::{Camera, look_at};
    use crate::math::random::Random;
    use nalgebra::{Point3, Vector3};

    /// Two cameras with different lenses that look at the origin from about 5 units away.
    pub(crate) fn random_cameras(random: &mut Random) -> (PosedCamera, PosedCamera) {
        let mut camera = |focal_px| {
            let mut coordinate = || random.uniform(-1.0, 1.0);
            let center = Point3::new(3.0 * coordinate(), 3.0 * coordinate(), coordinate() - 4.5);
            let target = Point3::new(0.2 * coordinate(), 0.2 * coordinate(), 0.0);
            let up = Vector3::new(0.3 * coordinate(), -1.0, 0.0);
            PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::new(focal_px, focal_px * 1.1, 310.0, 250.0).unwrap(),
                    640,
                    480,
                ),
                cam_from_world: look_at(&center, &target, &up).unwrap(),
            }
        };
        (camera(600.0), camera(800.0))
    }

    pub(crate) fn random_point(random: &mut Random) -> Point3<f64> {
        let mut coordinate = || random.uniform(-1.0, 1.0);
        Point3::new(coordinate(), coordinate(), coordinate())
    }

    #[test]
    fn every_point_satisfies_the_constraint() {
        let mut random = Random::new(4);
        for _ in 0..100 {
            let (cam1, cam2) = random_cameras(&mut random);
            let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
            assert!((f.norm() - 1.0).abs() < 1e-14);
            let point = random_point(&mut random);
            let x1 = cam1.project(&point).unwrap().to_homogeneous();
            let x2 = cam2.project(&point).unwrap().to_homogeneous();
            let line = f * x1;
            assert!((x2.dot(&line) / line.xy().norm()).abs() < 1e-8);
        }
    }

    #[test]
    fn fundamental_and_essential_are_inverse() {
        let (cam1, cam2) = random_cameras(&mut Random::new(8));
        let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
        let e = essential_from_motion(&motion).unwrap();
        let f = fundamental_from_essential(&e, &cam1.camera.intrinsics, &cam2.camera.intrinsics)
            .unwrap();
        let back = essential_from_fundamental(&f, &cam1.camera.intrinsics, &cam2.camera.intrinsics)
            .unwrap();
        assert!((e - back).norm() < 1e-12);
    }

    #[test]
    fn lenses_of_any_focal_length() {
        let e = essential_from_motion(&RigidTransform::translation(-1e200, 0.0, 1e200)).unwrap();
        for focal_px in [1e-250, 1e250] {
            let k = Intrinsics::new(focal_px, focal_px, 0.0, 0.0).unwrap();
            let f = fundamental_from_essential(&e, &k, &k).unwrap();
            assert!((f.norm() - 1.0).abs() < 1e-14);
            let back = essential_from_fundamental(&e, &k, &k).unwrap();
            assert!((back.norm() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_row_aligned_pair_has_zero_last_entry() {
        let intrinsics = Intrinsics::new(500.0, 500.0, 320.0, 240.0).unwrap();
        let camera = |x: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: RigidTransform::translation(x, 0.0, 0.0),
        };
        let f = fundamental_from_cameras(&camera(0.0), &camera(-0.2)).unwrap();
        assert!(f[(2, 2)].abs() < 1e-15);
        assert!((f.norm() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn coincident_centers_are_refused() {
        let mut random = Random::new(3);
        for _ in 0..50 {
            let (cam1, other) = random_cameras(&mut random);
            // The same center, rotated differently; computed, so equal only up to rounding.
            let center = cam1.center_in_world();
            let mut cam2 = other;
            cam2.cam_from_world.translation.vector =
                -(cam2.cam_from_world.rotation * center.coords);
            assert_eq!(fundamental_from_cameras(&cam1, &cam2), Err(NO_BASELINE));
            assert_eq!(fundamental_from_cameras(&cam1, &cam1), Err(NO_BASELINE));
        }
        assert!(essential_from_motion(&RigidTransform::identity()).is_err());
        assert!(essential_from_motion(&RigidTransform::translation(f64::NAN, 0.0, 0.0)).is_err());
        let k = Intrinsics::centered(500.0, 640, 480).unwrap();
        assert!(fundamental_from_essential(&Matrix3::zeros(), &k, &k).is_err());
    }
}
