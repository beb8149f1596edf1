//! Features of a photo, with the image for a reconstruction.

use super::images::SfmImage;
use super::wrapper::{require_equal, wrapper};
use crate::feature::{self, Keypoints, give_descriptors};
use epipole::sfm;
use pyo3::prelude::*;

/// Features of a photo, without its pixels.
///
/// Parameters
/// ----------
/// image : SfmImage
///     Size, keypoints and their colors.
/// descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
///     Floating-point numbers, or 256 bits.
/// keypoints : epipole.feature.Keypoints
///     Keypoints with scales and directions.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct PhotoFeatures(pub(super) sfm::PhotoFeatures);

wrapper!(PhotoFeatures: image, descriptors, keypoints);

#[pymethods]
impl PhotoFeatures {
    #[new]
    fn new(
        image: &SfmImage,
        descriptors: &Bound<'_, PyAny>,
        keypoints: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let features = sfm::PhotoFeatures {
            image: image.0.clone(),
            descriptors: feature::descriptors("descriptors", descriptors)?,
            keypoints: feature::keypoints("keypoints", keypoints)?,
        };
        let count = features.image.keypoints.len();
        require_equal(
            ("image.keypoints", count),
            ("keypoints", features.keypoints.len()),
        )?;
        require_equal(
            ("keypoints", count),
            ("descriptors", features.descriptors.len()),
        )?;
        Ok(Self(features))
    }

    /// Keypoints and their colors, `SfmImage`.
    #[getter]
    fn image(&self) -> SfmImage {
        SfmImage(self.0.image.clone())
    }

    /// Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for binary ones.
    #[getter]
    fn descriptors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        give_descriptors(py, &self.0.descriptors)
    }

    /// Keypoints with scales and directions.
    #[getter]
    fn keypoints(&self, py: Python<'_>) -> PyResult<Keypoints> {
        Keypoints::give(py, &self.0.keypoints)
    }

    fn __len__(&self) -> usize {
        self.0.keypoints.len()
    }
}
