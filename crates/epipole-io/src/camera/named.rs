//! Cameras with names.

use crate::error::Listed;
use crate::{Error, Result};
use epipole::camera::{Camera, RigidTransform};
use nalgebra::Translation3;

/// A camera and its name in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCamera {
    /// Name, number or image in the file; by default "camera", or "left" and "right".
    pub name: String,
    /// Size, intrinsics and lens, pixel centers at integers.
    pub camera: Camera,
    /// Pose, if the format has one: `x_in_cam = cam_from_world * x_in_world`.
    pub cam_from_world: Option<RigidTransform>,
}

/// Content of a file of cameras.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cameras {
    /// At least one after reading, in the order of the file.
    pub cameras: Vec<NamedCamera>,
    /// Motion of a rig, from the first camera to the second: `x_in_right = R x_in_left + t`, in the
    /// unit of the file.
    pub right_from_left: Option<RigidTransform>,
    /// Sentences on cameras of the file that are left out because their lens is not supported.
    pub notes: Vec<String>,
}

impl Cameras {
    /// Returns the supported cameras of a list, and notes on the others.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if none remain.
    pub(super) fn of_list(
        list: impl IntoIterator<Item = (String, Listed<Camera>)>,
    ) -> Result<Self> {
        let mut all = Self::default();
        for (name, camera) in list {
            match camera {
                Ok(camera) => all.cameras.push(NamedCamera::new(name, camera)),
                Err(why) => all.notes.push(format!("camera {name} is left out: {why}")),
            }
        }
        match (&all.cameras[..], all.notes.first()) {
            ([], Some(note)) => Err(Error::unsupported(note)),
            _ => Ok(all),
        }
    }

    /// Creates a list of one camera, named "camera".
    pub fn of(camera: Camera) -> Self {
        Self {
            cameras: vec![NamedCamera::new("camera", camera)],
            ..Self::default()
        }
    }

    /// Creates a stereo rig with cameras named "left" and "right".
    pub fn of_rig([left, right]: [Camera; 2], right_from_left: RigidTransform) -> Self {
        Self {
            cameras: vec![
                NamedCamera::new("left", left),
                NamedCamera::new("right", right),
            ],
            right_from_left: Some(right_from_left),
            ..Self::default()
        }
    }

    /// Creates a rectified rig, whose right camera is `baseline` to the right of the left one, in
    /// the unit of the file.
    pub(super) fn of_rectified(cameras: [Camera; 2], baseline: f64) -> Self {
        let right_from_left = Translation3::new(-baseline, 0.0, 0.0);
        Self::of_rig(cameras, right_from_left.into())
    }

    /// Returns the camera of a name.
    pub fn named(&self, name: &str) -> Option<&Camera> {
        let found = self.cameras.iter().find(|named| named.name == name);
        found.map(|named| &named.camera)
    }
}

impl NamedCamera {
    /// Creates a camera with a name.
    pub fn new(name: impl Into<String>, camera: Camera) -> Self {
        Self {
            name: name.into(),
            camera,
            cam_from_world: None,
        }
    }
}
