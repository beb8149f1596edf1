//! Photos warped by a rectified rig.

use super::matcher::{Matcher, StereoBm, StereoSgm};
use super::rectify::Rectification;
use crate::errors::OrRaise;
use crate::images::{disparity as read, from_disparity, from_gray, from_rgb, rgb};
use crate::progress;
use crate::record::plain_class;
use epipole::image::{GrayImage, RgbImage};
use epipole::stereo::{self, DisparityImage};
use numpy::{PyArray2, PyArray3};
use pyo3::prelude::*;

/// Pair of arrays of shape (H, W, 3).
type Colors<'py> = (Bound<'py, PyArray3<u8>>, Bound<'py, PyArray3<u8>>);

/// Two photos warped by a rectified rig.
///
/// Empty borders get no disparities, and images of vertical rigs are transposed for matching.
///
/// Parameters
/// ----------
/// rig : Rectification
/// image1, image2 : array_like, shape (H, W, 3)
///     uint8, with the image sizes of the rig's cameras.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
#[pyclass(frozen, module = "epipole.stereo")]
pub(super) struct RectifiedPair {
    rig: Py<Rectification>,
    images: [RgbImage; 2],
    pair: stereo::RectifiedPair,
}

plain_class!(RectifiedPair: rig, image1, image2);

#[pymethods]
impl RectifiedPair {
    #[new]
    #[pyo3(signature = (rig, image1, image2, *, progress=None))]
    fn new(
        py: Python<'_>,
        rig: Py<Rectification>,
        image1: &Bound<'_, PyAny>,
        image2: &Bound<'_, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let images = [rgb("image1", image1)?, rgb("image2", image2)?];
        let core = &rig.get().0;
        let pair = progress::run(py, progress, |monitor| {
            stereo::RectifiedPair::new(core, images.each_ref(), monitor)
        })?;
        Ok(Self { rig, images, pair })
    }

    /// Rectified rig.
    #[getter]
    fn rig(&self, py: Python<'_>) -> Py<Rectification> {
        self.rig.clone_ref(py)
    }

    /// First photo, uint8 of shape (H, W, 3).
    #[getter]
    fn image1<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.images[0].clone())
    }

    /// Second photo, uint8 of shape (H, W, 3).
    #[getter]
    fn image2<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.images[1].clone())
    }

    /// Rectified photos, black outside the image content.
    ///
    /// Returns
    /// -------
    /// first, second : ndarray of uint8, shape (h, w, 3)
    #[getter]
    fn pictures<'py>(&self, py: Python<'py>) -> PyResult<Colors<'py>> {
        let [first, second] = self.pair.pictures();
        Ok((from_rgb(py, first.clone())?, from_rgb(py, second.clone())?))
    }

    /// Number of pixels of the first rectified photo with image content.
    #[getter]
    fn num_shown(&self) -> usize {
        self.pair.num_shown()
    }

    /// Computes disparities of the first rectified photo, along the columns if the rig is vertical.
    ///
    /// Parameters
    /// ----------
    /// matching : StereoSgm, StereoBm or callable
    ///     ``matching(left, right)`` returns the disparities of two uint8 gray images whose matches
    ///     share a row: float of shape (h, w), NaN where unknown.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction, for a matcher of this module.
    ///
    /// Returns
    /// -------
    /// ndarray of float32, shape (h, w)
    ///     Pixels; NaN where unknown.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If an option of the matcher is out of range, or the disparities differ in size from the
    ///     images.
    #[pyo3(signature = (matching, *, progress=None))]
    fn disparity<'py>(
        &self,
        matching: &Bound<'py, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let py = matching.py();
        let found = if let Ok(matcher) = matching.cast::<StereoSgm>() {
            self.matched(py, &matcher.get().0, progress)
        } else if let Ok(matcher) = matching.cast::<StereoBm>() {
            self.matched(py, &matcher.get().0, progress)
        } else {
            self.called(matching)
        };
        from_disparity(py, found?)
    }

    /// Fills the disparities of all pixels with image content, like `fill_gaps`.
    ///
    /// Parameters
    /// ----------
    /// disparity : array_like of float, shape (h, w)
    ///     Pixels; NaN where unknown.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Returns
    /// -------
    /// ndarray of float32, shape (h, w)
    #[pyo3(signature = (disparity, *, progress=None))]
    fn filled<'py>(
        &self,
        disparity: &Bound<'py, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let py = disparity.py();
        let disparity = read("disparity", disparity)?;
        let filled = progress::run(py, progress, |monitor| {
            self.pair.filled(&disparity, monitor)
        });
        from_disparity(py, filled?)
    }
}

impl RectifiedPair {
    fn matched(
        &self,
        py: Python<'_>,
        matcher: &impl Matcher,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<DisparityImage> {
        progress::run(py, progress, |monitor| {
            (self.pair).disparity(|left, right| matcher.bytes(left, right, monitor))
        })
    }

    /// Computes disparities by a Python callable and propagates its exceptions.
    fn called(&self, matching: &Bound<'_, PyAny>) -> PyResult<DisparityImage> {
        let py = matching.py();
        let call = |left: &GrayImage, right: &GrayImage| {
            let left = from_gray(py, left.clone())?;
            let right = from_gray(py, right.clone())?;
            read("the result of matching", &matching.call1((left, right))?)
        };
        let mut raised = None;
        let found = self.pair.disparity(|left, right| {
            let size = left.dimensions();
            call(left, right)
                .and_then(|found| require_same(size, found))
                .map_err(|error| {
                    raised = Some(error);
                    epipole::Error::Canceled
                })
        });
        match raised {
            Some(error) => Err(error),
            None => found.or_raise(),
        }
    }
}

/// Rejects disparities that differ in size from the images.
fn require_same(size: (u32, u32), found: DisparityImage) -> PyResult<DisparityImage> {
    if (found.width(), found.height()) == size {
        return Ok(found);
    }
    Err(pyo3::exceptions::PyValueError::new_err(format!(
        "the result of matching must have the shape ({}, {}) of its images, but has ({}, {})",
        size.1,
        size.0,
        found.height(),
        found.width()
    )))
}
