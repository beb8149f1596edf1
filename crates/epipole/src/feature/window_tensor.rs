//! Structure tensor of a single window, and its change under shifts.

use super::structure_tensor::window_kernel;
use super::{StructureTensor, StructureTensorOptions};
use crate::imaging::{Border, GrayImage32, require_finite};
use crate::{Error, Result};
use nalgebra::Vector2;

/// The symmetric matrix `M = Σ [Iᵤ² IᵤIᵥ; IᵤIᵥ Iᵥ²]` of one window.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WindowTensor {
    /// `Σ Iᵤ²`.
    pub uu: f64,
    /// `Σ Iᵤ Iᵥ`.
    pub uv: f64,
    /// `Σ Iᵥ²`.
    pub vv: f64,
}

impl WindowTensor {
    /// Computes the tensor of a window from the gradients (Iᵤ, Iᵥ) of its pixels.
    ///
    /// ```
    /// use epipole::feature::WindowTensor;
    /// use nalgebra::Vector2;
    /// let gradients = [(4.0, 0.0), (0.0, 3.0), (2.0, 2.0)].map(|(u, v)| Vector2::new(u, v));
    /// let tensor = WindowTensor::from_gradients(&gradients);
    /// assert_eq!(tensor, WindowTensor { uu: 20.0, uv: 4.0, vv: 13.0 });
    /// ```
    pub fn from_gradients(gradients: &[Vector2<f64>]) -> Self {
        gradients.iter().fold(Self::default(), |sum, g| Self {
            uu: sum.uu + g.x * g.x,
            uv: sum.uv + g.x * g.y,
            vv: sum.vv + g.y * g.y,
        })
    }

