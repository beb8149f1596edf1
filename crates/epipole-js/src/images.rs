//! Images: gray values, or colors with eight bits per channel.

use crate::argument::{Argument, not};
use crate::fault::{Fault, Result};
use crate::output::Output;
use crate::types::Types;
use crate::value::Value;
use epipole::camera::Camera;
use epipole::feature::photo_to_gray;
use epipole::image::{self, GrayImage, ImageBuffer, Pixel, RgbImage, RgbaImage};
use epipole::imaging::{GrayImage32, gray_from_values, gray_to_f32, rgb_to_gray};

/// Amount by which filters may exceed [0, 1].
const OVERSHOOT: f32 = 0.5;

/// Maximum side of an image, pixels.
const MAX_SIDE: u32 = 65_535;

/// An image of any kind.
pub enum Image {
    /// Gray values as bytes.
    Gray8(GrayImage),
    /// Red, green, blue as bytes.
    Rgb8(RgbImage),
    /// Red, green, blue, alpha as bytes, such as an `ImageData`. Alpha is ignored when converted to
    /// gray.
    Rgba8(RgbaImage),
    /// Gray values as floats.
    Gray32(GrayImage32),
}

/// Computes an image of the same kind.
macro_rules! same_kind {
    ($image:expr, |$pixels:ident| $run:expr) => {
        match $image {
            $crate::images::Image::Gray8($pixels) => $crate::images::Image::Gray8($run),
            $crate::images::Image::Rgb8($pixels) => $crate::images::Image::Rgb8($run),
            $crate::images::Image::Rgba8($pixels) => $crate::images::Image::Rgba8($run),
            $crate::images::Image::Gray32($pixels) => $crate::images::Image::Gray32($run),
        }
    };
}
pub(crate) use same_kind;

/// A gray image of floats, with black 0 and white 1, from an image of any kind.
pub struct Gray(pub GrayImage32);

/// Colors of a photo; gray bytes are repeated in all three channels.
pub struct Rgb(pub RgbImage);

/// Gray values of any range: bytes are divided by 255, floats remain unchanged.
pub struct Field(pub GrayImage32);

/// Rejects sizes that no image can have.
pub(crate) fn require_size(name: &str, width: u32, height: u32) -> Result<()> {
    let side = 1..=MAX_SIDE;
    match side.contains(&width) && side.contains(&height) {
        true => Ok(()),
        false => Err(Fault::of_range(format!(
            "{name} must have sides from 1 to {MAX_SIDE} pixels, but has {width} x {height}"
        ))),
    }
}

/// Rejects images whose size differs from their camera's.
pub(crate) fn require_camera(name: &str, image: &Image, camera: &Camera) -> Result<()> {
    let (width, height) = image.dimensions();
    match (width, height) == (camera.width, camera.height) {
        true => Ok(()),
        false => Err(Fault::of_range(format!(
            "{name} must have the size of its camera, {} x {}, but has {width} x {height}",
            camera.width, camera.height
        ))),
    }
}

impl Image {
    /// Returns width and height, pixels.
    pub fn dimensions(&self) -> (u32, u32) {
        match self {
            Self::Gray8(image) => image.dimensions(),
            Self::Rgb8(image) => image.dimensions(),
            Self::Rgba8(image) => image.dimensions(),
            Self::Gray32(image) => image.dimensions(),
        }
    }

    /// Converts bytes to gray; floats remain unchanged.
    pub fn into_gray(self) -> Self {
        match self {
            Self::Rgb8(image) => Self::Gray8(rgb_to_gray(&image)),
            Self::Rgba8(image) => Self::Gray8(rgb_to_gray(&opaque(&image))),
            gray => gray,
        }
    }
}

fn opaque(photo: &RgbaImage) -> RgbImage {
    let color = |u, v| image::Rgb([0, 1, 2].map(|channel| photo.get_pixel(u, v).0[channel]));
    RgbImage::from_fn(photo.width(), photo.height(), color)
}

impl Argument for Image {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "ImageLike",
            "An image, rows from top to bottom: an ImageData, or an object like it.",
            &[
                ("width", "number", "Pixels."),
                ("height", "number", "Pixels."),
                (
                    "data",
                    "Uint8Array | Uint8ClampedArray | Float32Array | Float64Array | ArrayLike<number>",
                    "Bytes: 1 (gray), 3 (RGB) or 4 (RGBA) a pixel. Floats: 1 a pixel, black 0 and white 1.",
                ),
            ],
        );
        types.alias(
            "ImageSource",
            "An image; in browsers also an `ImageBitmap`, a `VideoFrame`, or a `Blob` or `File` with \
             an encoded image.",
            "ImageLike | Picture",
        );
        "ImageSource".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let Value::Record(_) = value else {
            return Err(not(name, "an image with width, height and data", value));
        };
        let side = |key| {
            let pixels = u32::read(&format!("{name}.{key}"), value.get(key))?;
            match pixels {
                1..=MAX_SIDE => Ok(pixels),
                _ => Err(Fault::of_range(format!(
                    "{name}.{key} must be from 1 to {MAX_SIDE}, but is {pixels}"
                ))),
            }
        };
        let (width, height) = (side("width")?, side("height")?);
        let count = width as usize * height as usize;
        let wrong = |got: usize, expected: &str| {
            Fault::of_range(format!(
                "{name}.data must have {expected} for {width} x {height} pixels, but has {got}"
            ))
        };
        let data = value.get("data");
        if let Value::Bytes(bytes) = data {
            let (got, bytes) = (bytes.len(), bytes.clone());
            let image = match got {
                _ if got == count => ImageBuffer::from_raw(width, height, bytes).map(Self::Gray8),
                _ if got == 3 * count => {
                    ImageBuffer::from_raw(width, height, bytes).map(Self::Rgb8)
                }
                _ if got == 4 * count => {
                    ImageBuffer::from_raw(width, height, bytes).map(Self::Rgba8)
                }
                _ => None,
            };
            return image.ok_or_else(|| wrong(got, "1, 3 or 4 bytes a pixel"));
        }
        let floats: Vec<f32> = match data {
            Value::Floats(floats) => floats.clone(),
            Value::Doubles(doubles) => doubles.iter().map(|&x| x as f32).collect(),
            _ => {
                let expected = "an array of bytes or floats";
                return Err(not(&format!("{name}.data"), expected, data));
            }
        };
        if floats.len() != count {
            return Err(wrong(floats.len(), "1 float a pixel"));
        }
        if let Some(place) = floats.iter().position(|value| !value.is_finite()) {
            let (u, v) = (place % width as usize, place / width as usize);
            return Err(Fault::of_range(format!(
                "{name} has {} at pixel ({u}, {v})",
                f64::from(floats[place])
            )));
        }
        Ok(Self::Gray32(gray_from_values(width, height, floats)?))
    }
}

