//! Two views whose configuration is unknown: F, E, H or a rotation.

use crate::arrays::{from_matrix, mask, pixel_pairs};
use crate::camera::{Camera, RigidTransform};
use crate::errors::OrRaise;
use crate::options;
use crate::progress;
use crate::record::record;
use crate::register::{classes, functions};
use crate::robust::{RansacReport, estimator, give_matrix, stop_reason};
use epipole::nalgebra::{Matrix3, Point2};
use epipole::two_view::{self, Configuration, TwoViewModel, TwoViewOptions};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Geometry of two views.
    "epipole.two_view" TwoViewReport {
        /// "general", "planar", "panoramic" or "degenerate".
        configuration: String,
        /// Kind of the model: "fundamental", "essential" or "homography".
        kind: String,
        /// Chosen matrix, shape (3, 3).
        model: Py<PyArray2<f64>>,
        /// Whether `model` and `homography` apply to rays, not pixels: lenses with distortion.
        is_of_rays: bool,
        /// F, shape (3, 3), or None.
        fundamental: Option<Py<PyArray2<f64>>>,
        /// H, shape (3, 3), or None.
        homography: Option<Py<PyArray2<f64>>>,
        /// Motion of calibrated views, or None. Its translation has length 1, or 0 for a rotation.
        cam2_from_cam1: Option<RigidTransform>,
        /// Second motion that explains a plane equally well, or None.
        other_cam2_from_cam1: Option<RigidTransform>,
        /// Whether each match is an inlier, boolean array of shape (N,).
        inliers: Py<PyArray1<bool>>,
        /// Number of inliers.
        num_inliers: usize,
        /// Number of matches ignored because a coordinate is infinite or beyond 1e9 pixels.
        num_left_out: usize,
        /// Threshold of F and E, pixels.
        max_error_px: f64,
        /// Number of samples drawn for all models tried.
        iterations: usize,
        /// Number of samples required for the model.
        required_iterations: u64,
        /// Reason the search ended: "confident", "exhausted" or "interrupted".
        stop: String,
        /// Median triangulation angle of the inliers, radians, or None.
        median_triangulation_angle_rad: Option<f64>,
    }
}

fn report(py: Python<'_>, found: two_view::TwoViewReport) -> PyResult<TwoViewReport> {
    let (kind, model) = match found.model {
        TwoViewModel::Fundamental(f) => ("fundamental", f),
        TwoViewModel::Essential(e) => ("essential", e),
        TwoViewModel::Homography(h) => ("homography", h),
    };
    let configuration = match found.configuration {
        Configuration::General => "general",
        Configuration::Planar => "planar",
        Configuration::Panoramic => "panoramic",
        Configuration::Degenerate => "degenerate",
    };
    let array = |m: &Matrix3<f64>| Ok::<_, PyErr>(from_matrix(py, m)?.unbind());
    Ok(TwoViewReport {
        configuration: configuration.to_owned(),
        kind: kind.to_owned(),
        model: array(&model)?,
        is_of_rays: found.is_of_rays,
        fundamental: found.fundamental.as_ref().map(array).transpose()?,
        homography: found.homography.as_ref().map(array).transpose()?,
        cam2_from_cam1: found.cam2_from_cam1.map(RigidTransform::from),
        other_cam2_from_cam1: found.other_cam2_from_cam1.map(RigidTransform::from),
        inliers: found.inliers.to_pyarray(py).unbind(),
        num_inliers: found.num_inliers,
        num_left_out: found.num_left_out,
        max_error_px: found.max_error_px,
        iterations: found.iterations,
        required_iterations: found.required_iterations,
        stop: stop_reason(found.stop),
        median_triangulation_angle_rad: found.median_triangulation_angle_rad,
    })
}

record! {
    /// Rotation that explains nearly all inliers.
    "epipole.two_view" ExplainingRotation {
        /// Rotation, with a translation of 0.
        cam2_from_cam1: RigidTransform,
        /// Number of inliers that it explains.
        num_explained: usize,
        /// Number of inliers.
        num_inliers: usize,
    }
}