    /// Computes the value of [`structure_tensor`](super::structure_tensor) at one pixel of an
    /// image, without those of all other pixels.
    ///
    /// # Errors
    /// As [`structure_tensor`](super::structure_tensor), where only the pixels used must be finite;
    /// [`Error::OutOfRange`] for a pixel outside the image.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::feature::{StructureTensorOptions, WindowTensor};
    /// use epipole::imaging::gray_from_values;
    /// // A vertical step: Sobel gives 4 on both sides, a 3×3 box sums nine squares.
    /// let step = gray_from_values(6, 3, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3))?;
    /// let tensor = WindowTensor::at(&step, (2, 1), &StructureTensorOptions::default())?;
    /// assert_eq!(tensor, WindowTensor { uu: 96.0, uv: 0.0, vv: 0.0 });
    /// # Ok(()) }
    /// ```
    pub fn at(
        image: &GrayImage32,
        (u, v): (u32, u32),
        options: &StructureTensorOptions,
    ) -> Result<Self> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        if u >= image.width() || v >= image.height() {
            return Err(Error::OutOfRange {
                what: "the pixel whose window is looked at",
                requirement: "inside the image",
                value: f64::from(if u >= image.width() { u } else { v }),
            });
        }
        let (weights, block) = window_kernel(options.window)?;
        let scale = f64::from(options.scale(block));
        let (along, across) = options.derivative.kernels();
        let (radius, reach) = (weights.len() / 2, along.len() / 2);
        let gray = |x: isize, y: isize| {
            let place = options
                .border
                .index(x, width)
                .zip(options.border.index(y, height));
            let inside = |(x, y): (usize, usize)| image.as_raw()[y * width + x];
            f64::from(place.map_or(options.border.constant(), inside))
        };
        let derivative = |x: usize, y: usize, right: &[f32], down: &[f32]| {
            let mut sum = 0.0;
            for (j, b) in down.iter().enumerate() {
                for (i, a) in right.iter().enumerate() {
                    let place = |at: usize, k: usize| at as isize + k as isize - reach as isize;
                    sum += f64::from(a * b) * gray(place(x, i), place(y, j));
                }
            }
            sum * scale
        };
        // Derivatives beyond a constant border are 0.
        let beside = |at: u32, k: usize, length: usize| {
            let place = at as isize + k as isize - radius as isize;
            options.border.index(place, length)
        };
        let mut tensor = Self::default();
        for (j, b) in weights.iter().enumerate() {
            for (i, a) in weights.iter().enumerate() {
                let place = beside(u, i, width).zip(beside(v, j, height));
                let Some((x, y)) = place.filter(|_| a * b > 0.0) else {
                    continue;
                };
                let weight = f64::from(a * b);
                let du = derivative(x, y, along, across);
                let dv = derivative(x, y, across, along);
                tensor.uu += weight * du * du;
                tensor.uv += weight * du * dv;
                tensor.vv += weight * dv * dv;
            }
        }
        if !(tensor.uu + tensor.vv).is_finite() {
            return Err(Error::NotFinite {
                what: "every pixel of the window",
            });
        }
        Ok(tensor)
    }

    /// Returns the product of the eigenvalues, `Σ Iᵤ² Σ Iᵥ² − (Σ Iᵤ Iᵥ)²`.
    pub fn determinant(&self) -> f64 {
        self.uu * self.vv - self.uv * self.uv
    }

    /// Returns the sum of the eigenvalues, `Σ Iᵤ² + Σ Iᵥ²`.
    pub fn trace(&self) -> f64 {
        self.uu + self.vv
    }

    /// Returns the two eigenvalues, the larger first; neither is negative.
    ///
    /// `λ = (M₁₁ + M₂₂)/2 ± √(((M₁₁ − M₂₂)/2)² + M₁₂²)`.
    ///
    /// ```
    /// use epipole::feature::WindowTensor;
    /// let tensor = WindowTensor { uu: 2.0, uv: 1.0, vv: 2.0 };
    /// assert_eq!(tensor.eigenvalues(), (3.0, 1.0));
    /// ```
    pub fn eigenvalues(&self) -> (f64, f64) {
        let (mean, half) = (0.5 * (self.uu + self.vv), 0.5 * (self.uu - self.vv));
        let radius = (half * half + self.uv * self.uv).sqrt();
        (mean + radius, (mean - radius).max(0.0))
    }

    /// Returns the direction in which a shift changes the window most, the eigenvector of the
    /// larger eigenvalue: `atan2(v, u)` with v down, in (−π/2, π/2]; 0 if all directions are equal.
    ///
    /// ```
    /// use epipole::feature::WindowTensor;
    /// let vertical_edge = WindowTensor { uu: 9.0, uv: 0.0, vv: 0.0 };
    /// assert_eq!(vertical_edge.direction_rad(), 0.0);
    /// let diagonal_edge = WindowTensor { uu: 1.0, uv: 1.0, vv: 1.0 };
    /// assert!((diagonal_edge.direction_rad() - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    /// ```
    pub fn direction_rad(&self) -> f64 {
        0.5 * libm::atan2(2.0 * self.uv, self.uu - self.vv)
    }

    /// Computes the Harris measure `R = det M − k (trace M)²`: positive at corners, negative on
    /// edges.
    ///
    /// Source: Harris & Stephens 1988, "A combined corner and edge detector", eq. 13.
    ///
    /// ```
    /// use epipole::feature::WindowTensor;
    /// let corner = WindowTensor { uu: 20.0, uv: 4.0, vv: 13.0 };
    /// assert!((corner.harris(0.04) - 200.44).abs() < 1e-12); // 244 − 0.04 · 33²
    /// let edge = WindowTensor { uu: 50.0, uv: 0.0, vv: 0.0 };
    /// assert!((edge.harris(0.04) + 100.0).abs() < 1e-12); // 0 − 0.04 · 50²
    /// ```
    pub fn harris(&self, k: f64) -> f64 {
        let trace = self.trace();
        self.determinant() - k * trace * trace
    }

    /// Returns the first-order estimate of the squared change of the window under a small shift,
    /// `Δᵀ M Δ`.
    ///
    /// ```
    /// use epipole::feature::WindowTensor;
    /// use nalgebra::Vector2;
    /// let tensor = WindowTensor { uu: 20.0, uv: 4.0, vv: 13.0 };
    /// assert_eq!(tensor.change(&Vector2::new(1.0, -1.0)), 25.0); // 20 − 2 · 4 + 13
    /// ```
    pub fn change(&self, shift: &Vector2<f64>) -> f64 {
        let (du, dv) = (shift.x, shift.y);
        self.uu * du * du + 2.0 * self.uv * du * dv + self.vv * dv * dv
    }
}

