//! Patches around features, rotated to their orientation, for comparison.

use crate::canvas::{Canvas, Stroke};
use crate::contract::{Panel, Rect};
use crate::kit::picture::Picture;
use epipole::feature::Keypoint;
use image::{Rgb, RgbImage};
use serde::{Deserialize, Serialize};

/// Side of a descriptor's window, in units of the feature's scale σ: four cells of width 3.
pub(crate) const WINDOW_SIGMAS: f64 = 12.0;

/// Position, scale and orientation of a feature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Spot {
    /// Column and row, pixels.
    pub(crate) place: [f64; 2],
    /// Scale σ at which it was detected, pixels.
    pub(crate) scale_px: f64,
    pub(crate) angle_rad: f64,
}

impl From<&Keypoint> for Spot {
    fn from(keypoint: &Keypoint) -> Self {
        Self {
            place: [keypoint.u, keypoint.v],
            scale_px: f64::from(keypoint.scale_px),
            angle_rad: f64::from(keypoint.angle_rad),
        }
    }
}

impl Spot {
    /// Returns half the side of the descriptor's window, pixels.
    pub(crate) fn half_px(&self) -> f64 {
        0.5 * WINDOW_SIGMAS * self.scale_px
    }

    /// Returns the pixel at an offset in the feature's own frame, in half windows along its
    /// orientation and perpendicular to it.
    pub(crate) fn at(&self, along: f64, across: f64) -> (f64, f64) {
        let (sin, cos) = (libm::sin(self.angle_rad), libm::cos(self.angle_rad));
        let half = self.half_px();
        (
            self.place[0] + half * (along * cos - across * sin),
            self.place[1] + half * (along * sin + across * cos),
        )
    }

    /// Returns whether its values are valid for drawing.
    pub(crate) fn is_sound(&self) -> bool {
        let [u, v] = self.place;
        // Written so that NaN is rejected.
        [u, v, self.scale_px, self.angle_rad]
            .iter()
            .all(|x| x.abs() < 1e5)
            && self.scale_px > 0.0
    }

    /// Resamples the descriptor's window, rotated so that the orientation points right, `side`
    /// pixels wide.
    pub(crate) fn cut(&self, photograph: &RgbImage, side: u32) -> RgbImage {
        let share = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(side) - 1.0;
        RgbImage::from_fn(side, side, |i, j| {
            bilinear(photograph, self.at(share(i), share(j)))
        })
    }
}

/// Interpolates the color bilinearly; edge pixels are repeated beyond the border.
fn bilinear(photograph: &RgbImage, (u, v): (f64, f64)) -> Rgb<u8> {
    let (width, height) = photograph.dimensions();
    let keep = |x: f64, size: u32| x.clamp(0.0, f64::from(size - 1));
    let (u, v) = (keep(u, width), keep(v, height));
    let (left, top) = (u as u32, v as u32);
    let (right, below) = ((left + 1).min(width - 1), (top + 1).min(height - 1));
    let (du, dv) = (u - f64::from(left), v - f64::from(top));
    Rgb(std::array::from_fn(|k| {
        let at = |x, y| f64::from(photograph.get_pixel(x, y).0[k]);
        let upper = (1.0 - du) * at(left, top) + du * at(right, top);
        let lower = (1.0 - du) * at(left, below) + du * at(right, below);
        ((1.0 - dv) * upper + dv * lower).round() as u8
    }))
}

/// Cache of patches.
#[derive(Default)]
pub(crate) struct Cuts {
    kept: Vec<(Spot, u64, RgbImage)>,
}

/// Side of a patch, pixels.
const SIDE: u32 = 48;

impl Cuts {
    /// Draws the window of a feature.
    ///
    /// * `version`: version of the photograph, to invalidate the cache
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Canvas,
        rect: Rect,
        photograph: &Picture,
        spot: &Spot,
        version: u64,
    ) {
        let known = |(other, of, _): &(Spot, u64, RgbImage)| other == spot && *of == version;
        let index = self.kept.iter().position(known).unwrap_or_else(|| {
            // Slightly more than a figure shows at a time.
            if self.kept.len() >= 40 {
                self.kept.remove(0);
            }
            let cut = spot.cut(photograph.image(), SIDE);
            self.kept.push((*spot, version, cut));
            self.kept.len() - 1
        });
        canvas.photograph(rect, &self.kept[index].2);
    }
}

/// Outlines the window of a feature's descriptor, with a line in its orientation.
pub(crate) fn draw_window(canvas: &mut Canvas, panel: &Panel, spot: &Spot, stroke: Stroke) {
    let at = |along, across| panel.canvas_from_world(spot.at(along, across));
    let corners = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    canvas.clipped(panel.rect, |canvas| {
        canvas.polygon_outline(&corners, stroke);
        canvas.line(at(0.0, 0.0), at(1.0, 0.0), stroke);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_is_turned_with_its_feature() {
        // Green increases to the right, red downwards.
        let photograph = RgbImage::from_fn(60, 60, |u, v| Rgb([4 * v as u8, 4 * u as u8, 0]));
        let spot = Spot {
            place: [30.0, 30.0],
            scale_px: 2.0,
            angle_rad: std::f64::consts::FRAC_PI_2,
        };
        assert_eq!(spot.half_px(), 12.0);
        let cut = spot.cut(&photograph, 6);
        // Its orientation is down, so the pixels below appear on the right, 2 · 12 · 5/6 pixels
        // apart.
        let (left, right) = (cut.get_pixel(0, 3).0, cut.get_pixel(5, 3).0);
        assert_eq!(right[0] - left[0], 80);
        assert_eq!(right[1], left[1]);
        let nowhere = Spot {
            place: [-500.0, 900.0],
            ..spot
        };
        assert_eq!(nowhere.cut(&photograph, 2).get_pixel(0, 0).0, [236, 0, 0]);
        assert!(
            nowhere.is_sound()
                && !Spot {
                    scale_px: f64::NAN,
                    ..spot
                }
                .is_sound()
        );
    }
}
