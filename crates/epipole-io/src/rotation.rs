//! Rotations and poses from the numbers of files.

use epipole::camera::RigidTransform;
use epipole::math::svd3;
use nalgebra::{Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Largest entry of RᵀR − I of a rotation matrix written with four digits.
pub(crate) const FOUR_DIGITS: f64 = 1e-3;

/// Returns a rotation from a quaternion of any length, w first.
pub(crate) fn rotation_from_quaternion(&[w, x, y, z]: &[f64; 4]) -> Option<UnitQuaternion<f64>> {
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        return None;
    }
    // Unchanged if its length is 1 up to rounding.
    Some(match (norm - 1.0).abs() <= 4.0 * f64::EPSILON {
        true => UnitQuaternion::new_unchecked(quaternion),
        false => UnitQuaternion::new_normalize(quaternion),
    })
}

/// Returns the rotation nearest to a matrix; `None` if it is not a rotation matrix.
///
/// * `max_deviation`: largest entry of RᵀR − I
///
/// Source: Horn, Hilden & Negahdaripour 1988, "Closed-form solution of absolute orientation using
/// orthonormal matrices" (the nearest one, by a singular value decomposition).
pub(crate) fn rotation_from_matrix(
    matrix: &Matrix3<f64>,
    max_deviation: f64,
) -> Option<UnitQuaternion<f64>> {
    let deviation = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    // Also false for NaN.
    if !(deviation <= max_deviation && matrix.determinant() > 0.0) {
        return None;
    }
    let axes = svd3(matrix);
    let nearest = Rotation3::from_matrix_unchecked(axes.u * axes.v.transpose());
    Some(UnitQuaternion::from_rotation_matrix(&nearest))
}

/// Returns a pose, if its translation is finite.
pub(crate) fn pose(rotation: UnitQuaternion<f64>, t: Vector3<f64>) -> Option<RigidTransform> {
    let is_finite = t.iter().all(|value| value.is_finite());
    is_finite.then(|| RigidTransform::from_parts(Translation3::from(t), rotation))
}

/// Returns the rotation by 180° about x, which converts between cameras along z with y down and
/// cameras along −z with y up.
pub(crate) fn half_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0))
}