impl Argument for Rgb {
    fn typescript(types: &mut Types) -> String {
        <Image as Argument>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        Ok(Self(match Image::read(name, value)? {
            Image::Gray8(gray) => {
                let color = |u, v| image::Rgb([gray.get_pixel(u, v).0[0]; 3]);
                RgbImage::from_fn(gray.width(), gray.height(), color)
            }
            Image::Rgb8(photo) => photo,
            Image::Rgba8(photo) => opaque(&photo),
            Image::Gray32(_) => {
                let message = format!("{name} must be an image of bytes, but has floats");
                return Err(Fault::of_type(message));
            }
        }))
    }
}

impl Argument for Field {
    fn typescript(types: &mut Types) -> String {
        <Image as Argument>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        Ok(Self(match Image::read(name, value)? {
            Image::Gray8(image) => gray_to_f32(&image),
            Image::Rgb8(image) => photo_to_gray(&image),
            Image::Rgba8(image) => photo_to_gray(&opaque(&image)),
            Image::Gray32(image) => image,
        }))
    }
}

impl Argument for Gray {
    fn typescript(types: &mut Types) -> String {
        <Image as Argument>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let Field(image) = Field::read(name, value)?;
        let range = -OVERSHOOT..=1.0 + OVERSHOOT;
        match image.as_raw().iter().find(|value| !range.contains(value)) {
            None => Ok(Self(image)),
            Some(value) => Err(Fault::of_range(format!(
                "{name} must have gray values in [0, 1], but has {}; divide by the value of white",
                f64::from(*value)
            ))),
        }
    }
}

/// Reads `colors` of an object, if it has them.
///
/// * `of`: name of the things that have a color each
#[cfg(feature = "all")]
pub(crate) fn colors(name: &str, value: &Value, of: &str) -> Result<Option<Vec<[u8; 3]>>> {
    match value.get("colors") {
        Value::Nothing => Ok(None),
        Value::Bytes(bytes) if bytes.len() % 3 == 0 => {
            let colors = bytes.chunks_exact(3);
            let colors = colors.map(|color| [color[0], color[1], color[2]]);
            Ok(Some(colors.collect()))
        }
        other => {
            let expected = format!("a Uint8Array of 3 bytes for each {of}");
            Err(not(&format!("{name}.colors"), &expected, other))
        }
    }
}

fn image_value<P: Pixel>(image: ImageBuffer<P, Vec<P::Subpixel>>, data: Value) -> Value {
    Value::Record(vec![
        ("width".into(), image.width().into_value()),
        ("height".into(), image.height().into_value()),
        ("data".into(), data),
    ])
}

impl Output for GrayImage32 {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "GrayImage",
            "Floats, one a pixel, rows from top to bottom.",
            &[
                ("width", "number", "Pixels."),
                ("height", "number", "Pixels."),
                ("data", "Float32Array", "Values."),
            ],
        );
        "GrayImage".to_owned()
    }

    fn into_value(self) -> Value {
        let data = Value::Floats(self.as_raw().clone());
        image_value(self, data)
    }
}

#[cfg(feature = "all")]
impl Output for RgbImage {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "RgbImage",
            "Red, green and blue, a byte each, rows from top to bottom.",
            &[
                ("width", "number", "Pixels."),
                ("height", "number", "Pixels."),
                ("data", "Uint8Array", "Values."),
            ],
        );
        "RgbImage".to_owned()
    }

    fn into_value(self) -> Value {
        let data = Value::Bytes(self.as_raw().clone());
        image_value(self, data)
    }
}

impl Output for Image {
    fn typescript(types: &mut Types) -> String {
        types.interface(
            "ImageOfKind",
            "An image of the kind that was given: bytes or floats, with as many channels.",
            &[
                ("width", "number", "Pixels."),
                ("height", "number", "Pixels."),
                ("data", "Uint8Array | Float32Array", "Values."),
            ],
        );
        "ImageOfKind".to_owned()
    }

    fn into_value(self) -> Value {
        match self {
            Self::Gray8(image) => {
                let data = Value::Bytes(image.as_raw().clone());
                image_value(image, data)
            }
            Self::Rgb8(image) => {
                let data = Value::Bytes(image.as_raw().clone());
                image_value(image, data)
            }
            Self::Rgba8(image) => {
                let data = Value::Bytes(image.as_raw().clone());
                image_value(image, data)
            }
            Self::Gray32(image) => image.into_value(),
        }
    }
}
