//! Structure tensor: the distribution of the gradient around each pixel.

use super::short_tensor::ShortTensor;
use crate::imaging::kernel::{Kernel, Row, Three};
use crate::imaging::rows::along_and_across;
use crate::imaging::separable::{Ring, RowFilter, Sink, in_bands};
use crate::imaging::short_derivative::ShortDerivative;
use crate::imaging::{Border, DerivativeFilter, GrayImage32, gaussian_kernel};
use crate::math::monitored::Reporter;
use crate::math::simd::dispatched;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use derive_setters::Setters;
use std::ops::Range;

/// Weights of the neighbors in the structure tensor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Window {
    /// A square of this side in pixels, with weights 1. An even square reaches one pixel further up
    /// and left, as in OpenCV.
    Box(usize),
    /// A Gaussian of this standard deviation in pixels; its weights sum to 1.
    Gaussian(f64),
}

/// Scaling of the structure tensor and of its responses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Scaling {
    /// Sums of products of the unscaled filter responses: integers for integer gray values.
    #[default]
    Textbook,
    /// OpenCV's: the derivative is divided by `2^(k−1) b` for a k×k filter and a box of b pixels (1
    /// for a Gaussian). On gray values in [0, 1] responses equal those of OpenCV for 8 bits.
    OpenCv,
}

/// Options of a structure tensor.
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct StructureTensorOptions {
    /// Derivative filter.
    pub derivative: DerivativeFilter,
    /// Weights of the neighbors.
    pub window: Window,
    /// Scaling.
    pub scaling: Scaling,
    /// Border of the image; derivatives beyond a constant border count as 0.
    pub border: Border,
}

impl Default for StructureTensorOptions {
    /// Returns Sobel 3×3, a box of 3×3 pixels, textbook scaling, and a mirrored border.
    fn default() -> Self {
        Self {
            derivative: DerivativeFilter::Sobel3,
            window: Window::Box(3),
            scaling: Scaling::Textbook,
            border: Border::Reflect101,
        }
    }
}

impl StructureTensorOptions {
    /// Returns the weight of the derivatives; `block` as from [`window_kernel`].
    pub(super) fn scale(&self, block: f32) -> f32 {
        match self.scaling {
            Scaling::Textbook => 1.0,
            Scaling::OpenCv => {
                let size = match self.derivative {
                    DerivativeFilter::Sobel3 => 4.0,
                    DerivativeFilter::Sobel5 => 16.0,
                    // OpenCV halves again for Scharr, whose kernel sums to 32.
                    DerivativeFilter::Scharr => 8.0,
                };
                1.0 / (size * block)
            }
        }
    }
}

/// The symmetric matrix `M = Σ w [Iᵤ² IᵤIᵥ; IᵤIᵥ Iᵥ²]` at each pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct StructureTensor {
    /// `Σ w Iᵤ²`.
    pub uu: GrayImage32,
    /// `Σ w Iᵤ Iᵥ`.
    pub uv: GrayImage32,
    /// `Σ w Iᵥ²`.
    pub vv: GrayImage32,
}

impl StructureTensor {
    /// Returns the two eigenvalues at a pixel, the larger first; `None` outside the image.
    ///
    /// `λ = (M₁₁ + M₂₂)/2 ± √(((M₁₁ − M₂₂)/2)² + M₁₂²)`; two small ones mean a flat patch, one
    /// large an edge, two large a corner.
    ///
    /// ```
    /// use epipole::feature::StructureTensor;
    /// use epipole::imaging::gray_from_values;
    /// # fn main() -> Result<(), epipole::Error> {
    /// let one = |value| gray_from_values(1, 1, vec![value]);
    /// let tensor = StructureTensor { uu: one(2.0)?, uv: one(1.0)?, vv: one(2.0)? };
    /// assert_eq!(tensor.eigenvalues(0, 0), Some((3.0, 1.0)));
    /// # Ok(()) }
    /// ```
    pub fn eigenvalues(&self, u: u32, v: u32) -> Option<(f32, f32)> {
        let [a, b, c] = [&self.uu, &self.uv, &self.vv]
            .map(|image| image.get_pixel_checked(u, v).map(|p| p.0[0]));
        let (a, b, c) = (a?, b?, c?);
        let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
        let radius = (half * half + b * b).sqrt();
        Some((mean + radius, mean - radius))
    }
}

