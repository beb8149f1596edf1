//! Rotations and poses from the numbers of files.

use epipole::camera::RigidTransform;
use nalgebra::{Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Largest deviation of RᵀR from the identity: files with four digits are read.
const MAX_DEVIATION: f64 = 1e-3;

/// A rotation from a quaternion of any length, w first.
pub(super) fn rotation_from_quaternion(&[w, x, y, z]: &[f64; 4]) -> Option<UnitQuaternion<f64>> {
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        return None;
    }
    // Kept to the last bit if it is of length 1 as far as its digits go.
    Some(match (norm - 1.0).abs() <= 4.0 * f64::EPSILON {
        true => UnitQuaternion::new_unchecked(quaternion),
        false => UnitQuaternion::new_normalize(quaternion),
    })
}

/// The rotation of a matrix; `None` if it is none.
pub(super) fn rotation_from_matrix(matrix: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let deviation = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    // Also false for NaN.
    if !(deviation <= MAX_DEVIATION && matrix.determinant() > 0.0) {
        return None;
    }
    let near = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*matrix));
    Some(UnitQuaternion::new_normalize(near.into_inner()))
}

/// A pose, if its translation is finite.
pub(super) fn pose(rotation: UnitQuaternion<f64>, t: Vector3<f64>) -> Option<RigidTransform> {
    let is_finite = t.iter().all(|value| value.is_finite());
    is_finite.then(|| RigidTransform::from_parts(Translation3::from(t), rotation))
}

/// Half a turn about x: between a camera that looks along z with y down, and one that looks along
/// −z with y up.
pub(super) fn half_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0))
}
