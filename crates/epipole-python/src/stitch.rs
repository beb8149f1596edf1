//! Panoramas.

use crate::arrays::{from_matrix, from_points, matrix, pixel_pairs};
use crate::camera::Intrinsics;
use crate::errors::OrRaise;
use crate::images::{from_rgb, rgb};
use crate::register::{classes, functions};
use crate::sfm::wrapper::{require_equal, wrapper};
use crate::{options, progress};
use epipole::nalgebra::Matrix3;
use epipole::stitch;
use numpy::{PyArray2, PyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Two overlapping photos and their inliers.
///
/// Parameters
/// ----------
/// images : tuple of int
///     Indices of the photos.
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Inlier matches.
/// homography : array_like, shape (3, 3)
///     From the first photo to the second, at any scale.
/// num_matches : int
///     Number of matches, including outliers.
/// has_parallax : bool
///     Whether the matches show parallax: the camera moved, and no homography fits all of them.
#[pyclass(frozen, from_py_object, module = "epipole.stitch")]
#[derive(Clone)]
struct Overlap(stitch::Overlap);

wrapper!(Overlap: images, pixels1, pixels2, homography, num_matches, has_parallax);

#[pymethods]
impl Overlap {
    #[new]
    fn new(
        images: [usize; 2],
        pixels1: &Bound<'_, PyAny>,
        pixels2: &Bound<'_, PyAny>,
        homography: &Bound<'_, PyAny>,
        num_matches: usize,
        has_parallax: bool,
    ) -> PyResult<Self> {
        let pixels = pixel_pairs(pixels1, pixels2)?;
        require_equal(("pixels1", pixels[0].len()), ("pixels2", pixels[1].len()))?;
        Ok(Self(stitch::Overlap {
            images,
            pixels,
            homography: matrix("homography", homography)?,
            num_matches,
            has_parallax,
        }))
    }

    /// Indices of the photos.
    #[getter]
    fn images(&self) -> (usize, usize) {
        self.0.images.into()
    }

    /// Pixels of the inliers in the first photo, shape (N, 2).
    #[getter]
    fn pixels1<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pixels(py, 0)
    }

    /// Pixels of the inliers in the second photo, shape (N, 2).
    #[getter]
    fn pixels2<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pixels(py, 1)
    }

    /// H from the first photo to the second, shape (3, 3).
    #[getter]
    fn homography<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.homography)
    }

    /// Number of matches, including outliers.
    #[getter]
    fn num_matches(&self) -> usize {
        self.0.num_matches
    }

    /// Whether the matches show parallax, because the camera moved.
    #[getter]
    fn has_parallax(&self) -> bool {
        self.0.has_parallax
    }
}

impl Overlap {
    fn pixels<'py>(&self, py: Python<'py>, image: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.0.pixels[image])
    }
}

/// Photos in the frame of a panorama, which looks along z with y down.
///
/// Parameters
/// ----------
/// pixel_from_direction : list of array_like or None
///     Matrix M of each photo, shape (3, 3), which maps a direction to a homogeneous pixel.
/// rotations : list of array_like or None
///     Rotation of each camera, for rotating cameras: ``d_in_cam = R @ d``.
/// scale_px : float
///     Pixels per unit of a direction at z = 1.
/// focal_factor : float, optional
///     Common factor of the focal lengths, if it was estimated.
#[pyclass(frozen, module = "epipole.stitch")]
struct Panorama(stitch::Panorama);

wrapper!(Panorama: pixel_from_direction, rotations, scale_px, focal_factor);

/// Matrices by photo.
type Matrices<'py> = Vec<Option<Bound<'py, PyAny>>>;

fn read_matrices(name: &str, matrices: &Matrices<'_>) -> PyResult<Vec<Option<Matrix3<f64>>>> {
    let read = |(place, value): (usize, &Option<Bound<'_, PyAny>>)| {
        let value = value.as_ref();
        value
            .map(|value| matrix(&format!("{name}[{place}]"), value))
            .transpose()
    };
    matrices.iter().enumerate().map(read).collect()
}

fn give_matrices<'py>(
    py: Python<'py>,
    matrices: &[Option<Matrix3<f64>>],
) -> PyResult<Vec<Option<Bound<'py, PyArray2<f64>>>>> {
    let give = |matrix: &Option<Matrix3<f64>>| {
        matrix
            .as_ref()
            .map(|matrix| from_matrix(py, matrix))
            .transpose()
    };
    matrices.iter().map(give).collect()
}

#[pymethods]
impl Panorama {
    #[new]
    #[pyo3(signature = (pixel_from_direction, rotations, scale_px, focal_factor=None))]
    fn new(
        pixel_from_direction: Matrices<'_>,
        rotations: Matrices<'_>,
        scale_px: f64,
        focal_factor: Option<f64>,
    ) -> PyResult<Self> {
        Ok(Self(stitch::Panorama {
            pixel_from_direction: read_matrices("pixel_from_direction", &pixel_from_direction)?,
            rotations: read_matrices("rotations", &rotations)?,
            scale_px,
            focal_factor,
        }))
    }

    /// Matrix of each photo, direction to homogeneous pixel, shape (3, 3); None without overlap.
    #[getter]
    fn pixel_from_direction<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Vec<Option<Bound<'py, PyArray2<f64>>>>> {
        give_matrices(py, &self.0.pixel_from_direction)
    }

    /// Rotation of each camera, shape (3, 3), for rotating cameras, or None.
    #[getter]
    fn rotations<'py>(&self, py: Python<'py>) -> PyResult<Vec<Option<Bound<'py, PyArray2<f64>>>>> {
        give_matrices(py, &self.0.rotations)
    }

    /// Pixels per unit of a direction at z = 1: the focal length, for rotating cameras.
    #[getter]
    fn scale_px(&self) -> f64 {
        self.0.scale_px
    }

    /// Common factor of the focal lengths, or None.
    #[getter]
    fn focal_factor(&self) -> Option<f64> {
        self.0.focal_factor
    }
}

