//! A photo at one resolution.

use super::views::MvsView;
use crate::Result;
use crate::camera::{Camera, PosedCamera};
use crate::imaging::{GrayImage32, gray_to_u8, resize};

/// Maximum longer side of photos matched from random hypotheses, pixels.
const COARSEST_PX: u32 = 600;

/// A photo at one resolution.
#[derive(Debug, Clone)]
pub(super) struct Level {
    pub(super) camera: PosedCamera,
    pub(super) width: usize,
    pub(super) height: usize,
    /// Gray values of each pixel and its neighbors to the right, below and diagonal, from the
    /// lowest byte upwards, for bilinear sampling. Border pixels are repeated outside.
    pub(super) quads: Vec<u32>,
}

/// Returns the number of resolutions, each half of the next.
pub(super) fn num_levels(views: &[MvsView]) -> usize {
    let longest = |view: &MvsView| view.image.width().max(view.image.height());
    let longest = views.iter().map(longest).max().unwrap_or(0);
    (0..)
        .find(|level| longest >> level <= COARSEST_PX)
        .unwrap_or(0)
        + 1
}

impl Level {
    /// * `gray`: image at full resolution
    /// * `halvings`: number of times the size is halved
    ///
    /// # Errors
    /// As [`resize`], for a photo without pixels.
    pub(super) fn new(view: &MvsView, gray: &GrayImage32, halvings: usize) -> Result<Self> {
        let full = gray.dimensions();
        let half = |side: u32| (side >> halvings).max(1);
        let size = (half(full.0), half(full.1));
        let values = match halvings {
            0 => gray_to_u8(gray).into_raw(),
            _ => gray_to_u8(&resize(gray, size.0, size.1)?).into_raw(),
        };
        let intrinsics = view.camera.camera.intrinsics.resized(full, size)?;
        let (width, height) = (size.0 as usize, size.1 as usize);
        let read =
            |u: usize, v: usize| u32::from(values[v.min(height - 1) * width + u.min(width - 1)]);
        let mut quads = Vec::with_capacity(width * height);
        for v in 0..height {
            quads.extend((0..width).map(|u| {
                read(u, v) | read(u + 1, v) << 8 | read(u, v + 1) << 16 | read(u + 1, v + 1) << 24
            }));
        }
        Ok(Self {
            camera: PosedCamera {
                camera: Camera::pinhole(intrinsics, size.0, size.1),
                cam_from_world: view.camera.cam_from_world,
            },
            width,
            height,
            quads,
        })
    }

    /// Returns the gray value of a pixel, 0 to 255; border pixels are repeated outside.
    #[inline(always)]
    pub(super) fn gray(&self, u: isize, v: isize) -> u8 {
        let column = u.clamp(0, self.width as isize - 1) as usize;
        let row = v.clamp(0, self.height as isize - 1) as usize;
        self.quads[row * self.width + column] as u8
    }

    /// Returns whether a position is within the image.
    #[inline(always)]
    pub(super) fn contains(&self, x: f32, y: f32) -> bool {
        x >= 0.0 && y >= 0.0 && x <= self.width as f32 - 1.0 && y <= self.height as f32 - 1.0
    }
}
