//! Keypoints, one array per attribute.

use crate::arrays::{as_array, from_rows, points2};
use crate::images::{column, elements, kind};
use crate::record::plain_class;
use epipole::feature::Keypoint;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Detected positions in an image; row k of each array belongs to keypoint k.
///
/// Parameters
/// ----------
/// points : array_like, shape (N, 2)
///     (u, v) in pixels, pixel centers at integers.
/// scales_px : array_like, shape (N,), optional
///     Standard deviation of the blur at detection, pixels of the image. 1 by default.
/// angles_rad : array_like, shape (N,), optional
///     Direction, ``arctan2(v, u)`` with v down. 0 by default.
/// responses : array_like, shape (N,), optional
///     Response of the detector; larger is better. 0 by default.
/// octaves : array_like of int, shape (N,), optional
///     Octave or level of the pyramid. 0 by default.
///
/// Notes
/// -----
/// A slice, a mask or an array of indices selects keypoints: ``keypoints[:100]``.
#[pyclass(frozen, get_all, module = "epipole.feature")]
pub(crate) struct Keypoints {
    /// (u, v) in pixels, shape (N, 2).
    points: Py<PyArray2<f64>>,
    /// Standard deviation of the blur at detection, pixels of the image, float32 of shape (N,).
    scales_px: Py<PyArray1<f32>>,
    /// Direction, radians, float32 of shape (N,).
    angles_rad: Py<PyArray1<f32>>,
    /// Response of the detector, float32 of shape (N,).
    responses: Py<PyArray1<f32>>,
    /// Octave or level of the pyramid, int32 of shape (N,).
    octaves: Py<PyArray1<i32>>,
}

plain_class!(Keypoints: points, scales_px, angles_rad, responses, octaves);

#[pymethods]
impl Keypoints {
    #[new]
    #[pyo3(signature = (points, scales_px=None, angles_rad=None, responses=None, octaves=None))]
    fn new(
        points: &Bound<'_, PyAny>,
        scales_px: Option<&Bound<'_, PyAny>>,
        angles_rad: Option<&Bound<'_, PyAny>>,
        responses: Option<&Bound<'_, PyAny>>,
        octaves: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let places = points2("points", points)?;
        let count = places.len();
        let scales = optional("scales_px", scales_px, count, 1.0)?;
        let angles = optional("angles_rad", angles_rad, count, 0.0)?;
        let responses = optional("responses", responses, count, 0.0)?;
        let octaves = match octaves {
            Some(octaves) => integers("octaves", octaves, count)?,
            None => vec![0; count],
        };
        let keypoint = |k: usize| Keypoint {
            u: places[k].x,
            v: places[k].y,
            scale_px: scales[k],
            angle_rad: angles[k],
            response: responses[k],
            octave: octaves[k],
        };
        let keypoints: Vec<Keypoint> = (0..count).map(keypoint).collect();
        Self::give(points.py(), &keypoints)
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.points.bind(py).shape()[0]
    }

    /// Selects rows.
    ///
    /// Parameters
    /// ----------
    /// index : slice or array_like
    ///     Slice, indices or boolean mask.
    fn __getitem__(slf: &Bound<'_, Self>, index: &Bound<'_, PyAny>) -> PyResult<Self> {
        require_several(index)?;
        let part = |name: &str| slf.getattr(name)?.get_item(index);
        Self::new(
            &part("points")?,
            Some(&part("scales_px")?),
            Some(&part("angles_rad")?),
            Some(&part("responses")?),
            Some(&part("octaves")?),
        )
    }
}

impl Keypoints {
    /// Converts a list to a Python object.
    pub(crate) fn give(py: Python<'_>, keypoints: &[Keypoint]) -> PyResult<Self> {
        let points = keypoints.iter().map(|k| k.point().coords);
        let floats = |of: fn(&Keypoint) -> f32| {
            PyArray1::from_vec(py, keypoints.iter().map(of).collect()).unbind()
        };
        let octaves = keypoints.iter().map(|k| k.octave).collect();
        Ok(Self {
            points: from_rows(py, points)?.unbind(),
            scales_px: floats(|k| k.scale_px),
            angles_rad: floats(|k| k.angle_rad),
            responses: floats(|k| k.response),
            octaves: PyArray1::from_vec(py, octaves).unbind(),
        })
    }

    /// Returns the number of keypoints.
    pub(super) fn count(&self, py: Python<'_>) -> usize {
        self.__len__(py)
    }

    fn list(&self, py: Python<'_>) -> PyResult<Vec<Keypoint>> {
        let points = self.points.bind(py).readonly();
        let points = points.as_array();
        let scales = self.scales_px.bind(py).to_vec()?;
        let angles = self.angles_rad.bind(py).to_vec()?;
        let responses = self.responses.bind(py).to_vec()?;
        let octaves = self.octaves.bind(py).to_vec()?;
        let keypoint = |k: usize| Keypoint {
            u: points[[k, 0]],
            v: points[[k, 1]],
            scale_px: scales[k],
            angle_rad: angles[k],
            response: responses[k],
            octave: octaves[k],
        };
        Ok((0..scales.len()).map(keypoint).collect())
    }
}

/// Reads `Keypoints`, or points of shape `(N, 2)`.
///
/// # Errors
/// As [`points2`].
pub(crate) fn keypoints(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Keypoint>> {
    if let Ok(keypoints) = value.cast::<Keypoints>() {
        return keypoints.get().list(value.py());
    }
    let points = points2(name, value)?;
    Ok(points.iter().map(|p| Keypoint::at(p.x, p.y, 0.0)).collect())
}

/// Rejects the index of a single row.
///
/// # Errors
/// `TypeError`.
pub(super) fn require_several(index: &Bound<'_, PyAny>) -> PyResult<()> {
    if index.extract::<i64>().is_err() {
        return Ok(());
    }
    Err(PyTypeError::new_err(
        "index must be a slice, a mask or an array of indices",
    ))
}

fn optional(
    name: &str,
    value: Option<&Bound<'_, PyAny>>,
    count: usize,
    default: f32,
) -> PyResult<Vec<f32>> {
    let Some(value) = value else {
        return Ok(vec![default; count]);
    };
    let values = column(name, value)?;
    require_count(name, values.len(), count)?;
    Ok(values)
}

fn integers(name: &str, value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<i32>> {
    let array = as_array(name, value, "(N,)")?;
    // An empty list becomes an array of floats.
    if array.ndim() != 1 || (!matches!(kind(&array), 'i' | 'u') && !array.is_empty()) {
        return Err(PyTypeError::new_err(format!(
            "{name} must be an array of integers of shape (N,)"
        )));
    }
    require_count(name, array.len(), count)?;
    elements(&array, "int32")
}

fn require_count(name: &str, got: usize, needed: usize) -> PyResult<()> {
    if got == needed {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "{name} must have one number per point, but has {got} for {needed} points"
    )))
}
