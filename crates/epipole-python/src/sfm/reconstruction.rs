//! Reconstructions, and localization of further photos.

use super::bundle::Bundle;
use super::images::SfmImage;
use super::photo_features::PhotoFeatures;
use super::similarity::Similarity3;
use super::tracks::{give_tracks, tracks};
use super::wrapper::{colors, give_colors, give_index_rows, give_indices, require_equal, wrapper};
use crate::arrays::{from_rows, from_vector, points3, vector};
use crate::camera::{Camera, PosedCamera, RigidTransform};
use crate::images::column;
use crate::progress;
use crate::record::record;
use epipole::nalgebra::Point3;
use epipole::sfm;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Cameras and points in one frame.
///
/// Scale and pose of the frame are arbitrary unless image positions are known: see `is_placed`.
///
/// Parameters
/// ----------
/// cameras : list of PosedCamera or None
///     Camera of each image; None if it could not be registered.
/// points : array_like, shape (P, 3)
///     Points in the world.
/// tracks : array_like of int, shape (K, 3)
///     Observations: indices of the point, of the image, and of the image's keypoint.
/// colors : array_like of uint8, shape (P, 3), optional
///     Red, green, blue. Gray by default.
/// errors_px : array_like, shape (P,), optional
///     Root mean square of the reprojection errors of each point, pixels. 0 by default.
/// is_placed : bool, optional
///     Whether the frame agrees with the known image positions, in their unit of length.
///
/// Raises
/// ------
/// ValueError
///     If a track refers to a missing point.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(crate) struct Reconstruction(pub(crate) sfm::Reconstruction);

wrapper!(Reconstruction: cameras, points, tracks, colors, errors_px, is_placed);

#[pymethods]
impl Reconstruction {
    #[new]
    #[pyo3(signature = (cameras, points, tracks, colors=None, errors_px=None, is_placed=false))]
    fn new(
        cameras: Vec<Option<PosedCamera>>,
        points: &Bound<'_, PyAny>,
        tracks: &Bound<'_, PyAny>,
        colors: Option<&Bound<'_, PyAny>>,
        errors_px: Option<&Bound<'_, PyAny>>,
        is_placed: bool,
    ) -> PyResult<Self> {
        let positions = points3("points", points)?;
        let count = positions.len();
        let tracks = self::tracks("tracks", tracks, count)?;
        let colors = match colors {
            Some(_) => self::colors("colors", colors)?,
            None => vec![[128; 3]; count],
        };
        let errors = match errors_px {
            Some(errors) => numbers("errors_px", errors)?,
            None => vec![0.0; count],
        };
        require_equal(("points", count), ("colors", colors.len()))?;
        require_equal(("points", count), ("errors_px", errors.len()))?;
        let parts = positions.into_iter().zip(colors).zip(errors).zip(tracks);
        let points = parts.map(|(((position, color), error_px), track)| sfm::ScenePoint {
            position,
            color,
            track,
            error_px,
        });
        Ok(Self(sfm::Reconstruction {
            cameras: cameras.into_iter().map(|camera| Some(camera?.0)).collect(),
            is_placed,
            points: points.collect(),
        }))
    }

    /// Camera of each image, a list of `PosedCamera`; None if it could not be registered.
    #[getter]
    fn cameras(&self) -> Vec<Option<PosedCamera>> {
        let cameras = self.0.cameras.iter();
        cameras.map(|&camera| Some(camera?.into())).collect()
    }

