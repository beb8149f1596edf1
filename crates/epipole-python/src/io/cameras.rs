//! Camera files.

use super::source::{Source, format_of, or_raise, write};
use crate::arrays::from_rows;
use crate::camera::{Camera, RigidTransform};
use crate::register::{classes, functions};
use crate::sfm::wrapper::wrapper;
use epipole_io::camera::{self, CameraFormat};
use numpy::PyArray2;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;

/// Formats by their Python names.
const FORMATS: [(&str, CameraFormat); 11] = [
    ("epipole", CameraFormat::Epipole),
    ("opencv", CameraFormat::OpenCv),
    ("ros", CameraFormat::Ros),
    ("kalibr", CameraFormat::Kalibr),
    ("colmap", CameraFormat::Colmap),
    ("nerfstudio", CameraFormat::NerfStudio),
    ("metashape", CameraFormat::Metashape),
    ("matlab", CameraFormat::Matlab),
    ("kitti", CameraFormat::Kitti),
    ("middlebury", CameraFormat::Middlebury),
    ("flat", CameraFormat::Flat),
];

/// Camera with its name in a file.
///
/// Parameters
/// ----------
/// name : str
/// camera : Camera
/// cam_from_world : RigidTransform, optional
///     Pose, for formats that have one.
#[pyclass(frozen, from_py_object, module = "epipole.io")]
#[derive(Clone)]
struct NamedCamera(camera::NamedCamera);

wrapper!(NamedCamera: name, camera, cam_from_world);

#[pymethods]
impl NamedCamera {
    #[new]
    #[pyo3(signature = (name, camera, cam_from_world=None))]
    fn new(name: String, camera: &Camera, cam_from_world: Option<&RigidTransform>) -> Self {
        Self(camera::NamedCamera {
            name,
            camera: camera.0,
            cam_from_world: cam_from_world.map(|pose| pose.0),
        })
    }

    /// Name, number or image in the file; otherwise "camera", or "left" and "right".
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Camera.
    #[getter]
    fn camera(&self) -> Camera {
        self.0.camera.into()
    }

    /// Pose, or None.
    #[getter]
    fn cam_from_world(&self) -> Option<RigidTransform> {
        self.0.cam_from_world.map(RigidTransform::from)
    }
}

/// Content of a camera file.
///
/// Parameters
/// ----------
/// cameras : list of NamedCamera
/// right_from_left : RigidTransform, optional
///     Motion of a rig from the first to the second camera, in the unit of the file.
/// notes : list of str, optional
///     Notes on cameras of the file that were skipped, as sentences.
#[pyclass(frozen, module = "epipole.io")]
struct Cameras(camera::Cameras);

wrapper!(Cameras: cameras, right_from_left, notes);

#[pymethods]
impl Cameras {
    #[new]
    #[pyo3(signature = (cameras, right_from_left=None, notes=None))]
    fn new(
        cameras: Vec<NamedCamera>,
        right_from_left: Option<&RigidTransform>,
        notes: Option<Vec<String>>,
    ) -> Self {
        Self(camera::Cameras {
            cameras: cameras.into_iter().map(|camera| camera.0).collect(),
            right_from_left: right_from_left.map(|motion| motion.0),
            notes: notes.unwrap_or_default(),
        })
    }

    /// Creates content with one camera.
    ///
    /// Parameters
    /// ----------
    /// camera : epipole.camera.Camera
    #[staticmethod]
    fn of(camera: &Camera) -> Self {
        Self(camera::Cameras::of(camera.0))
    }

    /// Creates content with the two cameras of a rig.
    ///
    /// Parameters
    /// ----------
    /// cameras : sequence of epipole.camera.Camera
    ///     Left and right camera.
    /// right_from_left : epipole.camera.RigidTransform
    #[staticmethod]
    fn of_rig(cameras: [Camera; 2], right_from_left: &RigidTransform) -> Self {
        let cameras = cameras.map(|camera| camera.0);
        Self(camera::Cameras::of_rig(cameras, right_from_left.0))
    }

    /// Cameras in the order of the file, a list of `NamedCamera`.
    #[getter]
    fn cameras(&self) -> Vec<NamedCamera> {
        self.0.cameras.iter().cloned().map(NamedCamera).collect()
    }

    /// Motion of a rig from the first to the second camera, or None.
    #[getter]
    fn right_from_left(&self) -> Option<RigidTransform> {
        self.0.right_from_left.map(RigidTransform::from)
    }

    /// Notes on cameras skipped because their lens is not supported, a list of str.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }

    /// Returns the camera with a name; `KeyError` if there is none.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///
    /// Raises
    /// ------
    /// KeyError
    ///     If there is no camera of this name.
    fn named(&self, name: &str) -> PyResult<Camera> {
        let camera = self.0.named(name).copied();
        let missing = || PyKeyError::new_err(name.to_owned());
        Ok(camera.ok_or_else(missing)?.into())
    }

    fn __len__(&self) -> usize {
        self.0.cameras.len()
    }
}

/// Reads the cameras of a file; the format is detected from its content.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///     File of Epipole, OpenCV, ROS, Kalibr, KITTI, ORB-SLAM, Middlebury, COLMAP, nerfstudio,
///     Metashape or MATLAB, or plain numbers.
/// size : tuple of int, optional
///     Width and height of the images, pixels, for files that lack them.
///
/// Returns
/// -------
/// format : str
/// cameras : Cameras
///
/// Raises
/// ------
/// ValueError
///     If the format is unknown, values are wrong or missing, or the lens model is not supported.
/// OSError
///     If the file cannot be read.
#[pyfunction]
#[pyo3(signature = (source, size=None))]
fn read_cameras(
    source: &Bound<'_, PyAny>,
    size: Option<(u32, u32)>,
) -> PyResult<(&'static str, Cameras)> {
    let source = Source::read(source)?;
    let (format, cameras) = source.done(camera::read_cameras(&source.bytes, size))?;
    let named = FORMATS.iter().find(|(_, other)| *other == format);
    Ok((named.map_or("other", |(name, _)| name), Cameras(cameras)))
}

/// Reads Q of a rectified pair, which maps pixels with disparities to points.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///     File with the key ``Q`` from OpenCV or ``epipole rectify --json``, or sixteen numbers, row
///     by row.
///
/// Returns
/// -------
/// ndarray, shape (4, 4)
///
/// Raises
/// ------
/// ValueError
///     If there are not 16 finite numbers, or they are not the Q of a rectified pair.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_q<'py>(source: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let py = source.py();
    let source = Source::read(source)?;
    let q = source.done(camera::read_q(&source.bytes))?;
    from_rows(py, (0..4).map(|row| q.row(row).transpose()))
}

/// Writes cameras with all digits.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// cameras : Cameras
/// format : {"epipole", "opencv", "ros", "colmap"}, optional
///
/// Raises
/// ------
/// ValueError
///     If the format is unknown, or cannot hold a lens or this number of cameras.
/// OSError
///     If the file cannot be written.
#[pyfunction]
#[pyo3(signature = (path, cameras, format="epipole"))]
fn write_cameras(path: &Bound<'_, PyAny>, cameras: &Cameras, format: &str) -> PyResult<()> {
    let format = format_of(&FORMATS, format)?;
    let text = or_raise(camera::write_cameras(format, &cameras.0))?;
    write(path, text.as_bytes())
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: NamedCamera, Cameras);
    functions!(module: read_cameras, read_q, write_cameras);
    Ok(())
}
