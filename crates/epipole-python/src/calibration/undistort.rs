//! Undistortion of photos.

use crate::camera::{Camera, Intrinsics};
use crate::sfm::wrapper::{object, wrapper};
use crate::{options, progress};
use epipole::calibration::{self, Keep};
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::prelude::*;

/// Best undistorted camera for the photos of a camera, and the map to it.
///
/// Parameters
/// ----------
/// camera : Camera
/// keep : {"valid", "all"}, optional
///     Only the area that is valid everywhere, or the whole image with black borders.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the lens model folds less than halfway to the border, or, with ``keep="all"``, the lens
///     sees more than 80° to a side.
/// ValueError
///     If a side of the image is shorter than 2 pixels, or the image has more than 2**32 pixels.
#[pyclass(frozen, module = "epipole.calibration")]
pub(crate) struct Undistortion(Content);

/// The library's result, with the arguments of the constructor.
#[derive(PartialEq)]
struct Content {
    camera: epipole::camera::Camera,
    keep: Keep,
    undistortion: calibration::Undistortion,
}

wrapper!(Undistortion: camera, keep);

#[pymethods]
impl Undistortion {
    #[new]
    #[pyo3(signature = (camera, keep=None, *, progress=None))]
    fn new(
        py: Python<'_>,
        camera: &Camera,
        keep: Option<&Bound<'_, PyAny>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let keep = keep.map_or(Ok(Keep::default()), |keep| options::value("keep", keep))?;
        let camera = camera.0;
        crate::images::require_size(camera.width, camera.height)?;
        let undistortion = progress::run(py, progress, |monitor| {
            calibration::Undistortion::new(&camera, keep, monitor)
        });
        Ok(Self(Content {
            camera,
            keep,
            undistortion: undistortion?,
        }))
    }

    /// Camera with distortion.
    #[getter]
    fn camera(&self) -> Camera {
        self.0.camera.into()
    }

    /// Kept area.
    ///
    /// Returns
    /// -------
    /// str
    ///     "valid" or "all".
    #[getter]
    fn keep<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize::pythonize(py, &self.0.keep)?)
    }

    /// K of the undistorted camera. Its pixels are square.
    #[getter]
    fn intrinsics(&self) -> Intrinsics {
        self.0.undistortion.intrinsics.into()
    }

    /// Part of the result in which every pixel has image content.
    ///
    /// Returns
    /// -------
    /// epipole.stereo.PixelRect
    #[getter]
    fn valid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let valid = self.0.undistortion.valid;
        let ends = (valid.u_min, valid.v_min, valid.u_max, valid.v_max);
        object(py, "epipole.stereo", "PixelRect", ends)
    }

    /// Source position of every pixel of the result.
    ///
    /// Returns
    /// -------
    /// epipole.stereo.PixelMap
    #[getter]
    fn map<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let map = &self.0.undistortion.map;
        let (width, height) = (map.width(), map.height());
        let mut numbers = Vec::with_capacity(2 * width as usize * height as usize);
        for v in 0..height {
            for u in 0..width {
                let source = map.source(u, v);
                numbers.extend(source.map_or([f32::NAN; 2], |p| [p.x as f32, p.y as f32]));
            }
        }
        let sources = PyArray1::from_vec(py, numbers);
        let sources = sources.reshape([height as usize, width as usize, 2])?;
        object(py, "epipole.stereo", "PixelMap", (sources,))
    }
}

impl Undistortion {
    /// Returns the undistortion of the library.
    pub(crate) fn core(&self) -> &calibration::Undistortion {
        &self.0.undistortion
    }
}
