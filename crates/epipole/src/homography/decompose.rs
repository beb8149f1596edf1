//! Motions from the homography of a plane.

use crate::camera::{Intrinsics, RigidTransform};
use crate::math::scaling::power_of_two;
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// A camera motion and the plane that both views see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneMotion {
    /// R and t, in units of the plane's distance from camera 1.
    pub cam2_from_cam1: RigidTransform,
    /// The plane's unit normal n in the frame of camera 1: its points satisfy `n · x = −1` in units
    /// of its distance, or `n · x = 1` for the solution of opposite sign.
    pub normal_in_cam1: Vector3<f64>,
}

/// Decomposes a plane's homography into its four possible motions; one if the camera only rotated.
///
/// With `H ∝ K2 (R − t nᵀ) K1⁻¹`, the normalized `K2⁻¹ H K1` is scaled until its middle singular
/// value is 1 and its determinant positive. The solutions come in pairs (R, t, n) and (R, −t, −n);
/// points in front of camera 1 have `n · x < 0` in the correct one of a pair. Two solutions remain;
/// a third view, or knowledge about the plane, resolves them.
///
/// Returns a single element with t = 0 and an arbitrary normal if the three singular values are
/// equal to within 10⁻⁹: a pure rotation.
///
/// # Errors
/// [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] for a singular matrix.
///
/// Source: Ma, Soatto, Košecká & Sastry 2004, "An invitation to 3-D vision", §5.3.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::homography::{decompose_homography, homography_from_motion};
/// use nalgebra::Vector3;
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// // A wall 2 units ahead, n pointing back at camera 1, and a step of 1 to the right.
/// let (step, n) = (RigidTransform::translation(-1.0, 0.0, 0.0), -Vector3::z());
/// let h = homography_from_motion(&step, &n, 2.0, &k, &k);
/// let motions = decompose_homography(&h, &k, &k)?;
/// assert_eq!(motions.len(), 4);
/// // One is correct, with t in units of the distance of the wall.
/// assert!(motions.iter().any(|m| (m.normal_in_cam1 - n).norm() < 1e-9
///     && (m.cam2_from_cam1.translation.vector - Vector3::new(-0.5, 0.0, 0.0)).norm() < 1e-9));
/// # Ok(()) }
/// ```
#[doc(alias = "decomposeHomographyMat")]
pub fn decompose_homography(
    homography: &Matrix3<f64>,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> Result<Vec<PlaneMotion>> {
    // The scale of H is arbitrary; the remaining scale is removed below.
    let h = k2.inverse_matrix() * (homography / power_of_two(homography.amax())) * k1.matrix();
    let h = h / power_of_two(h.amax());
    if !h.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "a homography",
        });
    }
    let svd = svd3(&h);
    let singular = svd.singular_values;
    if singular[2] <= 1e-13 * singular[0] || singular[0] == 0.0 {
        return Err(Error::Degenerate {
            what: "the motion of a homography",
            why: "the homography is singular",
        });
    }
    let h = h * (h.determinant().signum() / singular[1]);
    let [s1, s3] = [singular[0] / singular[1], singular[2] / singular[1]];
    let motion = |rotation: &Matrix3<f64>, t: Vector3<f64>, normal: Vector3<f64>| {
        let rotation = nearest_rotation(rotation);
        PlaneMotion {
            cam2_from_cam1: RigidTransform::from_parts(
                t.into(),
                UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)),
            ),
            normal_in_cam1: normal,
        }
    };
    if s1 - s3 < 1e-9 {
        return Ok(vec![motion(&h, Vector3::zeros(), Vector3::z())]);
    }
    // HᵀH preserves the length of two directions in the plane of v1 and v3; each spans, with v2, a
    // plane in which H acts as a rotation.
    let (v1, v2, v3) = (
        svd.v.column(0).into_owned(),
        svd.v.column(1).into_owned(),
        svd.v.column(2).into_owned(),
    );
    let spread = (s1 * s1 - s3 * s3).sqrt();
    let (a, b) = (
        (1.0 - s3 * s3).max(0.0).sqrt() / spread,
        (s1 * s1 - 1.0).max(0.0).sqrt() / spread,
    );
    let mut motions = Vec::with_capacity(4);
    for fixed in [v1 * a + v3 * b, v1 * a - v3 * b] {
        let normal = v2.cross(&fixed);
        let from = Matrix3::from_columns(&[v2, fixed, normal]);
        let (to2, to_fixed) = (h * v2, h * fixed);
        let to = Matrix3::from_columns(&[to2, to_fixed, to2.cross(&to_fixed)]);
        let rotation = to * from.transpose();
        // H = R − t nᵀ, so t = (R − H) n.
        let t = (rotation - h) * normal;
        motions.push(motion(&rotation, t, normal));
        motions.push(motion(&rotation, -t, -normal));
    }
    Ok(motions)
}

