//! Decoding of PNG, JPEG, WebP, TIFF, BMP and PNM files.

use super::exif::Facts;
use super::format::{Format, bad, check_size, recognize};
use super::range::PixelRange;
use super::raster::Raster;
use super::{jpeg, tiff};
use crate::{Error, Result};
use derive_setters::Setters;
use epipole::imaging::GrayImage32;
use epipole::math::Geodetic;
use image::codecs::pnm::PnmDecoder;
use image::metadata::Orientation;
use image::{
    DynamicImage, ImageBuffer, ImageDecoder, ImageFormat, ImageReader, Limits, Pixel, RgbImage,
    imageops,
};
use std::borrow::Cow;
use std::io::Cursor;

/// Maximum memory for the metadata of a PNG file, bytes. A color profile that unpacks to more is
/// ignored; larger stored data are an error.
pub(super) const MAX_METADATA_BYTES: u64 = 64 << 20;

/// Options of [`decode_gray`] and [`decode_rgb`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct DecodeOptions {
    /// Maximum width × height; larger files are refused before memory is allocated.
    pub max_pixels: u64,
    /// Whether to rotate the image upright by its EXIF orientation.
    pub apply_orientation: bool,
    /// Sample values that become black and white.
    pub range: PixelRange,
    /// Length of the longer side of the camera's sensor, millimeters, for files that have the focal
    /// length in millimeters only.
    pub sensor_width_mm: Option<f64>,
}

impl Default for DecodeOptions {
    /// At most 64 megapixels, rotated upright, samples of more than 8 bits mapped from the range in
    /// use.
    fn default() -> Self {
        Self {
            max_pixels: 64_000_000,
            apply_orientation: true,
            range: PixelRange::Auto,
            sensor_width_mm: None,
        }
    }
}

/// An image, with the data of its file about the camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded<I> {
    /// The pixels.
    pub image: I,
    /// Initial guess of the focal length from the EXIF data, pixels of this image; `None` without
    /// these data. With the principal point at the center it gives an initial K.
    pub focal_px: Option<f64>,
    /// Focal length from the EXIF data, millimeters.
    pub focal_mm: Option<f64>,
    /// Position of the camera, if the file has GPS data.
    pub place: Option<Geodetic>,
    /// Orientation from the file, applied or not.
    pub orientation: Orientation,
    /// Sample values that became black and white, if they differ from those of the format.
    pub range: Option<[f64; 2]>,
}

/// Decodes a PNG, JPEG, WebP, TIFF, BMP or PNM file to gray in [0, 1].
///
/// Colors become gray as in [`rgb_to_gray`](epipole::imaging::rgb_to_gray); gray of more than eight
/// bits keeps its depth; transparency is ignored. The first image of a TIFF file is read: gray or
/// RGB, integers or floats, in any compression but JPEG 2000, WebP and Zstandard.
///
/// # Errors
/// [`Error::BadImage`] for other, truncated or corrupt files; [`Error::TooManyPixels`] beyond the
/// limit; [`Error::Invalid`] for an empty range.
///
/// A JPEG file is corrupt if its data end early, contain codes missing in its tables, or have more
/// blocks than the image. There is no checksum, so changed data that still decode are not noticed.
/// Extra bytes between its parts or at the end are harmless, as is a missing end-of-image marker
/// after the last block. A file without Huffman tables is read with the standard ones.
///
/// ```
/// # fn main() -> Result<(), epipole_io::Error> {
/// use epipole_io::photo::{DecodeOptions, PixelRange, decode_gray};
/// // Twelve bits, of which the sensor used a few values.
/// let file = b"P2 3 1 4095 1000 1010 1040";
/// let gray = decode_gray(file, &DecodeOptions::default())?;
/// assert_eq!(gray.image.as_raw(), &[0.0, 0.25, 1.0]);
/// assert_eq!(gray.range, Some([1000.0, 1040.0]));
/// let options = DecodeOptions::default().with_range(PixelRange::Between(0.0, 2000.0));
/// assert_eq!(decode_gray(file, &options)?.image.as_raw()[0], 0.5);
/// # Ok(()) }
/// ```
pub fn decode_gray(bytes: &[u8], options: &DecodeOptions) -> Result<Decoded<GrayImage32>> {
    decode(bytes, options, Raster::into_gray)
}

/// Decodes the same files to color; gray files give three equal channels.
///
/// # Errors
/// As [`decode_gray`].
///
/// ```
/// use epipole_io::photo::{DecodeOptions, decode_rgb};
/// assert!(decode_rgb(&[], &DecodeOptions::default()).is_err());
/// ```
pub fn decode_rgb(bytes: &[u8], options: &DecodeOptions) -> Result<Decoded<RgbImage>> {
    decode(bytes, options, Raster::into_rgb)
}