/// Computes the structure tensor of an image. The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::NotFinite`] for a NaN or infinite pixel, [`Error::OutOfRange`] for a window of size 0
/// or above 255, or a σ outside (0, 31]; [`Error::Canceled`].
///
/// Source: Förstner & Gülch 1987; Bigün & Granlund 1987.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{StructureTensorOptions, structure_tensor};
/// use epipole::imaging::gray_from_values;
/// // A vertical step: Sobel gives 4 on both sides, a 3×3 box sums nine squares.
/// let step = gray_from_values(6, 3, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3))?;
/// let tensor = structure_tensor(&step, &StructureTensorOptions::default(), &mut ())?;
/// assert_eq!(tensor.eigenvalues(2, 1), Some((96.0, 0.0)));
/// # Ok(()) }
/// ```
pub fn structure_tensor(
    image: &GrayImage32,
    options: &StructureTensorOptions,
    monitor: &mut dyn Monitor,
) -> Result<StructureTensor> {
    let [uu, uv, vv] = with_tensor(image, options, monitor, |sums, out: [&mut [f32]; 3]| {
        for (sum, out) in sums.into_iter().zip(out) {
            out.copy_from_slice(sum);
        }
    })?;
    Ok(StructureTensor { uu, uv, vv })
}

/// Computes the tensor row by row and passes it to `finish`, which writes the output rows, so that
/// the tensor need not be stored.
pub(crate) fn with_tensor<const N: usize>(
    image: &GrayImage32,
    options: &StructureTensorOptions,
    monitor: &mut dyn Monitor,
    finish: impl Fn([&[f32]; 3], [&mut [f32]; N]) + Sync,
) -> Result<[GrayImage32; N]> {
    crate::imaging::require_finite(image)?;
    let (kernel, block) = window_kernel(options.window)?;
    let scale = options.scale(block);
    let (width, height) = (image.width() as usize, image.height() as usize);
    let work = |rows: Range<usize>, sink: Sink<N>, reporter: &mut Reporter| {
        let tensor = TensorRows {
            image,
            options,
            scale_sq: scale * scale,
            kernel: &kernel,
        };
        tensor.run(rows, sink, reporter, &finish)
    };
    let memory = [const { Vec::new() }; N];
    let outputs = in_bands(
        memory,
        width,
        height,
        Stage::FeatureDetection,
        monitor,
        work,
    )?;
    Ok(outputs.map(|values| {
        GrayImage32::from_raw(image.width(), image.height(), values)
            .expect("one value was computed for each pixel")
    }))
}

/// Returns the window's weights along one axis and the factor by which OpenCV divides derivatives.
pub(super) fn window_kernel(window: Window) -> Result<(Vec<f32>, f32)> {
    match window {
        Window::Box(size) if (1..=255).contains(&size) => {
            let mut kernel = vec![1.0; size];
            if size % 2 == 0 {
                // An odd kernel with a last weight of zero.
                kernel.push(0.0);
            }
            Ok((kernel, size as f32))
        }
        Window::Box(size) => Err(Error::OutOfRange {
            what: "the window of a structure tensor in pixels",
            requirement: "between 1 and 255",
            value: size as f64,
        }),
        Window::Gaussian(sigma_px) if sigma_px > 0.0 && sigma_px <= 31.0 => {
            let size = (8.0 * sigma_px + 1.0).round() as usize | 1;
            Ok((gaussian_kernel(sigma_px, size)?, 1.0))
        }
        Window::Gaussian(sigma_px) => Err(Error::OutOfRange {
            what: "the Gaussian window of a structure tensor in pixels",
            requirement: "greater than 0 and at most 31",
            value: sigma_px,
        }),
    }
}

/// Rows of the tensor, computed in order.
struct TensorRows<'a> {
    image: &'a GrayImage32,
    options: &'a StructureTensorOptions,
    scale_sq: f32,
    kernel: &'a [f32],
}

