//! Reconstruction from photos.

use super::images::{PairMatches, PositionPrior, SfmImage, SfmInput, give_matches};
use super::incremental::SfmResult;
use super::wrapper::{object, require_equal, wrapper};
use crate::arrays::{as_array, from_rows, points2};
use crate::camera::Camera;
use crate::errors::OrRaise;
use crate::images::{column, dtype, elements, from_rgb, rgb, table, wrong_shape};
use crate::{options, progress};
use epipole::feature::{Descriptors, Keypoint};
use epipole::sfm;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Number of bytes in a descriptor of bits.
const BYTES: usize = 32;

/// Photo with a name.
///
/// Parameters
/// ----------
/// name : str
///     Name, such as the file name.
/// image : array_like of uint8, shape (H, W, 3)
///     Red, green, blue.
/// lens : int, optional
///     Number of its lens, as in `SfmImage`.
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

    /// Number of its lens.
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

/// Features of a photo; its pixels are no longer needed.
///
/// Parameters
/// ----------
/// image : SfmImage
///     Size, keypoints and their colors.
/// descriptors : array_like, shape (N, D) or uint8 of shape (N, 32)
///     Numbers, or 256 bits.
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
            descriptors: self::descriptors("descriptors", descriptors)?,
            keypoints: self::keypoints("keypoints", keypoints)?,
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

    /// Descriptors, float32 of shape (N, D), or uint8 of shape (N, 32) for bits.
    #[getter]
    fn descriptors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let list = &self.0.descriptors;
        if let Some(bits) = list.as_bits() {
            let words = bits.iter().flatten();
            let bytes: Vec<u8> = words.flat_map(|word| word.to_le_bytes()).collect();
            return Ok(PyArray1::from_vec(py, bytes)
                .reshape([list.len(), BYTES])?
                .into_any());
        }
        let shape = [list.len(), list.dimension()];
        Ok(PyArray1::from_vec(py, list.to_floats())
            .reshape(shape)?
            .into_any())
    }

    /// Keypoints with scales and directions.
    ///
    /// Returns
    /// -------
    /// epipole.feature.Keypoints
    #[getter]
    fn keypoints<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let list = &self.0.keypoints;
        let points: Vec<_> = list
            .iter()
            .map(|keypoint| keypoint.point().coords)
            .collect();
        let scales = PyArray1::from_iter(py, list.iter().map(|keypoint| keypoint.scale_px));
        let angles = PyArray1::from_iter(py, list.iter().map(|keypoint| keypoint.angle_rad));
        let responses = PyArray1::from_iter(py, list.iter().map(|keypoint| keypoint.response));
        let octaves = PyArray1::from_iter(py, list.iter().map(|keypoint| keypoint.octave));
        let columns = (from_rows(py, &points)?, scales, angles, responses, octaves);
        object(py, "epipole.feature", "Keypoints", columns)
    }

    fn __len__(&self) -> usize {
        self.0.keypoints.len()
    }
}

