//! Rigs of models.

use crate::camera::RigidTransform;
use crate::sfm::wrapper::wrapper;
use epipole_io::model::{self, RigCamera, RigFrame};
use pyo3::prelude::*;

/// Cameras mounted rigidly on each other, and the frames that they took.
///
/// Parameters
/// ----------
/// id : int
///     Number of the rig in files with numbered rigs; unique.
/// cameras : list of tuple
///     Index of each camera and its ``cam_from_rig``, which is the identity for the first one.
/// frames : list of tuple
///     Number of each frame, its ``rig_from_world``, and the indices of its images.
#[pyclass(frozen, from_py_object, module = "epipole.io")]
#[derive(Clone)]
pub(super) struct Rig(pub(super) model::Rig);

wrapper!(Rig: id, cameras, frames);

#[pymethods]
impl Rig {
    #[new]
    fn new(
        id: u32,
        cameras: Vec<(usize, RigidTransform)>,
        frames: Vec<(u32, RigidTransform, Vec<usize>)>,
    ) -> Self {
        let camera = |(camera, cam_from_rig): (usize, RigidTransform)| RigCamera {
            camera,
            cam_from_rig: cam_from_rig.0,
        };
        let frame = |(id, rig_from_world, images): (u32, RigidTransform, Vec<usize>)| RigFrame {
            id,
            rig_from_world: rig_from_world.0,
            images,
        };
        Self(model::Rig {
            id,
            cameras: cameras.into_iter().map(camera).collect(),
            frames: frames.into_iter().map(frame).collect(),
        })
    }

    /// Number of the rig.
    #[getter]
    fn id(&self) -> u32 {
        self.0.id
    }

    /// Index of each camera and its ``cam_from_rig``, a list of tuple.
    #[getter]
    fn cameras(&self) -> Vec<(usize, RigidTransform)> {
        let cameras = self.0.cameras.iter();
        cameras
            .map(|of_rig| (of_rig.camera, of_rig.cam_from_rig.into()))
            .collect()
    }

    /// Number of each frame, its ``rig_from_world``, the indices of its images, a list of tuple.
    #[getter]
    fn frames(&self) -> Vec<(u32, RigidTransform, Vec<usize>)> {
        let frames = self.0.frames.iter();
        frames
            .map(|frame| (frame.id, frame.rig_from_world.into(), frame.images.clone()))
            .collect()
    }
}
