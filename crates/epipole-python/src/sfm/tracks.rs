//! Tracks, and matches verified by epipolar geometry.

use super::images::{PairMatches, SfmImage};
use super::wrapper::{give_index_rows, index_rows};
use crate::camera::{Camera, RigidTransform};
use crate::errors::OrRaise;
use crate::progress;
use crate::record::record;
use epipole::sfm::{self, TrackElement};
use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Reads rows of point, image and keypoint into the track of each point, sorted by image.
///
/// # Errors
/// `ValueError` for the index of a missing point.
pub(crate) fn tracks(
    name: &str,
    value: &Bound<'_, PyAny>,
    num_points: usize,
) -> PyResult<Vec<Vec<TrackElement>>> {
    let mut tracks = vec![Vec::new(); num_points];
    for [point, image, keypoint] in index_rows::<3>(name, value)? {
        let Some(track) = tracks.get_mut(point) else {
            return Err(PyValueError::new_err(format!(
                "{name} has point {point}, but there are {num_points}"
            )));
        };
        track.push(TrackElement {
            image: u32::try_from(image)?,
            keypoint: u32::try_from(keypoint)?,
        });
    }
    for track in &mut tracks {
        track.sort_unstable();
    }
    Ok(tracks)
}

/// Returns rows of point, image and keypoint, int64 of shape (K, 3).
pub(crate) fn give_tracks<'py, 'a>(
    py: Python<'py>,
    tracks: impl Iterator<Item = &'a [TrackElement]>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let rows = tracks.enumerate().flat_map(|(point, track)| {
        let elements = track.iter();
        elements.map(move |element| [point, element.image as usize, element.keypoint as usize])
    });
    give_index_rows(py, rows)
}

/// Joins matches into tracks.
///
/// Parameters
/// ----------
/// num_keypoints : list of int
///     Number of keypoints of each image.
/// pairs : list of PairMatches
///     Geometrically verified matches. Pairs with many matches take precedence.
///
/// Returns
/// -------
/// ndarray of int64, shape (K, 3)
///     Indices of the track, the image and its keypoint, sorted. A track has at most one keypoint
///     per image.
///
/// Raises
/// ------
/// ValueError
///     If a match refers to a missing image or keypoint, or joins an image with itself.
#[pyfunction]
pub(super) fn build_tracks(
    py: Python<'_>,
    num_keypoints: Vec<usize>,
    pairs: Vec<PairMatches>,
) -> PyResult<Bound<'_, PyArray2<i64>>> {
    let pairs: Vec<_> = pairs.into_iter().map(|pair| pair.0).collect();
    let tracks = sfm::build_tracks(&num_keypoints, &pairs).or_raise()?;
    give_tracks(py, tracks.iter().map(|track| &**track))
}

record! {
    /// Geometrically verified pair of images.
    "epipole.sfm" VerifiedPair {
        /// Verified matches.
        pair: PairMatches,
        /// Motion of the camera, with ``|t| == 1``.
        cam2_from_cam1: RigidTransform,
        /// Median triangulation angle of the matches, radians: small for pure rotations and distant
        /// scenes; 0 if a plane and a pure rotation explain the matches.
        median_angle_rad: f64,
        /// Whether a homography explains most matches: a flat scene or a pure rotation.
        is_flat: bool,
    }
}

/// Selects the matches of two images that agree with one motion of the camera.
///
/// Parameters
/// ----------
/// pair : PairMatches
/// images : tuple of SfmImage
///     The two images.
/// cameras : tuple of Camera
///     Cameras of the two images.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SfmOptions
///     See `reconstruct`; used are ``ransac``, a dict, ``min_num_inliers``, ``seed``.
///
/// Returns
/// -------
/// VerifiedPair or None
///     None if too few matches agree.
///
/// Raises
/// ------
/// ValueError
///     If a match refers to a missing keypoint.
#[pyfunction]
#[pyo3(signature = (pair, images, cameras, *, progress=None, **options))]
pub(super) fn verify_matches(
    py: Python<'_>,
    pair: &PairMatches,
    images: [SfmImage; 2],
    cameras: [Camera; 2],
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<VerifiedPair>> {
    let pair = &pair.0;
    let verified = progress::run_with(py, progress, options, |options, monitor| {
        let images = [&images[0].0, &images[1].0];
        let cameras = [&cameras[0].0, &cameras[1].0];
        sfm::verify_matches(pair, images, cameras, options, monitor)
    })?;
    Ok(verified.map(|verified| VerifiedPair {
        pair: PairMatches(verified.pair),
        cam2_from_cam1: verified.cam2_from_cam1.into(),
        median_angle_rad: verified.median_angle_rad,
        is_flat: verified.is_flat,
    }))
}
