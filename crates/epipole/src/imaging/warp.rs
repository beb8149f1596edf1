//! Warping of images by affine maps and homographies.

use super::sample::{bicubic, bilinear};
use super::{Border, Channel};
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use derive_setters::Setters;
use image::{ImageBuffer, Pixel};
use nalgebra::{Matrix2x3, Matrix3};

/// Interpolation between pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Interpolation {
    /// From the four surrounding pixels.
    #[default]
    Bilinear,
    /// From the sixteen surrounding pixels, Catmull–Rom.
    Bicubic,
}

/// Options of a warp.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct WarpOptions {
    /// Width of the result, pixels.
    pub width: u32,
    /// Height of the result, pixels.
    pub height: u32,
    /// Interpolation between pixels.
    pub interpolation: Interpolation,
    /// Border of the image.
    pub border: Border,
}

impl WarpOptions {
    /// Returns options for the given size, bilinear, black outside the image.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            interpolation: Interpolation::Bilinear,
            border: Border::Constant(0.0),
        }
    }
}

/// Warps an image by an affine map: `out(x') = I(x)` where `x' = A x`, `A` = `out_from_image`.
///
/// * `out_from_image`: `[a b c; d e f]`, pixels to pixels, as for OpenCV's `warpAffine`
///
/// The only stage is [`Stage::Warping`].
///
/// # Errors
/// As [`warp_perspective`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{WarpOptions, gray_from_values, warp_affine};
/// use nalgebra::Matrix2x3;
/// let image = gray_from_values(3, 1, vec![1.0, 2.0, 3.0])?;
/// let right = Matrix2x3::new(1.0, 0.0, 1.0, 0.0, 1.0, 0.0);
/// let moved = warp_affine(&image, &right, &WarpOptions::new(3, 1), &mut ())?;
/// assert_eq!(moved.as_raw(), &[0.0, 1.0, 2.0]);
/// # Ok(()) }
/// ```
pub fn warp_affine<P: Pixel<Subpixel: Channel>>(
    image: &ImageBuffer<P, Vec<P::Subpixel>>,
    out_from_image: &Matrix2x3<f64>,
    options: &WarpOptions,
    monitor: &mut dyn Monitor,
) -> Result<ImageBuffer<P, Vec<P::Subpixel>>> {
    let mut map = Matrix3::identity();
    map.fixed_view_mut::<2, 3>(0, 0).copy_from(out_from_image);
    warp_perspective(image, &map, options, monitor)
}