/// Finds the homography on which the matches of two photos agree, and detects parallax.
///
/// Parameters
/// ----------
/// images : tuple of int
///     Indices of the photos.
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, including outliers.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : OverlapOptions
///     ``ransac``, a dict such as ``{"max_error_px": 3.0}``; ``min_num_inliers``.
///
/// Returns
/// -------
/// Overlap or None
///     None if no more matches agree than wrong ones might by chance.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If all pixels of an image are on a line.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` of ``ransac`` is out of range.
///
/// Examples
/// --------
/// >>> steps = np.arange(60)
/// >>> pixels = np.column_stack([200 + steps * 37 % 440, steps * 71 % 480])
/// >>> h = find_overlap((0, 1), pixels, pixels - [200, 0]).homography
/// >>> round(float(h[0, 2] / h[2, 2]), 3)
/// -200.0
#[pyfunction]
#[pyo3(signature = (images, pixels1, pixels2, *, progress=None, **options))]
fn find_overlap(
    py: Python<'_>,
    images: [usize; 2],
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Overlap>> {
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    let overlap = progress::run_with(py, progress, options, |options, monitor| {
        stitch::find_overlap(images, &pixels1, &pixels2, options, monitor)
    })?;
    Ok(overlap.map(Overlap))
}

/// Converts overlaps to those of the library, if they refer to the first `count` photos.
fn of_images(overlaps: Vec<Overlap>, count: usize) -> PyResult<Vec<stitch::Overlap>> {
    let mut images = overlaps.iter().flat_map(|overlap| overlap.0.images);
    if let Some(image) = images.find(|&image| image >= count) {
        return Err(PyValueError::new_err(format!(
            "overlaps has photo {image}, but there are {count}"
        )));
    }
    Ok(overlaps.into_iter().map(|overlap| overlap.0).collect())
}

/// Estimates the rotations of photos from one position, with a common focal length factor.
///
/// Parameters
/// ----------
/// intrinsics : list of Intrinsics
///     K of each photo; focal lengths are known or guessed.
/// overlaps : list of Overlap
/// find_focal : bool, optional
///     Whether to estimate a common factor of all focal lengths, from 1/4 to 4.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// Panorama
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If there are no overlaps, or the matches of an overlap coincide.
/// ValueError
///     If an overlap refers to a missing photo.
#[pyfunction]
#[pyo3(signature = (intrinsics, overlaps, find_focal=false, *, progress=None))]
fn estimate_panorama(
    py: Python<'_>,
    intrinsics: Vec<Intrinsics>,
    overlaps: Vec<Overlap>,
    find_focal: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Panorama> {
    let intrinsics: Vec<_> = intrinsics.into_iter().map(|k| k.0).collect();
    let overlaps = of_images(overlaps, intrinsics.len())?;
    let panorama = progress::run(py, progress, |monitor| {
        stitch::estimate_panorama(&intrinsics, &overlaps, find_focal, monitor)
    })?;
    Ok(Panorama(panorama))
}

/// Aligns photos of a plane by homographies from one to the next.
///
/// Parameters
/// ----------
/// num_images : int
///     Number of photos.
/// overlaps : list of Overlap
///
/// Returns
/// -------
/// Panorama
///     To render with ``surface="plane"``.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If there are no overlaps.
/// ValueError
///     If an overlap refers to a missing photo.
#[pyfunction]
fn chain_homographies(num_images: usize, overlaps: Vec<Overlap>) -> PyResult<Panorama> {
    let overlaps = of_images(overlaps, num_images)?;
    Ok(Panorama(
        stitch::chain_homographies(num_images, &overlaps).or_raise()?,
    ))
}

/// Renders all photos of a panorama on a surface; black where there is none.
///
/// Parameters
/// ----------
/// panorama : Panorama
/// photos : list of array_like of uint8, shape (H, W, 3)
///     In the order of the panorama.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RenderOptions
///     ``surface``, ``"cylinder"``, ``"plane"`` or ``"sphere"``; ``blend``, ``"bands"``,
///     ``"feather"`` or ``"seams"``; ``gains``, whether to compensate exposure; ``max_pixels``.
///
/// Returns
/// -------
/// ndarray of uint8, shape (H, W, 3)
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a photo extends beyond the surface.
#[pyfunction]
#[pyo3(signature = (panorama, photos, *, progress=None, **options))]
fn render_panorama<'py>(
    py: Python<'py>,
    panorama: &Panorama,
    photos: Vec<Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let options = options::read(options)?;
    let numbered = photos.iter().enumerate();
    let photos = numbered.map(|(place, photo)| rgb(&format!("photos[{place}]"), photo));
    let photos: Vec<_> = photos.collect::<PyResult<_>>()?;
    let panorama = &panorama.0;
    let image = progress::run(py, progress, |monitor| {
        let photos: Vec<_> = photos.iter().collect();
        stitch::render_panorama(panorama, &photos, &options, monitor)
    })?;
    from_rgb(py, image)
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::stitch::OverlapOptions::default())?;
    crate::options::declare(module, &epipole::stitch::RenderOptions::default())?;
    classes!(module: Overlap, Panorama);
    functions!(module: find_overlap, estimate_panorama, chain_homographies, render_panorama);
    Ok(())
}
