//! Photographs from the bytes of a PNG, JPEG or WebP file.

use super::exif::Facts;
use super::gray::{GrayImage32, from_vec, rgb_to_gray};
use super::jpeg;
use crate::math::Geodetic;
use crate::{Error, Result};
use derive_setters::Setters;
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits, RgbImage};
use std::borrow::Cow;
use std::io::Cursor;

/// Maximum memory for data of a PNG file beside its pixels, bytes. A color profile that unpacks to
/// more is ignored; larger stored data are an error.
const MAX_METADATA_BYTES: u64 = 64 << 20;

/// Options of [`decode_gray`] and [`decode_rgb`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct DecodeOptions {
    /// The largest width × height; a file that promises more is refused before memory is taken.
    pub max_pixels: u64,
    /// Whether to turn the image upright by its EXIF orientation.
    pub apply_orientation: bool,
}

impl Default for DecodeOptions {
    /// At most 64 megapixels, turned upright.
    fn default() -> Self {
        Self {
            max_pixels: 64_000_000,
            apply_orientation: true,
        }
    }
}

/// An image and its file's data about the camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded<I> {
    /// The pixels.
    pub image: I,
    /// Initial guess of the focal length from the EXIF data, pixels of this image; `None` without
    /// these data. With the principal point in the middle it gives an initial K.
    pub focal_px: Option<f64>,
    /// Position of the camera, if the file has GPS data.
    pub place: Option<Geodetic>,
    /// Rotation to upright that the file asks for, applied or not.
    pub orientation: Orientation,
}

/// The gray image in [0, 1] of a PNG, JPEG or WebP file.
///
/// Colors become gray as in [`rgb_to_gray`]; sixteen-bit gray keeps its depth; transparency is
/// ignored.
///
/// # Errors
/// [`Error::BadImage`] if the bytes are no such file, or a truncated or corrupt one;
/// [`Error::TooManyPixels`] beyond the limit.
///
/// A JPEG file is corrupt if its data end early, hold codes that its tables do not have, or have
/// more blocks than the image. There is no checksum: changed data that still decode are another
/// image. Extra bytes between its parts or at the end do no harm, nor does a missing end-of-image
/// marker behind the last block.
///
/// ```
/// use epipole::imaging::{DecodeOptions, decode_gray};
/// assert!(decode_gray(b"not an image", &DecodeOptions::default()).is_err());
/// ```
pub fn decode_gray(bytes: &[u8], options: &DecodeOptions) -> Result<Decoded<GrayImage32>> {
    let decoded = decode(bytes, options)?;
    let (width, height) = (decoded.image.width(), decoded.image.height());
    let values = match &decoded.image {
        DynamicImage::ImageLuma16(gray) => scaled(gray.as_raw(), 1),
        DynamicImage::ImageLumaA16(gray) => scaled(gray.as_raw(), 2),
        DynamicImage::ImageLuma8(gray) => bytes_to_unit(gray.as_raw(), 1),
        DynamicImage::ImageLumaA8(gray) => bytes_to_unit(gray.as_raw(), 2),
        color => bytes_to_unit(rgb_to_gray(&color.to_rgb8()).as_raw(), 1),
    };
    Ok(decoded.with(|_| from_vec(width, height, values)))
}

/// The color image of a PNG, JPEG or WebP file; gray files give three equal channels.
///
/// # Errors
/// As [`decode_gray`].
///
/// ```
/// use epipole::imaging::{DecodeOptions, decode_rgb};
/// assert!(decode_rgb(&[], &DecodeOptions::default()).is_err());
/// ```
pub fn decode_rgb(bytes: &[u8], options: &DecodeOptions) -> Result<Decoded<RgbImage>> {
    Ok(decode(bytes, options)?.with(DynamicImage::into_rgb8))
}

impl<I> Decoded<I> {
    /// The same facts about another form of the image.
    fn with<J>(self, change: impl FnOnce(I) -> J) -> Decoded<J> {
        Decoded {
            image: change(self.image),
            focal_px: self.focal_px,
            place: self.place,
            orientation: self.orientation,
        }
    }
}

fn bytes_to_unit(raw: &[u8], stride: usize) -> Vec<f32> {
    let values = raw.iter().step_by(stride);
    values.map(|&v| f32::from(v) / 255.0).collect()
}

fn scaled(raw: &[u16], stride: usize) -> Vec<f32> {
    let values = raw.iter().step_by(stride);
    values.map(|&v| f32::from(v) / 65535.0).collect()
}

fn bad(error: &image::ImageError) -> Error {
    use image::ImageError::{Limits, Unsupported};
    let why = match error {
        Unsupported(_) => "it is no PNG, JPEG or WebP file".to_owned(),
        // A size beyond memory, before the caller's limit can be checked, or MAX_METADATA_BYTES.
        Limits(_) => "its pixels or the data beside them need too much memory".to_owned(),
        other => other.to_string(),
    };
    Error::BadImage { why }
}

/// Limits of the decoder: none for pixels, which are checked against the caller's own.
fn limits() -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_METADATA_BYTES);
    limits
}

