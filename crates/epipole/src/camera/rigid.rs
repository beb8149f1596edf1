//! Rigid transforms between frames, and their naming.
//!
//! A transform is called `b_from_a` and is read from right to left:
//! `x_in_b = b_from_a * x_in_a`, so `c_from_a = c_from_b * b_from_a`. The world-to-camera
//! transform is `cam_from_world`, the motion between two cameras `cam2_from_cam1`.

use crate::{Error, Result};
use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// A rotation followed by a translation: `x_in_b = R x_in_a + t`.
pub type RigidTransform = Isometry3<f64>;

/// Returns the matrix `[t]ₓ` with `[t]ₓ x = t × x` for every x.
///
/// Source: Hartley & Zisserman 2004, §A4.3.
///
/// ```
/// use epipole::camera::cross_matrix;
/// use nalgebra::Vector3;
/// let (t, x) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.0, 1.0, -1.0));
/// assert_eq!(cross_matrix(&t) * x, t.cross(&x));
/// ```
pub fn cross_matrix(t: &Vector3<f64>) -> Matrix3<f64> {
    t.cross_matrix()
}

/// Returns the motion between two cameras, `cam2_from_cam1 = cam2_from_world * cam1_from_world⁻¹`.
pub fn relative_motion(
    cam1_from_world: &RigidTransform,
    cam2_from_world: &RigidTransform,
) -> RigidTransform {
    cam2_from_world * cam1_from_world.inverse()
}

/// Returns `cam_from_world` of a camera at `center_in_world` that looks at `target_in_world`.
///
/// * `up_in_world`: approximate up direction of the image; the camera's y axis (down) points away
///   from it
///
/// # Errors
/// [`Error::Degenerate`] if the target is the center, or `up_in_world` is zero or along the viewing
/// direction; [`Error::NotFinite`] for NaN and infinities.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::look_at;
/// use nalgebra::{Point3, Vector3};
/// let up = Vector3::new(0.0, -1.0, 0.0);
/// let cam_from_world = look_at(&Point3::new(0.0, 0.0, -3.0), &Point3::origin(), &up)?;
/// assert!((cam_from_world * Point3::origin() - Point3::new(0.0, 0.0, 3.0)).norm() < 1e-12);
/// # Ok(()) }
/// ```
pub fn look_at(
    center_in_world: &Point3<f64>,
    target_in_world: &Point3<f64>,
    up_in_world: &Vector3<f64>,
) -> Result<RigidTransform> {
    let what = "a camera's orientation";
    let tiny = 1e-12;
    let finite = |v: &Vector3<f64>| v.iter().all(|x| x.is_finite());
    if ![
        &center_in_world.coords,
        &target_in_world.coords,
        up_in_world,
    ]
    .into_iter()
    .all(finite)
    {
        return Err(Error::NotFinite {
            what: "a camera's place, target and up direction",
        });
    }
    let forward = (target_in_world - center_in_world)
        .try_normalize(tiny)
        .ok_or(Error::Degenerate {
            what,
            why: "the target is the camera's center",
        })?;
    let right = forward
        .cross(up_in_world)
        .try_normalize(tiny)
        .ok_or(Error::Degenerate {
            what,
            why: "the up direction is zero or along the line of sight",
        })?;
    let down = forward.cross(&right);
    let cam_from_world = Rotation3::from_matrix_unchecked(Matrix3::from_rows(&[
        right.transpose(),
        down.transpose(),
        forward.transpose(),
    ]));
    let rotation = UnitQuaternion::from_rotation_matrix(&cam_from_world);
    let translation = Translation3::from(-(rotation * center_in_world.coords));
    Ok(RigidTransform::from_parts(translation, rotation))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_compose_from_right_to_left() {
        let up = Vector3::new(0.0, 0.0, 1.0);
        let cam1_from_world = look_at(&Point3::new(2.0, 0.5, 1.0), &Point3::origin(), &up).unwrap();
        let cam2_from_world = look_at(&Point3::new(1.0, 2.5, 1.5), &Point3::origin(), &up).unwrap();
        let cam2_from_cam1 = relative_motion(&cam1_from_world, &cam2_from_world);
        let x_in_world = Point3::new(0.3, -0.2, 0.7);
        let difference =
            cam2_from_cam1 * (cam1_from_world * x_in_world) - cam2_from_world * x_in_world;
        assert!(difference.norm() < 1e-12);
    }

    #[test]
    fn up_is_up_in_the_picture() {
        let up = Vector3::new(0.0, 0.0, 1.0);
        let cam_from_world = look_at(&Point3::new(3.0, 0.0, 0.0), &Point3::origin(), &up).unwrap();
        let above = cam_from_world * Point3::new(0.0, 0.0, 1.0);
        assert!(above.y < 0.0, "up must have negative y, got {above}");
        assert!(
            (cam_from_world
                .rotation
                .to_rotation_matrix()
                .matrix()
                .determinant()
                - 1.0)
                .abs()
                < 1e-12
        );
    }

    #[test]
    fn degenerate_directions_are_refused() {
        let up = Vector3::new(0.0, 0.0, 1.0);
        assert!(look_at(&Point3::origin(), &Point3::origin(), &up).is_err());
        assert!(look_at(&Point3::origin(), &Point3::new(0.0, 0.0, 2.0), &up).is_err());
        assert!(look_at(&Point3::origin(), &Point3::new(f64::NAN, 0.0, 2.0), &up).is_err());
    }
}
