//! Features, and descriptors as arrays.
//!
//! Descriptors are arrays as in OpenCV: float32 of shape `(N, D)`, compared by Euclidean distance,
//! or uint8 of shape `(N, 32)` for 256 bits, compared by Hamming distance.

use super::keypoints::{Keypoints, require_several};
use crate::arrays::as_array;
use crate::errors::OrRaise;
use crate::images::{dtype, elements, table};
use crate::record::plain_class;
use epipole::feature;
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Number of bytes in a binary descriptor.
const BYTES: usize = 32;

/// Keypoints and their descriptors, in the same order.
///
/// Parameters
/// ----------
/// keypoints : Keypoints
/// descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
///     Floating-point numbers, compared by Euclidean distance, or 256 bits, by Hamming distance.
///
/// Notes
/// -----
/// A slice, a mask or an array of indices selects features: ``features[:100]``.
#[pyclass(frozen, get_all, module = "epipole.feature")]
pub(super) struct Features {
    /// Keypoints.
    keypoints: Py<Keypoints>,
    /// Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for binary ones.
    descriptors: Py<PyAny>,
}

plain_class!(Features: keypoints, descriptors);

#[pymethods]
impl Features {
    #[new]
    fn new(keypoints: Bound<'_, Keypoints>, descriptors: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = descriptors.py();
        let list = self::descriptors("descriptors", descriptors)?;
        let count = keypoints.get().count(py);
        if list.len() != count {
            return Err(PyValueError::new_err(format!(
                "descriptors must have one row per keypoint, but has {} for {count} keypoints",
                list.len()
            )));
        }
        Ok(Self {
            keypoints: keypoints.unbind(),
            descriptors: give_descriptors(py, &list)?.unbind(),
        })
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.keypoints.get().count(py)
    }

    /// Selects rows.
    ///
    /// Parameters
    /// ----------
    /// index : slice or array_like
    ///     Slice, indices or boolean mask.
    fn __getitem__(slf: &Bound<'_, Self>, index: &Bound<'_, PyAny>) -> PyResult<Self> {
        require_several(index)?;
        let keypoints = slf.getattr("keypoints")?.get_item(index)?;
        let descriptors = slf.getattr("descriptors")?.get_item(index)?;
        Self::new(keypoints.cast_into()?, &descriptors)
    }

    /// Positions of the keypoints, (u, v) in pixels, shape (N, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.keypoints.bind(py).getattr("points")
    }
}

impl Features {
    pub(super) fn give(py: Python<'_>, features: &feature::Features) -> PyResult<Self> {
        Ok(Self {
            keypoints: Py::new(py, Keypoints::give(py, &features.keypoints)?)?,
            descriptors: give_descriptors(py, &features.descriptors)?.unbind(),
        })
    }
}

/// Reads `Features`, or an array of descriptors.
///
/// # Errors
/// `TypeError` or `ValueError` naming the argument.
pub(crate) fn descriptors(name: &str, value: &Bound<'_, PyAny>) -> PyResult<feature::Descriptors> {
    if let Ok(features) = value.cast::<Features>() {
        return descriptors(name, features.get().descriptors.bind(value.py()));
    }
    let array = as_array(name, value, "(N, D)")?;
    if dtype(&array)? != "uint8" {
        let (values, dimension) = table(name, &array)?;
        let is_byte = |&value: &f32| f32::from(value as u8) == value;
        // Integers, as in SIFT, are compared faster.
        if values.iter().all(is_byte) {
            let bytes = values.iter().map(|&value| value as u8).collect();
            return feature::Descriptors::from_bytes(dimension, bytes).or_raise();
        }
        return feature::Descriptors::from_floats(dimension, values).or_raise();
    }
    let [_, BYTES] = *array.shape() else {
        let shape = array.getattr("shape")?.repr()?;
        return Err(PyValueError::new_err(format!(
            "{name} must be uint8 of shape (N, {BYTES}) for bits, but has shape {shape}; convert \
             numbers by astype(numpy.float32)"
        )));
    };
    let bytes: Vec<u8> = elements(&array, "uint8")?;
    let word = |bytes: &[u8]| (bytes.iter().rev()).fold(0, |word, &b| word << 8 | u64::from(b));
    let words = |row: &[u8]| [0, 8, 16, 24].map(|start| word(&row[start..start + 8]));
    let bits = bytes.chunks_exact(BYTES).map(words).collect();
    Ok(feature::Descriptors::from_bits(bits))
}

/// Creates an array of descriptors: float32 of shape `(N, D)`, or uint8 of shape `(N, 32)`.
pub(crate) fn give_descriptors<'py>(
    py: Python<'py>,
    list: &feature::Descriptors,
) -> PyResult<Bound<'py, PyAny>> {
    if let Some(bits) = list.as_bits() {
        let words = bits.iter().flatten();
        let bytes: Vec<u8> = words.flat_map(|word| word.to_le_bytes()).collect();
        let array = PyArray1::from_vec(py, bytes).reshape([list.len(), BYTES])?;
        return Ok(array.into_any());
    }
    let shape = [list.len(), list.dimension()];
    Ok(PyArray1::from_vec(py, list.to_floats())
        .reshape(shape)?
        .into_any())
}
