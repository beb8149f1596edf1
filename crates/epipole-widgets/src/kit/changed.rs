//! A photograph that is rotated, scaled and changed in brightness, around a point.

use epipole::Error;
use epipole::imaging::{Border, GrayImage32, gaussian_blur, sample_bilinear};
use serde::{Deserialize, Serialize};

/// Side of the changed crop of the photograph, pixels; then its middle.
const PIECE_PX: u32 = 161;
pub(crate) const MIDDLE: f64 = (PIECE_PX / 2) as f64;

/// A change of the photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Change {
    pub(crate) turn_rad: f64,
    pub(crate) zoom: f64,
    /// Offset of gray values in [0, 1].
    pub(crate) brighter: f64,
    /// Factor on differences from middle gray.
    pub(crate) contrast: f64,
}

impl Change {
    pub(crate) const NONE: Self = Self {
        turn_rad: 0.0,
        zoom: 1.0,
        brighter: 0.0,
        contrast: 1.0,
    };

    /// Returns a crop of the changed photograph around a position in the original.
    ///
    /// # Errors
    /// As [`gaussian_blur`].
    pub(crate) fn piece(
        &self,
        gray: &GrayImage32,
        place: (f64, f64),
    ) -> Result<GrayImage32, Error> {
        let (sin, cos) = (libm::sin(self.turn_rad), libm::cos(self.turn_rad));
        // Blurs before downscaling, to avoid aliasing.
        let blur_px = 0.5 * (1.0 / (self.zoom * self.zoom) - 1.0).max(0.0).sqrt();
        let smooth;
        let source = match blur_px > 0.1 {
            true => {
                smooth = gaussian_blur(gray, blur_px, Border::Replicate, &mut ())?;
                &smooth
            }
            false => gray,
        };
        Ok(GrayImage32::from_fn(PIECE_PX, PIECE_PX, |i, j| {
            let (x, y) = (f64::from(i) - MIDDLE, f64::from(j) - MIDDLE);
            let u = place.0 + (x * cos + y * sin) / self.zoom;
            let v = place.1 + (y * cos - x * sin) / self.zoom;
            let value = f64::from(sample_bilinear(source, u, v, Border::Replicate));
            let lit = (value - 0.5) * self.contrast + 0.5 + self.brighter;
            image::Luma([lit.clamp(0.0, 1.0) as f32])
        }))
    }
}
