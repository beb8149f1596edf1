//! Gaussian kernels and blurs.

use super::separable::filter;
use super::{Border, GrayImage32};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Maximum size of a kernel, ±10 standard deviations of the widest Gaussian.
const MAX_SIZE: usize = 20_001;

/// Returns samples of a Gaussian that sum to one: `g[i] ∝ exp(−(i − r)² / 2σ²)`, `size = 2r + 1`.
///
/// * `sigma_px`: standard deviation, pixels, > 0
/// * `size`: an odd number of samples, at most 20 001
///
/// # Errors
/// [`Error::OutOfRange`] for another size, or for a σ outside (0, 1000].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// let g = epipole::imaging::gaussian_kernel(1.0, 3)?;
/// // e^(−1/2) = 0.6065: 0.6065 / (1 + 2 · 0.6065) = 0.2741.
/// assert!((g[0] - 0.2741).abs() < 1e-4 && (g[1] - 0.4519).abs() < 1e-4);
/// # Ok(()) }
/// ```
pub fn gaussian_kernel(sigma_px: f64, size: usize) -> Result<Vec<f32>> {
    require_sigma(sigma_px)?;
    if size.is_multiple_of(2) || size > MAX_SIZE {
        return Err(Error::OutOfRange {
            what: "the size of a Gaussian kernel",
            requirement: "odd and at most 20001",
            value: size as f64,
        });
    }
    let weights = samples(sigma_px, size / 2);
    Ok(weights.iter().map(|&w| w as f32).collect())
}

/// Returns normalized samples at −radius..=radius, in double precision.
pub(crate) fn samples(sigma_px: f64, radius: usize) -> Vec<f64> {
    let mut weights: Vec<f64> = (0..=2 * radius)
        .map(|i| {
            let x = i as f64 - radius as f64;
            libm::exp(-0.5 * x * x / (sigma_px * sigma_px))
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    for w in &mut weights {
        *w /= sum;
    }
    weights
}

fn require_sigma(sigma_px: f64) -> Result<()> {
    if sigma_px > 0.0 && sigma_px <= 1000.0 {
        return Ok(());
    }
    Err(Error::OutOfRange {
        what: "the standard deviation of a Gaussian in pixels",
        requirement: "greater than 0 and at most 1000",
        value: sigma_px,
    })
}

/// Returns the radius that contains all but 1/16 000 of a Gaussian, as in OpenCV for float images.
pub(crate) fn radius_for(sigma_px: f64) -> usize {
    ((sigma_px * 8.0 + 1.0).round() as usize | 1) / 2
}

/// Blurs an image by a Gaussian of standard deviation `sigma_px`, truncated at about 4σ.
///
/// The kernel has `size = round(8σ + 1) | 1` samples, as OpenCV's `GaussianBlur` for float images
/// without a given size. The only stage is [`Stage::Filtering`](crate::progress::Stage::Filtering).
///
/// * `sigma_px`: pixels, in (0, 1000]
///
/// # Errors
/// [`Error::OutOfRange`] for a σ outside that range, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gaussian_blur, gray_from_values};
/// let flat = gray_from_values(2, 2, vec![0.5; 4])?;
/// let blurred = gaussian_blur(&flat, 2.0, Border::Reflect101, &mut ())?;
/// assert!(blurred.as_raw().iter().all(|v| (v - 0.5).abs() < 1e-6));
/// # Ok(()) }
/// ```
pub fn gaussian_blur(
    image: &GrayImage32,
    sigma_px: f64,
    border: Border,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    require_sigma(sigma_px)?;
    let kernel = gaussian_kernel(sigma_px, 2 * radius_for(sigma_px) + 1)?;
    let [blurred] = filter(image, [(&kernel, &kernel)], border, monitor)?;
    Ok(blurred)
}

/// Returns the kernels of [`gaussian_derivative`](super::gaussian_derivative): a Gaussian `g` and
/// its derivative `g′`, both sampled to about 4σ. `g` sums to one, and `g′` gives 1 for a ramp of
/// slope 1.
///
/// * `sigma_px`: standard deviation, pixels, in (0, 1000]
///
/// # Errors
/// [`Error::OutOfRange`] for a σ outside that range.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// let (smooth, slope) = epipole::imaging::gaussian_derivative_kernels(1.0)?;
/// assert_eq!((smooth.len(), slope.len()), (9, 9));
/// assert!((smooth.iter().sum::<f32>() - 1.0).abs() < 1e-6);
/// // The difference between right and left.
/// assert!(slope[3] < 0.0 && slope[4] == 0.0 && slope[5] > 0.0);
/// # Ok(()) }
/// ```
pub fn gaussian_derivative_kernels(sigma_px: f64) -> Result<(Vec<f32>, Vec<f32>)> {
    require_sigma(sigma_px)?;
    let radius = radius_for(sigma_px).max(1);
    let smooth = samples(sigma_px, radius);
    let moment: f64 = (0..=2 * radius)
        .map(|i| {
            let x = i as f64 - radius as f64;
            x * x * smooth[i]
        })
        .sum();
    if moment <= 0.0 {
        // So narrow that only the center has weight: the derivative is a centered difference.
        return Ok((vec![0.0, 1.0, 0.0], vec![-0.5, 0.0, 0.5]));
    }
    let derivative = (0..=2 * radius).map(|i| {
        let x = i as f64 - radius as f64;
        (x * smooth[i] / moment) as f32
    });
    let derivative = derivative.collect();
    Ok((smooth.iter().map(|&w| w as f32).collect(), derivative))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{fixture, separable_filter};

    #[test]
    fn blur_equals_opencv() {
        let image = fixture::gray32("texture.npy");
        for (name, sigma_px, border) in [
            ("gauss_s1.5_reflect101.npy", 1.5, Border::Reflect101),
            ("gauss_s0.8_replicate.npy", 0.8, Border::Replicate),
        ] {
            let ours = gaussian_blur(&image, sigma_px, border, &mut ()).unwrap();
            fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
        }
        let kernel = gaussian_kernel(1.1, 5).unwrap();
        let ours =
            separable_filter(&image, &kernel, &kernel, Border::Constant(0.0), &mut ()).unwrap();
        let name = "gauss_5_s1.1_constant.npy";
        fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
    }

    #[test]
    fn sigmas_outside_the_range_are_refused() {
        let image = GrayImage32::new(4, 4);
        for sigma_px in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            assert!(gaussian_blur(&image, sigma_px, Border::Replicate, &mut ()).is_err());
            assert!(gaussian_kernel(sigma_px, 3).is_err());
        }
        assert!(gaussian_kernel(1.0, 4).is_err());
        assert!(gaussian_kernel(1.0, 0).is_err());
        assert!(gaussian_kernel(1.0, usize::MAX).is_err());
    }

    #[test]
    fn a_very_narrow_derivative_is_still_a_derivative() {
        let (smooth, derivative) = gaussian_derivative_kernels(0.01).unwrap();
        assert!(smooth.iter().chain(&derivative).all(|w| w.is_finite()));
        assert_eq!(derivative, [-0.5, 0.0, 0.5]);
    }
}
