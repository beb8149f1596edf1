//! Reconstruction from photos.

use super::images::{PairMatches, PositionPrior, SfmImage, SfmInput, give_matches};
use super::incremental::SfmResult;
use super::photo_features::PhotoFeatures;
use super::wrapper::wrapper;
use crate::camera::Camera;
use crate::images::{from_rgb, rgb};
use crate::{options, progress};
use epipole::sfm;
use numpy::PyArray3;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Photo with a name.
///
/// Parameters
/// ----------
/// name : str
///     Name, such as the file name.
/// image : array_like of uint8, shape (H, W, 3)
///     Red, green, blue.
/// lens : int, optional
///     Lens number, as in `SfmImage`.
/// position : PositionPrior, optional
///     Position of the camera, if known.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct Photo(sfm::Photo);

wrapper!(Photo: name, image, lens, position);

#[pymethods]
impl Photo {
    #[new]
    #[pyo3(signature = (name, image, lens=0, position=None))]
    fn new(
        name: String,
        image: &Bound<'_, PyAny>,
        lens: usize,
        position: Option<&PositionPrior>,
    ) -> PyResult<Self> {
        Ok(Self(sfm::Photo {
            name,
            image: rgb("image", image)?,
            lens,
            position: position.map(|position| position.0),
        }))
    }

    /// Name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Pixels, uint8 of shape (H, W, 3).
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.0.image.clone())
    }

    /// Lens number.
    #[getter]
    fn lens(&self) -> usize {
        self.0.lens
    }

    /// Position of the camera, or None.
    #[getter]
    fn position(&self) -> Option<PositionPrior> {
        self.0.position.map(PositionPrior)
    }
}

/// Detects keypoints and descriptors of a photo.
///
/// Parameters
/// ----------
/// photo : Photo
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : PhotoOptions
///     ``features``, a dict of the options of `epipole.feature.detect_features`.
///
/// Returns
/// -------
/// PhotoFeatures
///
/// Raises
/// ------
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (photo, *, progress=None, **options))]
pub(super) fn photo_features(
    py: Python<'_>,
    photo: &Photo,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<PhotoFeatures> {
    let photo = &photo.0;
    let features = progress::run_with(py, progress, options, |options, monitor| {
        sfm::photo_features(photo, options, monitor)
    })?;
    Ok(PhotoFeatures(features))
}

/// Matches pairs of photos: of some dozens all, of more similar ones or those close in order.
///
/// Parameters
/// ----------
/// features : list of PhotoFeatures
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : PhotoOptions
///     ``matching``, a dict such as ``{"max_ratio": 0.8}``; ``neighbors``, the number of following
///     photos to match with each photo; ``similar``, the number of photos that look most like it,
///     by default 40 if ``neighbors`` is 0, else 0 (all pairs if both are 0); ``best_first``.
///
/// Returns
/// -------
/// list of PairMatches
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If some lists of descriptors are float and others binary.
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (features, /, *, progress=None, **options))]
pub(super) fn match_features(
    py: Python<'_>,
    features: Vec<PhotoFeatures>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<PairMatches>> {
    let features: Vec<_> = features.into_iter().map(|features| features.0).collect();
    let pairs = progress::run_with(py, progress, options, |options, monitor| {
        sfm::match_features(&features, options, monitor)
    })?;
    Ok(pairs.into_iter().map(PairMatches).collect())
}

/// Matches the two images of a rectified stereo pair.
///
/// Parameters
/// ----------
/// left, right : PhotoFeatures
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : PhotoOptions
///     See `match_features`.
///
/// Returns
/// -------
/// epipole.feature.Matches
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If one list of descriptors is float and the other binary.
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (left, right, *, progress=None, **options))]
pub(super) fn match_rectified<'py>(
    py: Python<'py>,
    left: &PhotoFeatures,
    right: &PhotoFeatures,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (left, right) = (&left.0, &right.0);
    let matches = progress::run_with(py, progress, options, |options, monitor| {
        sfm::match_rectified(left, right, options, monitor)
    })?;
    give_matches(py, &matches)
}

/// Detects keypoints in all photos and matches them between all pairs.
///
/// Parameters
/// ----------
/// photos : list of Photo
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : PhotoOptions
///     See `photo_features` and `match_features`.
///
/// Returns
/// -------
/// images : list of SfmImage
/// pairs : list of PairMatches
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 photos.
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (photos, *, progress=None, **options))]
pub(super) fn match_photos(
    py: Python<'_>,
    photos: Vec<Photo>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Vec<SfmImage>, Vec<PairMatches>)> {
    let photos: Vec<_> = photos.into_iter().map(|photo| photo.0).collect();
    let (images, pairs) = progress::run_with(py, progress, options, |options, monitor| {
        sfm::match_photos(&photos, options, monitor)
    })?;
    let images = images.into_iter().map(SfmImage).collect();
    Ok((images, pairs.into_iter().map(PairMatches).collect()))
}

/// Reconstructs cameras and points from photos: features, matches, and `reconstruct`.
///
/// Parameters
/// ----------
/// photos : list of Photo
/// cameras : list of Camera
///     Camera of each photo, or one for all.
/// photo_options : dict, optional
///     Options of `match_photos`.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SfmOptions
///     See `reconstruct`.
///
/// Returns
/// -------
/// input : SfmInput
///     Keypoints and matches.
/// result : SfmResult
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 photos.
/// epipole.DegenerateError
///     If photos with the same lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (photos, cameras, *, photo_options=None, progress=None, **options))]
pub(super) fn reconstruct_photos(
    py: Python<'_>,
    photos: Vec<Photo>,
    cameras: Vec<Camera>,
    photo_options: Option<&Bound<'_, PyDict>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(SfmInput, SfmResult)> {
    let photo_options = options::read(photo_options)?;
    let photos: Vec<_> = photos.into_iter().map(|photo| photo.0).collect();
    let cameras: Vec<_> = cameras.into_iter().map(|camera| camera.0).collect();
    let (input, result) = progress::run_with(py, progress, options, |options, monitor| {
        sfm::reconstruct_photos(&photos, &cameras, &photo_options, options, monitor)
    })?;
    Ok((SfmInput(input), SfmResult(result)))
}
