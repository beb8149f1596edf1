//! The picture, and measurements of a window: the change for every shift, and the structure tensor.

use crate::kit::picture::gray_levels;
use crate::kit::scenes::square_picture;
use epipole::feature::{ShiftSurface, StructureTensorOptions, Window, WindowTensor, shift_surface};
use epipole::imaging::{Border, GrayImage32};
use image::RgbImage;
use nalgebra::Vector2;

/// Maximum shift along each axis, pixels.
pub(super) const REACH: usize = 8;
/// Visible part of the picture: left, top, width and height, pixels. Shifted windows also use
/// pixels around it.
pub(super) const SHOWN: (u32, u32, u32, u32) = (100, 75, 120, 90);
/// Half size of the largest window, pixels.
pub(super) const LARGEST_HALF: u32 = 10;
/// Root mean square change on the ellipse of Taylor's estimate, gray levels.
pub(super) const CHANGE: f64 = 60.0;
/// Squared gain of the 3 × 3 Sobel filter, which is 8 times the slope.
const SOBEL_GAIN_SQ: f64 = 64.0;

/// Classification of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Flat,
    Edge,
    Corner,
}

/// Measurements of a window. Sums are divided by its number of pixels.
pub(super) struct Found {
    tensor: WindowTensor,
    surface: ShiftSurface,
    pixels: f64,
}

impl Found {
    /// Returns the squared change for a shift by whole pixels; 0 beyond the reach.
    pub(super) fn change(&self, (du, dv): (f64, f64)) -> f64 {
        self.surface.at(du as i32, dv as i32).unwrap_or(0.0) / self.pixels
    }

    /// Returns Taylor's estimate of the squared change for a shift.
    pub(super) fn estimate(&self, (du, dv): (f64, f64)) -> f64 {
        self.tensor.change(&Vector2::new(du, dv)) / self.pixels
    }

    /// Returns the eigenvalues of the structure tensor, larger first.
    pub(super) fn eigenvalues(&self) -> (f64, f64) {
        let (large, small) = self.tensor.eigenvalues();
        (large / self.pixels, small / self.pixels)
    }

    /// Returns the ellipse of shifts with an estimated change of [`CHANGE`]: the semi-axes in
    /// pixels, shorter first, and the direction of the shorter one. An undetermined axis is a
    /// thousand pixels long.
    pub(super) fn ellipse(&self) -> (f64, f64, f64) {
        let (large, small) = self.eigenvalues();
        let half_axis = |lambda: f64| (CHANGE / lambda.sqrt().max(1e-9)).min(1000.0);
        let angle = self.tensor.direction_rad();
        (half_axis(large), half_axis(small), angle)
    }

    /// Classifies the window; eigenvalues are large from `threshold` on.
    pub(super) fn verdict(&self, threshold: f64) -> Verdict {
        let (large, small) = self.eigenvalues();
        match (large >= threshold, small >= threshold) {
            (_, true) => Verdict::Corner,
            (true, false) => Verdict::Edge,
            (false, false) => Verdict::Flat,
        }
    }
}

/// Returns the visible part of the picture, and the whole picture in gray levels.
pub(super) fn take_picture(noise: f64) -> (RgbImage, GrayImage32) {
    let whole = square_picture(noise);
    let (left, top, width, height) = SHOWN;
    let shown = image::imageops::crop_imm(&whole, left, top, width, height).to_image();
    (shown, gray_levels(&whole))
}

/// Measures a window of this size, pixels, centered at column u and row v.
///
/// # Errors
/// As the core's functions; positions within the handle's range never fail.
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
