//! The second motion past a plane.

use crate::math::nearest_orthogonal;
use nalgebra::{Matrix3, Vector3};

/// Computes the other motion past a plane: two views of a plane allow two, R + t nᵀ and R' + t'
/// n'ᵀ.
///
/// * `rotation`, `direction`: one motion, its direction of unit length
/// * `homography`: homography of the plane, from rays of camera 1 to rays of camera 2, at any scale
///
/// Returns R' and t' of unit length; `None` if the camera does not move relative to the plane, or
/// the two motions are the same.
///
/// With u = Rᵀt, HᵀH = I + n wᵀ + w nᵀ for w = u + ½|u|² n: the normal and w are interchangeable.
///
/// Source: Longuet-Higgins 1986, "The reconstruction of a plane surface from two perspective
/// projections".
pub(super) fn other_motion_of_plane(
    rotation: &Matrix3<f64>,
    direction: &Vector3<f64>,
    homography: &Matrix3<f64>,
) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    // Perpendicular to t, the homography is R at some scale.
    let across = Matrix3::identity() - direction * direction.transpose();
    let (of_h, of_r) = (across * homography, across * rotation);
    let homography = homography * (of_h.dot(&of_r) / of_h.norm_squared());
    // t nᵀ with |t| = 1; its length is that of the normal here.
    let scaled_normal = (homography - rotation).transpose() * direction;
    let length = scaled_normal.norm();
    let normal = scaled_normal.try_normalize(1e-9)?;
    let u = rotation.transpose() * direction * length;
    let half = 0.5 * length * length;
    let w = u + normal * half;
    let other_normal = w.try_normalize(1e-9)?;
    let other_u = normal * w.norm() - other_normal * half;
    let other_t_normal = Matrix3::identity() + other_u * other_normal.transpose();
    let other_rotation = homography * other_t_normal.try_inverse()?;
    let other_rotation = nearest_orthogonal(&other_rotation);
    let other_direction = (other_rotation * other_u).try_normalize(1e-12)?;
    let finite = other_rotation
        .iter()
        .chain(other_direction.iter())
        .all(|x| x.is_finite());
    (finite && other_rotation.determinant() > 0.0).then_some((other_rotation, other_direction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Rotation3;

    #[test]
    fn both_motions_explain_the_plane() {
        let mut random = Random::new(1);
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * random.normal());
        for _ in 0..200 {
            let rotation = Rotation3::from_scaled_axis(vector(0.3)).into_inner();
            let (direction, normal) = (vector(1.0).normalize(), vector(0.2));
            let h = rotation + direction * normal.transpose();
            if h.determinant() < 0.1 {
                continue;
            }
            let (other_r, other_t) =
                other_motion_of_plane(&rotation, &direction, &(h * -2.5)).unwrap();
            assert!((other_r.transpose() * other_r - Matrix3::identity()).norm() < 1e-9);
            // Another motion, for which H − R' has rank 1 with column t'.
            assert!((other_r - rotation).norm() > 1e-6);
            let rest = h - other_r;
            assert!((rest - other_t * (other_t.transpose() * rest)).norm() < 1e-9);
            // Applied twice, it returns to the first motion.
            let (r, t) = other_motion_of_plane(&other_r, &other_t, &h).unwrap();
            assert!((r - rotation).norm() < 1e-8 && t.cross(&direction).norm() < 1e-8);
        }
    }

    #[test]
    fn a_rotation_has_no_other_motion() {
        let rotation = Rotation3::from_scaled_axis(Vector3::new(0.1, 0.2, 0.3)).into_inner();
        assert_eq!(
            other_motion_of_plane(&rotation, &Vector3::x(), &rotation),
            None
        );
        // Straight towards a plane: the normal and w are parallel.
        let h = Matrix3::identity() + Vector3::z() * Vector3::z().transpose() * 0.2;
        let (r, t) = other_motion_of_plane(&Matrix3::identity(), &Vector3::z(), &h).unwrap();
        assert!((r - Matrix3::identity()).norm() < 1e-12 && t.cross(&Vector3::z()).norm() < 1e-12);
    }
}