impl TensorRows<'_> {
    /// Passes the three sums of each row to `finish`, which writes the output rows of `sink`.
    ///
    /// # Errors
    /// [`Error::Canceled`].
    fn run<const N: usize>(
        &self,
        rows: Range<usize>,
        sink: Sink<N>,
        reporter: &mut Reporter,
        finish: &impl Fn([&[f32]; 3], [&mut [f32]; N]),
    ) -> Result<()> {
        if let Some(tensor) = self.short() {
            return self.run_short(tensor, rows, sink, reporter, finish);
        }
        let Self {
            image,
            options,
            scale_sq,
            kernel,
        } = *self;
        let (width, height) = (image.width() as usize, image.height() as usize);
        let border = self.border();
        let radius = kernel.len() / 2;
        let (along, across) = options.derivative.kernels();
        let kernels = [(along, across), (across, along)];
        let mut gradient = RowFilter::new(image, kernels, options.border);
        let mut rings: [Ring; 3] = std::array::from_fn(|_| Ring::new(kernel.len(), width));
        let row = || vec![0.0f32; width];
        let mut sums = [row(), row(), row()];
        let (mut du, mut dv, mut product, mut edge) = (row(), row(), row(), Vec::new());
        let kernel = &Kernel::new(kernel);
        for y in rows.clone() {
            let newest = (y + radius) as isize;
            let first = if y == rows.start {
                newest - 2 * radius as isize
            } else {
                newest
            };
            for row in first..=newest {
                reporter.report(y - rows.start, rows.len())?;
                let source = border.index(row, height);
                if let Some(m) = source {
                    gradient.row(m, [Row::Over(&mut du), Row::Over(&mut dv)]);
                }
                let factors = [(&du, &du), (&du, &dv), (&dv, &dv)];
                for ((ring, (a, b)), sums) in rings.iter_mut().zip(factors).zip(&mut sums) {
                    multiply(a, b, scale_sq, &mut product);
                    let product = source.map(|_| product.as_slice());
                    let target = ring.push();
                    if row < newest {
                        kernel.along(product, border, &mut edge, target);
                    } else {
                        let (rows, sums) = (ring.rows(), Row::Over(sums));
                        along_and_across([kernel; 2], product, border, &mut edge, rows, sums);
                    }
                }
            }
            sink(&mut |mut out| {
                let out = out.each_mut().map(|out| out.columns(0..width));
                finish([&sums[0], &sums[1], &sums[2]], out);
            });
        }
        Ok(())
    }

    /// Returns the border of products: beyond a constant border derivatives are 0.
    fn border(&self) -> Border {
        match self.options.border {
            Border::Constant(_) => Border::Constant(0.0),
            other => other,
        }
    }

    /// Returns the optimized tensor for the usual derivatives and windows.
    fn short(&self) -> Option<ShortTensor<'_>> {
        let (image, options) = (self.image, self.options);
        let window = Three::new(self.kernel)?;
        let derivative = ShortDerivative::new(image, options.derivative.kernels(), options.border)?;
        let border = self.border();
        Some(ShortTensor::new(
            image,
            derivative,
            window,
            self.scale_sq,
            border,
        ))
    }

    /// Runs like [`run`](Self::run), with specialized loops.
    fn run_short<const N: usize>(
        &self,
        mut tensor: ShortTensor,
        rows: Range<usize>,
        sink: Sink<N>,
        reporter: &mut Reporter,
        finish: &impl Fn([&[f32]; 3], [&mut [f32]; N]),
    ) -> Result<()> {
        let (width, first) = (self.image.width() as usize, rows.start as isize);
        tensor.push(first - 1);
        tensor.push(first);
        for y in rows.clone() {
            reporter.report(y - rows.start, rows.len())?;
            tensor.push(y as isize + 1);
            let [uu, uv, vv] = &tensor.sums;
            sink(&mut |mut out| {
                let out = out.each_mut().map(|out| out.columns(0..width));
                finish([uu, uv, vv], out);
            });
        }
        Ok(())
    }
}