fn decode(bytes: &[u8], options: &DecodeOptions) -> Result<Decoded<DynamicImage>> {
    if bytes.is_empty() {
        return Err(Error::BadImage {
            why: "the file is empty".to_owned(),
        });
    }
    let mut whole = Cow::from(bytes);
    if image::guess_format(bytes).is_ok_and(|format| format == ImageFormat::Jpeg) {
        let missing = jpeg::check(bytes, options.max_pixels);
        let missing = missing.map_err(|why| Error::BadImage { why })?;
        whole = missing.added_to(bytes);
    }
    let mut reader = ImageReader::new(Cursor::new(&*whole))
        .with_guessed_format()
        .map_err(|error| Error::BadImage {
            why: error.to_string(),
        })?;
    reader.limits(limits());
    let mut decoder = reader.into_decoder().map_err(|error| bad(&error))?;
    let (width, height) = decoder.dimensions();
    let got = u64::from(width) * u64::from(height);
    if got > options.max_pixels {
        return Err(Error::TooManyPixels {
            got,
            limit: options.max_pixels,
        });
    }
    if got == 0 {
        return Err(Error::BadImage {
            why: "it has no pixels".to_owned(),
        });
    }
    // Unreadable metadata are treated as absent: the image matters more.
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let exif = decoder.exif_metadata().unwrap_or(None);
    let mut image = DynamicImage::from_decoder(decoder).map_err(|error| bad(&error))?;
    let facts = exif.and_then(|data| Facts::read(&data));
    if options.apply_orientation {
        image.apply_orientation(orientation);
    }
    Ok(Decoded {
        image,
        focal_px: (facts.as_ref()).and_then(|facts| facts.focal_length_px(width, height)),
        place: facts.and_then(|facts| facts.place()),
        orientation,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;
    use image::codecs::png::PngEncoder;
    use image::{GrayImage, ImageEncoder, ImageFormat, Luma};

    fn png(image: &DynamicImage) -> Vec<u8> {
        let mut bytes = Vec::new();
        image
            .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
            .unwrap();
        bytes
    }

    fn sample() -> GrayImage {
        GrayImage::from_fn(40, 30, |u, v| Luma([((u * 7 + v * 13) % 256) as u8]))
    }

    /// A TIFF structure with an orientation and a 35 mm equivalent focal length.
    fn exif(orientation: u16, focal_35mm: u16) -> Vec<u8> {
        let mut data = b"II\x2a\0\x08\0\0\0".to_vec();
        data.extend(2u16.to_le_bytes());
        for (tag, kind, value) in [(0x0112u16, 3u16, u32::from(orientation)), (0x8769, 4, 38)] {
            data.extend(tag.to_le_bytes());
            data.extend(kind.to_le_bytes());
            data.extend(1u32.to_le_bytes());
            data.extend(value.to_le_bytes());
        }
        data.extend(0u32.to_le_bytes());
        assert_eq!(data.len(), 38);
        data.extend(1u16.to_le_bytes());
        data.extend(0xA405u16.to_le_bytes());
        data.extend(3u16.to_le_bytes());
        data.extend(1u32.to_le_bytes());
        data.extend(u32::from(focal_35mm).to_le_bytes());
        data.extend(0u32.to_le_bytes());
        data
    }

    #[test]
    fn metadata_beyond_the_limit_are_an_error() {
        let mut bytes = Vec::new();
        let mut encoder = PngEncoder::new(&mut bytes);
        let stored = vec![0; MAX_METADATA_BYTES as usize + 1];
        encoder.set_exif_metadata(stored).unwrap();
        let kind = image::ExtendedColorType::L8;
        encoder.write_image(&sample(), 40, 30, kind).unwrap();
        let Err(Error::BadImage { why }) = decode_gray(&bytes, &DecodeOptions::default()) else {
            panic!("the data fit");
        };
        assert!(why.contains("beside them"), "{why}");
    }

    #[test]
    fn a_color_profile_beyond_the_limit_is_ignored() {
        let image = sample();
        let profile = vec![0; 2 * MAX_METADATA_BYTES as usize];
        let mut bytes = Vec::new();
        let mut encoder = PngEncoder::new(&mut bytes);
        encoder.set_icc_profile(profile).unwrap();
        let kind = image::ExtendedColorType::L8;
        encoder.write_image(&image, 40, 30, kind).unwrap();
        assert!(bytes.len() < MAX_METADATA_BYTES as usize / 100);
        let has_profile = |limits| {
            let reader = ImageReader::new(Cursor::new(&bytes)).with_guessed_format();
            let mut reader = reader.unwrap();
            reader.limits(limits);
            let mut decoder = reader.into_decoder().unwrap();
            decoder.icc_profile().unwrap().is_some()
        };
        assert!(has_profile(Limits::no_limits()));
        assert!(!has_profile(limits()));
        let decoded = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
        assert_eq!(decoded.image.dimensions(), (40, 30));
    }

    #[test]
    fn a_gray_png_comes_back_exactly() {
        let image = sample();
        let decoded = decode_gray(
            &png(&DynamicImage::ImageLuma8(image.clone())),
            &DecodeOptions::default(),
        )
        .unwrap();
        assert_eq!(crate::imaging::gray_to_u8(&decoded.image), image);
        assert_eq!(decoded.focal_px, None);
    }

    #[test]
    fn sixteen_bits_are_kept() {
        let deep = image::ImageBuffer::from_fn(5, 4, |u, v| Luma([(u * 1000 + v * 77) as u16]));
        let bytes = png(&DynamicImage::ImageLuma16(deep));
        let decoded = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
        let value = decoded.image.get_pixel(3, 2).0[0];
        assert!((value - 3154.0 / 65535.0).abs() < 1e-7);
    }

    #[test]
    fn orientation_and_focal_length_are_read() {
        let image = sample();
        let mut bytes = Vec::new();
        let mut encoder = PngEncoder::new(&mut bytes);
        // Orientation 6: the camera was rotated; a clockwise quarter turn makes it upright.
        encoder.set_exif_metadata(exif(6, 28)).unwrap();
        encoder
            .write_image(image.as_raw(), 40, 30, image::ExtendedColorType::L8)
            .unwrap();
        let decoded = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
        assert_eq!(decoded.image.dimensions(), (30, 40));
        // The stored top-left pixel is at the top right.
        let stored = f32::from(image.get_pixel(0, 0).0[0]) / 255.0;
        assert_eq!(decoded.image.get_pixel(29, 0).0[0], stored);
        // The diagonal is 50 pixels, equivalent to 43.2666 mm of film.
        let focal_px = decoded.focal_px.unwrap();
        assert!(
            (focal_px - 28.0 * 50.0 / 1872f64.sqrt()).abs() < 1e-9,
            "{focal_px}"
        );
        let options = DecodeOptions {
            apply_orientation: false,
            ..DecodeOptions::default()
        };
        let stored = decode_rgb(&bytes, &options).unwrap();
        assert_eq!(stored.image.dimensions(), (40, 30));
        assert_eq!(stored.orientation, Orientation::Rotate90);
    }

    #[test]
    fn truncated_and_corrupt_files_are_errors() {
        let mut formats = vec![png(&DynamicImage::ImageLuma8(sample()))];
        for (format, image) in [
            (ImageFormat::Jpeg, DynamicImage::ImageLuma8(sample())),
            (
                ImageFormat::WebP,
                DynamicImage::ImageLuma8(sample()).to_rgb8().into(),
            ),
        ] {
            let mut bytes = Vec::new();
            image
                .write_to(&mut Cursor::new(&mut bytes), format)
                .unwrap();
            formats.push(bytes);
        }
        for bytes in formats {
            let options = DecodeOptions::default();
            assert!(decode_gray(&bytes, &options).is_ok());
            for keep in [
                0,
                1,
                7,
                20,
                bytes.len() / 3,
                bytes.len() / 2,
                bytes.len() * 9 / 10,
            ] {
                let result = decode_gray(&bytes[..keep], &options);
                assert!(
                    matches!(result, Err(Error::BadImage { .. })),
                    "{keep}: {result:?}"
                );
            }
            // A flipped byte may pass as another image, but never panics.
            for k in 0..bytes.len() {
                let mut corrupt = bytes.clone();
                corrupt[k] ^= 0x55;
                let _ = decode_gray(&corrupt, &options);
            }
        }
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said_in_words() {
        let why = |bytes: &[u8]| decode_rgb(bytes, &DecodeOptions::default()).unwrap_err();
        assert!(why(&[]).to_string().ends_with("the file is empty"));
        let letter = why(b"Dear reader, this is no picture.").to_string();
        assert!(
            letter.ends_with("it is no PNG, JPEG or WebP file"),
            "{letter}"
        );
        // An image format that is known elsewhere.
        let gif = why(b"GIF89a\x01\0\x01\0\0\0\0").to_string();
        assert!(gif.ends_with("it is no PNG, JPEG or WebP file"), "{gif}");
    }

    #[test]
    fn the_limit_is_checked_before_decoding_and_can_be_raised() {
        let bytes = png(&DynamicImage::ImageLuma8(sample()));
        let mut options = DecodeOptions {
            max_pixels: 1199,
            ..DecodeOptions::default()
        };
        assert_eq!(
            decode_gray(&bytes, &options),
            Err(Error::TooManyPixels {
                got: 1200,
                limit: 1199
            })
        );
        options.max_pixels = 1200;
        assert!(decode_gray(&bytes, &options).is_ok());
    }

    #[test]
    fn a_photograph_from_the_data_folder() {
        let Some(path) = fixture::data("multiview/fountain_p11/0000.jpg") else {
            return;
        };
        let bytes = std::fs::read(path).unwrap();
        let gray = decode_gray(&bytes, &DecodeOptions::default()).unwrap();
        assert_eq!(gray.image.dimensions(), (768, 512));
        assert!(crate::imaging::is_finite(&gray.image));
    }
}