fn nearest_rotation(m: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = svd3(m);
    let r = svd.u * svd.v.transpose();
    if r.determinant() < 0.0 {
        // Only for input without a valid rotation; flip the least significant direction.
        let flip = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
        svd.u * flip * svd.v.transpose()
    } else {
        r
    }
}

/// Computes the homography of a plane, `K2 (R − t nᵀ/d) K1⁻¹`, not scaled.
///
/// * `normal_in_cam1`: n, of length 1
/// * `distance`: d, with `n · x = −d` for points of the plane; infinity gives the homography of
///   the rotation alone
///
/// Source: Hartley & Zisserman 2004, equation 13.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::homography::{homography_from_motion, transfer};
/// use nalgebra::{Point2, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// // A wall 2 units ahead and a step of 0.1 to the right: the disparity is f B / Z = 35.
/// let step = RigidTransform::translation(-0.1, 0.0, 0.0);
/// let h = homography_from_motion(&step, &-Vector3::z(), 2.0, &k, &k);
/// let pixel2 = transfer(&h, &Point2::new(400.0, 300.0)).expect("a finite pixel");
/// assert!((pixel2 - Point2::new(365.0, 300.0)).norm() < 1e-9);
/// # Ok(()) }
/// ```
pub fn homography_from_motion(
    cam2_from_cam1: &RigidTransform,
    normal_in_cam1: &Vector3<f64>,
    distance: f64,
    k1: &Intrinsics,
    k2: &Intrinsics,
) -> Matrix3<f64> {
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
    let shift = cam2_from_cam1.translation.vector / distance;
    k2.matrix() * (rotation - shift * normal_in_cam1.transpose()) * k1.inverse_matrix()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// The values of COLMAP's src/colmap/geometry/homography_matrix_test.cc, originally from
    /// OpenCV.
    #[test]
    fn published_reference() {
        #[rustfmt::skip]
        let h = Matrix3::new(
             2.649157564634028,  4.583875997496426,   70.694_447_785_121_33,
            -1.072756858861583,  3.533262150437228, 1_513.656_999_614_321_6,
             0.001303887589576,  0.003042206876298,    1.0,
        ) * 3.0;
        let k = Intrinsics::new(640.0, 640.0, 320.0, 240.0).unwrap();
        #[rustfmt::skip]
        let rotation = Matrix3::new(
             0.43307983549125, 0.545749113549648, -0.717356090899523,
            -0.85630229674426, 0.497582023798831, -0.138414255706431,
             0.281404038139784, 0.67421809131173,  0.682818960388909,
        );
        let t = Vector3::new(1.826751712278038, 1.264_718_492_450_82, 0.195080809998819);
        let n = Vector3::new(-0.244875830334816, -0.480857890778889, -0.841909446789566);
        let motions = decompose_homography(&h, &k, &k).unwrap();
        assert_eq!(motions.len(), 4);
        let off = |m: &PlaneMotion| {
            let r = m.cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
            let t_off = m.cam2_from_cam1.translation.vector;
            (r - rotation).norm() + (m.normal_in_cam1 - n).norm() + (t_off - t).norm()
        };
        let best = motions.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(best < 1e-6, "{motions:?}");
    }

    #[test]
    fn random_motions_are_found_and_rebuild_the_homography() {
        let mut random = Random::new(1);
        let k1 = Intrinsics::new(500.0, 520.0, 320.0, 240.0).unwrap();
        let k2 = Intrinsics::new(700.0, 700.0, 300.0, 200.0).unwrap();
        for _ in 0..200 {
            let mut vector = |size: f64| Vector3::from_fn(|_, _| size * random.normal());
            let truth = RigidTransform::new(vector(1.0), vector(0.5));
            let n = vector(1.0).normalize();
            let h = homography_from_motion(&truth, &n, 1.0, &k1, &k2);
            // Scale and sign of a homography are arbitrary as long as both cameras see the same
            // side of the plane, by the sign of the determinant.
            if h.determinant() < 1e-3 {
                continue;
            }
            let motions = decompose_homography(&(h * -2.0), &k1, &k2).unwrap();
            assert_eq!(motions.len(), 4);
            let off = |m: &PlaneMotion| {
                m.cam2_from_cam1.rotation.angle_to(&truth.rotation)
                    + (m.cam2_from_cam1.translation.vector - truth.translation.vector).norm()
                    + (m.normal_in_cam1 - n).norm()
            };
            let best = motions.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(best < 1e-6, "{best}");
            for m in &motions {
                let back =
                    homography_from_motion(&m.cam2_from_cam1, &m.normal_in_cam1, 1.0, &k1, &k2);
                let (a, b) = (h / h.norm(), back / back.norm());
                assert!((a - b).norm().min((a + b).norm()) < 1e-8);
                let r = m.cam2_from_cam1.rotation.to_rotation_matrix().into_inner();
                assert!((r.determinant() - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn pure_rotation_and_singular_matrices() {
        let k = Intrinsics::new(500.0, 500.0, 320.0, 240.0).unwrap();
        let rotation_only = RigidTransform::rotation(Vector3::new(0.1, 0.3, -0.2));
        let h = homography_from_motion(&rotation_only, &Vector3::z(), f64::INFINITY, &k, &k);
        let motions = decompose_homography(&h, &k, &k).unwrap();
        assert_eq!(motions.len(), 1);
        assert!(
            motions[0]
                .cam2_from_cam1
                .rotation
                .angle_to(&rotation_only.rotation)
                < 1e-7
        );
        assert_eq!(
            motions[0].cam2_from_cam1.translation.vector,
            Vector3::zeros()
        );
        assert!(decompose_homography(&Matrix3::zeros(), &k, &k).is_err());
        assert!(decompose_homography(&Matrix3::from_element(1.0), &k, &k).is_err());
        assert!(decompose_homography(&Matrix3::from_element(f64::NAN), &k, &k).is_err());
    }

    #[test]
    fn the_scale_of_a_homography_means_nothing() {
        let k = Intrinsics::new(500.0, 500.0, 320.0, 240.0).unwrap();
        let motion = RigidTransform::new(Vector3::new(0.3, -0.1, 0.2), Vector3::new(0.1, 0.0, 0.2));
        let h = homography_from_motion(&motion, &-Vector3::z(), 1.0, &k, &k);
        let expected = decompose_homography(&h, &k, &k).unwrap();
        for scale in [-1e-300, -1e-160, 1e-160, 1e160, 1e300] {
            let found = decompose_homography(&(h * scale), &k, &k).unwrap();
            assert_eq!(found.len(), expected.len());
            for (a, b) in found.iter().zip(&expected) {
                let t = |m: &PlaneMotion| m.cam2_from_cam1.translation.vector;
                assert!((t(a) - t(b)).norm() < 1e-9, "{scale}: {a:?}");
                assert!((a.normal_in_cam1 - b.normal_in_cam1).norm() < 1e-9);
                assert!(
                    a.cam2_from_cam1
                        .rotation
                        .angle_to(&b.cam2_from_cam1.rotation)
                        < 1e-7
                );
            }
        }
    }
}
