//! Camera of a reconstruction.

use epipole::camera::Lens;
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// Registered camera.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CameraFound {
    /// Focal lengths and principal point, pixels.
    pub intrinsics: [f64; 4],
    /// Rotation of camera from world, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Translation of camera from world.
    pub translation: [f64; 3],
}

impl CameraFound {
    /// Returns the camera as a type of the core, bit for bit.
    ///
    /// * `width`, `height`: size of its image, pixels
    ///
    /// # Errors
    /// A message for invalid numbers.
    #[cfg(any(feature = "vision", feature = "files"))]
    pub(super) fn posed(
        &self,
        (width, height): (u32, u32),
        lens: Lens,
    ) -> Result<epipole::camera::PosedCamera, String> {
        use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
        let [fu, fv, cu, cv] = self.intrinsics;
        let [i, j, k, w] = self.rotation;
        Ok(PosedCamera {
            camera: Camera {
                width,
                height,
                intrinsics: Intrinsics::new(fu, fv, cu, cv).map_err(|error| error.to_string())?,
                lens,
            },
            cam_from_world: RigidTransform::from_parts(
                self.translation.into(),
                UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
            ),
        })
    }

    /// Returns the position of the camera in the world.
    pub fn center(&self) -> Point3<f64> {
        let (rotation, origin) = self.transform(&Point3::origin());
        Point3::from(-(rotation.transpose() * origin.coords))
    }

    /// Returns the viewing direction of a pixel in the world, unnormalized, ignoring distortion.
    pub fn ray(&self, pixel: [f64; 2]) -> Vector3<f64> {
        self.rays()(pixel)
    }

    /// Returns [`ray`](Self::ray) as a function for many pixels.
    pub fn rays(&self) -> impl Fn([f64; 2]) -> Vector3<f64> + 'static {
        let [fu, fv, cu, cv] = self.intrinsics;
        let (rotation, _) = self.transform(&Point3::origin());
        let world_from_cam = rotation.transpose();
        move |[u, v]| world_from_cam * Vector3::new((u - cu) / fu, (v - cv) / fv, 1.0)
    }

    /// Returns the depth of a point along the camera's axis; negative behind it.
    pub fn depth(&self, position: [f64; 3]) -> f64 {
        self.transform(&Point3::from(position)).1.z
    }

    /// Projects a point through a lens; `None` if the lens does not see it.
    pub fn project(&self, position: [f64; 3], lens: &Lens) -> Option<[f64; 2]> {
        let (_, p) = self.transform(&Point3::from(position));
        let seen = lens.project(&p.coords)?;
        let [fu, fv, cu, cv] = self.intrinsics;
        Some([fu * seen.x + cu, fv * seen.y + cv])
    }

    /// Returns the rotation of camera from world, and a point in the camera's frame.
    pub(crate) fn transform(&self, position: &Point3<f64>) -> (Matrix3<f64>, Point3<f64>) {
        let [i, j, k, w] = self.rotation;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        let in_cam = rotation * position + Vector3::from(self.translation);
        (*rotation.to_rotation_matrix().matrix(), in_cam)
    }
}
