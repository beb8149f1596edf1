//! Detectors and descriptors.

use super::descriptors::{Features, give_descriptors};
use super::keypoints::keypoints;
use crate::images::{from_gray, gray, rgb, unit_gray};
use crate::options::{self, Options};
use crate::progress;
use epipole::feature;
use epipole::imaging::GrayImage32;
use epipole::progress::Monitor;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Converts a photo to gray in [0, 1], as input for the detectors.
///
/// Parameters
/// ----------
/// photo : array_like, shape (H, W, 3)
///     uint8, in the order red, green, blue. For images from `cv2.imread`, pass
///     ``photo[..., ::-1]``.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
#[pyfunction]
pub(super) fn photo_to_gray<'py>(photo: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let color = rgb("photo", photo)?;
    let gray = progress::detach(photo.py(), || feature::photo_to_gray(&color));
    from_gray(photo.py(), gray)
}

/// Detects features by a function of the library.
fn detect<O: Options>(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
    detector: fn(&GrayImage32, &O, &mut dyn Monitor) -> epipole::Result<feature::Features>,
) -> PyResult<Features> {
    let pixels = unit_gray("image", image)?;
    let features = progress::run_with(image.py(), progress, options, |options, monitor| {
        detector(&pixels, options, monitor)
    })?;
    Features::give(image.py(), &features)
}

/// Detects the features of an image, strongest first.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : FeatureOptions
///     ``kind``: ``"root_sift"`` (the default), ``"sift"``, ``"orb"`` or ``"harris"``;
///     ``max_features=8192``, 0 for no limit; ``upright=False``; and options of each kind.
///
/// Returns
/// -------
/// Features
///     Descriptors are float32, or uint8 (bits) for ORB.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], or an option is out of range.
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn detect_features(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Features> {
    detect(image, progress, options, feature::detect_features)
}

/// Detects the SIFT features of an image, strongest first.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SiftOptions
///     For example ``max_features`` (0 for no limit), ``contrast_threshold``, ``upsample``,
///     ``upright``, ``normalization="root"`` for RootSIFT.
///
/// Returns
/// -------
/// Features
///     Descriptors are float32 of shape (N, 128), integers from 0 to 255.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], or an option is out of range.
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn detect_sift(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Features> {
    detect(image, progress, options, feature::detect_sift)
}

/// Detects the ORB features of an image, strongest first.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : OrbOptions
///     For example ``max_features``, ``num_levels``, ``scale_factor``, ``fast_threshold`` (for gray
///     values in [0, 1]), ``upright``.
///
/// Returns
/// -------
/// Features
///     Descriptors are bits in uint8, shape (N, 32).
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], or an option is out of range.
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn detect_orb(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Features> {
    detect(image, progress, options, feature::detect_orb)
}

/// Computes SIFT descriptors at given positions, scales and directions.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// keypoints : Keypoints or array_like, shape (N, 2)
///     Points without scale and direction get a scale of 1 pixel and the direction 0.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SiftOptions
///     See `detect_sift`.
///
/// Returns
/// -------
/// ndarray of float32, shape (N, 128)
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], an option is out of range, or the scale of a
///     keypoint is not above 0.
#[pyfunction]
#[pyo3(signature = (image, keypoints, *, progress=None, **options))]
pub(super) fn describe_sift<'py>(
    image: &Bound<'py, PyAny>,
    keypoints: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (pixels, options) = (unit_gray("image", image)?, options::read(options)?);
    let keypoints = self::keypoints("keypoints", keypoints)?;
    let list = progress::run(image.py(), progress, |monitor| {
        feature::describe_sift(&pixels, &keypoints, &options, monitor)
    });
    give_descriptors(image.py(), &list?)
}

/// Computes the dominant gradient directions around given positions.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// keypoints : Keypoints or array_like, shape (N, 2)
///     Points without scale get a scale of 1 pixel.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SiftOptions
///     See `detect_sift`.
///
/// Returns
/// -------
/// list of ndarray of float32
///     Directions of each keypoint, radians, strongest first.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], an option is out of range, or the scale of a
///     keypoint is not above 0.
#[pyfunction]
#[pyo3(signature = (image, keypoints, *, progress=None, **options))]
pub(super) fn sift_directions<'py>(
    image: &Bound<'py, PyAny>,
    keypoints: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Vec<Bound<'py, PyArray1<f32>>>> {
    let (pixels, options) = (unit_gray("image", image)?, options::read(options)?);
    let keypoints = self::keypoints("keypoints", keypoints)?;
    let found = progress::run(image.py(), progress, |monitor| {
        feature::sift_directions(&pixels, &keypoints, &options, monitor)
    });
    let give = |directions| PyArray1::from_vec(image.py(), directions);
    Ok(found?.into_iter().map(give).collect())
}

/// Computes zero-mean, unit-length patches of gray values around keypoints.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// keypoints : Keypoints or array_like, shape (N, 2)
/// size : int
///     Samples along a side, 2 to 64.
/// spacing_px : float, optional
///     Distance between samples, pixels, > 0.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (N, size**2)
///     Inner products are normalized cross-correlations.
///
/// Raises
/// ------
/// ValueError
///     If ``size`` is outside 2 to 64, or ``spacing_px`` is not above 0.
#[pyfunction]
#[pyo3(signature = (image, keypoints, size, spacing_px=1.0, *, progress=None))]
pub(super) fn describe_patches<'py>(
    image: &Bound<'py, PyAny>,
    keypoints: &Bound<'py, PyAny>,
    size: usize,
    spacing_px: f64,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let pixels = gray("image", image)?;
    let keypoints = self::keypoints("keypoints", keypoints)?;
    let list = progress::run(image.py(), progress, |monitor| {
        feature::describe_patches(&pixels, &keypoints, size, spacing_px, monitor)
    });
    give_descriptors(image.py(), &list?)
}