impl StructureTensor {
    /// Returns the tensor at one pixel; `None` outside the image.
    ///
    /// ```
    /// use epipole::feature::{StructureTensor, WindowTensor};
    /// use epipole::imaging::gray_from_values;
    /// # fn main() -> Result<(), epipole::Error> {
    /// let one = |value| gray_from_values(1, 1, vec![value]);
    /// let tensor = StructureTensor { uu: one(2.0)?, uv: one(1.0)?, vv: one(2.0)? };
    /// assert_eq!(tensor.at(0, 0), Some(WindowTensor { uu: 2.0, uv: 1.0, vv: 2.0 }));
    /// assert_eq!(tensor.at(1, 0), None);
    /// # Ok(()) }
    /// ```
    pub fn at(&self, u: u32, v: u32) -> Option<WindowTensor> {
        let [uu, uv, vv] = [&self.uu, &self.uv, &self.vv]
            .map(|image| Some(f64::from(image.get_pixel_checked(u, v)?.0[0])));
        Some(WindowTensor {
            uu: uu?,
            uv: uv?,
            vv: vv?,
        })
    }
}

/// Change of a window under every shift by integer pixels within a range.
#[derive(Debug, Clone, PartialEq)]
pub struct ShiftSurface {
    reach: usize,
    values: Vec<f64>,
}

impl ShiftSurface {
    /// Returns the maximum shift in each direction, pixels.
    pub fn reach(&self) -> usize {
        self.reach
    }

    /// Returns the squared change under a shift by `du` columns and `dv` rows; `None` beyond the
    /// range.
    pub fn at(&self, du: i32, dv: i32) -> Option<f64> {
        let side = 2 * self.reach + 1;
        let index = |shift: i32| {
            let index = usize::try_from(i64::from(shift) + self.reach as i64).ok()?;
            (index < side).then_some(index)
        };
        Some(self.values[index(dv)? * side + index(du)?])
    }
}

