//! Photos with EXIF data.

use super::source::{Source, or_raise};
use crate::calibration::Undistortion;
use crate::camera::{Camera, Intrinsics};
use crate::images::{from_gray, from_rgb, rgb};
use crate::math::Geodetic;
use crate::progress;
use crate::record::record;
use crate::register::{classes, functions};
use crate::sfm::wrapper::wrapper;
use epipole_io::photo::{self, DecodeOptions, PixelRange, PrepareOptions};
use numpy::PyArray3;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

record! {
    /// Image, with camera data from its file.
    "epipole.io" Decoded {
        /// Pixels: uint8 of shape (H, W, 3), or float32 of shape (H, W) in [0, 1].
        image: Py<PyAny>,
        /// Initial guess of the focal length from the EXIF data, pixels of this image, or None.
        focal_px: Option<f64>,
        /// Focal length from the EXIF data, millimeters, or None.
        focal_mm: Option<f64>,
        /// Position of the camera, an `epipole.math.Geodetic`, or None without GPS data.
        place: Option<Geodetic>,
        /// EXIF orientation of the file, 1 to 8, whether applied or not.
        orientation: u8,
        /// Sample values that became black and white; None for those of the format.
        range: Option<[f64; 2]>,
    }
}

/// Reads the range of sample values: "auto", "full", or a pair of numbers.
fn pixel_range(range: Option<&Bound<'_, PyAny>>) -> PyResult<PixelRange> {
    let Some(range) = range else {
        return Ok(PixelRange::default());
    };
    if let Ok((black, white)) = range.extract::<(f64, f64)>() {
        return Ok(PixelRange::Between(black, white));
    }
    match range.extract::<String>().as_deref() {
        Ok("auto") => Ok(PixelRange::Auto),
        Ok("full") => Ok(PixelRange::Full),
        _ => Err(PyValueError::new_err(format!(
            "range must be \"auto\", \"full\" or a pair of numbers, but is {}",
            range.repr()?
        ))),
    }
}

fn decode_options(
    max_pixels: Option<u64>,
    apply_orientation: bool,
    range: Option<&Bound<'_, PyAny>>,
) -> PyResult<DecodeOptions> {
    let defaults = DecodeOptions::default();
    Ok(defaults
        .with_max_pixels(max_pixels.unwrap_or(defaults.max_pixels))
        .with_apply_orientation(apply_orientation)
        .with_range(pixel_range(range)?))
}

/// Decodes an image by a function of the library.
///
/// * `give`: converts its pixels to an array
fn decode<'py, I: Send>(
    source: &Bound<'py, PyAny>,
    options: &DecodeOptions,
    decoder: fn(&[u8], &DecodeOptions) -> epipole_io::Result<photo::Decoded<I>>,
    give: impl FnOnce(Python<'py>, I) -> PyResult<Bound<'py, PyAny>>,
) -> PyResult<Decoded> {
    let py = source.py();
    let source = Source::read(source)?;
    let decoded = source.done(progress::detach(py, || decoder(&source.bytes, options)))?;
    Ok(Decoded {
        image: give(py, decoded.image)?.unbind(),
        focal_px: decoded.focal_px,
        focal_mm: decoded.focal_mm,
        place: decoded.place.map(Geodetic),
        orientation: decoded.orientation.to_exif(),
        range: decoded.range,
    })
}

/// Decodes a PNG, JPEG, WebP, TIFF, BMP or PNM file to a color image, with its EXIF data.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
/// max_pixels : int, optional
///     Larger images are rejected. 64 million by default.
/// apply_orientation : bool, optional
///     Whether to rotate the image upright by its EXIF orientation.
/// range : str or tuple of float, optional
///     Sample values that become black and white: ``"auto"`` for those in use, ``"full"`` for all
///     of the format, or a pair of values.
///
/// Returns
/// -------
/// Decoded
///     `image` is uint8 of shape (H, W, 3).
///
/// Raises
/// ------
/// ValueError
///     If the file is damaged or not an image, it has more than ``max_pixels`` pixels, or ``range``
///     is unknown or empty.
/// OSError
///     If the file cannot be read.
#[pyfunction]
#[pyo3(signature = (source, *, max_pixels=None, apply_orientation=true, range=None))]
fn decode_rgb(
    source: &Bound<'_, PyAny>,
    max_pixels: Option<u64>,
    apply_orientation: bool,
    range: Option<&Bound<'_, PyAny>>,
) -> PyResult<Decoded> {
    let give = |py, image| Ok(from_rgb(py, image)?.into_any());
    let options = decode_options(max_pixels, apply_orientation, range)?;
    decode(source, &options, photo::decode_rgb, give)
}

