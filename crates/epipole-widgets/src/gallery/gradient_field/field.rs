//! An image with its gradient at every pixel, and a synthetic edge with known gradient.

use crate::kit::picture;
use epipole::imaging::{
    Border, Gradient, GrayImage32, centered_difference, gaussian_blur, gaussian_derivative,
    gaussian_derivative_kernels, gray_to_u8, noise_gain,
};
use epipole::math::random::Random;
use image::{Luma, RgbImage};
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;

/// Columns and rows of the edge image, of a photograph's surface patch, and of its grid of arrows.
pub(super) const GRID: (u32, u32) = (24, 18);
/// Hidden margin around the edge image, pixels, so that no filter sees a border.
const MARGIN: u32 = 22;
/// Gray level of the dark side.
const DARK: f64 = 68.0;
/// Difference between the dark and the bright side, gray levels.
const STEP: f64 = 120.0;
/// Width of the ramp, pixels: the slope is 20 gray levels per pixel.
const RAMP_PX: f64 = 6.0;
/// Maximum distance of an edge pixel from the middle of the ramp, pixels.
const ON_EDGE_PX: f64 = 1.5;

/// The gradient at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arrow {
    /// Column and row.
    pub(super) at: (f64, f64),
    /// Iᵤ and Iᵥ, gray levels per pixel.
    pub(super) du: f64,
    pub(super) dv: f64,
}

impl Arrow {
    pub(super) fn magnitude(&self) -> f64 {
        libm::hypot(self.du, self.dv)
    }

    /// Returns the direction, clockwise from the right, degrees in (−180, 180].
    pub(super) fn angle_deg(&self) -> f64 {
        libm::atan2(self.dv, self.du).to_degrees()
    }
}

/// Gray levels, smoothed or not, and their gradient.
#[derive(Serialize, Deserialize)]
pub(super) struct Field {
    #[serde(with = "picture::floats")]
    levels: GrayImage32,
    #[serde(with = "picture::floats")]
    du: GrayImage32,
    #[serde(with = "picture::floats")]
    dv: GrayImage32,
    #[serde(skip)]
    shown: OnceCell<(RgbImage, Vec<Arrow>)>,
}

impl Field {
    /// Computes the gradient of an image in gray levels: by centered differences, or by the
    /// derivative of a Gaussian.
    ///
    /// # Errors
    /// As [`gaussian_derivative`].
    pub(super) fn new(levels: &GrayImage32, smooth_px: Option<f64>) -> epipole::Result<Self> {
        let border = Border::Replicate;
        let (levels, Gradient { du, dv }) = match smooth_px {
            None => (levels.clone(), centered_difference(levels, border)),
            Some(sigma_px) => (
                gaussian_blur(levels, sigma_px, border, &mut ())?,
                gaussian_derivative(levels, sigma_px, border, &mut ())?,
            ),
        };
        let shown = OnceCell::new();
        Ok(Self {
            levels,
            du,
            dv,
            shown,
        })
    }

    /// Returns the part inside the margin of the edge image.
    fn inside(self) -> Self {
        let cut = |image: &GrayImage32| {
            image::imageops::crop_imm(image, MARGIN, MARGIN, GRID.0, GRID.1).to_image()
        };
        let [levels, du, dv] = [&self.levels, &self.du, &self.dv].map(cut);
        Self {
            levels,
            du,
            dv,
            ..self
        }
    }

    pub(super) fn size(&self) -> (u32, u32) {
        self.levels.dimensions()
    }

    /// Whether all images have this size and finite values.
    pub(super) fn fits(&self, size: (u32, u32)) -> bool {
        let is_good = |image: &GrayImage32| {
            image.dimensions() == size && image.iter().all(|value| value.is_finite())
        };
        [&self.levels, &self.du, &self.dv].into_iter().all(is_good)
    }

    pub(super) fn level(&self, (u, v): (u32, u32)) -> f64 {
        f64::from(self.levels.get_pixel(u, v).0[0])
    }

