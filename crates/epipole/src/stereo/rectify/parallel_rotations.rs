//! Rotations that make the cameras of a rig parallel.

use crate::camera::RigidTransform;
use crate::{Error, Result};
use nalgebra::{Rotation3, UnitVector3, Vector3};

/// Rotations that make two cameras parallel, with the baseline along an image axis.
pub(super) struct ParallelRotations {
    pub(super) rect_from_cam: [Rotation3<f64>; 2],
    pub(super) is_vertical: bool,
    /// From the second to the first center, in the rectified frame: along ±x or ±y.
    pub(super) translation: Vector3<f64>,
}

pub(super) fn parallel_rotations(cam2_from_cam1: &RigidTransform) -> Result<ParallelRotations> {
    let what = "a rectification";
    let rotation = cam2_from_cam1.rotation.to_rotation_matrix();
    let t = cam2_from_cam1.translation.vector;
    if !t.iter().all(|x| x.is_finite()) || !rotation.matrix().iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite {
            what: "the motion between the cameras",
        });
    }
    if t.norm() < 1e-12 {
        return Err(Error::Degenerate {
            what,
            why: "both cameras are at the same place",
        });
    }
    let half = half_rotation(&rotation);
    // x2 = R x1 + t in the frame halfway: R^½ x1 and R^−½ x2 differ only by R^−½ t.
    let halfway = half.inverse() * t;
    let is_vertical = halfway.y.abs() > halfway.x.abs();
    // Beyond 60° from the image plane, in any direction, the epipole enters the image.
    if halfway.z.abs() > 3.0_f64.sqrt() * halfway.xy().norm() {
        return Err(Error::Degenerate {
            what,
            why: "one camera is in front of the other: the baseline may be at most 60° off the image plane",
        });
    }
    let axis = if is_vertical {
        Vector3::y()
    } else {
        Vector3::x()
    };
    let target = axis * halfway.dot(&axis).signum();
    let align = shortest_rotation(&halfway, &target);
    Ok(ParallelRotations {
        rect_from_cam: [align * half, align * half.inverse()],
        is_vertical,
        translation: align * halfway,
    })
}

/// Returns the rotation by half the angle about the same axis.
fn half_rotation(rotation: &Rotation3<f64>) -> Rotation3<f64> {
    let m = rotation.matrix();
    // sin and cos of the angle, times 2.
    let axis = Vector3::new(
        m[(2, 1)] - m[(1, 2)],
        m[(0, 2)] - m[(2, 0)],
        m[(1, 0)] - m[(0, 1)],
    );
    let angle = libm::atan2(axis.norm(), m.trace() - 1.0);
    match UnitVector3::try_new(axis, 1e-15) {
        Some(axis) => Rotation3::from_axis_angle(&axis, angle / 2.0),
        None => Rotation3::identity(),
    }
}

/// Returns the smallest rotation from the direction of `from` to that of `to`.
fn shortest_rotation(from: &Vector3<f64>, to: &Vector3<f64>) -> Rotation3<f64> {
    let axis = from.cross(to);
    let angle = libm::atan2(axis.norm(), from.dot(to));
    match UnitVector3::try_new(axis, 1e-15 * from.norm() * to.norm()) {
        Some(axis) => Rotation3::from_axis_angle(&axis, angle),
        None => Rotation3::identity(),
    }
}