/// Computes the change of a window under shifts, `E(Δ) = Σ (I(p + Δ) − I(p))²` over the pixels p of
/// the window, for all integer Δ within a range.
///
/// * `center`: column and row of the window's middle, within the image
/// * `half_window`: the window is `2 half + 1` pixels wide and high; at most 127
/// * `reach`: maximum shift in each direction, pixels, at most 127
///
/// # Errors
/// [`Error::OutOfRange`] for a center outside the image, a half window or a reach above 127,
/// [`Error::NotFinite`] for a NaN or infinite pixel.
///
/// Source: Moravec 1980; Harris & Stephens 1988, §2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::shift_surface;
/// use epipole::imaging::{Border, gray_from_values};
/// // A vertical step: along it nothing changes, across it a column of three pixels does.
/// let step = gray_from_values(6, 5, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(5))?;
/// let surface = shift_surface(&step, (2, 2), 1, 1, Border::Replicate)?;
/// assert_eq!(surface.at(0, 1), Some(0.0));
/// assert_eq!(surface.at(1, 0), Some(3.0));
/// assert_eq!(surface.at(2, 0), None);
/// # Ok(()) }
/// ```
pub fn shift_surface(
    image: &GrayImage32,
    center: (u32, u32),
    half_window: usize,
    reach: usize,
    border: Border,
) -> Result<ShiftSurface> {
    require_finite(image)?;
    for (what, value, size) in [
        ("the column of a window's middle", center.0, image.width()),
        ("the row of a window's middle", center.1, image.height()),
    ] {
        if value >= size {
            return Err(Error::OutOfRange {
                what,
                requirement: "within the image",
                value: f64::from(value),
            });
        }
    }
    for (what, value) in [
        ("half a window in pixels", half_window),
        ("the reach of a shift in pixels", reach),
    ] {
        if value > 127 {
            return Err(Error::OutOfRange {
                what,
                requirement: "at most 127",
                value: value as f64,
            });
        }
    }
    let (width, height) = (image.width() as usize, image.height() as usize);
    let (u, v) = (center.0 as isize, center.1 as isize);
    let margin = (half_window + reach) as isize;
    let side = 2 * (half_window + reach) + 1;
    let mut patch = Vec::with_capacity(side * side);
    for y in v - margin..=v + margin {
        for x in u - margin..=u + margin {
            let place = border.index(x, width).zip(border.index(y, height));
            let value = place.map_or(border.constant(), |(x, y)| image.as_raw()[y * width + x]);
            patch.push(f64::from(value));
        }
    }
    let window = 2 * half_window + 1;
    let row = |top: usize, left: usize| &patch[top * side + left..][..window];
    let mut values = Vec::with_capacity((2 * reach + 1) * (2 * reach + 1));
    for down in 0..=2 * reach {
        for right in 0..=2 * reach {
            let rows = (0..window).map(|y| (row(y + down, right), row(y + reach, reach)));
            let change = rows.flat_map(|(shifted, still)| shifted.iter().zip(still));
            values.push(change.fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b)));
        }
    }
    Ok(ShiftSurface { reach, values })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::DerivativeFilter;

    #[test]
    fn a_single_pixel_has_the_same_tensor_as_among_all() {
        let image = crate::imaging::fixture::gray32("texture.npy");
        for (derivative, window, scaling, border) in [
            (
                DerivativeFilter::Sobel3,
                Window::Box(5),
                Scaling::Textbook,
                Border::Reflect101,
            ),
            (
                DerivativeFilter::Sobel5,
                Window::Box(4),
                Scaling::OpenCv,
                Border::Replicate,
            ),
            (
                DerivativeFilter::Scharr,
                Window::Gaussian(1.2),
                Scaling::OpenCv,
                Border::Constant(0.3),
            ),
        ] {
            let options = StructureTensorOptions {
                derivative,
                window,
                scaling,
                border,
            };
            let all = structure_tensor(&image, &options, &mut ()).unwrap();
            for (u, v) in [
                (0, 0),
                (1, 3),
                (17, 11),
                (image.width() - 1, image.height() - 1),
            ] {
                let want = all.at(u, v).unwrap();
                let got = WindowTensor::at(&image, (u, v), &options).unwrap();
                let off = |a: f64, b: f64| (a - b).abs() / want.trace();
                let worst = off(got.uu, want.uu)
                    .max(off(got.uv, want.uv))
                    .max(off(got.vv, want.vv));
                assert!(worst < 1e-5, "{options:?} at {u}, {v}: {got:?} {want:?}");
            }
        }
    }

    #[test]
    fn pixels_outside_and_pixels_without_a_value_are_refused() {
        let options = StructureTensorOptions::default();
        let mut image = GrayImage32::new(9, 9);
        assert!(WindowTensor::at(&image, (9, 0), &options).is_err());
        image.put_pixel(8, 8, image::Luma([f32::NAN]));
        assert!(WindowTensor::at(&image, (7, 7), &options).is_err());
        assert!(WindowTensor::at(&image, (2, 2), &options).is_ok());
    }

    use crate::feature::{Scaling, Window, harris_response, structure_tensor};

    /// A smooth hill with its top away from the middle.
    fn hill() -> GrayImage32 {
        GrayImage32::from_fn(41, 41, |u, v| {
            let (x, y) = (f64::from(u) - 17.0, f64::from(v) - 22.0);
            image::Luma([(100.0 * libm::exp(-(x * x + 0.4 * y * y + 0.3 * x * y) / 200.0)) as f32])
        })
    }

    #[test]
    fn one_window_agrees_with_the_image_of_windows() {
        let image = hill();
        let options = StructureTensorOptions {
            window: Window::Box(5),
            ..StructureTensorOptions::default()
        };
        let all = structure_tensor(&image, &options, &mut ()).unwrap();
        let responses = harris_response(&image, 0.05, &options, &mut ()).unwrap();
        for (u, v) in [(10, 10), (20, 30), (17, 22)] {
            let one = all.at(u, v).unwrap();
            let (large, small) = all.eigenvalues(u, v).unwrap();
            let (lambda1, lambda2) = one.eigenvalues();
            assert!((lambda1 - f64::from(large)).abs() < 1e-5 * lambda1);
            assert!((lambda2 - f64::from(small)).abs() < 1e-5 * lambda1);
            let response = f64::from(responses.get_pixel(u, v).0[0]);
            assert!((one.harris(0.05) - response).abs() < 1e-5 * lambda1 * lambda1);
            assert!((lambda1 + lambda2 - one.trace()).abs() < 1e-9 * lambda1);
            assert!((lambda1 * lambda2 - one.determinant()).abs() < 1e-9 * lambda1 * lambda1);
        }
    }

    #[test]
    fn taylor_predicts_the_change_of_a_smooth_image() {
        let image = hill();
        let options = StructureTensorOptions {
            window: Window::Box(9),
            ..StructureTensorOptions::default()
        };
        // Sobel gives 8 times the slope.
        let sums = structure_tensor(&image, &options, &mut ()).unwrap();
        let sums = sums.at(12, 15).unwrap();
        let tensor = WindowTensor {
            uu: sums.uu / 64.0,
            uv: sums.uv / 64.0,
            vv: sums.vv / 64.0,
        };
        let surface = shift_surface(&image, (12, 15), 4, 1, Border::Replicate).unwrap();
        assert_eq!(surface.at(0, 0), Some(0.0));
        for (du, dv) in [(1, 0), (0, 1), (1, 1), (-1, 1)] {
            // The mean of both directions cancels the next term of the series.
            let mean = 0.5 * (surface.at(du, dv).unwrap() + surface.at(-du, -dv).unwrap());
            let estimate = tensor.change(&Vector2::new(f64::from(du), f64::from(dv)));
            assert!((mean - estimate).abs() < 0.03 * mean, "{mean} {estimate}");
        }
    }

    #[test]
    fn the_direction_is_that_of_the_larger_eigenvalue() {
        for degrees in [-80.0_f64, -30.0, 0.0, 10.0, 45.0, 89.0] {
            let angle = degrees.to_radians();
            let across = Vector2::new(libm::cos(angle), libm::sin(angle));
            let along = Vector2::new(-across.y, across.x);
            let tensor = WindowTensor::from_gradients(&[3.0 * across, -along]);
            assert!((tensor.direction_rad() - angle).abs() < 1e-12, "{degrees}");
            let (lambda1, lambda2) = tensor.eigenvalues();
            assert!((lambda1 - 9.0).abs() < 1e-12 && (lambda2 - 1.0).abs() < 1e-12);
            assert!((tensor.change(&across) - 9.0).abs() < 1e-12);
        }
        assert_eq!(WindowTensor::default().direction_rad(), 0.0);
        assert_eq!(WindowTensor::default().eigenvalues(), (0.0, 0.0));
    }

    #[test]
    fn shifts_are_counted_from_the_window() {
        // Only the pixel (4, 3) is bright; the window is a single pixel next to it.
        let mut image = GrayImage32::new(8, 8);
        image.put_pixel(4, 3, image::Luma([3.0]));
        let surface = shift_surface(&image, (3, 5), 0, 2, Border::Replicate).unwrap();
        assert_eq!(surface.reach(), 2);
        for dv in -2..=2 {
            for du in -2..=2 {
                let expected = if (du, dv) == (1, -2) { 9.0 } else { 0.0 };
                assert_eq!(surface.at(du, dv), Some(expected), "{du} {dv}");
            }
        }
        assert_eq!(surface.at(3, 0), None);
        assert_eq!(surface.at(i32::MIN, i32::MAX), None);
    }

    #[test]
    fn bad_windows_are_refused_and_borders_count() {
        let image = hill();
        let border = Border::Replicate;
        assert!(shift_surface(&image, (41, 0), 2, 1, border).is_err());
        assert!(shift_surface(&image, (0, 41), 2, 1, border).is_err());
        assert!(shift_surface(&image, (0, 0), 128, 1, border).is_err());
        assert!(shift_surface(&image, (0, 0), 1, 128, border).is_err());
        assert!(shift_surface(&GrayImage32::new(0, 0), (0, 0), 1, 1, border).is_err());
        // Far outside, a replicated border no longer changes.
        let surface = shift_surface(&image, (0, 0), 1, 100, border).unwrap();
        assert_eq!(surface.at(-50, -50), surface.at(-100, -100));
        let mut corrupted = image;
        corrupted.put_pixel(3, 3, image::Luma([f32::NAN]));
        assert!(shift_surface(&corrupted, (20, 20), 1, 1, border).is_err());
    }
}
