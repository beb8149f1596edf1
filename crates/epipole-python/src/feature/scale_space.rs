//! Scale space of SIFT.

use crate::arrays::{from_rows, vector};
use crate::images::{field, unit_gray};
use crate::progress;
use crate::record::{plain_class, record};
use epipole::feature;
use epipole::imaging::GrayImage32;
use epipole::nalgebra::Vector2;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Layers of a scale space with the same sampling.
    "epipole.feature" ScaleOctave {
        /// Binary logarithm of the pixels per sample.
        octave: i32,
        /// Pixels of the image per sample.
        step_px: f64,
        /// Position of the first sample, pixels of the image, shape (2,).
        origin: Py<PyArray1<f64>>,
        /// Blurred images, float32 of shape (L, h, w).
        blurred: Py<PyArray3<f32>>,
        /// Standard deviation of the blur of each image, pixels of the image, shape (L,).
        sigmas_px: Py<PyArray1<f64>>,
        /// Each blurred image minus the previous one, float32 of shape (L - 1, h, w).
        differences: Py<PyArray3<f32>>,
    }
}

impl ScaleOctave {
    fn give(py: Python<'_>, octave: &feature::ScaleOctave) -> PyResult<Self> {
        Ok(Self {
            octave: octave.octave,
            step_px: octave.step_px,
            origin: PyArray1::from_slice(py, &octave.origin).unbind(),
            blurred: stack(py, &octave.blurred)?.unbind(),
            sigmas_px: PyArray1::from_slice(py, &octave.sigmas_px).unbind(),
            differences: stack(py, &octave.differences)?.unbind(),
        })
    }

    fn core(&self, py: Python<'_>) -> PyResult<feature::ScaleOctave> {
        Ok(feature::ScaleOctave {
            octave: self.octave,
            step_px: self.step_px,
            origin: vector::<2>("origin", self.origin.bind(py))?.into(),
            blurred: layers("blurred", self.blurred.bind(py))?,
            sigmas_px: self.sigmas_px.bind(py).to_vec()?,
            differences: layers("differences", self.differences.bind(py))?,
        })
    }
}

/// Stacks images into an array of shape `(L, h, w)`.
fn stack<'py>(py: Python<'py>, images: &[GrayImage32]) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let (width, height) = images.first().map_or((0, 0), GrayImage32::dimensions);
    let values: Vec<f32> = images
        .iter()
        .flat_map(|i| i.as_raw().iter().copied())
        .collect();
    let shape = [images.len(), height as usize, width as usize];
    PyArray1::from_vec(py, values).reshape(shape)
}

fn layers(name: &str, stack: &Bound<'_, PyArray3<f32>>) -> PyResult<Vec<GrayImage32>> {
    (0..stack.shape()[0])
        .map(|k| field(name, &stack.get_item(k)?))
        .collect()
}

/// Image at increasing blur, and the differences between neighboring blurs.
///
/// Parameters
/// ----------
/// octaves : list of ScaleOctave
#[pyclass(frozen, module = "epipole.feature")]
pub(super) struct ScaleSpace {
    core: feature::ScaleSpace,
    octaves: Vec<Py<ScaleOctave>>,
}

plain_class!(ScaleSpace: octaves);

#[pymethods]
impl ScaleSpace {
    #[new]
    fn new(py: Python<'_>, octaves: Vec<Py<ScaleOctave>>) -> PyResult<Self> {
        let core = octaves.iter().map(|octave| octave.get().core(py));
        Ok(Self {
            core: feature::ScaleSpace {
                octaves: core.collect::<PyResult<_>>()?,
            },
            octaves,
        })
    }

    /// Octaves, each with half as many samples per axis as the previous one.
    #[getter]
    fn octaves(&self, py: Python<'_>) -> Vec<Py<ScaleOctave>> {
        self.octaves
            .iter()
            .map(|octave| octave.clone_ref(py))
            .collect()
    }

    /// Returns the responses of the differences at a pixel.
    ///
    /// Parameters
    /// ----------
    /// u, v : float
    ///     Pixels.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (K, 2)
    ///     Blur in pixels and difference, by increasing blur.
    fn answers<'py>(&self, py: Python<'py>, u: f64, v: f64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let answers = self.core.answers(u, v).into_iter();
        from_rows(py, answers.map(|(sigma, value)| Vector2::new(sigma, value)))
    }
}

/// Computes the scale space of an image.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SiftOptions
///     See `detect_sift`.
///
/// Returns
/// -------
/// ScaleSpace
///     No octaves for an image smaller than about a dozen pixels.
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], or an option is out of range.
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn scale_space(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<ScaleSpace> {
    let py = image.py();
    let pixels = unit_gray("image", image)?;
    let core = progress::run_with(py, progress, options, |options, monitor| {
        feature::scale_space(&pixels, options, monitor)
    })?;
    let octaves = core.octaves.iter();
    let octaves: PyResult<Vec<_>> = octaves
        .map(|octave| Py::new(py, ScaleOctave::give(py, octave)?))
        .collect();
    Ok(ScaleSpace {
        octaves: octaves?,
        core,
    })
}