/// Reads `epipole.feature.Keypoints`.
fn keypoints(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Keypoint>> {
    let part = |field: &str| value.getattr(field);
    let floats = |field: &str| column(&format!("{name}.{field}"), &part(field)?);
    let points = points2(name, &part("points")?)?;
    let (scales, angles) = (floats("scales_px")?, floats("angles_rad")?);
    let responses = floats("responses")?;
    let octaves: Vec<i32> = part("octaves")?.call_method0("tolist")?.extract()?;
    let columns = scales.iter().zip(&angles).zip(&responses).zip(&octaves);
    let rows = points.iter().zip(columns);
    Ok(rows
        .map(
            |(point, (((&scale_px, &angle_rad), &response), &octave))| Keypoint {
                u: point.x,
                v: point.y,
                scale_px,
                angle_rad,
                response,
                octave,
            },
        )
        .collect())
}

/// Reads numbers of shape (N, D), or bits in uint8 of shape (N, 32).
fn descriptors(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Descriptors> {
    let array = as_array(name, value, "(N, D)")?;
    if dtype(&array)? != "uint8" {
        let (values, dimension) = table(name, &array)?;
        let is_byte = |value: &f32| value.fract() == 0.0 && (0.0..=255.0).contains(value);
        if values.iter().all(is_byte) {
            let bytes = values.iter().map(|&value| value as u8).collect();
            return Descriptors::from_bytes(dimension, bytes).or_raise();
        }
        return Descriptors::from_floats(dimension, values).or_raise();
    }
    let [_, BYTES] = *array.shape() else {
        return Err(wrong_shape(name, "(N, 32) for bits", &array)?);
    };
    let bytes: Vec<u8> = elements(&array, "uint8")?;
    let word = |bytes: &[u8]| (bytes.iter().rev()).fold(0, |word, &b| word << 8 | u64::from(b));
    let words = |row: &[u8]| [0, 8, 16, 24].map(|start| word(&row[start..start + 8]));
    Ok(Descriptors::from_bits(
        bytes.chunks_exact(BYTES).map(words).collect(),
    ))
}

/// Keypoints and descriptors of a photo.
///
/// Parameters
/// ----------
/// photo : Photo
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : PhotoOptions
///     ``features``, a dict of the options of `epipole.feature.detect_features`.
///
/// Returns
/// -------
/// PhotoFeatures
#[pyfunction]
#[pyo3(signature = (photo, *, progress=None, **options))]
pub(super) fn photo_features(
    py: Python<'_>,
    photo: &Photo,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<PhotoFeatures> {
    let options = options::read(options)?;
    let photo = &photo.0;
    let features = progress::run(py, progress, |monitor| {
        sfm::photo_features(photo, &options, monitor)
    })?;
    Ok(PhotoFeatures(features))
}

/// Matches between all pairs of photos, or between those that are near in order.
///
/// Parameters
/// ----------
/// features : list of PhotoFeatures
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : PhotoOptions
///     ``matching``, a dict such as ``{"max_ratio": 0.8}``; ``neighbors``, the number of following
///     photos to match each with, 0 for all; ``best_first``.
///
/// Returns
/// -------
/// list of PairMatches
#[pyfunction]
#[pyo3(signature = (features, /, *, progress=None, **options))]
pub(super) fn match_features(
    py: Python<'_>,
    features: Vec<PhotoFeatures>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<PairMatches>> {
    let options = options::read(options)?;
    let features: Vec<_> = features.into_iter().map(|features| features.0).collect();
    let pairs = progress::run(py, progress, |monitor| {
        sfm::match_features(&features, &options, monitor)
    })?;
    Ok(pairs.into_iter().map(PairMatches).collect())
}

/// Matches between the two images of a rectified stereo pair.
///
/// Parameters
/// ----------
/// left, right : PhotoFeatures
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : PhotoOptions
///     Those of `match_features`.
///
/// Returns
/// -------
/// epipole.feature.Matches
#[pyfunction]
#[pyo3(signature = (left, right, *, progress=None, **options))]
pub(super) fn match_rectified<'py>(
    py: Python<'py>,
    left: &PhotoFeatures,
    right: &PhotoFeatures,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let options = options::read(options)?;
    let (left, right) = (&left.0, &right.0);
    let matches = progress::run(py, progress, |monitor| {
        sfm::match_rectified(left, right, &options, monitor)
    })?;
    give_matches(py, &matches)
}

/// Keypoints of all photos and matches between all pairs of them.
///
/// Parameters
/// ----------
/// photos : list of Photo
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : PhotoOptions
///     Those of `photo_features` and `match_features`.
///
/// Returns
/// -------
/// images : list of SfmImage
/// pairs : list of PairMatches
#[pyfunction]
#[pyo3(signature = (photos, *, progress=None, **options))]
pub(super) fn match_photos(
    py: Python<'_>,
    photos: Vec<Photo>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Vec<SfmImage>, Vec<PairMatches>)> {
    let options = options::read(options)?;
    let photos: Vec<_> = photos.into_iter().map(|photo| photo.0).collect();
    let (images, pairs) = progress::run(py, progress, |monitor| {
        sfm::match_photos(&photos, &options, monitor)
    })?;
    let images = images.into_iter().map(SfmImage).collect();
    Ok((images, pairs.into_iter().map(PairMatches).collect()))
}

/// Cameras and points from photos: features, matches, and `reconstruct`.
///
/// Parameters
/// ----------
/// photos : list of Photo
/// cameras : list of Camera
///     Camera of each photo, or one for all.
/// photo_options : dict, optional
///     Options of `match_photos`.
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : SfmOptions
///     Those of `reconstruct`.
///
/// Returns
/// -------
/// input : SfmInput
///     Keypoints and matches.
/// result : SfmResult
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
    let options = options::read(options)?;
    let photos: Vec<_> = photos.into_iter().map(|photo| photo.0).collect();
    let cameras: Vec<_> = cameras.into_iter().map(|camera| camera.0).collect();
    let (input, result) = progress::run(py, progress, |monitor| {
        sfm::reconstruct_photos(&photos, &cameras, &photo_options, &options, monitor)
    })?;
    Ok((SfmInput(input), SfmResult(result)))
}
