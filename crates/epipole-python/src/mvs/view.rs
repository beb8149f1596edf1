//! Photos of multi-view stereo.

use crate::camera::PosedCamera;
use crate::images::{from_rgb, rgb};
use crate::sfm::wrapper::wrapper;
use epipole::mvs;
use numpy::PyArray3;
use pyo3::prelude::*;

/// Undistorted photo with its neighbors and depth range.
///
/// Parameters
/// ----------
/// photo : int
///     Index of the image in the reconstruction.
/// camera : PosedCamera
///     Camera without distortion, with the size of the image.
/// image : array_like of uint8, shape (H, W, 3)
///     Red, green, blue.
/// neighbors : list of int
///     Indices of the views to compare with, best first.
/// depth_range : tuple of float
///     Minimum and maximum depth to search.
#[pyclass(frozen, from_py_object, module = "epipole.mvs")]
#[derive(Clone)]
pub(super) struct MvsView(pub(super) mvs::MvsView);

wrapper!(MvsView: photo, camera, image, neighbors, depth_range);

#[pymethods]
impl MvsView {
    #[new]
    fn new(
        photo: usize,
        camera: &PosedCamera,
        image: &Bound<'_, PyAny>,
        neighbors: Vec<usize>,
        depth_range: (f64, f64),
    ) -> PyResult<Self> {
        Ok(Self(mvs::MvsView {
            photo,
            camera: camera.0,
            image: rgb("image", image)?,
            neighbors,
            depth_range: depth_range.into(),
        }))
    }

    /// Index of the image in the reconstruction.
    #[getter]
    fn photo(&self) -> usize {
        self.0.photo
    }

    /// Camera without distortion.
    #[getter]
    fn camera(&self) -> PosedCamera {
        self.0.camera.into()
    }

    /// Undistorted pixels, uint8 of shape (H, W, 3).
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.0.image.clone())
    }

    /// Indices of the views to compare with, best first.
    #[getter]
    fn neighbors(&self) -> Vec<usize> {
        self.0.neighbors.clone()
    }

    /// Minimum and maximum depth to search.
    #[getter]
    fn depth_range(&self) -> (f64, f64) {
        self.0.depth_range.into()
    }
}