/// Decodes a PNG, JPEG, WebP, TIFF, BMP or PNM file to a gray image, with its EXIF data.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
/// max_pixels : int, optional
///     Larger images are rejected. 64 million by default.
/// apply_orientation : bool, optional
///     Whether to rotate the image upright by its EXIF orientation.
/// range : str or tuple of float, optional
///     Sample values that become black and white: ``"auto"`` for those in use, ``"full"`` for all
///     of the format, or a pair of values.
///
/// Returns
/// -------
/// Decoded
///     `image` is float32 of shape (H, W), in [0, 1].
///
/// Raises
/// ------
/// ValueError
///     If the file is damaged or not an image, it has more than ``max_pixels`` pixels, or ``range``
///     is unknown or empty.
/// OSError
///     If the file cannot be read.
#[pyfunction]
#[pyo3(signature = (source, *, max_pixels=None, apply_orientation=true, range=None))]
fn decode_gray(
    source: &Bound<'_, PyAny>,
    max_pixels: Option<u64>,
    apply_orientation: bool,
    range: Option<&Bound<'_, PyAny>>,
) -> PyResult<Decoded> {
    let give = |py, image| Ok(from_gray(py, image)?.into_any());
    let options = decode_options(max_pixels, apply_orientation, range)?;
    decode(source, &options, photo::decode_gray, give)
}

/// Reads width and height of an image before its orientation is applied, from the header alone.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// tuple of int
///
/// Raises
/// ------
/// ValueError
///     If the file is not an image, or its header is damaged.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn sensor_size(source: &Bound<'_, PyAny>) -> PyResult<(u32, u32)> {
    let source = Source::read(source)?;
    source.done(photo::sensor_size(&source.bytes))
}

/// Photo after it was rotated upright, undistorted and downscaled.
///
/// Parameters
/// ----------
/// image : array_like of uint8, shape (H, W, 3)
/// focal_px, focal_mm : float, optional
/// place : epipole.math.Geodetic, optional
/// intrinsics : Intrinsics, optional
/// full_size, sensor_size : tuple of int
/// quarters : int, optional
/// range : tuple of float, optional
/// is_as_stored : bool
#[pyclass(frozen, module = "epipole.io")]
struct PreparedPhoto(photo::PreparedPhoto);

wrapper!(
    PreparedPhoto: image, focal_px, focal_mm, place, intrinsics, full_size, sensor_size, quarters,
    range, is_as_stored
);

#[pymethods]
impl PreparedPhoto {
    #[new]
    #[allow(clippy::too_many_arguments)]
    fn new(
        image: &Bound<'_, PyAny>,
        focal_px: Option<f64>,
        focal_mm: Option<f64>,
        place: Option<Geodetic>,
        intrinsics: Option<&Intrinsics>,
        full_size: (u32, u32),
        sensor_size: (u32, u32),
        quarters: Option<u8>,
        range: Option<[f64; 2]>,
        is_as_stored: bool,
    ) -> PyResult<Self> {
        Ok(Self(photo::PreparedPhoto {
            image: rgb("image", image)?,
            focal_px,
            focal_mm,
            place: place.map(|place| place.0),
            intrinsics: intrinsics.map(|intrinsics| intrinsics.0),
            full_size,
            sensor_size,
            quarters,
            range,
            is_as_stored,
        }))
    }