/// Warps an image by a homography: `out(x') = I(x)` where `x' ~ H x`, `H` = `out_from_image`.
///
/// * `out_from_image`: pixels to pixels at any scale, as for OpenCV's `warpPerspective`
///
/// Accepts gray or color, bytes or floats. Result pixels without a finite source get the border's
/// constant, 0 unless set. The map is inverted for each pixel of the result; a map that shrinks the
/// image aliases, so [`resize`](super::resize()) or blur first. The only stage is
/// [`Stage::Warping`].
///
/// # Errors
/// [`Error::NotFinite`] for a matrix that is not finite, [`Error::Degenerate`] for one without an
/// inverse, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{WarpOptions, gray_from_values, warp_perspective};
/// use nalgebra::Matrix3;
/// let image = gray_from_values(2, 1, vec![1.0, 3.0])?;
/// let wider = Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into());
/// let out = warp_perspective(&image, &wider, &WarpOptions::new(3, 1), &mut ())?;
/// assert_eq!(out.as_raw(), &[1.0, 2.0, 3.0]);
/// let color = image::RgbImage::from_raw(2, 1, vec![0, 10, 20, 100, 10, 21]).expect("two pixels");
/// let out = warp_perspective(&color, &wider, &WarpOptions::new(3, 1), &mut ())?;
/// assert_eq!(out.get_pixel(1, 0).0, [50, 10, 21]);
/// # Ok(()) }
/// ```
pub fn warp_perspective<P: Pixel<Subpixel: Channel>>(
    image: &ImageBuffer<P, Vec<P::Subpixel>>,
    out_from_image: &Matrix3<f64>,
    options: &WarpOptions,
    monitor: &mut dyn Monitor,
) -> Result<ImageBuffer<P, Vec<P::Subpixel>>> {
    if out_from_image.iter().any(|v| !v.is_finite()) {
        return Err(Error::NotFinite {
            what: "every entry of the warp's matrix",
        });
    }
    let singular = Error::Degenerate {
        what: "the warp's inverse",
        why: "its matrix maps the image to a line or a point",
    };
    let scale = out_from_image.amax();
    if scale == 0.0 {
        return Err(singular);
    }
    let image_from_out = (out_from_image / scale)
        .try_inverse()
        .ok_or(singular.clone())?;
    if image_from_out.iter().any(|v| !v.is_finite()) {
        return Err(singular);
    }
    let m = image_from_out;
    let (size, border, raw) = (image.dimensions(), options.border, image.as_raw());
    let num_channels = usize::from(P::CHANNEL_COUNT);
    let row_len = num_channels * options.width as usize;
    let mut values = vec![Channel::from_float(0.0); row_len * options.height as usize];
    monitored::for_each_chunk(
        &mut values,
        row_len,
        Stage::Warping,
        monitor,
        |first, row| {
            let y = (first / row_len) as f64;
            for (column, pixel) in row.chunks_exact_mut(num_channels).enumerate() {
                let x = column as f64;
                let w = m[(2, 0)] * x + m[(2, 1)] * y + m[(2, 2)];
                let u = (m[(0, 0)] * x + m[(0, 1)] * y + m[(0, 2)]) / w;
                let v = (m[(1, 0)] * x + m[(1, 1)] * y + m[(1, 2)]) / w;
                for (channel, value) in pixel.iter_mut().enumerate() {
                    let read = |pixel: usize| raw[pixel * num_channels + channel].to_float();
                    *value = Channel::from_float(match options.interpolation {
                        Interpolation::Bilinear => bilinear(size, u, v, border, read),
                        Interpolation::Bicubic => bicubic(size, u, v, border, read),
                    });
                }
            }
        },
    )?;
    let out = ImageBuffer::from_raw(options.width, options.height, values);
    Ok(out.expect("every channel of every pixel was computed"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{GrayImage32, fixture};

    #[test]
    fn warps_equal_scipy() {
        let image = fixture::gray32("texture.npy");
        let mut options = WarpOptions::new(45, 35);
        options.border = Border::Replicate;
        let affine = Matrix2x3::new(0.9, 0.3, 2.0, -0.2, 1.1, 5.0);
        let ours = warp_affine(&image, &affine, &options, &mut ()).unwrap();
        let name = "warp_affine.npy";
        fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
        let homography = Matrix3::new(1.1, 0.2, -3.0, -0.1, 0.9, 4.0, 1e-3, -2e-3, 1.0);
        let ours = warp_perspective(&image, &homography, &options, &mut ()).unwrap();
        let name = "warp_perspective.npy";
        fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
    }

    #[test]
    fn matrices_without_an_inverse_are_refused() {
        let image = GrayImage32::new(4, 4);
        let options = WarpOptions::new(4, 4);
        for matrix in [
            Matrix3::zeros(),
            Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 0.0, 1.0),
        ] {
            let result = warp_perspective(&image, &matrix, &options, &mut ());
            assert!(matches!(result, Err(Error::Degenerate { .. })));
        }
        let nan = Matrix3::repeat(f64::NAN);
        assert!(warp_perspective(&image, &nan, &options, &mut ()).is_err());
    }

    #[test]
    fn a_horizon_inside_the_result_gives_no_nan() {
        let image = GrayImage32::from_pixel(8, 8, image::Luma([1.0]));
        let map = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.25, 0.0, 1.0);
        for interpolation in [Interpolation::Bilinear, Interpolation::Bicubic] {
            let options = WarpOptions {
                interpolation,
                ..WarpOptions::new(40, 8)
            };
            let out = warp_perspective(&image, &map, &options, &mut ()).unwrap();
            assert!(crate::imaging::is_finite(&out));
        }
    }
}