/// Returns width and height of an image in the orientation of the sensor, from the header alone.
///
/// # Errors
/// As [`decode_gray`], for errors in the header.
///
/// ```
/// use epipole_io::photo::sensor_size;
/// assert_eq!(sensor_size(b"P2 3 1 255 10 20 30"), Ok((3, 1)));
/// assert!(sensor_size(b"no image").is_err());
/// ```
pub fn sensor_size(bytes: &[u8]) -> Result<(u32, u32)> {
    let format = match recognize(bytes)? {
        Format::Tiff => return tiff::size(bytes),
        Format::Jpeg => ImageFormat::Jpeg,
        Format::Pnm => ImageFormat::Pnm,
        Format::Other(format) => format,
    };
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader
        .into_dimensions()
        .map_err(|error| decoder_error(&error))
}

/// An image with the given kind of pixels.
type Buffer<P> = ImageBuffer<P, Vec<<P as Pixel>::Subpixel>>;

/// * `make`: creates the image from samples and the values of black and white
fn decode<P: Pixel + 'static>(
    bytes: &[u8],
    options: &DecodeOptions,
    make: impl FnOnce(Raster, Option<[f64; 2]>) -> Buffer<P>,
) -> Result<Decoded<Buffer<P>>> {
    options.range.check()?;
    let File {
        raster,
        orientation,
        facts,
    } = read(bytes, options.max_pixels)?;
    let (width, height) = (raster.width, raster.height);
    let range = raster.mapped(options.range);
    let mut image = make(raster, range);
    if options.apply_orientation {
        rotate_upright(&mut image, orientation);
    }
    Ok(Decoded {
        image,
        focal_px: (facts.as_ref())
            .and_then(|facts| facts.focal_length_px(width, height, options.sensor_width_mm)),
        focal_mm: facts.as_ref().and_then(Facts::focal_length_mm),
        place: facts.and_then(|facts| facts.place()),
        orientation,
        range,
    })
}

/// Contents of a file.
struct File {
    raster: Raster,
    orientation: Orientation,
    facts: Option<Facts>,
}

fn read(bytes: &[u8], max_pixels: u64) -> Result<File> {
    let mut whole = Cow::from(bytes);
    let format = match recognize(bytes)? {
        Format::Tiff => {
            let (raster, orientation) = tiff::read(bytes, max_pixels)?;
            return Ok(File {
                raster,
                orientation,
                // EXIF data have the format of TIFF.
                facts: Facts::read(bytes),
            });
        }
        Format::Jpeg => {
            let missing = jpeg::check(bytes, max_pixels);
            whole = missing.map_err(bad)?.added_to(bytes);
            ImageFormat::Jpeg
        }
        Format::Pnm => ImageFormat::Pnm,
        Format::Other(format) => format,
    };
    let mut reader = ImageReader::with_format(Cursor::new(&*whole), format);
    reader.limits(limits());
    let mut decoder = reader
        .into_decoder()
        .map_err(|error| decoder_error(&error))?;
    let (width, height) = decoder.dimensions();
    check_size(width, height, max_pixels)?;
    // Unreadable metadata are treated as absent, because the image is still useful.
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let exif = decoder.exif_metadata().unwrap_or(None);
    let image = DynamicImage::from_decoder(decoder).map_err(|error| decoder_error(&error))?;
    let mut raster = Raster::from_dynamic(image)?;
    if format == ImageFormat::Pnm
        && let Ok(decoder) = PnmDecoder::new(Cursor::new(bytes))
        && let Ok(white) = u16::try_from(decoder.into_inner().1.maximal_sample())
    {
        raster.unscale(white);
    }
    Ok(File {
        raster,
        orientation,
        facts: exif.and_then(|data| Facts::read(&data)),
    })
}

/// Returns the limits of the decoder: none for pixels, which are checked against the caller's
/// limit.
pub(super) fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_METADATA_BYTES);
    limits
}

/// Describes the error of a decoder.
fn decoder_error(error: &image::ImageError) -> Error {
    use image::ImageError::{Limits, Unsupported};
    match error {
        // A size beyond memory, detected before the caller's limit is checked, or
        // MAX_METADATA_BYTES.
        Limits(_) => bad("its pixels or the data beside them need too much memory"),
        Unsupported(what) => bad(format!("{what}; convert it to PNG")),
        other => bad(other.to_string()),
    }
}

fn rotate_upright<P: Pixel + 'static>(image: &mut Buffer<P>, orientation: Orientation) {
    match orientation {
        Orientation::NoTransforms => (),
        Orientation::Rotate90 => *image = imageops::rotate90(image),
        Orientation::Rotate180 => imageops::rotate180_in_place(image),
        Orientation::Rotate270 => *image = imageops::rotate270(image),
        Orientation::FlipHorizontal => imageops::flip_horizontal_in_place(image),
        Orientation::FlipVertical => imageops::flip_vertical_in_place(image),
        Orientation::Rotate90FlipH => {
            *image = imageops::rotate90(image);
            imageops::flip_horizontal_in_place(image);
        }
        Orientation::Rotate270FlipH => {
            *image = imageops::rotate270(image);
            imageops::flip_horizontal_in_place(image);
        }
    }
}