    /// Points in the world, shape (P, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_rows(py, self.0.points.iter().map(|point| point.position.coords))
    }

    /// Observations, int64 of shape (K, 3): indices of the point, the image and its keypoint.
    #[getter]
    fn tracks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        give_tracks(py, self.0.points.iter().map(|point| &*point.track))
    }

    /// Mean color of the keypoints of each point, uint8 of shape (P, 3).
    #[getter]
    fn colors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        give_colors(py, self.0.points.iter().map(|point| point.color))
    }

    /// Root mean square of the reprojection errors of each point, pixels, shape (P,).
    #[getter]
    fn errors_px<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.0.points.iter().map(|point| point.error_px))
    }

    /// Whether the frame agrees with the known image positions, in their unit of length.
    #[getter]
    fn is_placed(&self) -> bool {
        self.0.is_placed
    }

    /// Returns the number of images with a camera.
    fn num_registered(&self) -> usize {
        self.0.num_registered()
    }

    /// Returns the number of observations of all points.
    fn num_observations(&self) -> usize {
        self.0.num_observations()
    }

    /// Returns the reconstruction in another world, transformed by ``to_from_world``.
    ///
    /// Parameters
    /// ----------
    /// to_from_world : Similarity3
    fn moved(&self, to_from_world: &Similarity3) -> Self {
        Self(self.0.moved(&to_from_world.0))
    }

    /// Projects a point into an image.
    ///
    /// Parameters
    /// ----------
    /// image : int
    ///     Index of the image.
    /// point : array_like, shape (3,)
    ///
    /// Returns
    /// -------
    /// ndarray or None, shape (2,)
    ///     None if the camera does not see the point.
    fn project<'py>(
        &self,
        image: usize,
        point: &Bound<'py, PyAny>,
    ) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        let place = Point3::from(vector("point", point)?);
        let pixel = self.0.project(image, &place);
        Ok(pixel.map(|pixel| from_vector(point.py(), &pixel.coords)))
    }

    /// Computes the mean length of all reprojection errors, pixels.
    ///
    /// Parameters
    /// ----------
    /// images : list of SfmImage
    ///     Images of the input.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If a track refers to a keypoint that is missing in ``images``.
    fn mean_reprojection_px(&self, images: Vec<SfmImage>) -> PyResult<f64> {
        let images = self.images(images)?;
        Ok(self.0.mean_reprojection_px(&images))
    }

    /// Converts the reconstruction for bundle adjustment.
    ///
    /// Parameters
    /// ----------
    /// images : list of SfmImage
    ///
    /// Returns
    /// -------
    /// bundle : Bundle
    /// image_of_camera : ndarray of int64
    ///     Index of the image of each camera.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If a track refers to a keypoint that is missing in ``images``.
    fn to_bundle<'py>(
        &self,
        py: Python<'py>,
        images: Vec<SfmImage>,
    ) -> PyResult<(Bundle, Bound<'py, PyArray1<i64>>)> {
        let (bundle, images) = self.0.to_bundle(&self.images(images)?);
        Ok((Bundle(bundle), give_indices(py, &images)))
    }

    /// Estimates the pose of another photo.
    ///
    /// Parameters
    /// ----------
    /// features : list of PhotoFeatures
    ///     Features of the images of the reconstruction.
    /// photo : PhotoFeatures
    /// camera : Camera
    ///     Camera of the photo.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : LocalizeOptions
    ///     ``matching`` and ``ransac``, dicts; ``min_num_inliers``.
    ///
    /// Returns
    /// -------
    /// Localization
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If fewer than ``min_num_inliers`` points match or agree with a pose.
    /// epipole.DegenerateError
    ///     If some lists of descriptors are float and others binary.
    /// epipole.NoConsensusError
    ///     If no pose has 3 inliers.
    /// ValueError
    ///     If a track refers to a missing keypoint, or an option is out of range.
    #[pyo3(signature = (features, photo, camera, *, progress=None, **options))]
    fn localize(
        &self,
        py: Python<'_>,
        features: Vec<PhotoFeatures>,
        photo: &PhotoFeatures,
        camera: &Camera,
        progress: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Localization> {
        let features: Vec<_> = features.into_iter().map(|features| features.0).collect();
        let (photo, camera) = (&photo.0, &camera.0);
        let found = progress::run_with(py, progress, options, |options, monitor| {
            self.0.localize(&features, photo, camera, options, monitor)
        })?;
        let inliers = found
            .inliers
            .iter()
            .map(|&(point, keypoint)| [point, keypoint]);
        Ok(Localization {
            cam_from_world: found.cam_from_world.into(),
            inliers: give_index_rows(py, inliers)?.unbind(),
            num_matches: found.num_matches,
        })
    }
}

impl Reconstruction {
    /// Returns images of the library, if they have all keypoints of the tracks.
    fn images(&self, images: Vec<SfmImage>) -> PyResult<Vec<sfm::SfmImage>> {
        require_equal(("images", images.len()), ("cameras", self.0.cameras.len()))?;
        let mut elements = self.0.points.iter().flat_map(|point| &point.track);
        let is_missing = |element: &&sfm::TrackElement| {
            let image = images.get(element.image as usize);
            image.is_none_or(|image| element.keypoint as usize >= image.0.keypoints.len())
        };
        if let Some(element) = elements.find(is_missing) {
            let (image, keypoint) = (element.image, element.keypoint);
            let message = format!("images has no keypoint {keypoint} of image {image}");
            return Err(PyIndexError::new_err(message));
        }
        Ok(images.into_iter().map(|image| image.0).collect())
    }
}

fn numbers(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    // Checks shape and values; float32 would round them.
    column(name, value)?;
    let array = crate::arrays::as_array(name, value, "(N,)")?;
    crate::images::elements(&array, "float64")
}

record! {
    /// Photo localized in a reconstruction.
    "epipole.sfm" Localization {
        /// Pose of the camera.
        cam_from_world: RigidTransform,
        /// Points that agree with the pose: indices of the point and of the photo's keypoint, int64
        /// of shape (M, 2).
        inliers: Py<PyArray2<i64>>,
        /// Number of matches between keypoints of the photo and points.
        num_matches: usize,
    }
}
