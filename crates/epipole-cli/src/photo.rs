//! Photographs from files.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::reading::{ReadArguments, SizeArguments};
use epipole::calibration::Undistortion;
use epipole::camera::{Camera, Intrinsics, Lens};
use epipole::feature::photo_to_gray;
use epipole::imaging::{GrayImage32, rgb_to_gray};
use epipole::math::Geodetic;
use epipole_io::photo::{DecodeOptions, PrepareOptions, PreparedPhoto, decode_rgb, prepare_photo};
use image::{GrayImage, RgbImage};
use std::path::Path;

/// An upright photo, with the data of its file about the camera.
pub(crate) struct Photo {
    pub(crate) color: RgbImage,
    /// First guess of the focal length from EXIF, pixels.
    pub(crate) focal_px: Option<f64>,
    /// Focal length from EXIF, millimeters.
    pub(crate) focal_mm: Option<f64>,
    /// Position from EXIF.
    pub(crate) place: Option<Geodetic>,
    /// K, if the camera is known, or if the distortion of its lens was removed.
    pub(crate) k: Option<Intrinsics>,
    /// The lens, if it is known and its distortion was kept.
    pub(crate) lens: Option<RetainedLens>,
    /// Width and height before downscaling.
    pub(crate) full_size: (u32, u32),
    /// Width and height before downscaling and rotation.
    pub(crate) sensor_size: (u32, u32),
    /// Whether the file has exactly these pixels: not rotated, resampled or downscaled.
    pub(crate) is_as_stored: bool,
}

/// A lens whose distortion a photo keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RetainedLens {
    pub(crate) lens: Lens,
    /// Number of quarter turns from the frame of the camera to upright.
    pub(crate) quarters: u8,
}

impl From<PreparedPhoto> for Photo {
    fn from(photo: PreparedPhoto) -> Self {
        Self {
            color: photo.image,
            focal_px: photo.focal_px,
            focal_mm: photo.focal_mm,
            place: photo.place,
            k: photo.intrinsics,
            lens: None,
            full_size: photo.full_size,
            sensor_size: photo.sensor_size,
            is_as_stored: photo.is_as_stored,
        }
    }
}

impl Photo {
    /// Reads and downscales a file, and undistorts it if it has the size of the camera.
    ///
    /// # Errors
    /// A failure naming the file: missing, unreadable, corrupt or too large.
    pub(crate) fn prepared(
        path: &Path,
        size: impl Into<SizeArguments>,
        undistortion: Option<&Undistortion>,
        context: &Context,
    ) -> Result<Self, Failure> {
        let photo = prepare(size.into(), path, undistortion, context)?;
        Ok(Self::from(photo))
    }

    /// Reads and downscales a file and keeps its distortion. K and the lens are those of the
    /// camera, if the sizes are equal.
    ///
    /// # Errors
    /// As [`Photo::prepared`].
    pub(crate) fn by_camera(
        path: &Path,
        size: impl Into<SizeArguments>,
        camera: &Camera,
        context: &Context,
    ) -> Result<Self, Failure> {
        let prepared = prepare(size.into(), path, None, context)?;
        let its_own = (prepared.camera(camera)).map_err(|e| Failure::from(e).about(path))?;
        let is_of_sensor = (camera.width, camera.height) == prepared.sensor_size;
        let quarters = prepared.quarters.filter(|_| is_of_sensor).unwrap_or(0);
        let mut photo = Self::from(prepared);
        if let Some(camera) = its_own {
            photo.k = Some(camera.intrinsics);
            photo.lens = Some(RetainedLens {
                lens: camera.lens,
                quarters,
            });
        }
        Ok(photo)
    }

    /// Returns a placeholder for a missing photo, with its camera if known.
    pub(crate) fn without_pixels(camera: Option<&Camera>) -> Self {
        Self {
            color: RgbImage::new(0, 0),
            focal_px: None,
            focal_mm: None,
            place: None,
            k: camera.map(|camera| camera.intrinsics),
            lens: camera.map(|camera| RetainedLens {
                lens: camera.lens,
                quarters: 0,
            }),
            full_size: (0, 0),
            sensor_size: (0, 0),
            is_as_stored: true,
        }
    }

