//! Image gradients.

use super::approx::atan2;
use super::gaussian::gaussian_derivative_kernels;
use super::gray::from_vec;
use super::separable::{Sink, filter, filter_briefly, in_bands};
use super::short_derivative::ShortDerivative;
use super::{Border, GrayImage32};
use crate::Result;
use crate::math::monitored::Reporter;
use crate::math::simd::dispatched;
use crate::progress::{Monitor, Stage};
use std::ops::Range;

/// The two partial derivatives of an image, in the units of the filter.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Derivative along u, rightwards.
    pub du: GrayImage32,
    /// Derivative along v, downwards.
    pub dv: GrayImage32,
}

impl Gradient {
    /// Returns the gradient magnitude at each pixel, `√(Iᵤ² + Iᵥ²)`.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::imaging::{Gradient, gray_from_values};
    /// let (du, dv) = (gray_from_values(1, 1, vec![3.0])?, gray_from_values(1, 1, vec![4.0])?);
    /// assert_eq!(Gradient { du, dv }.magnitude().as_raw(), &[5.0]);
    /// # Ok(()) }
    /// ```
    pub fn magnitude(&self) -> GrayImage32 {
        self.map(magnitudes)
    }

    /// Returns the direction of steepest ascent, `atan2(Iᵥ, Iᵤ)` in (−π, π], v pointing down; 0 in
    /// flat regions.
    ///
    /// Accurate to 3·10⁻⁷, with identical bits on every platform.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::imaging::{Gradient, gray_from_values};
    /// let (du, dv) = (gray_from_values(1, 1, vec![0.0])?, gray_from_values(1, 1, vec![2.0])?);
    /// let down = Gradient { du, dv }.orientation().as_raw()[0];
    /// assert!((down - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    /// # Ok(()) }
    /// ```
    pub fn orientation(&self) -> GrayImage32 {
        self.map(orientations)
    }

    fn map(&self, run: impl Fn(&[f32], &[f32], &mut [f32])) -> GrayImage32 {
        // Fields are public, so their sizes may differ: use the common pixels.
        let mut out = vec![0.0; self.du.as_raw().len()];
        let n = out.len().min(self.dv.as_raw().len());
        run(
            &self.du.as_raw()[..n],
            &self.dv.as_raw()[..n],
            &mut out[..n],
        );
        from_vec(self.du.width(), self.du.height(), out)
    }
}

dispatched! {
    fn magnitudes(du: &[f32], dv: &[f32], out: &mut [f32]) {
        for ((out, du), dv) in out.iter_mut().zip(du).zip(dv) {
            *out = (du * du + dv * dv).sqrt();
        }
    }
}
dispatched! {
    fn orientations(du: &[f32], dv: &[f32], out: &mut [f32]) {
        for ((out, du), dv) in out.iter_mut().zip(du).zip(dv) {
            *out = atan2(*dv, *du);
        }
    }
}

/// A derivative filter of small integers, not normalized.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum DerivativeFilter {
    /// `[−1 0 1]` along, `[1 2 1]` across: gain 8.
    #[default]
    Sobel3,
    /// `[−1 −2 0 2 1]` along, `[1 4 6 4 1]` across: gain 128.
    Sobel5,
    /// `[−1 0 1]` along, `[3 10 3]` across: gain 32; the direction is more accurate (Scharr 2000,
    /// "Optimal operators in digital image processing").
    Scharr,
}

impl DerivativeFilter {
    /// Returns the weights along the derivative, and across.
    pub(crate) fn kernels(self) -> (&'static [f32], &'static [f32]) {
        match self {
            Self::Sobel3 => (&[-1.0, 0.0, 1.0], &[1.0, 2.0, 1.0]),
            Self::Sobel5 => (&[-1.0, -2.0, 0.0, 2.0, 1.0], &[1.0, 4.0, 6.0, 4.0, 1.0]),
            Self::Scharr => (&[-1.0, 0.0, 1.0], &[3.0, 10.0, 3.0]),
        }
    }

    /// Returns the response to a ramp that rises by one gray value per pixel.
    ///
    /// ```
    /// assert_eq!(epipole::imaging::DerivativeFilter::Sobel3.gain(), 8.0);
    /// ```
    pub fn gain(self) -> f32 {
        match self {
            Self::Sobel3 => 8.0,
            Self::Sobel5 => 128.0,
            Self::Scharr => 32.0,
        }
    }
}

/// Computes the gradient by a filter of small integers, including its
/// [`gain`](DerivativeFilter::gain).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, DerivativeFilter, derivative, gray_from_values};
/// let ramp = gray_from_values(3, 1, vec![0.0, 1.0, 2.0])?;
/// let gradient = derivative(&ramp, DerivativeFilter::Scharr, Border::Replicate);
/// assert_eq!(gradient.du.as_raw(), &[16.0, 32.0, 16.0]);
/// # Ok(()) }
/// ```
pub fn derivative(image: &GrayImage32, kind: DerivativeFilter, border: Border) -> Gradient {
    let (along, across) = kind.kernels();
    let [du, dv] = match ShortDerivative::new(image, (along, across), border) {
        Some(start) => short_derivative(image, &start),
        None => filter_briefly(image, [(along, across), (across, along)], border),
    };
    Gradient { du, dv }
}

/// Computes both derivatives of an image; each band of rows begins with a copy of `start`.
fn short_derivative(image: &GrayImage32, start: &ShortDerivative) -> [GrayImage32; 2] {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let work = |rows: Range<usize>, sink: Sink<2>, _: &mut Reporter| {
        let mut derivative = start.clone();
        for y in rows {
            sink(&mut |[mut du, mut dv]| {
                derivative.row(y, du.columns(0..width), dv.columns(0..width));
            });
        }
        Ok(())
    };
    let memory = [const { Vec::new() }; 2];
    in_bands(memory, width, height, Stage::Filtering, &mut (), work)
        .expect("`()` never cancels")
        .map(|values| from_vec(image.width(), image.height(), values))
}

