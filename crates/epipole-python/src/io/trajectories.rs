//! Trajectory files.

use super::source::{Source, format_of, or_raise, write};
use crate::camera::RigidTransform;
use crate::register::{classes, functions};
use crate::sfm::wrapper::{require_equal, wrapper};
use epipole_io::trajectory::{self, TrajectoryFormat};
use numpy::PyArray1;
use pyo3::prelude::*;

/// Formats by their Python names.
const FORMATS: [(&str, TrajectoryFormat); 3] = [
    ("tum", TrajectoryFormat::Tum),
    ("kitti", TrajectoryFormat::Kitti),
    ("euroc", TrajectoryFormat::EuRoC),
];

/// Poses of one camera over time.
///
/// Parameters
/// ----------
/// world_from_cam : list of RigidTransform
/// stamps_ns : array_like of int, shape (N,), optional
///     Time of each pose, nanoseconds, not decreasing.
/// notes : list of str, optional
///     Assumptions of a reader, as sentences.
#[pyclass(frozen, module = "epipole.io")]
struct Trajectory(trajectory::Trajectory);

wrapper!(Trajectory: world_from_cam, stamps_ns, notes);

#[pymethods]
impl Trajectory {
    #[new]
    #[pyo3(signature = (world_from_cam, stamps_ns=None, notes=None))]
    fn new(
        world_from_cam: Vec<RigidTransform>,
        stamps_ns: Option<Vec<i64>>,
        notes: Option<Vec<String>>,
    ) -> PyResult<Self> {
        if let Some(stamps) = &stamps_ns {
            let count = world_from_cam.len();
            require_equal(("world_from_cam", count), ("stamps_ns", stamps.len()))?;
        }
        Ok(Self(trajectory::Trajectory {
            stamps_ns,
            world_from_cam: world_from_cam.into_iter().map(|pose| pose.0).collect(),
            notes: notes.unwrap_or_default(),
        }))
    }

    /// ``x_in_world = world_from_cam @ x_in_cam``, a list of `RigidTransform`.
    #[getter]
    fn world_from_cam(&self) -> Vec<RigidTransform> {
        let poses = self.0.world_from_cam.iter();
        poses.map(|&pose| pose.into()).collect()
    }

    /// Time of each pose, nanoseconds, int64 of shape (N,), or None.
    #[getter]
    fn stamps_ns<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<i64>>> {
        let stamps = self.0.stamps_ns.as_ref()?;
        Some(PyArray1::from_slice(py, stamps))
    }

    /// Assumptions of a reader, as sentences, a list of str.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }

    fn __len__(&self) -> usize {
        self.0.world_from_cam.len()
    }
}

/// Reads a trajectory; the format is detected from its content.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///     TUM, KITTI or EuRoC file.
///
/// Returns
/// -------
/// format : {"tum", "kitti", "euroc"}
/// trajectory : Trajectory
///
/// Raises
/// ------
/// ValueError
///     If the format is unknown, numbers are wrong, a quaternion is zero, a matrix is not a
///     rotation, or times decrease.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_trajectory(source: &Bound<'_, PyAny>) -> PyResult<(&'static str, Trajectory)> {
    let source = Source::read(source)?;
    let (format, path) = source.done(trajectory::read_trajectory(&source.bytes))?;
    let named = FORMATS.iter().find(|(_, other)| *other == format);
    Ok((named.map_or("other", |(name, _)| name), Trajectory(path)))
}

/// Writes a trajectory with all digits.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// trajectory : Trajectory
/// format : {"tum", "kitti", "euroc"}, optional
///     "kitti" has no times, the other formats require them.
///
/// Raises
/// ------
/// ValueError
///     If the format is unknown, or times are missing for TUM or EuRoC.
/// OSError
///     If the file cannot be written.
#[pyfunction]
#[pyo3(signature = (path, trajectory, format="tum"))]
fn write_trajectory(
    path: &Bound<'_, PyAny>,
    trajectory: &Trajectory,
    format: &str,
) -> PyResult<()> {
    let format = format_of(&FORMATS, format)?;
    let text = or_raise(trajectory::write_trajectory(format, &trajectory.0))?;
    write(path, text.as_bytes())
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: Trajectory);
    functions!(module: read_trajectory, write_trajectory);
    Ok(())
}