record! {
    /// Rotation and focal length change that explain nearly all inliers.
    "epipole.two_view" RotationAndFocal {
        /// Rotation, with a translation of 0.
        cam2_from_cam1: RigidTransform,
        /// Ratio of the actual to the given focal lengths, for both cameras.
        focal_factor: f64,
        /// Number of unique matches that it explains.
        num_explained: usize,
        /// Number of unique matches.
        num_inliers: usize,
    }
}

record! {
    /// Reason the inliers do not determine F.
    "epipole.two_view" Degeneracy {
        /// "unmoved" or "homography".
        kind: String,
        /// Number of inliers that did not move or that a homography explains.
        num_explained: usize,
        /// Number of inliers.
        num_inliers: usize,
    }
}

fn degeneracy(found: two_view::Degeneracy) -> Degeneracy {
    let (kind, num_explained, num_inliers) = match found {
        two_view::Degeneracy::Unmoved {
            num_unmoved,
            num_inliers,
        } => ("unmoved", num_unmoved, num_inliers),
        two_view::Degeneracy::Homography {
            num_explained,
            num_inliers,
        } => ("homography", num_explained, num_inliers),
    };
    Degeneracy {
        kind: kind.to_owned(),
        num_explained,
        num_inliers,
    }
}

/// Estimates the geometry of two uncalibrated views: F or H.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : TwoViewOptions
///     ``min_num_inliers=15``, ``max_homography_ratio=0.8``, ``min_essential_ratio=0.95``, and
///     ``ransac``, a dict of RANSAC options.
///
/// Returns
/// -------
/// TwoViewReport
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 4 different matches.
/// epipole.DegenerateError
///     If all pixels of an image are on a line.
/// epipole.NoConsensusError
///     If every model has fewer inliers than its sample has matches.
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, *, progress=None, **options))]
fn estimate_two_view(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<TwoViewReport> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let found = progress::run_with(pixels1.py(), progress, options, |options, monitor| {
        two_view::estimate_two_view(&first, &second, options, monitor)
    });
    report(pixels1.py(), found?)
}

/// Estimates the geometry of two calibrated views: E, H or a rotation, and the motion.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches.
/// camera1, camera2 : Camera
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : TwoViewOptions
///
/// Returns
/// -------
/// TwoViewReport
///
/// Raises
/// ------
/// epipole.TooFewError
///     If fewer than 4 different matches are given that no rotation explains, or fewer than 5
///     through a lens with distortion.
/// epipole.DegenerateError
///     If all pixels of an image of a pinhole camera are on a line, unless a rotation explains
///     them.
/// epipole.NoConsensusError
///     If every model has fewer inliers than its sample has matches.
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, camera1, camera2, *, progress=None, **options))]
fn estimate_two_view_calibrated(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<TwoViewReport> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let cameras = [&camera1.0, &camera2.0];
    let found = progress::run_with(pixels1.py(), progress, options, |options, monitor| {
        two_view::estimate_two_view_calibrated(&first, &second, cameras, options, monitor)
    });
    report(pixels1.py(), found?)
}

estimator! {
    /// Estimates the rotation between two calibrated views from the same position, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// camera1, camera2 : Camera
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of ndarray
    ///     Its model is the rotation matrix of ``cam2_from_cam1``, shape (3, 3).
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 different matches.
    /// epipole.NoConsensusError
    ///     If no rotation has 2 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_rotation(pixels1, pixels2, camera1, camera2) -> PyResult<RansacReport> {
        two_view::estimate_rotation, give_matrix
    }
}

/// Looks for a configuration that explains the inliers.
fn find<T: Send>(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    inliers: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
    look: impl FnOnce(
        &[Point2<f64>],
        &[Point2<f64>],
        &[bool],
        &TwoViewOptions,
    ) -> epipole::Result<Option<T>>
    + Send,
) -> PyResult<Option<T>> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let mask = mask("inliers", inliers)?;
    let options = options::read(options)?;
    progress::detach(inliers.py(), || look(&first, &second, &mask, &options)).or_raise()
}