    /// Returns the gradient at a pixel of the image.
    pub(super) fn at(&self, (u, v): (u32, u32)) -> Arrow {
        Arrow {
            at: (f64::from(u), f64::from(v)),
            du: f64::from(self.du.get_pixel(u, v).0[0]),
            dv: f64::from(self.dv.get_pixel(u, v).0[0]),
        }
    }

    /// Returns the image in gray levels.
    pub(super) fn picture(&self) -> &RgbImage {
        &self.shown().0
    }

    /// Returns one gradient per grid cell, the steepest in it; for the edge a cell is one pixel.
    pub(super) fn arrows(&self) -> &[Arrow] {
        &self.shown().1
    }

    fn shown(&self) -> &(RgbImage, Vec<Arrow>) {
        self.shown.get_or_init(|| {
            let shares = GrayImage32::from_fn(self.levels.width(), self.levels.height(), |u, v| {
                Luma([self.levels.get_pixel(u, v).0[0] / 255.0])
            });
            let gray = gray_to_u8(&shares);
            let picture = RgbImage::from_fn(gray.width(), gray.height(), |u, v| {
                image::Rgb([gray.get_pixel(u, v).0[0]; 3])
            });
            (picture, self.steepest())
        })
    }

    fn steepest(&self) -> Vec<Arrow> {
        let (width, height) = self.size();
        let side = (width.div_ceil(GRID.0)).max(height.div_ceil(GRID.1)).max(1);
        let mut arrows = Vec::new();
        for top in (0..height).step_by(side as usize) {
            for left in (0..width).step_by(side as usize) {
                let cell = (top..(top + side).min(height))
                    .flat_map(|v| (left..(left + side).min(width)).map(move |u| (u, v)))
                    .map(|pixel| self.at(pixel));
                arrows.extend(cell.max_by(|a, b| a.magnitude().total_cmp(&b.magnitude())));
            }
        }
        arrows
    }
}

/// A straight edge: a ramp from dark to bright, with noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    /// Direction of the edge, clockwise from the right, degrees.
    pub(super) angle_deg: f64,
    /// Standard deviation of the noise of each pixel, gray levels.
    pub(super) noise: f64,
    pub(super) seed: u64,
}

impl Edge {
    /// Returns the direction toward the bright side, 90° counterclockwise from the edge, degrees.
    pub(super) fn uphill_deg(&self) -> f64 {
        self.angle_deg - 90.0
    }

    /// Returns the distance of a shown pixel from the edge's middle line, positive on the bright
    /// side.
    fn distance_px(&self, (u, v): (f64, f64)) -> f64 {
        let up = self.uphill_deg().to_radians();
        let x = u - f64::from(GRID.0 - 1) / 2.0;
        let y = v - f64::from(GRID.1 - 1) / 2.0;
        x * libm::cos(up) + y * libm::sin(up)
    }

    /// Returns the gradient field of the edge, without the margin.
    ///
    /// # Errors
    /// As [`Field::new`].
    pub(super) fn field(&self, smooth_px: Option<f64>) -> epipole::Result<Field> {
        let mut random = Random::new(self.seed);
        let shown = |at: u32| f64::from(at) - f64::from(MARGIN);
        let levels = GrayImage32::from_fn(GRID.0 + 2 * MARGIN, GRID.1 + 2 * MARGIN, |u, v| {
            let clean = ramp(self.distance_px((shown(u), shown(v))));
            Luma([(clean + self.noise * random.normal()) as f32])
        });
        Ok(Field::new(&levels, smooth_px)?.inside())
    }

    /// Returns the RMS angle between the gradients on the edge and their true direction, degrees.
    pub(super) fn off_deg(&self, field: &Field) -> f64 {
        let on_edge = |arrow: &&Arrow| self.distance_px(arrow.at).abs() <= ON_EDGE_PX;
        let squares: Vec<f64> = (field.arrows().iter().filter(on_edge))
            .map(|arrow| {
                let off = arrow.angle_deg() - self.uphill_deg();
                let off = off - 360.0 * (off / 360.0).round();
                off * off
            })
            .collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    }
}

