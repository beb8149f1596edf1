//! Gray images: borders, filters, gradients, pyramids, resizing and warps.

mod convert;
mod filter;
mod gradient;
mod integral;
mod pyramid;
mod resize;
mod warp;

use crate::register::{classes, functions};
use epipole::imaging;
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::imaging::WarpOptions::new(0, 0))?;
    let weights = [
        ("BT601_WEIGHTS", imaging::BT601_WEIGHTS),
        ("BT709_WEIGHTS", imaging::BT709_WEIGHTS),
    ];
    for (name, [red, green, blue]) in weights {
        // Conversion via the shortest decimals gives 0.299, not 0.29899999499320984.
        let exact = [red, green, blue].map(|weight| weight.to_string().parse::<f64>());
        let [red, green, blue] = exact.map(|weight| weight.unwrap_or(f64::NAN));
        module.add(name, (red, green, blue))?;
    }
    classes!(module: gradient::{Gradient}, integral::{IntegralImage});
    functions!(module:
        convert::{gray_to_f32, gray_to_u8, rgb_to_gray, rgb_to_gray_f32},
        filter::{
            correlate, separable_filter, noise_gain, gaussian_kernel, gaussian_derivative_kernels,
            gaussian_blur, box_filter
        },
        gradient::{derivative, centered_difference, sobel, gaussian_derivative},
        pyramid::{
            pyramid_down, pyramid_up, gaussian_pyramid, laplacian_pyramid, from_laplacian_pyramid,
            sharpness
        },
        resize::{resize, reduce_rgb, sample_bilinear, sample_bicubic},
        warp::{warp_affine, warp_perspective}
    );
    Ok(())
}
