//! Exports: zip files with a reconstruction, or with a project.

mod archive;
mod depth;
mod model;
mod order;
mod summary;

pub(crate) use archive::{open, save};
pub(crate) use model::reconstruction;
pub(crate) use order::Order;

use image::{DynamicImage, ImageFormat, RgbaImage};
use std::io::Cursor;

/// A picture of the screen as a PNG file.
///
/// # Errors
/// A sentence, if it did not arrive whole.
pub(crate) fn picture(width: u32, rgba: &[u8]) -> Result<Vec<u8>, String> {
    let height = (rgba.len() / 4) as u32 / width.max(1);
    let image = RgbaImage::from_raw(width, height, rgba.to_vec())
        .filter(|image| image.as_raw().len() == rgba.len() && width > 0 && height > 0)
        .ok_or("the picture did not arrive whole")?;
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(image)
        .to_rgb8()
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}
