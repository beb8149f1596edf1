//! Photos prepared for reconstruction: upright, undistorted if the lens is known, downscaled.

use super::{DecodeOptions, PixelRange, decode_rgb};
use crate::Result;
use derive_setters::Setters;
use epipole::calibration::Undistortion;
use epipole::camera::{Camera, Intrinsics};
use epipole::imaging::reduce_rgb;
use epipole::math::Geodetic;
use image::metadata::Orientation;
use image::{DynamicImage, RgbImage};

/// Options of [`prepare_photo`].
#[derive(Debug, Clone, Copy, Setters)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct PrepareOptions<'a> {
    /// Maximum number of pixels of the result.
    pub max_pixels: u64,
    /// Maximum number of pixels of the file, which bounds memory.
    pub max_file_pixels: u64,
    /// Sample values that become black and white.
    pub range: PixelRange,
    /// Length of the longer side of the camera's sensor, millimeters, for files that have the focal
    /// length in millimeters only.
    pub sensor_width_mm: Option<f64>,
    /// Undistortion for images of one camera, with its size before or else after rotation to
    /// upright.
    pub undistortion: Option<&'a Undistortion>,
}

impl Default for PrepareOptions<'_> {
    /// Rotated upright, otherwise unchanged; decoded as by [`DecodeOptions::default`].
    fn default() -> Self {
        let DecodeOptions {
            max_pixels, range, ..
        } = DecodeOptions::default();
        Self {
            max_pixels: u64::MAX,
            max_file_pixels: max_pixels,
            range,
            sensor_width_mm: None,
            undistortion: None,
        }
    }
}

/// A prepared photo.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedPhoto {
    /// The pixels, upright.
    pub image: RgbImage,
    /// Initial guess of the focal length from the EXIF data, pixels of `image`.
    pub focal_px: Option<f64>,
    /// Focal length from the EXIF data, millimeters.
    pub focal_mm: Option<f64>,
    /// Position of the camera, from the EXIF data.
    pub place: Option<Geodetic>,
    /// K, pixels of `image`, if the distortion of a known lens was removed.
    pub intrinsics: Option<Intrinsics>,
    /// Upright width and height before downscaling.
    pub full_size: (u32, u32),
    /// Width and height in the orientation of the sensor, before downscaling.
    pub sensor_size: (u32, u32),
    /// Number of clockwise quarter turns to upright; `None` if it was mirrored.
    pub quarters: Option<u8>,
    /// Sample values that became black and white, where they are not those of the format.
    pub range: Option<[f64; 2]>,
    /// Whether the pixels are those of the file: not rotated, undistorted or downscaled, nor mapped
    /// from a range.
    pub is_as_stored: bool,
}

impl PreparedPhoto {
    /// Converts a focal length to pixels of the downscaled photo.
    pub fn reduced_focal_px(&self, focal_px: f64) -> f64 {
        focal_px * (f64::from(self.image.width()) / f64::from(self.full_size.0.max(1)))
    }

    /// Returns the camera of the prepared image, rotated and downscaled with it. `None` if neither
    /// the sensor nor the upright photo has the size of the camera, or if the photo was mirrored.
    /// For photos that keep their distortion.
    ///
    /// * `camera`: camera with the orientation and size of the sensor, or of the upright photo
    ///
    /// # Errors
    /// As [`Intrinsics::resized`].
    pub fn camera(&self, camera: &Camera) -> Result<Option<Camera>> {
        let size = (camera.width, camera.height);
        let quarters = match size == self.sensor_size {
            true => self.quarters,
            false => (size == self.full_size).then_some(0),
        };
        let Some(quarters) = quarters else {
            return Ok(None);
        };
        let k = camera.intrinsics.rotated(quarters, size);
        let (width, height) = self.image.dimensions();
        Ok(Some(Camera {
            intrinsics: match self.full_size == (width, height) {
                true => k,
                false => k.resized(self.full_size, (width, height))?,
            },
            lens: camera.lens.rotated(quarters),
            width,
            height,
        }))
    }
}