    /// Pixels, upright, uint8 of shape (H, W, 3).
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.0.image.clone())
    }

    /// Initial guess of the focal length from the EXIF data, pixels of `image`, or None.
    #[getter]
    fn focal_px(&self) -> Option<f64> {
        self.0.focal_px
    }

    /// Focal length from the EXIF data, millimeters, or None.
    #[getter]
    fn focal_mm(&self) -> Option<f64> {
        self.0.focal_mm
    }

    /// Position of the camera, an `epipole.math.Geodetic`, or None.
    #[getter]
    fn place(&self) -> Option<Geodetic> {
        self.0.place.map(Geodetic)
    }

    /// K if the distortion of a known lens was removed, else None.
    #[getter]
    fn intrinsics(&self) -> Option<Intrinsics> {
        self.0.intrinsics.map(Intrinsics::from)
    }

    /// Width and height before downscaling, upright.
    #[getter]
    fn full_size(&self) -> (u32, u32) {
        self.0.full_size
    }

    /// Width and height before the rotation.
    #[getter]
    fn sensor_size(&self) -> (u32, u32) {
        self.0.sensor_size
    }

    /// Number of clockwise quarter turns to the upright image; None if it was mirrored.
    #[getter]
    fn quarters(&self) -> Option<u8> {
        self.0.quarters
    }

    /// Sample values that became black and white; None for those of the format.
    #[getter]
    fn range(&self) -> Option<[f64; 2]> {
        self.0.range
    }

    /// Whether the pixels are unchanged from the file.
    #[getter]
    fn is_as_stored(&self) -> bool {
        self.0.is_as_stored
    }

    /// Converts a focal length to pixels of `image`, from pixels before downscaling.
    ///
    /// Parameters
    /// ----------
    /// focal_px : float
    ///     Focal length in the file, pixels.
    fn reduced_focal_px(&self, focal_px: f64) -> f64 {
        self.0.reduced_focal_px(focal_px)
    }

    /// Returns the camera of `image`; None for another size or a mirrored photo.
    ///
    /// Parameters
    /// ----------
    /// camera : epipole.camera.Camera
    ///     Camera of the sensor, or of the upright photo.
    fn camera(&self, camera: &Camera) -> PyResult<Option<Camera>> {
        let camera = or_raise(self.0.camera(&camera.0))?;
        Ok(camera.map(Camera::from))
    }
}

/// Reads a color image, undistorts it, rotates it upright and downscales it.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
/// max_pixels : int, optional
///     Maximum number of pixels of the result.
/// max_file_pixels : int, optional
///     Larger files are rejected. 64 million by default.
/// range : str or tuple of float, optional
///     Same as for `decode_rgb`.
/// sensor_width_mm : float, optional
///     Length of the longer side of the sensor, millimeters, for files that give the focal length
///     in millimeters only.
/// undistortion : epipole.calibration.Undistortion, optional
///     Applied to images with the size of its camera.
///
/// Returns
/// -------
/// PreparedPhoto
///
/// Raises
/// ------
/// ValueError
///     If the file is damaged or not an image, it has more than ``max_file_pixels`` pixels, or
///     ``range`` is unknown or empty.
/// OSError
///     If the file cannot be read.
#[pyfunction]
#[pyo3(signature = (
    source, *, max_pixels=None, max_file_pixels=None, range=None, sensor_width_mm=None,
    undistortion=None
))]
fn prepare_photo(
    source: &Bound<'_, PyAny>,
    max_pixels: Option<u64>,
    max_file_pixels: Option<u64>,
    range: Option<&Bound<'_, PyAny>>,
    sensor_width_mm: Option<f64>,
    undistortion: Option<&Undistortion>,
) -> PyResult<PreparedPhoto> {
    let py = source.py();
    let defaults = PrepareOptions::default();
    let options = defaults
        .with_max_pixels(max_pixels.unwrap_or(defaults.max_pixels))
        .with_max_file_pixels(max_file_pixels.unwrap_or(defaults.max_file_pixels))
        .with_range(pixel_range(range)?)
        .with_sensor_width_mm(sensor_width_mm)
        .with_undistortion(undistortion.map(Undistortion::core));
    let source = Source::read(source)?;
    let prepared = progress::detach(py, || photo::prepare_photo(&source.bytes, &options));
    Ok(PreparedPhoto(source.done(prepared)?))
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: Decoded, PreparedPhoto);
    functions!(module: decode_rgb, decode_gray, sensor_size, prepare_photo);
    Ok(())
}
