//! The viewpoints for which the scenes were composed.

use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at};
use epipole::{Error, Result};
use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

/// Returns the intrinsics for a picture of any size; `focal_px` is for 640 × 480.
fn intrinsics(focal_px: f64, width: u32, height: u32) -> Intrinsics {
    let (width, height) = (width.max(1), height.max(1));
    let scale = (f64::from(width) / 640.0).min(f64::from(height) / 480.0);
    Intrinsics::centered(scale * focal_px, width, height)
        .expect("a focal length made of positive numbers is positive")
}

/// Returns the viewpoint for which the still life was composed, for a picture of this size.
///
/// The focal length is 1.25 × the width of a 4:3 picture; other shapes show the whole composition
/// and more of the room at two sides.
///
/// ```
/// use epipole_scenes::still_life_camera;
/// assert_eq!(still_life_camera(640, 480).camera.intrinsics.fu_px(), 800.0);
/// ```
pub fn still_life_camera(width: u32, height: u32) -> PosedCamera {
    PosedCamera {
        camera: Camera::pinhole(intrinsics(800.0, width, height), width, height),
        cam_from_world: look_at(
            &Point3::new(0.035, -0.43, -1.30),
            &Point3::new(0.035, -0.165, 0.05),
            &Vector3::new(0.0, -1.0, 0.0),
        )
        .expect("the table is below the camera, not above it"),
    }
}

/// Returns a camera of the rectified pair that looks along the long table: its center at (`x_m`, 0,
/// 0), no rotation, and a focal length of 700 px for a picture of 640 × 480.
///
/// The second camera of a pair with baseline B has `x_m` = B.
///
/// # Errors
/// [`Error::NotFinite`] if `x_m` is not finite.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole_scenes::long_table_camera;
/// use nalgebra::Point3;
/// let (left, right) = (long_table_camera(0.0, 640, 480)?, long_table_camera(0.2, 640, 480)?);
/// let x_in_world = Point3::new(0.0, 0.1, 2.0);
/// let disparity_px = left.project(&x_in_world)?.x - right.project(&x_in_world)?.x;
/// assert!((disparity_px - 700.0 * 0.2 / 2.0).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn long_table_camera(x_m: f64, width: u32, height: u32) -> Result<PosedCamera> {
    if !x_m.is_finite() {
        return Err(Error::NotFinite {
            what: "the camera's place",
        });
    }
    Ok(PosedCamera {
        camera: Camera::pinhole(intrinsics(700.0, width, height), width, height),
        cam_from_world: RigidTransform::from_parts(
            Translation3::new(-x_m, 0.0, 0.0),
            UnitQuaternion::identity(),
        ),
    })
}
