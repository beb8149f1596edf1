//! The picture, and what is found at a place of the window: the change under every shift, and the
//! structure tensor.

use crate::kit::picture::gray_levels;
use crate::kit::scenes::square_picture;
use epipole::feature::{ShiftSurface, StructureTensorOptions, Window, WindowTensor, shift_surface};
use epipole::imaging::{Border, GrayImage32};
use image::RgbImage;
use nalgebra::Vector2;

/// Shifts of so many pixels to each side are tried.
pub(super) const REACH: usize = 8;
/// The part of the picture that is shown: left, top, width and height, pixels. Windows shifted as far as
/// possible see pixels around it.
pub(super) const SHOWN: (u32, u32, u32, u32) = (100, 75, 120, 90);
/// Half of the largest window, pixels.
pub(super) const LARGEST_HALF: u32 = 10;
/// What counts as a change, gray levels: the ellipse is where Taylor expects this root mean square.
pub(super) const CHANGE: f64 = 60.0;
/// Sobel's 3×3 filter answers 8 times the slope.
const SOBEL_GAIN_SQ: f64 = 64.0;

/// What the window lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Flat,
    Edge,
    Corner,
}

/// Everything that follows from the place of the window. Sums are by pixel of the window.
pub(super) struct Found {
    tensor: WindowTensor,
    surface: ShiftSurface,
    pixels: f64,
}

impl Found {
    /// The squared change under a shift by whole pixels; none beyond the reach.
    pub(super) fn change(&self, (du, dv): (f64, f64)) -> f64 {
        self.surface.at(du as i32, dv as i32).unwrap_or(0.0) / self.pixels
    }

    /// Taylor's estimate of the squared change under a shift.
    pub(super) fn estimate(&self, (du, dv): (f64, f64)) -> f64 {
        self.tensor.change(&Vector2::new(du, dv)) / self.pixels
    }

    /// The eigenvalues of the structure tensor, the larger first.
    pub(super) fn eigenvalues(&self) -> (f64, f64) {
        let (large, small) = self.tensor.eigenvalues();
        (large / self.pixels, small / self.pixels)
    }

    /// The shifts under which Taylor expects the change [`CHANGE`]: the half axes of the ellipse,
    /// pixels, the shorter first, and the direction of that one. An axis that the picture leaves
    /// open is a thousand pixels long.
    pub(super) fn ellipse(&self) -> (f64, f64, f64) {
        let (large, small) = self.eigenvalues();
        let half_axis = |lambda: f64| (CHANGE / lambda.sqrt().max(1e-9)).min(1000.0);
        let angle = self.tensor.direction_rad();
        (half_axis(large), half_axis(small), angle)
    }

    /// What the window lies on, if eigenvalues count as large from `threshold`.
    pub(super) fn verdict(&self, threshold: f64) -> Verdict {
        let (large, small) = self.eigenvalues();
        match (large >= threshold, small >= threshold) {
            (_, true) => Verdict::Corner,
            (true, false) => Verdict::Edge,
            (false, false) => Verdict::Flat,
        }
    }
}

/// The part of the picture that is shown, and all of it in gray levels.
pub(super) fn take_picture(noise: f64) -> (RgbImage, GrayImage32) {
    let whole = square_picture(noise);
    let (left, top, width, height) = SHOWN;
    let shown = image::imageops::crop_imm(&whole, left, top, width, height).to_image();
    (shown, gray_levels(&whole))
}

/// Measures the window of so many pixels with its middle at column u and row v.
///
/// # Errors
/// As the core's functions; places within the handle's range are never refused.
pub(super) fn find(
    gray: &GrayImage32,
    (u, v): (u32, u32),
    window_px: usize,
) -> epipole::Result<Found> {
    let surface = shift_surface(gray, (u, v), window_px / 2, REACH, Border::Reflect101)?;
    let options = StructureTensorOptions::default().with_window(Window::Box(window_px));
    let sums = WindowTensor::at(gray, (u, v), &options)?;
    let tensor = WindowTensor {
        uu: sums.uu / SOBEL_GAIN_SQ,
        uv: sums.uv / SOBEL_GAIN_SQ,
        vv: sums.vv / SOBEL_GAIN_SQ,
    };
    Ok(Found {
        tensor,
        surface,
        pixels: (window_px * window_px) as f64,
    })
}