/// Computes the gradient by centered differences, `Iᵤ = (I(u+1, v) − I(u−1, v)) / 2`, likewise
/// along v.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, centered_difference, gray_from_values};
/// let image = gray_from_values(3, 1, vec![0.0, 1.0, 4.0])?;
/// assert_eq!(centered_difference(&image, Border::Replicate).du.as_raw(), &[0.5, 2.0, 1.5]);
/// # Ok(()) }
/// ```
pub fn centered_difference(image: &GrayImage32, border: Border) -> Gradient {
    let half = &[-0.5, 0.0, 0.5];
    let [du, dv] = filter_briefly(image, [(half, &[1.0]), (&[1.0], half)], border);
    Gradient { du, dv }
}

/// Computes the gradient by the 3×3 Sobel filter, with gain 8, as OpenCV's `Sobel`.
///
/// Source: Sobel & Feldman 1968, as printed in Duda & Hart 1973, p. 271.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, sobel};
/// let ramp = gray_from_values(3, 1, vec![0.0, 1.0, 2.0])?;
/// assert_eq!(sobel(&ramp, Border::Replicate).du.as_raw(), &[4.0, 8.0, 4.0]);
/// # Ok(()) }
/// ```
pub fn sobel(image: &GrayImage32, border: Border) -> Gradient {
    derivative(image, DerivativeFilter::Sobel3, border)
}

/// Computes the gradient of the image blurred by a Gaussian, `Iᵤ = ∂g/∂u ∗ I`, per pixel.
///
/// * `sigma_px`: standard deviation of the Gaussian, pixels, in (0, 1000]
///
/// The sampled derivative is scaled so that a ramp of slope 1 gives exactly 1. The only stage is
/// [`Stage::Filtering`](crate::progress::Stage::Filtering).
///
/// # Errors
/// [`OutOfRange`](crate::Error::OutOfRange) for a σ outside that range,
/// [`Canceled`](crate::Error::Canceled).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gaussian_derivative, gray_from_values};
/// let ramp = gray_from_values(31, 1, (0..31).map(|u| u as f32).collect())?;
/// let gradient = gaussian_derivative(&ramp, 2.0, Border::Replicate, &mut ())?;
/// assert!((gradient.du.get_pixel(15, 0).0[0] - 1.0).abs() < 1e-5);
/// # Ok(()) }
/// ```
pub fn gaussian_derivative(
    image: &GrayImage32,
    sigma_px: f64,
    border: Border,
    monitor: &mut dyn Monitor,
) -> Result<Gradient> {
    let (smooth, slope) = gaussian_derivative_kernels(sigma_px)?;
    let kernels = [(&*slope, &*smooth), (&*smooth, &*slope)];
    let [du, dv] = filter(image, kernels, border, monitor)?;
    Ok(Gradient { du, dv })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn derivatives_equal_opencv() {
        let image = fixture::gray32("texture.npy");
        for (name, kind) in [
            ("sobel3", DerivativeFilter::Sobel3),
            ("sobel5", DerivativeFilter::Sobel5),
            ("scharr", DerivativeFilter::Scharr),
        ] {
            for (suffix, border) in [
                ("reflect101", Border::Reflect101),
                ("replicate", Border::Replicate),
                ("constant", Border::Constant(0.0)),
            ] {
                let gradient = derivative(&image, kind, border);
                for (axis, ours) in [("u", &gradient.du), ("v", &gradient.dv)] {
                    let name = format!("{name}_{axis}_{suffix}.npy");
                    fixture::assert_close(ours, &fixture::gray32(&name), 1e-6, &name);
                }
            }
        }
    }

    #[test]
    fn magnitude_and_orientation_equal_numpy() {
        let gradient = sobel(&fixture::gray32("texture.npy"), Border::Reflect101);
        let expected = fixture::gray32("sobel3_magnitude.npy");
        fixture::assert_close(&gradient.magnitude(), &expected, 1e-6, "magnitude");
        let expected = fixture::gray32("sobel3_orientation.npy");
        let angles = gradient.orientation();
        for ((got, want), size) in angles
            .as_raw()
            .iter()
            .zip(expected.as_raw())
            .zip(gradient.magnitude().as_raw())
        {
            // The direction of a tiny gradient depends on its last bit.
            if *size > 1e-3 {
                let difference = (got - want).abs();
                assert!(
                    difference.min(std::f32::consts::TAU - difference) < 1e-4,
                    "{got} {want}"
                );
            }
        }
    }

    #[test]
    fn gaussian_derivative_equals_scipy() {
        let image = fixture::gray32("texture.npy");
        let gradient = gaussian_derivative(&image, 1.5, Border::Reflect101, &mut ()).unwrap();
        // SciPy samples the same Gaussian but scales its derivative by 1/σ², a 10⁻⁴ difference.
        for (name, ours) in [
            ("gauss_du_s1.5.npy", gradient.du),
            ("gauss_dv_s1.5.npy", gradient.dv),
        ] {
            fixture::assert_close(&ours, &fixture::gray32(name), 1e-3, name);
        }
    }

    #[test]
    fn a_flat_image_has_no_gradient() {
        let image = GrayImage32::from_pixel(9, 4, image::Luma([0.7]));
        let gradient = sobel(&image, Border::Reflect101);
        assert!(gradient.magnitude().as_raw().iter().all(|&m| m == 0.0));
        assert!(gradient.orientation().as_raw().iter().all(|&a| a == 0.0));
    }
}