/// Decodes a file as [`decode_rgb`], undistorts it if it has the size of the undistortion's camera,
/// rotates it upright, and downscales it.
///
/// The lens is fixed to the sensor, so a camera calibrated in the sensor's orientation also applies
/// to photos taken upright, if their files have the orientation. It does not apply to a mirrored
/// photo. A camera that has only the size of the upright photo was calibrated with rotated photos,
/// as OpenCV reads them.
///
/// # Errors
/// As [`decode_rgb`].
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use epipole_io::photo::{PrepareOptions, prepare_photo};
/// let mut file = std::io::Cursor::new(Vec::new());
/// image::RgbImage::new(40, 30).write_to(&mut file, image::ImageFormat::Png)?;
/// let options = PrepareOptions::default().with_max_pixels(300);
/// let photo = prepare_photo(file.get_ref(), &options)?;
/// assert_eq!((photo.image.dimensions(), photo.full_size), ((20, 15), (40, 30)));
/// assert_eq!(photo.reduced_focal_px(50.0), 25.0);
/// # Ok(()) }
/// ```
pub fn prepare_photo(bytes: &[u8], options: &PrepareOptions<'_>) -> Result<PreparedPhoto> {
    let as_stored = DecodeOptions {
        max_pixels: options.max_file_pixels,
        apply_orientation: false,
        range: options.range,
        sensor_width_mm: options.sensor_width_mm,
    };
    let decoded = decode_rgb(bytes, &as_stored)?;
    let sensor_size = decoded.image.dimensions();
    let quarters = quarters(decoded.orientation);
    let of_size = |size| {
        let has_size = |flat: &&Undistortion| (flat.map.width(), flat.map.height()) == size;
        options.undistortion.filter(has_size)
    };
    let rotate_upright = |image: RgbImage| {
        let mut image = DynamicImage::from(image);
        image.apply_orientation(decoded.orientation);
        image.into_rgb8()
    };
    let (image, intrinsics) = match of_size(sensor_size).zip(quarters) {
        Some((flat, quarters)) => (
            rotate_upright(flat.map.warp(&decoded.image, &mut ())?),
            Some(flat.intrinsics.rotated(quarters, sensor_size)),
        ),
        None => {
            let upright = rotate_upright(decoded.image);
            let is_rotated = upright.dimensions() != sensor_size;
            match of_size(upright.dimensions()).filter(|_| is_rotated) {
                Some(flat) => (flat.map.warp(&upright, &mut ())?, Some(flat.intrinsics)),
                None => (upright, None),
            }
        }
    };
    let full_size = image.dimensions();
    let image = reduce_rgb(image, options.max_pixels);
    let size = image.dimensions();
    let mut photo = PreparedPhoto {
        image,
        focal_px: None,
        focal_mm: decoded.focal_mm,
        place: decoded.place,
        intrinsics: intrinsics.map(|k| k.resized(full_size, size)).transpose()?,
        full_size,
        sensor_size,
        quarters,
        range: decoded.range,
        is_as_stored: decoded.orientation == Orientation::NoTransforms
            && intrinsics.is_none()
            && decoded.range.is_none()
            && size == full_size,
    };
    photo.focal_px = decoded.focal_px.map(|f| photo.reduced_focal_px(f));
    Ok(photo)
}