dispatched! {
    fn multiply(a: &[f32], b: &[f32], scale: f32, out: &mut [f32]) {
        for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
            *out = a * b * scale;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact integers of scikit-image's skimage/feature/tests/test_corner.py: a square of ones,
    /// Sobel, almost no window.
    #[test]
    fn a_bright_pixel_gives_exact_integers() {
        let mut image = GrayImage32::new(5, 5);
        image.put_pixel(2, 2, image::Luma([1.0]));
        let options = StructureTensorOptions {
            window: Window::Box(1),
            ..StructureTensorOptions::default()
        };
        let tensor = structure_tensor(&image, &options, &mut ()).unwrap();
        #[rustfmt::skip]
        assert_eq!(tensor.uu.as_raw(), &[
            0.0, 0.0, 0.0, 0.0, 0.0,
            0.0, 1.0, 0.0, 1.0, 0.0,
            0.0, 4.0, 0.0, 4.0, 0.0,
            0.0, 1.0, 0.0, 1.0, 0.0,
            0.0, 0.0, 0.0, 0.0, 0.0,
        ]);
        #[rustfmt::skip]
        assert_eq!(tensor.uv.as_raw(), &[
            0.0, 0.0, 0.0, 0.0, 0.0,
            0.0, 1.0, 0.0, -1.0, 0.0,
            0.0, 0.0, 0.0, 0.0, 0.0,
            0.0, -1.0, 0.0, 1.0, 0.0,
            0.0, 0.0, 0.0, 0.0, 0.0,
        ]);
    }

    #[test]
    fn bad_windows_and_pixels_are_refused() {
        let image = GrayImage32::new(5, 5);
        for window in [
            Window::Box(0),
            Window::Box(999),
            Window::Gaussian(0.0),
            Window::Gaussian(f64::NAN),
            Window::Gaussian(1e9),
        ] {
            let options = StructureTensorOptions {
                window,
                ..Default::default()
            };
            assert!(structure_tensor(&image, &options, &mut ()).is_err());
        }
        let mut image = image;
        image.put_pixel(1, 1, image::Luma([f32::NAN]));
        assert_eq!(
            structure_tensor(&image, &StructureTensorOptions::default(), &mut ()),
            Err(Error::NotFinite {
                what: "every pixel of the image"
            })
        );
    }

    /// Short filters have specialized loops, equal to the general filters to the last bit.
    #[test]
    fn sums_are_those_of_filtered_products() {
        use crate::imaging::{derivative, gaussian_kernel, separable_filter};
        let filtered = |image: &GrayImage32, along: &[f32], across: &[f32], border| {
            separable_filter(image, along, across, border, &mut ()).unwrap()
        };
        for (w, h) in [(1, 1), (2, 5), (31, 3), (70, 9)] {
            let image = GrayImage32::from_fn(w, h, |u, v| {
                image::Luma([((u * 37 + v * 71) % 19) as f32 * 0.17 - 0.9])
            });
            for border in [Border::Reflect101, Border::Replicate, Border::Constant(0.3)] {
                for (filter, sigma_px) in [
                    (DerivativeFilter::Sobel3, None),
                    (DerivativeFilter::Scharr, Some(0.25)),
                    (DerivativeFilter::Sobel5, Some(0.25)),
                    (DerivativeFilter::Sobel3, Some(0.6)),
                ] {
                    let (window, kernel) = match sigma_px {
                        None => (Window::Box(3), vec![1.0; 3]),
                        Some(sigma_px) => (
                            Window::Gaussian(sigma_px),
                            gaussian_kernel(sigma_px, if sigma_px < 0.5 { 3 } else { 7 }).unwrap(),
                        ),
                    };
                    let options = StructureTensorOptions {
                        derivative: filter,
                        window,
                        border,
                        ..StructureTensorOptions::default()
                    };
                    let tensor = structure_tensor(&image, &options, &mut ()).unwrap();
                    let (along, across) = filter.kernels();
                    let mut product = filtered(&image, along, across, border);
                    let dv = filtered(&image, across, along, border);
                    let gradient = derivative(&image, filter, border);
                    assert_eq!((&gradient.du, &gradient.dv), (&product, &dv), "{filter:?}");
                    for (p, dv) in product.iter_mut().zip(dv.iter()) {
                        *p *= dv;
                    }
                    let outside = match border {
                        Border::Constant(_) => Border::Constant(0.0),
                        other => other,
                    };
                    let sums = filtered(&product, &kernel, &kernel, outside);
                    assert_eq!(tensor.uv, sums, "{w}x{h} {filter:?} {window:?} {border:?}");
                }
            }
        }
    }

    #[test]
    fn a_gaussian_window_is_a_blur_of_products() {
        let image = GrayImage32::from_fn(20, 15, |u, v| image::Luma([((u * v) % 7) as f32]));
        let options = StructureTensorOptions {
            window: Window::Gaussian(1.5),
            ..StructureTensorOptions::default()
        };
        let tensor = structure_tensor(&image, &options, &mut ()).unwrap();
        let gradient = crate::imaging::sobel(&image, Border::Reflect101);
        let mut product = gradient.du.clone();
        for (p, dv) in product.as_mut().iter_mut().zip(gradient.dv.as_raw()) {
            *p *= dv;
        }
        let blurred =
            crate::imaging::gaussian_blur(&product, 1.5, Border::Reflect101, &mut ()).unwrap();
        crate::imaging::fixture::assert_close(&tensor.uv, &blurred, 1e-6, "uv");
    }
}
