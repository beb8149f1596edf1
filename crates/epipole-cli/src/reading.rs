//! Options of reading photos: values, memory, size.

use crate::context::Context;
use crate::failure::Failure;
use crate::matrices::positive;
use clap::Args;
use epipole_io::photo::PixelRange;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Bytes per pixel while a photo is read: the decoded image and its upright copy.
const BYTES_PER_PIXEL: f64 = 6.0;

/// Reading of photos.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Images")]
pub(crate) struct ReadArguments {
    /// Values of the file that become black and white: its used range, if it has more than 8 bits
    /// (auto); its full range (full); or two numbers.
    #[arg(long, value_name = "auto|full|LOW,HIGH", default_value = "auto", value_parser = range, allow_hyphen_values = true)]
    pub(crate) range: PixelRange,
    /// Maximum memory for reading an image, at 6 bytes per pixel before downscaling.
    #[arg(long, value_name = "GB", default_value_t = 2.0, value_parser = positive)]
    max_memory_gb: f64,
}

impl ReadArguments {
    /// Returns the maximum number of pixels of a file.
    pub(crate) fn max_file_pixels(self) -> u64 {
        (self.max_memory_gb * 1e9 / BYTES_PER_PIXEL) as u64
    }

    /// Describes why a photo cannot be read.
    pub(crate) fn failure(self, error: epipole_io::Error, path: &Path) -> Failure {
        let failure = match error {
            epipole_io::Error::TooManyPixels { got, .. } => {
                let needed_gb = got as f64 * BYTES_PER_PIXEL / 1e9;
                let message = format!(
                    "the image has {:.1} megapixels, more than --max-memory-gb {} holds: {:.1} would do",
                    got as f64 / 1e6,
                    self.max_memory_gb,
                    needed_gb + 0.05
                );
                Failure::new("too-large", message)
            }
            error => error.into(),
        };
        failure.about(path)
    }

    /// Warns once per run which values became black and white, if the range is automatic.
    pub(crate) fn warn_of_range(self, range: Option<[f64; 2]>, path: &Path, context: &Context) {
        static IS_REPORTED: AtomicBool = AtomicBool::new(false);
        let (PixelRange::Auto, Some([low, high])) = (self.range, range) else {
            return;
        };
        if !IS_REPORTED.swap(true, Ordering::Relaxed) {
            let [low, high] = [low, high].map(six_digits);
            context.warn(&format!(
                "{} has more than 8 bits, of which the values from {low} to {high} are in use: these become black and \
                 white. Each such image has its own range; --range {low},{high} is one for all",
                path.display()
            ));
        }
    }
}

/// Rounds to six significant digits.
fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Reads "auto", "full" or two numbers.
fn range(text: &str) -> Result<PixelRange, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    match text {
        "auto" => Ok(PixelRange::Auto),
        "full" => Ok(PixelRange::Full),
        _ => match text.split_once(',').map(|(a, b)| (number(a), number(b))) {
            Some((Some(low), Some(high))) if low < high => Ok(PixelRange::Between(low, high)),
            Some((Some(_), Some(_))) => Err("the second number must be above the first".to_owned()),
            _ => Err("it must be auto, full, or two numbers: LOW,HIGH".to_owned()),
        },
    }
}

/// Size of photos.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Images")]
pub(crate) struct SizeArguments {
    /// Downscale images to at most M megapixels. Results are in pixels of the downscaled image; --k
    /// and --focal-px are in pixels of the file.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub(crate) max_megapixels: Option<f64>,
    /// Longer side of the sensor, mm, for images whose EXIF data have the focal length in
    /// millimeters only.
    #[arg(long, value_name = "W", value_parser = positive)]
    pub(crate) sensor_width_mm: Option<f64>,
    #[command(flatten)]
    pub(crate) reading: ReadArguments,
}

impl From<ReadArguments> for SizeArguments {
    /// Returns options without downscaling.
    fn from(reading: ReadArguments) -> Self {
        Self {
            max_megapixels: None,
            sensor_width_mm: None,
            reading,
        }
    }
}

impl SizeArguments {
    /// Returns the maximum number of pixels of the result.
    pub(crate) fn max_pixels(self) -> u64 {
        // The cast saturates.
        let pixels = |megapixels: f64| (megapixels * 1e6).round().max(1.0) as u64;
        self.max_megapixels.map_or(u64::MAX, pixels)
    }
}
