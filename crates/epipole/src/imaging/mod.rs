//! Gray images: borders, filters, gradients, pyramids, resizing and warps.
//!
//! Pixel centers are at integers and (u, v) = (column, row). Filters are sums over pixels: a NaN
//! pixel affects only the results that use it. An image without pixels gives an image without
//! pixels.
//!
//! Image types are those of the `image` crate: [`GrayImage32`] for floats, `image::GrayImage` for
//! bytes.

pub(crate) mod approx;
mod border;
mod bytes;
mod channel;
mod correlate;
#[cfg(test)]
pub(crate) mod fixture;
mod gaussian;
mod gradient;
mod gray;
mod integral;
pub(crate) mod kernel;
mod pyramid;
mod reduce;
mod resize;
pub(crate) mod rows;
mod sample;
pub(crate) mod separable;
mod sharpness;
pub(crate) mod short_derivative;
mod warp;
mod weigh;

pub use border::Border;
pub(crate) use bytes::gaussian_blur_u8;
pub(crate) use channel::Channel;
pub use correlate::{correlate, noise_gain};
pub use gaussian::{gaussian_blur, gaussian_derivative_kernels, gaussian_kernel};
pub use gradient::{
    DerivativeFilter, Gradient, centered_difference, derivative, gaussian_derivative, sobel,
};
#[cfg(test)]
pub(crate) use gray::is_finite;
pub use gray::{
    BT601_WEIGHTS, BT709_WEIGHTS, GrayImage32, gray_from_values, gray_to_f32, gray_to_u8,
    rgb_to_gray, rgb_to_gray_f32,
};
pub(crate) use gray::{from_vec, require_finite};
pub use integral::{IntegralImage, box_filter};
pub use pyramid::{
    from_laplacian_pyramid, gaussian_pyramid, laplacian_pyramid, pyramid_down, pyramid_up,
};
pub use reduce::reduce_rgb;
pub use resize::resize;
pub(crate) use sample::bilinear;
pub use sample::{sample_bicubic, sample_bilinear};
pub use separable::separable_filter;
pub use sharpness::sharpness;
pub use warp::{Interpolation, WarpOptions, warp_affine, warp_perspective};

/// Splits the rows of an image into at most `count` ranges.
#[cfg(feature = "parallel")]
pub(crate) fn bands(height: usize, count: usize) -> Vec<std::ops::Range<usize>> {
    let each = height.div_ceil(count).max(1);
    let from = (0..height).step_by(each);
    from.map(|k| k..(k + each).min(height)).collect()
}