/// Checks whether the inliers determine F: not if nothing moved or a homography explains them.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
/// inliers : array_like of bool, shape (N,)
/// **options : TwoViewOptions
///
/// Returns
/// -------
/// Degeneracy or None
///
/// Raises
/// ------
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, inliers, **options))]
fn find_degeneracy(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    inliers: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Degeneracy>> {
    let look = two_view::find_degeneracy;
    Ok(find(pixels1, pixels2, inliers, options, look)?.map(degeneracy))
}

/// Checks whether nearly all inliers are at the same pixel in both images.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
/// inliers : array_like of bool, shape (N,)
/// **options : TwoViewOptions
///
/// Returns
/// -------
/// Degeneracy or None
///
/// Raises
/// ------
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
///
/// Examples
/// --------
/// >>> pixels = [[i * i % 97, 5 * i] for i in range(20)]
/// >>> find_unmoved(pixels, pixels, [True] * 20)
/// Degeneracy(kind='unmoved', num_explained=20, num_inliers=20)
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, inliers, **options))]
fn find_unmoved(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    inliers: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Degeneracy>> {
    let look = two_view::find_unmoved;
    Ok(find(pixels1, pixels2, inliers, options, look)?.map(degeneracy))
}

/// Finds a rotation that explains nearly all inliers of calibrated views.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
/// camera1, camera2 : Camera
/// inliers : array_like of bool, shape (N,)
/// **options : TwoViewOptions
///
/// Returns
/// -------
/// ExplainingRotation or None
///
/// Raises
/// ------
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, camera1, camera2, inliers, **options))]
fn find_explaining_rotation(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    inliers: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<ExplainingRotation>> {
    let cameras = [&camera1.0, &camera2.0];
    let found = find(pixels1, pixels2, inliers, options, |p, q, mask, options| {
        two_view::find_explaining_rotation(p, q, cameras, mask, options)
    })?;
    Ok(found.map(|found_rotation| ExplainingRotation {
        cam2_from_cam1: found_rotation.cam2_from_cam1.into(),
        num_explained: found_rotation.num_explained,
        num_inliers: found_rotation.num_inliers,
    }))
}

/// Finds a rotation and a focal length change that explain nearly all inliers.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
/// camera1, camera2 : Camera
/// inliers : array_like of bool, shape (N,)
/// **options : TwoViewOptions
///
/// Returns
/// -------
/// RotationAndFocal or None
///
/// Raises
/// ------
/// ValueError
///     If ``ransac``, ``max_homography_ratio`` or ``min_essential_ratio`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, camera1, camera2, inliers, **options))]
fn find_rotation_and_focal(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    inliers: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<RotationAndFocal>> {
    let cameras = [&camera1.0, &camera2.0];
    let found = find(pixels1, pixels2, inliers, options, |p, q, mask, options| {
        two_view::find_rotation_and_focal(p, q, cameras, mask, options)
    })?;
    Ok(found.map(|found_rotation| RotationAndFocal {
        cam2_from_cam1: found_rotation.cam2_from_cam1.into(),
        focal_factor: found_rotation.focal_factor,
        num_explained: found_rotation.num_explained,
        num_inliers: found_rotation.num_inliers,
    }))
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("PHOTO_MAX_ERROR_PX", two_view::PHOTO_MAX_ERROR_PX)?;
    options::declare(module, &TwoViewOptions::default())?;
    classes!(module: TwoViewReport, ExplainingRotation, RotationAndFocal, Degeneracy);
    functions!(module:
        estimate_two_view, estimate_two_view_calibrated, estimate_rotation, find_degeneracy,
        find_unmoved, find_explaining_rotation, find_rotation_and_focal
    );
    Ok(())
}
