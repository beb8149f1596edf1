//! Gray images: borders, filters, gradients, pyramids, resizing and warps.

mod convert;
mod filter;
mod gradient;
mod integral;
mod pyramid;
mod resize;
mod warp;

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
    module.add_class::<gradient::Gradient>()?;
    module.add_class::<integral::IntegralImage>()?;
    module.add_function(wrap_pyfunction!(convert::gray_to_f32, module)?)?;
    module.add_function(wrap_pyfunction!(convert::gray_to_u8, module)?)?;
    module.add_function(wrap_pyfunction!(convert::rgb_to_gray, module)?)?;
    module.add_function(wrap_pyfunction!(convert::rgb_to_gray_f32, module)?)?;
    module.add_function(wrap_pyfunction!(filter::correlate, module)?)?;
    module.add_function(wrap_pyfunction!(filter::separable_filter, module)?)?;
    module.add_function(wrap_pyfunction!(filter::noise_gain, module)?)?;
    module.add_function(wrap_pyfunction!(filter::gaussian_kernel, module)?)?;
    module.add_function(wrap_pyfunction!(
        filter::gaussian_derivative_kernels,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(filter::gaussian_blur, module)?)?;
    module.add_function(wrap_pyfunction!(filter::box_filter, module)?)?;
    module.add_function(wrap_pyfunction!(gradient::derivative, module)?)?;
    module.add_function(wrap_pyfunction!(gradient::centered_difference, module)?)?;
    module.add_function(wrap_pyfunction!(gradient::sobel, module)?)?;
    module.add_function(wrap_pyfunction!(gradient::gaussian_derivative, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::pyramid_down, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::pyramid_up, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::gaussian_pyramid, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::laplacian_pyramid, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::from_laplacian_pyramid, module)?)?;
    module.add_function(wrap_pyfunction!(pyramid::sharpness, module)?)?;
    module.add_function(wrap_pyfunction!(resize::resize, module)?)?;
    module.add_function(wrap_pyfunction!(resize::reduce_rgb, module)?)?;
    module.add_function(wrap_pyfunction!(resize::sample_bilinear, module)?)?;
    module.add_function(wrap_pyfunction!(resize::sample_bicubic, module)?)?;
    module.add_function(wrap_pyfunction!(warp::warp_affine, module)?)?;
    module.add_function(wrap_pyfunction!(warp::warp_perspective, module)?)
}