    /// Returns the camera of the photo, given its intrinsics.
    pub(crate) fn camera(&self, intrinsics: Intrinsics) -> Camera {
        let (width, height) = self.color.dimensions();
        Camera {
            lens: self.lens.map_or(Lens::NONE, |retained| retained.lens),
            ..Camera::pinhole(intrinsics, width, height)
        }
    }

    /// Reads the pixels of a file in the orientation of the sensor, which is the frame of the lens.
    ///
    /// # Errors
    /// As [`Photo::prepared`].
    pub(crate) fn of_sensor(
        path: &Path,
        reading: ReadArguments,
        context: &Context,
    ) -> Result<RgbImage, Failure> {
        let as_stored = DecodeOptions::default()
            .with_max_pixels(reading.max_file_pixels())
            .with_range(reading.range)
            .with_apply_orientation(false);
        let decoded = decode_rgb(&bytes(path)?, &as_stored);
        let decoded = decoded.map_err(|error| reading.failure(error, path))?;
        reading.warn_of_range(decoded.range, path, context);
        Ok(decoded.image)
    }

    /// Converts a focal length from pixels of the file to pixels of the photo.
    pub(crate) fn reduced_focal_px(&self, focal_px: f64) -> f64 {
        focal_px * (f64::from(self.color.width()) / f64::from(self.full_size.0.max(1)))
    }

    /// Converts K from pixels of the file to pixels of the photo.
    ///
    /// # Errors
    /// As [`Intrinsics::resized`].
    pub(crate) fn reduced_k(&self, k: &Intrinsics) -> Result<Intrinsics, Failure> {
        match self.full_size == self.color.dimensions() {
            true => Ok(*k),
            false => Ok(k.resized(self.full_size, self.color.dimensions())?),
        }
    }

    /// Returns gray values in [0, 1].
    pub(crate) fn gray(&self) -> GrayImage32 {
        photo_to_gray(&self.color)
    }

    /// Returns gray values in 8 bits.
    pub(crate) fn gray_u8(&self) -> GrayImage {
        rgb_to_gray(&self.color)
    }
}

/// Reads a photo and warns if it has no contrast.
fn prepare(
    size: SizeArguments,
    path: &Path,
    undistortion: Option<&Undistortion>,
    context: &Context,
) -> Result<PreparedPhoto, Failure> {
    let options = PrepareOptions::default()
        .with_max_pixels(size.max_pixels())
        .with_max_file_pixels(size.reading.max_file_pixels())
        .with_range(size.reading.range)
        .with_sensor_width_mm(size.sensor_width_mm)
        .with_undistortion(undistortion);
    let photo = prepare_photo(&bytes(path)?, &options)
        .map_err(|error| size.reading.failure(error, path))?;
    size.reading.warn_of_range(photo.range, path, context);
    if is_flat(&photo.image) {
        let path = path.display();
        context.warn(&format!(
            "{path} shows no texture, so nothing can be found or matched in it"
        ));
    }
    Ok(photo)
}

/// Returns whether all gray levels are adjacent.
fn is_flat(image: &RgbImage) -> bool {
    let levels = rgb_to_gray(image).into_raw();
    let ends = levels.iter().min().zip(levels.iter().max());
    ends.is_none_or(|(darkest, brightest)| brightest - darkest <= 2)
}

/// Refuses a pair of different sizes.
///
/// # Errors
/// A failure with both sizes.
pub(crate) fn check_same_size([first, second]: &[Photo; 2]) -> Result<(), Failure> {
    let (first, second) = (Size::from(&first.color), Size::from(&second.color));
    if first == second {
        return Ok(());
    }
    let message = format!(
        "the two images must have the same size, but one is {} × {} and the other {} × {}",
        first.width, first.height, second.width, second.height
    );
    Err(Failure::new("size-mismatch", message))
}

/// Reads the bytes of a file.
///
/// # Errors
/// A failure naming it: missing or unreadable.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| files::unreadable(path, &error))
}

/// `{width, height}` of an image.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub(crate) struct Size {
    width: u32,
    height: u32,
}

impl From<&RgbImage> for Size {
    fn from(image: &RgbImage) -> Self {
        Self {
            width: image.width(),
            height: image.height(),
        }
    }
}
