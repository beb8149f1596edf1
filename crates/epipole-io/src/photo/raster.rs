//! Samples of any depth, and their conversion to images.

use super::range::{PixelRange, of_floats, of_words, to_byte, to_unit};
use crate::{Error, Result};
use epipole::imaging::{GrayImage32, rgb_to_gray};
use image::{DynamicImage, RgbImage};

/// Pixels of a file, row by row.
pub(super) struct Raster {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Number of samples per pixel: gray; gray and alpha; RGB; RGB and alpha.
    pub(super) channels: usize,
    pub(super) samples: Samples,
    /// Sample values of black and white by the format.
    pub(super) full: [f64; 2],
}

pub(super) enum Samples {
    Bytes(Vec<u8>),
    Words(Vec<u16>),
    Floats(Vec<f32>),
}

/// Creates an image with a value for each pixel.
fn gray(width: u32, height: u32, values: Vec<f32>) -> GrayImage32 {
    GrayImage32::from_raw(width, height, values).expect("every pixel has a sample")
}

impl Raster {
    /// # Errors
    /// [`Error::BadImage`] for an unsupported pixel type.
    pub(super) fn from_dynamic(image: DynamicImage) -> Result<Self> {
        use DynamicImage as D;
        use Samples::{Bytes, Floats, Words};
        let (width, height) = (image.width(), image.height());
        let channels = usize::from(image.color().channel_count());
        let (samples, white) = match image {
            D::ImageLuma8(image) => (Bytes(image.into_raw()), 255.0),
            D::ImageLumaA8(image) => (Bytes(image.into_raw()), 255.0),
            D::ImageRgb8(image) => (Bytes(image.into_raw()), 255.0),
            D::ImageRgba8(image) => (Bytes(image.into_raw()), 255.0),
            D::ImageLuma16(image) => (Words(image.into_raw()), 65_535.0),
            D::ImageLumaA16(image) => (Words(image.into_raw()), 65_535.0),
            D::ImageRgb16(image) => (Words(image.into_raw()), 65_535.0),
            D::ImageRgba16(image) => (Words(image.into_raw()), 65_535.0),
            D::ImageRgb32F(image) => (Floats(image.into_raw()), 1.0),
            D::ImageRgba32F(image) => (Floats(image.into_raw()), 1.0),
            _ => {
                return Err(Error::BadImage {
                    why: "its kind of pixel is not known".to_owned(),
                });
            }
        };
        Ok(Self {
            width,
            height,
            channels,
            samples,
            full: [0.0, white],
        })
    }

    /// Returns whether all pixels have their samples.
    pub(super) fn is_whole(&self) -> bool {
        let num_samples = match &self.samples {
            Samples::Bytes(bytes) => bytes.len(),
            Samples::Words(words) => words.len(),
            Samples::Floats(floats) => floats.len(),
        };
        num_samples == self.width as usize * self.height as usize * self.channels
    }

    /// Undoes the scaling to the full range of 16 bits.
    ///
    /// * `white`: the value of white in the file
    pub(super) fn unscale(&mut self, white: u16) {
        if let Samples::Words(words) = &mut self.samples {
            for word in words {
                let scaled = u32::from(*word) * u32::from(white);
                *word = ((scaled + 32_767) / 65_535) as u16;
            }
            self.full = [0.0, white.into()];
        }
    }

    /// Returns the number of samples per pixel without alpha.
    fn num_color_samples(&self) -> usize {
        if self.channels < 3 { 1 } else { 3 }
    }

    /// Returns the samples without alpha.
    fn colors<'a, T: Copy>(&self, samples: &'a [T]) -> impl Iterator<Item = T> + use<'a, T> {
        let num_color_samples = self.num_color_samples();
        let pixels = samples.chunks_exact(self.channels);
        pixels.flat_map(move |pixel| pixel[..num_color_samples].iter().copied())
    }

    /// Returns the values of black and white, if they differ from those of the format.
    pub(super) fn mapped(&self, range: PixelRange) -> Option<[f64; 2]> {
        match (range, &self.samples) {
            (PixelRange::Between(low, high), _) => Some([low, high]),
            (PixelRange::Full, _) | (PixelRange::Auto, Samples::Bytes(_)) => None,
            (PixelRange::Auto, Samples::Words(words)) => of_words(self.colors(words)),
            (PixelRange::Auto, Samples::Floats(floats)) => of_floats(self.colors(floats)),
        }
    }

    /// * `mapped`: values of black and white, if not those of the format
    pub(super) fn into_gray(self, mapped: Option<[f64; 2]>) -> GrayImage32 {
        let (width, height) = (self.width, self.height);
        if self.channels > 2 {
            let bytes = rgb_to_gray(&self.into_rgb(mapped)).into_raw();
            let values = bytes.into_iter().map(|v| f32::from(v) / 255.0);
            return gray(width, height, values.collect());
        }
        let range = mapped.unwrap_or(self.full);
        let unit = |value: f64| to_unit(value, range) as f32;
        let values = match &self.samples {
            Samples::Bytes(bytes) if mapped.is_none() => {
                self.colors(bytes).map(|v| f32::from(v) / 255.0).collect()
            }
            Samples::Bytes(bytes) => self.colors(bytes).map(|v| unit(v.into())).collect(),
            Samples::Words(words) => self.colors(words).map(|v| unit(v.into())).collect(),
            Samples::Floats(floats) => self.colors(floats).map(|v| unit(v.into())).collect(),
        };
        gray(width, height, values)
    }

    /// * `mapped`: values of black and white, if not those of the format
    pub(super) fn into_rgb(self, mapped: Option<[f64; 2]>) -> RgbImage {
        let range = mapped.unwrap_or(self.full);
        let bytes = match self.samples {
            Samples::Bytes(bytes) if mapped.is_none() => bytes,
            Samples::Bytes(bytes) => {
                let table = table(0..=u8::MAX, range);
                bytes.iter().map(|&v| table[usize::from(v)]).collect()
            }
            Samples::Words(words) => {
                let table = table(0..=u16::MAX, range);
                words.iter().map(|&v| table[usize::from(v)]).collect()
            }
            Samples::Floats(floats) => (floats.iter().map(|&v| to_byte(v.into(), range))).collect(),
        };
        let bytes = match self.channels {
            3 => bytes,
            channels => (bytes.chunks_exact(channels))
                .flat_map(|pixel| match *pixel {
                    [r, g, b, _] => [r, g, b],
                    _ => [pixel[0]; 3],
                })
                .collect(),
        };
        let (width, height) = (self.width, self.height);
        RgbImage::from_raw(width, height, bytes).expect("as many samples as pixels need")
    }
}

/// Returns the lookup table of all integers.
fn table<T: Into<f64>>(values: impl Iterator<Item = T>, range: [f64; 2]) -> Vec<u8> {
    values.map(|value| to_byte(value.into(), range)).collect()
}
