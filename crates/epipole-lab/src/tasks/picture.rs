//! Writing of a rendered view as a PNG file.

use super::task::Task;
#[cfg(feature = "files")]
use super::task::{Monitor, Run};
use crate::project::Blob;
use serde::{Deserialize, Serialize};

/// Writes a rendered view as a PNG file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WritePicture {
    /// Width, pixels.
    pub width: u32,
    /// Red, green, blue, opacity, row by row.
    pub rgba: Blob,
}

impl Task for WritePicture {
    /// A PNG file.
    type Output = Blob;
}

#[cfg(feature = "files")]
impl Run for WritePicture {
    fn run(self, _monitor: Monitor<'_>) -> Result<Blob, String> {
        use image::{DynamicImage, ImageFormat, RgbaImage};
        use std::io::Cursor;
        let Self { width, rgba } = self;
        let height = (rgba.len() / 4) as u32 / width.max(1);
        let image = RgbaImage::from_raw(width, height, rgba.to_vec())
            .filter(|image| image.as_raw().len() == rgba.len() && width > 0 && height > 0)
            .ok_or("the picture did not arrive whole")?;
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::from(image)
            .to_rgb8()
            .write_to(&mut bytes, ImageFormat::Png)
            .map_err(|error| error.to_string())?;
        Ok(bytes.into_inner().into())
    }
}
