//! Images as keypoints, and matches between them.

use super::wrapper::{
    colors, give_colors, give_index_rows, index_rows, object, require_equal, wrapper,
};
use crate::arrays::{from_points, from_vector, points2, vector};
use crate::camera::Camera;
use crate::images::column;
use epipole::feature::Match;
use epipole::nalgebra::Point3;
use epipole::sfm;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

/// Prior of a camera position, such as from GPS.
///
/// Parameters
/// ----------
/// center_in_world : array_like, shape (3,)
///     Center of the camera.
/// sigma : array_like, shape (3,)
///     Standard deviation along each world axis, in world units, > 0.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct PositionPrior(pub(super) sfm::PositionPrior);

wrapper!(PositionPrior: center_in_world, sigma);

#[pymethods]
impl PositionPrior {
    #[new]
    fn new(center_in_world: &Bound<'_, PyAny>, sigma: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(sfm::PositionPrior {
            center_in_world: Point3::from(vector("center_in_world", center_in_world)?),
            sigma: vector("sigma", sigma)?,
        }))
    }

    /// Center of the camera, shape (3,).
    #[getter]
    fn center_in_world<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.center_in_world.coords)
    }

    /// Standard deviations, shape (3,).
    #[getter]
    fn sigma<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.sigma)
    }
}

/// Image, reduced to its keypoints.
///
/// Parameters
/// ----------
/// name : str
///     Name, such as the file name.
/// keypoints : array_like, shape (N, 2)
///     Pixels.
/// colors : array_like of uint8, shape (N, 3), optional
///     Red, green, blue.
/// lens : int, optional
///     Lens number. Images with the same number have equal lenses and share their refined
///     parameters.
/// position : PositionPrior, optional
///     Position of the camera, if known.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(crate) struct SfmImage(pub(crate) sfm::SfmImage);

wrapper!(SfmImage: name, keypoints, colors, lens, position);

#[pymethods]
impl SfmImage {
    #[new]
    #[pyo3(signature = (name, keypoints, colors=None, lens=0, position=None))]
    fn new(
        name: String,
        keypoints: &Bound<'_, PyAny>,
        colors: Option<&Bound<'_, PyAny>>,
        lens: usize,
        position: Option<&PositionPrior>,
    ) -> PyResult<Self> {
        let keypoints = points2("keypoints", keypoints)?;
        let colors = self::colors("colors", colors)?;
        if !colors.is_empty() {
            require_equal(("keypoints", keypoints.len()), ("colors", colors.len()))?;
        }
        Ok(Self(sfm::SfmImage {
            name,
            keypoints,
            colors,
            lens,
            position: position.map(|position| position.0),
        }))
    }

    /// Name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Keypoints, pixels, shape (N, 2).
    #[getter]
    fn keypoints<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.0.keypoints)
    }

    /// Colors of the keypoints, uint8 of shape (N, 3), or None.
    #[getter]
    fn colors<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<u8>>>> {
        if self.0.colors.is_empty() {
            return Ok(None);
        }
        give_colors(py, self.0.colors.iter().copied()).map(Some)
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

/// Matches between the keypoints of two images.
///
/// Parameters
/// ----------
/// image1, image2 : int
///     Indices of the images.
/// matches : epipole.feature.Matches or array_like of int, shape (M, 2)
///     Indices of the matching keypoints.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(crate) struct PairMatches(pub(super) sfm::PairMatches);

wrapper!(PairMatches: image1, image2, matches);

#[pymethods]
impl PairMatches {
    #[new]
    fn new(image1: usize, image2: usize, matches: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(sfm::PairMatches {
            image1,
            image2,
            matches: self::matches("matches", matches)?,
        }))
    }

    /// Index of the first image.
    #[getter]
    fn image1(&self) -> usize {
        self.0.image1
    }

    /// Index of the second image.
    #[getter]
    fn image2(&self) -> usize {
        self.0.image2
    }

    /// Matching keypoints.
    ///
    /// Returns
    /// -------
    /// epipole.feature.Matches
    #[getter]
    fn matches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        give_matches(py, &self.0.matches)
    }

    fn __len__(&self) -> usize {
        self.0.matches.len()
    }
}

/// Reads `epipole.feature.Matches`, or indices of shape `(M, 2)`.
///
/// # Errors
/// `TypeError` or `ValueError` naming the argument.
pub(super) fn matches(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Match>> {
    if !value.hasattr("indices")? {
        let rows = index_rows::<2>(name, value)?;
        return Ok(rows.iter().map(|&[a, b]| Match::new(a, b)).collect());
    }
    let part = |field: &str| value.getattr(field);
    let rows = index_rows::<2>(&format!("{name}.indices"), &part("indices")?)?;
    let distances = column(&format!("{name}.distances"), &part("distances")?)?;
    let ratios = column(&format!("{name}.ratios"), &part("ratios")?)?;
    require_equal(("indices", rows.len()), ("distances", distances.len()))?;
    require_equal(("indices", rows.len()), ("ratios", ratios.len()))?;
    let numbers = distances.into_iter().zip(ratios);
    let numbered = rows.iter().zip(numbers);
    Ok(numbered
        .map(|(&[index1, index2], (distance, ratio))| Match {
            index1,
            index2,
            distance,
            ratio,
        })
        .collect())
}

/// Creates `epipole.feature.Matches` in Python.
pub(super) fn give_matches<'py>(py: Python<'py>, matches: &[Match]) -> PyResult<Bound<'py, PyAny>> {
    let indices = give_index_rows(py, matches.iter().map(|m| [m.index1, m.index2]))?;
    let distances = PyArray1::from_iter(py, matches.iter().map(|m| m.distance));
    let ratios = PyArray1::from_iter(py, matches.iter().map(|m| m.ratio));
    object(
        py,
        "epipole.feature",
        "Matches",
        (indices, distances, ratios),
    )
}

/// Images, their cameras, and matches between them.
///
/// Parameters
/// ----------
/// images : list of SfmImage
/// cameras : list of Camera
///     Camera of each image, or one for all.
/// pairs : list of PairMatches
///     Matches between images, including outliers.
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct SfmInput(pub(super) sfm::SfmInput);

wrapper!(SfmInput: images, cameras, pairs);

#[pymethods]
impl SfmInput {
    #[new]
    fn new(images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>) -> Self {
        Self(sfm::SfmInput {
            images: images.into_iter().map(|image| image.0).collect(),
            cameras: cameras.into_iter().map(|camera| camera.0).collect(),
            pairs: pairs.into_iter().map(|pair| pair.0).collect(),
        })
    }

    /// Images, a list of `SfmImage`.
    #[getter]
    fn images(&self) -> Vec<SfmImage> {
        self.0.images.iter().cloned().map(SfmImage).collect()
    }

    /// Camera of each image, or one for all.
    #[getter]
    fn cameras(&self) -> Vec<Camera> {
        self.0.cameras.iter().map(|&camera| camera.into()).collect()
    }

    /// Matches between images, a list of `PairMatches`.
    #[getter]
    fn pairs(&self) -> Vec<PairMatches> {
        self.0.pairs.iter().cloned().map(PairMatches).collect()
    }
}