fn ramp(distance_px: f64) -> f64 {
    DARK + STEP * (0.5 + distance_px / RAMP_PX).clamp(0.0, 1.0)
}

/// Returns the standard deviation of a slope for pixel noise of standard deviation 1.
///
/// # Errors
/// As [`gaussian_derivative_kernels`].
pub(super) fn noise_left(smooth_px: Option<f64>) -> epipole::Result<f64> {
    let Some(sigma_px) = smooth_px else {
        return Ok(noise_gain(&[-0.5, 0.0, 0.5]));
    };
    let (smooth, slope) = gaussian_derivative_kernels(sigma_px)?;
    Ok(noise_gain(&smooth) * noise_gain(&slope))
}

/// Returns the slope of the edge after smoothing, gray levels per pixel.
///
/// # Errors
/// As [`Field::new`].
pub(super) fn slope_left(smooth_px: Option<f64>) -> epipole::Result<f64> {
    let width = 2 * MARGIN + 1;
    let across = GrayImage32::from_fn(width, 1, |u, _| {
        Luma([ramp(f64::from(u) - f64::from(MARGIN)) as f32])
    });
    Ok(Field::new(&across, smooth_px)?.at((MARGIN, 0)).du)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLEAN: Edge = Edge {
        angle_deg: 120.0,
        noise: 0.0,
        seed: 1,
    };

    #[test]
    fn on_a_clean_edge_the_gradient_is_the_slope_across_it() {
        for angle_deg in [0.0, 35.0, 120.0, 180.0] {
            let edge = Edge { angle_deg, ..CLEAN };
            let field = edge.field(None).unwrap();
            let middle = field.at((12, 9));
            assert!(
                (middle.magnitude() - STEP / RAMP_PX).abs() < 1e-4,
                "{angle_deg}"
            );
            assert!(edge.off_deg(&field) < 1e-3, "{angle_deg}");
        }
        assert_eq!(CLEAN.field(None).unwrap().at((0, 17)).magnitude(), 0.0);
    }

    #[test]
    fn noise_and_slope_fall_as_predicted() {
        // NumPy: x = np.arange(-8, 9), g = exp(−x²/8) / Σ, Σ x g ramp / Σ x² g, with the ramp of
        // 120 over 6.
        for (smooth_px, slope) in [(None, 20.0), (Some(2.0), 17.495), (Some(4.0), 10.987)] {
            assert!((slope_left(smooth_px).unwrap() - slope).abs() < 0.001);
        }
        let flat = Edge {
            noise: 10.0,
            ..CLEAN
        };
        for smooth_px in [None, Some(1.0)] {
            let (mut sum, mut count) = (0.0, 0.0);
            for seed in 1..=20 {
                let field = Edge { seed, ..flat }.field(smooth_px).unwrap();
                let far = |arrow: &&Arrow| flat.distance_px(arrow.at).abs() > 8.0;
                for arrow in field.arrows().iter().filter(far) {
                    sum += arrow.du * arrow.du;
                    count += 1.0;
                }
            }
            let (measured, predicted) = (
                f64::sqrt(sum / count),
                10.0 * noise_left(smooth_px).unwrap(),
            );
            assert!(
                (measured / predicted - 1.0).abs() < 0.06,
                "{measured} {predicted}"
            );
        }
    }

    #[test]
    fn smoothing_puts_the_arrows_right() {
        let noisy = Edge {
            noise: 20.0,
            ..CLEAN
        };
        let off = |smooth_px| noisy.off_deg(&noisy.field(smooth_px).unwrap());
        assert!(
            off(None) > 25.0 && off(Some(2.0)) < 6.0,
            "{} {}",
            off(None),
            off(Some(2.0))
        );
    }
}