/// Returns the number of clockwise quarter turns to upright; `None` for a mirrored photo.
fn quarters(orientation: Orientation) -> Option<u8> {
    match orientation {
        Orientation::NoTransforms => Some(0),
        Orientation::Rotate90 => Some(1),
        Orientation::Rotate180 => Some(2),
        Orientation::Rotate270 => Some(3),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::calibration::Keep;
    use epipole::camera::{Lens, LensKind};
    use image::{ExtendedColorType, ImageEncoder, Rgb};

    /// Returns a PNG file with an EXIF orientation.
    fn file(image: &RgbImage, orientation: u16) -> Vec<u8> {
        let mut exif = b"II\x2a\0\x08\0\0\0\x01\0".to_vec();
        for part in [0x0112_u16, 3, 1, 0, orientation, 0, 0, 0] {
            exif.extend(part.to_le_bytes());
        }
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        encoder.set_exif_metadata(exif).unwrap();
        let (width, height) = image.dimensions();
        encoder
            .write_image(image.as_raw(), width, height, ExtendedColorType::Rgb8)
            .unwrap();
        bytes
    }

    fn camera() -> Camera {
        Camera {
            intrinsics: Intrinsics::new(70.0, 71.0, 42.0, 27.0).unwrap(),
            lens: Lens::from_coefficients(LensKind::Brown, &[-0.2, 0.03, 0.004, -0.006, 0.0])
                .unwrap(),
            width: 80,
            height: 60,
        }
    }

    fn smooth() -> RgbImage {
        let wave = |x: u32, slow: f64| (127.0 + 120.0 * libm::sin(f64::from(x) / slow)) as u8;
        RgbImage::from_fn(80, 60, |u, v| {
            Rgb([wave(u, 9.0), wave(v, 7.0), wave(u + v, 11.0)])
        })
    }

    #[test]
    fn however_the_camera_was_held_its_rays_are_the_same() {
        let flat = Undistortion::new(&camera(), Keep::Valid, &mut ()).unwrap();
        let options = PrepareOptions {
            undistortion: Some(&flat),
            ..PrepareOptions::default()
        };
        let lying = prepare_photo(&file(&smooth(), 1), &options).unwrap();
        assert_eq!(lying.image, flat.map.warp(&smooth(), &mut ()).unwrap());
        assert_eq!(lying.intrinsics, Some(flat.intrinsics));
        let (u, v) = (13, 41);
        let place = |u: u32, v: u32| nalgebra::Point2::new(f64::from(u), f64::from(v));
        let ray = flat.intrinsics.ray(&place(u, v));
        // Position and ray of the pixel after clockwise rotation.
        for (orientation, at, rotated) in [
            (6, (59 - v, u), [-ray.y, ray.x]),
            (3, (79 - u, 59 - v), [-ray.x, -ray.y]),
            (8, (v, 79 - u), [ray.y, -ray.x]),
        ] {
            let photo = prepare_photo(&file(&smooth(), orientation), &options).unwrap();
            assert_eq!(photo.sensor_size, (80, 60));
            assert_eq!(photo.image.dimensions(), photo.full_size);
            assert_eq!(photo.full_size == (60, 80), orientation != 3);
            assert!(!photo.is_as_stored);
            assert_eq!(
                photo.image.get_pixel(at.0, at.1),
                lying.image.get_pixel(u, v)
            );
            // With its distortion kept, the camera is rotated with the image.
            let distorted =
                prepare_photo(&file(&smooth(), orientation), &PrepareOptions::default());
            let distorted = distorted.unwrap().camera(&camera()).unwrap().unwrap();
            let ray_of = |camera: &Camera, pixel| {
                let ray = camera.unproject(&pixel).unwrap();
                nalgebra::Point2::new(ray.x / ray.z, ray.y / ray.z)
            };
            let bent = ray_of(&camera(), place(u, v));
            let its_bent = ray_of(&distorted, place(at.0, at.1));
            let expected = match orientation {
                6 => [-bent.y, bent.x],
                3 => [-bent.x, -bent.y],
                _ => [bent.y, -bent.x],
            };
            assert!((its_bent.x - expected[0]).abs() < 1e-12, "{orientation}");
            assert!((its_bent.y - expected[1]).abs() < 1e-12, "{orientation}");
            assert_eq!((distorted.width, distorted.height), photo.full_size);
            let its_ray = photo.intrinsics.unwrap().ray(&place(at.0, at.1));
            assert!((its_ray.x - rotated[0]).abs() < 1e-12, "{orientation}");
            assert!((its_ray.y - rotated[1]).abs() < 1e-12, "{orientation}");
        }
    }

    #[test]
    fn a_camera_of_upright_images_is_used_unchanged() {
        let upright = image::imageops::rotate90(&smooth());
        let lens = camera().lens.rotated(1);
        let camera = Camera {
            lens,
            ..Camera::pinhole(camera().intrinsics.rotated(1, (80, 60)), 60, 80)
        };
        let flat = Undistortion::new(&camera, Keep::Valid, &mut ()).unwrap();
        let options = PrepareOptions {
            undistortion: Some(&flat),
            ..PrepareOptions::default()
        };
        for bytes in [file(&smooth(), 6), file(&upright, 1)] {
            let photo = prepare_photo(&bytes, &options).unwrap();
            assert_eq!(photo.image, flat.map.warp(&upright, &mut ()).unwrap());
            assert_eq!(photo.intrinsics, Some(flat.intrinsics));
            assert!(!photo.is_as_stored);
            assert_eq!(photo.camera(&camera), Ok(Some(camera)));
        }
    }

    #[test]
    fn an_image_of_another_camera_is_only_downscaled() {
        let flat = Undistortion::new(&camera(), Keep::Valid, &mut ()).unwrap();
        let options = PrepareOptions {
            max_pixels: 1200,
            undistortion: Some(&flat),
            ..PrepareOptions::default()
        };
        // Upright pixels without an orientation, and a mirrored photo.
        let upright = image::imageops::rotate90(&smooth());
        for bytes in [file(&upright, 1), file(&smooth(), 2)] {
            let photo = prepare_photo(&bytes, &options).unwrap();
            assert_eq!(photo.intrinsics, None);
            assert_eq!(photo.camera(&camera()), Ok(None));
            let (width, height) = photo.image.dimensions();
            assert_eq!((2 * width, 2 * height), photo.full_size);
        }
        let photo = prepare_photo(&file(&smooth(), 6), &options).unwrap();
        let expected = flat.intrinsics.rotated(1, (80, 60)).scaled(0.5).unwrap();
        assert_eq!(photo.intrinsics, Some(expected));
        let distorted = photo.camera(&camera()).unwrap().unwrap();
        let rotated = camera().intrinsics.rotated(1, (80, 60));
        assert_eq!(distorted.intrinsics, rotated.scaled(0.5).unwrap());
        assert!(prepare_photo(b"nothing", &options).is_err());
        let untouched = prepare_photo(&file(&smooth(), 1), &PrepareOptions::default()).unwrap();
        assert!(untouched.is_as_stored && untouched.image == smooth());
    }
}
