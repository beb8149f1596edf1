//! JPEG files of images.

use crate::{Error, Result};
use image::RgbImage;
use image::codecs::jpeg::JpegEncoder;

/// Quality, 1 to 100: edges stay free of visible artifacts.
const QUALITY: u8 = 95;

/// Encodes an image as JPEG of high quality.
///
/// # Errors
/// [`Error::Unsupported`] for an image without pixels, or with a side above 65535 pixels.
///
/// ```
/// use epipole_io::photo::{DecodeOptions, decode_rgb, encode_jpeg};
/// let image = epipole::image::RgbImage::from_pixel(8, 8, epipole::image::Rgb([200, 100, 50]));
/// let bytes = encode_jpeg(&image)?;
/// let again = decode_rgb(&bytes, &DecodeOptions::default())?.image;
/// assert!(again.get_pixel(3, 3).0[0].abs_diff(200) < 3);
/// # Ok::<(), epipole_io::Error>(())
/// ```
pub fn encode_jpeg(image: &RgbImage) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY)
        .encode_image(image)
        .map_err(|error| Error::unsupported(format!("no JPEG file: {error}")))?;
    Ok(bytes)
}
