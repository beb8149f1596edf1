//! The long computation behind `harris`: the picture, its response and the local maxima.

use crate::contract::{Problem, Progress};
use crate::scenes::{self, square_picture};
use epipole::feature::{
    StructureTensorOptions, Window, WindowTensor, harris_response, non_maximum_suppression,
};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use epipole::synthetic::still_life_camera;
use image::RgbImage;
use serde::{Deserialize, Serialize};

/// Size of the rendered photograph, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = (480, 360);
/// Noise of the test pattern, gray levels.
const PATTERN_NOISE: f64 = 2.5;
/// Half the window of non-maximum suppression, pixels.
const SUPPRESSION_RADIUS_PX: usize = 4;
/// More maxima than this help nobody.
const MAX_PEAKS: usize = 4000;

/// Where the picture comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Source {
    /// A tilted square on a plain ground, with a little noise.
    Pattern,
    /// The rendered still life.
    StillLife,
    /// The reader's own: width, height, RGB bytes.
    Own(u32, u32, Vec<u8>),
}

/// Everything that the answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    pub(super) source: Source,
    pub(super) k: f32,
    pub(super) window_px: usize,
}

/// What the computation finds, as it travels.
#[derive(Serialize, Deserialize)]
struct Wire {
    size: (u32, u32),
    rgb: Vec<u8>,
    response: Vec<f32>,
    peaks: Vec<(u32, u32)>,
}

/// What the computation finds.
pub(super) struct Answer {
    pub(super) picture: RgbImage,
    gray: GrayImage32,
    /// Harris response, in gray levels to the fourth power.
    pub(super) response: GrayImage32,
    /// Local maxima, strongest first.
    pub(super) peaks: Vec<(u32, u32)>,
    pub(super) window_px: usize,
    pub(super) k: f32,
}

/// Gray levels divided by 8, what Sobel's 3×3 filter multiplies slopes by: gradients are then gray
/// levels a pixel.
fn gray_levels(picture: &RgbImage) -> GrayImage32 {
    let mut gray = rgb_to_gray_f32(picture, &BT601_WEIGHTS);
    gray.pixels_mut()
        .for_each(|pixel| pixel.0[0] *= 255.0 / 8.0);
    gray
}

fn options(window_px: usize) -> StructureTensorOptions {
    StructureTensorOptions {
        window: Window::Box(window_px),
        ..StructureTensorOptions::default()
    }
}

impl Request {
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        postcard::to_allocvec(self).unwrap_or_default()
    }

    /// Carries out the computation.
    ///
    /// # Errors
    /// A sentence about the picture.
    pub(super) fn compute(bytes: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, Problem> {
        let unreadable = |_| epipole::Error::Degenerate {
            what: "the corner response",
            why: "the request cannot be read",
        };
        let request: Self = postcard::from_bytes(bytes).map_err(unreadable)?;
        let picture = match request.source {
            Source::Pattern => square_picture(PATTERN_NOISE),
            Source::StillLife => still_life(progress)?,
            Source::Own(width, height, rgb) => RgbImage::from_raw(width, height, rgb)
                .unwrap_or_else(|| RgbImage::new(width.min(1), height.min(1))),
        };
        let gray = gray_levels(&picture);
        let response = harris_response(&gray, request.k, &options(request.window_px))?;
        if progress(0.8).is_break() {
            return Err(epipole::Error::Canceled.into());
        }
        let mut peaks = non_maximum_suppression(&response, SUPPRESSION_RADIUS_PX, 0.0)?;
        peaks.truncate(MAX_PEAKS);
        let wire = Wire {
            size: picture.dimensions(),
            rgb: picture.into_raw(),
            response: response.into_raw(),
            peaks: peaks
                .iter()
                .map(|peak| (peak.u as u32, peak.v as u32))
                .collect(),
        };
        Ok(postcard::to_allocvec(&wire).unwrap_or_default())
    }
}

impl Answer {
    /// Reads the answer to `request`; `None` if it is no answer.
    pub(super) fn from_bytes(bytes: &[u8], request: &Request) -> Option<Self> {
        let wire: Wire = postcard::from_bytes(bytes).ok()?;
        let picture = RgbImage::from_raw(wire.size.0, wire.size.1, wire.rgb)?;
        Some(Self {
            gray: gray_levels(&picture),
            response: GrayImage32::from_raw(wire.size.0, wire.size.1, wire.response)?,
            peaks: wire.peaks,
            window_px: request.window_px,
            k: request.k,
            picture,
        })
    }

    /// The largest response of the picture; positive, so that shares of it make sense.
    pub(super) fn strongest(&self) -> f32 {
        let first = self.peaks.first();
        first.map_or(f32::MIN_POSITIVE, |&(u, v)| {
            self.response.get_pixel(u, v).0[0]
        })
    }

    /// The structure tensor at a pixel.
    pub(super) fn tensor(&self, u: u32, v: u32) -> Option<WindowTensor> {
        WindowTensor::at(&self.gray, (u, v), &options(self.window_px)).ok()
    }
}

fn still_life(progress: Progress<'_>) -> Result<RgbImage, Problem> {
    let (width, height) = STILL_LIFE_SIZE;
    let camera = still_life_camera(width, height);
    let photograph =
        scenes::photograph(&camera, STILL_LIFE_SIZE, &mut |share| progress(0.7 * share));
    Ok(photograph?)
}
