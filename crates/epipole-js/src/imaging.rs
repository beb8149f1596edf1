//! Filters for gray images, and warps for images of any kind.

pub(crate) mod pyramid;

use crate::fault::Result;
use crate::functions::functions;
use crate::images::{Field, Image, require_size, same_kind};
use crate::options::{Options, Setting};
use crate::output::structs;
use epipole::imaging::{self, Border, DerivativeFilter, GrayImage32, Interpolation, WarpOptions};
use epipole::nalgebra::{Matrix2x3, Matrix3};
use serde::{Deserialize, Serialize};

structs! {
    /// Partial derivatives of an image.
    struct Gradient as Gradient {
        /// Derivative along u, to the right.
        du: GrayImage32,
        /// Derivative along v, downwards.
        dv: GrayImage32,
        /// Length of the gradient.
        magnitude: GrayImage32,
        /// Direction of steepest ascent, atan2(dv, du), radians; 0 where the image is flat.
        orientation: GrayImage32,
    }
}

impl From<imaging::Gradient> for Gradient {
    fn from(gradient: imaging::Gradient) -> Self {
        Self {
            magnitude: gradient.magnitude(),
            orientation: gradient.orientation(),
            du: gradient.du,
            dv: gradient.dv,
        }
    }
}

/// [`WarpOptions`] with an optional size of the result.
#[derive(Default, Serialize, Deserialize)]
#[serde(rename = "WarpOptions", default, deny_unknown_fields)]
struct Warp {
    width: Option<u32>,
    height: Option<u32>,
    interpolation: Interpolation,
    border: Option<Border>,
}

impl Warp {
    fn of(self, image: &Image) -> Result<WarpOptions> {
        let (width, height) = image.dimensions();
        let (width, height) = (self.width.unwrap_or(width), self.height.unwrap_or(height));
        require_size("options", width, height)?;
        let options = WarpOptions::new(width, height).with_interpolation(self.interpolation);
        Ok(match self.border {
            Some(border) => options.with_border(border),
            None => options,
        })
    }
}

fn border(border: Option<Setting<Border>>) -> Border {
    border.map_or(Border::default(), |border| border.0)
}

functions! {
    /// Gradient by centered differences, slopes per pixel. A constant border has the unit of the
    /// values.
    fn centered_difference(image: Field, border: Option<Setting<Border>>) -> Gradient {
        imaging::centered_difference(&image.0, self::border(border)).into()
    }

    /// Gradient by the 3 x 3 Sobel filter, 8 times the slope per pixel.
    fn sobel(image: Field, border: Option<Setting<Border>>) -> Gradient {
        imaging::sobel(&image.0, self::border(border)).into()
    }

    /// Gradient by a filter of small integers, not divided by its gain: 8 for sobel3, 128 for
    /// sobel5, 32 for scharr.
    fn derivative(
        image: Field, kind: Option<Setting<DerivativeFilter>>, border: Option<Setting<Border>>
    ) -> Gradient {
        let kind = kind.map_or(DerivativeFilter::default(), |kind| kind.0);
        imaging::derivative(&image.0, kind, self::border(border)).into()
    }

    /// Gradient of the image blurred by a Gaussian of standard deviation `sigmaPx`, slopes per
    /// pixel.
    fn gaussian_derivative(
        image: Field, sigma_px: f64, border: Option<Setting<Border>>; monitor
    ) -> Gradient {
        imaging::gaussian_derivative(&image.0, sigma_px, self::border(border), monitor)?.into()
    }

    /// Image blurred by a Gaussian of standard deviation `sigmaPx`, cut off at about 4 of them.
    fn gaussian_blur(
        image: Field, sigma_px: f64, border: Option<Setting<Border>>; monitor
    ) -> GrayImage32 {
        imaging::gaussian_blur(&image.0, sigma_px, self::border(border), monitor)?
    }

    /// Mean of the `size` x `size` window around each pixel; `size` is odd.
    fn box_filter(
        image: Field, size: u32, border: Option<Setting<Border>>; monitor
    ) -> GrayImage32 {
        imaging::box_filter(&image.0, size as usize, self::border(border), monitor)?
    }

    /// Image correlated with a kernel with odd sides, which is not flipped.
    fn correlate(
        image: Field, kernel: Field, border: Option<Setting<Border>>; monitor
    ) -> GrayImage32 {
        imaging::correlate(&image.0, &kernel.0, self::border(border), monitor)?
    }

    /// Image moved by a homography from its pixels to those of the result, up to scale.
    fn warp_perspective(
        image: Image, out_from_image: Matrix3<f64>, options: Options<Warp>; monitor
    ) -> Image {
        let options = options.0.of(&image)?;
        same_kind!(&image, |pixels| {
            imaging::warp_perspective(pixels, &out_from_image, &options, monitor)?
        })
    }

    /// Image moved by an affine map, 2 x 3, from its pixels to those of the result.
    fn warp_affine(
        image: Image, out_from_image: Matrix2x3<f64>, options: Options<Warp>; monitor
    ) -> Image {
        let options = options.0.of(&image)?;
        same_kind!(&image, |pixels| {
            imaging::warp_affine(pixels, &out_from_image, &options, monitor)?
        })
    }
}
