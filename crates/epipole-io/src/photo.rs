//! Photos: PNG, JPEG, WebP, TIFF, BMP and PNM files, with their EXIF data.

mod decode;
mod encode;
mod exif;
mod format;
mod jpeg;
mod prepare;
mod range;
mod raster;
#[cfg(test)]
mod tests;
mod tiff;

pub use decode::{DecodeOptions, Decoded, decode_gray, decode_rgb, sensor_size};
pub use encode::encode_jpeg;
pub use prepare::{PrepareOptions, PreparedPhoto, prepare_photo};
pub use range::PixelRange;
