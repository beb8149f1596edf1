//! Correlation with any small kernel, and the noise gain of kernels.

use super::gray::from_vec;
use super::{Border, GrayImage32};
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};

/// Correlates the image with a kernel, an image of weights with odd sides:
/// `out(u, v) = Σ kernel(i, j) I(u + i − rᵤ, v + j − rᵥ)`.
///
/// Takes one multiplication per weight and pixel; for a kernel that is an outer product,
/// [`separable_filter`](super::separable_filter) takes far fewer. The kernel is not flipped. The
/// only stage is [`Stage::Filtering`].
///
/// # Errors
/// [`Error::OutOfRange`] for an empty kernel or one with an even side, [`Error::NotFinite`] for
/// weights that are not finite, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, correlate, gray_from_values};
/// let image = gray_from_values(3, 1, vec![7.0, 8.0, 9.0])?;
/// // The weight to the right of the middle selects the neighbor on the right.
/// let fetch = gray_from_values(3, 1, vec![0.0, 0.0, 1.0])?;
/// let moved = correlate(&image, &fetch, Border::Replicate, &mut ())?;
/// assert_eq!(moved.as_raw(), &[8.0, 9.0, 9.0]);
/// # Ok(()) }
/// ```
pub fn correlate(
    image: &GrayImage32,
    kernel: &GrayImage32,
    border: Border,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    for side in [kernel.width(), kernel.height()] {
        if side % 2 == 0 {
            return Err(Error::OutOfRange {
                what: "each side of a filter kernel",
                requirement: "odd",
                value: f64::from(side),
            });
        }
    }
    if kernel.as_raw().iter().any(|weight| !weight.is_finite()) {
        return Err(Error::NotFinite {
            what: "every weight of a filter kernel",
        });
    }
    let (half_u, half_v) = (kernel.width() as isize / 2, kernel.height() as isize / 2);
    let weighed = |u: u32, v: u32| {
        let mut sum = 0.0;
        for (i, j, weight) in kernel.enumerate_pixels() {
            let (u, v) = (u as isize + i as isize, v as isize + j as isize);
            sum += weight.0[0] * border.value(image, u - half_u, v - half_v);
        }
        sum
    };
    let (width, height) = image.dimensions();
    let mut values = vec![0.0; image.as_raw().len()];
    let row_len = width as usize;
    monitored::for_each_chunk(
        &mut values,
        row_len,
        Stage::Filtering,
        monitor,
        |first, row| {
            let v = (first / row_len) as u32;
            for (u, value) in (0..).zip(row) {
                *value = weighed(u, v);
            }
        },
    )?;
    Ok(from_vec(width, height, values))
}

/// Returns the noise gain of a filter: the standard deviation of its response to noise of standard
/// deviation 1, independent between pixels, `√(Σ w²)`.
///
/// The gain of a separable kernel is the product of the gains of its two factors.
///
/// ```
/// // The centered difference: √(¼ + ¼).
/// let gain = epipole::imaging::noise_gain(&[-0.5, 0.0, 0.5]);
/// assert!((gain - 0.5_f64.sqrt()).abs() < 1e-12);
/// ```
pub fn noise_gain(weights: &[f32]) -> f64 {
    let squares = weights
        .iter()
        .map(|&weight| f64::from(weight) * f64::from(weight));
    squares.sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{
        fixture, from_vec, gaussian_derivative, gaussian_derivative_kernels, separable_filter,
    };
    use crate::math::random::Random;

    #[test]
    fn an_outer_product_gives_what_its_factors_give() {
        let image = fixture::gray32("texture.npy");
        let (along, across) = ([0.1, -0.2, 0.7, 0.3, 0.4], [1.0, 2.0, -1.5]);
        let weights = across.iter().flat_map(|b| along.iter().map(move |a| a * b));
        let kernel = from_vec(5, 3, weights.collect());
        for border in [Border::Replicate, Border::Reflect101, Border::Constant(0.3)] {
            let ours = correlate(&image, &kernel, border, &mut ()).unwrap();
            let expected = separable_filter(&image, &along, &across, border, &mut ()).unwrap();
            fixture::assert_close(&ours, &expected, 1e-5, "correlate");
        }
    }

    #[test]
    fn bad_kernels_are_refused_and_empty_images_stay_empty() {
        let image = GrayImage32::new(3, 3);
        for kernel in [
            GrayImage32::new(2, 3),
            GrayImage32::new(3, 4),
            GrayImage32::new(0, 0),
        ] {
            assert!(correlate(&image, &kernel, Border::Replicate, &mut ()).is_err());
        }
        let invalid = GrayImage32::from_pixel(3, 3, image::Luma([f32::INFINITY]));
        assert!(correlate(&image, &invalid, Border::Replicate, &mut ()).is_err());
        let dot = GrayImage32::from_pixel(1, 1, image::Luma([1.0]));
        let empty = correlate(&GrayImage32::new(0, 5), &dot, Border::Reflect101, &mut ());
        assert_eq!(empty.unwrap().dimensions(), (0, 5));
    }

    #[test]
    fn noise_comes_out_as_predicted() {
        let mut random = Random::new(2);
        let noise = GrayImage32::from_fn(160, 120, |_, _| image::Luma([random.normal() as f32]));
        for sigma_px in [0.5, 1.0, 2.0] {
            let slopes = gaussian_derivative(&noise, sigma_px, Border::Reflect101, &mut ())
                .unwrap()
                .du;
            let squares: f64 = slopes
                .as_raw()
                .iter()
                .map(|&x| f64::from(x) * f64::from(x))
                .sum();
            let measured = (squares / slopes.as_raw().len() as f64).sqrt();
            let (smooth, slope) = gaussian_derivative_kernels(sigma_px).unwrap();
            let predicted = noise_gain(&smooth) * noise_gain(&slope);
            assert!(
                (measured / predicted - 1.0).abs() < 0.05,
                "{measured} {predicted}"
            );
            if sigma_px >= 1.0 {
                // For the continuous Gaussian: 1 / (√(8π) σ²).
                let continuous = 1.0 / ((8.0 * std::f64::consts::PI).sqrt() * sigma_px * sigma_px);
                assert!((predicted / continuous - 1.0).abs() < 0.01);
            }
        }
    }
}
