//! Photographs from files.

use crate::failure::Failure;
use epipole::feature::photo_to_gray;
use epipole::imaging::{DecodeOptions, Decoded, GrayImage32, decode_rgb, rgb_to_gray};
use image::{GrayImage, RgbImage};
use std::path::Path;

/// A photograph, upright, with what its file says about the camera.
pub(crate) struct Photo {
    pub(crate) color: RgbImage,
    /// First guess of the focal length from EXIF, pixels.
    pub(crate) focal_px: Option<f64>,
}

impl Photo {
    /// Reads a PNG, JPEG or WebP file.
    ///
    /// # Errors
    /// A sentence naming the file: missing, unreadable, corrupt or too large.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = std::fs::read(path).map_err(|error| {
            let why = match error.kind() {
                std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
                _ => format!("cannot be read: {error}"),
            };
            Failure::new("read", why).about(path)
        })?;
        let decoded = decode_rgb(&bytes, &DecodeOptions::default());
        let Decoded { image, focal_px } =
            decoded.map_err(|error| Failure::from(error).about(path))?;
        Ok(Self {
            color: image,
            focal_px,
        })
    }

    /// Gray values in [0, 1], the same for every command.
    pub(crate) fn gray(&self) -> GrayImage32 {
        photo_to_gray(&self.color)
    }

    /// Gray values in 8 bits.
    pub(crate) fn gray_u8(&self) -> GrayImage {
        rgb_to_gray(&self.color)
    }
}

/// `{width, height}` of an image.
#[derive(Debug, Clone, Copy, serde::Serialize)]
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
