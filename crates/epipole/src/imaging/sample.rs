//! Interpolation of gray values between pixels.

use super::{Border, GrayImage32};

/// Interpolates the gray value at (u, v) bilinearly from the four surrounding pixels.
///
/// With `a, b` the fractional parts of u and v,
/// `I = (1−a)(1−b) I₀₀ + a(1−b) I₁₀ + (1−a)b I₀₁ + ab I₁₁`.
///
/// * `u`, `v`: pixels, centers at integers; `border` applies outside the image
///
/// An empty image, or a coordinate that is not finite, gives the border's constant, 0 unless set.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, sample_bilinear};
/// let image = gray_from_values(2, 2, vec![0.0, 1.0, 2.0, 3.0])?;
/// assert_eq!(sample_bilinear(&image, 0.5, 0.5, Border::Replicate), 1.5);
/// # Ok(()) }
/// ```
pub fn sample_bilinear(image: &GrayImage32, u: f64, v: f64, border: Border) -> f32 {
    bilinear(image.dimensions(), u, v, border, |i| image.as_raw()[i])
}

/// * `read`: returns the value of a pixel by its index, row by row
pub(crate) fn bilinear(
    (width, height): (u32, u32),
    u: f64,
    v: f64,
    border: Border,
    read: impl Fn(usize) -> f32,
) -> f32 {
    let Some((u0, v0)) = base_pixel(u, v) else {
        return border.constant();
    };
    let (a, b) = ((u - u.floor()) as f32, (v - v.floor()) as f32);
    let (columns, rows) = (width as isize, height as isize);
    let [p00, p10, p01, p11] = if u0 >= 0 && v0 >= 0 && u0 + 1 < columns && v0 + 1 < rows {
        let top = (v0 * columns + u0) as usize;
        let bottom = top + width as usize;
        [read(top), read(top + 1), read(bottom), read(bottom + 1)]
    } else {
        let read = |i, j| pixel((width, height), u0 + i, v0 + j, border, &read);
        [read(0, 0), read(1, 0), read(0, 1), read(1, 1)]
    };
    // With differences, an exact pixel or a constant patch is reproduced exactly.
    let (top, bottom) = (p00 + a * (p10 - p00), p01 + a * (p11 - p01));
    top + b * (bottom - top)
}

/// Interpolates the gray value at (u, v) bicubically from the sixteen surrounding pixels.
///
/// The kernel is Keys' with a = −1/2 (the Catmull–Rom spline): it passes through the pixels and
/// reproduces every quadratic exactly.
///
/// * `u`, `v`: pixels, centers at integers; `border` applies outside the image
///
/// An empty image, or a coordinate that is not finite, gives the border's constant, 0 unless set.
///
/// Source: Keys 1981, "Cubic convolution interpolation for digital image processing", eq. 15.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::imaging::{Border, gray_from_values, sample_bicubic};
/// let squares = gray_from_values(5, 1, vec![0.0, 1.0, 4.0, 9.0, 16.0])?;
/// assert_eq!(sample_bicubic(&squares, 2.5, 0.0, Border::Replicate), 6.25);
/// # Ok(()) }
/// ```
pub fn sample_bicubic(image: &GrayImage32, u: f64, v: f64, border: Border) -> f32 {
    bicubic(image.dimensions(), u, v, border, |i| image.as_raw()[i])
}

/// * `read`: returns the value of a pixel by its index, row by row
pub(super) fn bicubic(
    size: (u32, u32),
    u: f64,
    v: f64,
    border: Border,
    read: impl Fn(usize) -> f32,
) -> f32 {
    let Some((u0, v0)) = base_pixel(u, v) else {
        return border.constant();
    };
    let along_u = keys_weights((u - u.floor()) as f32);
    let along_v = keys_weights((v - v.floor()) as f32);
    let mut sum = 0.0;
    for (j, wv) in along_v.iter().enumerate() {
        let mut row = 0.0;
        for (i, wu) in along_u.iter().enumerate() {
            let (x, y) = (u0 + i as isize - 1, v0 + j as isize - 1);
            row += wu * pixel(size, x, y, border, &read);
        }
        sum += wv * row;
    }
    sum
}

/// Returns the pixel to the upper left of (u, v); `None` if a coordinate is not finite.
fn base_pixel(u: f64, v: f64) -> Option<(isize, isize)> {
    // Far outside, the fraction is meaningless and the index must not overflow.
    let clamp = |x: f64| x.floor().clamp(-1e9, 1e9) as isize;
    (u.is_finite() && v.is_finite()).then(|| (clamp(u), clamp(v)))
}

fn pixel(
    (width, height): (u32, u32),
    u: isize,
    v: isize,
    border: Border,
    read: &impl Fn(usize) -> f32,
) -> f32 {
    let (columns, rows) = (width as usize, height as usize);
    match (border.index(u, columns), border.index(v, rows)) {
        (Some(x), Some(y)) => read(y * columns + x),
        _ => border.constant(),
    }
}

/// Returns the weights of the pixels at −1, 0, 1, 2 for a point at `t` in [0, 1).
fn keys_weights(t: f32) -> [f32; 4] {
    [
        ((-0.5 * t + 1.0) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((-1.5 * t + 2.0) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn bilinear_equals_scipy() {
        let image = fixture::gray32("texture.npy");
        let points = fixture::floats("sample_points.npy");
        for (name, border) in [
            ("sample_bilinear_reflect.npy", Border::Reflect101),
            ("sample_bilinear_replicate.npy", Border::Replicate),
        ] {
            let expected = fixture::floats(name);
            for (uv, want) in points.values.chunks_exact(2).zip(&expected.values) {
                let got = sample_bilinear(&image, f64::from(uv[0]), f64::from(uv[1]), border);
                assert!((got - want).abs() < 1e-6, "{uv:?}: {got} {want}");
            }
        }
    }

    #[test]
    fn bicubic_reproduces_quadratics_and_pixels() {
        let f = |u: f32, v: f32| 0.5 * u * u - 0.25 * u * v + 0.125 * v * v - u + 2.0;
        let image = GrayImage32::from_fn(9, 8, |u, v| image::Luma([f(u as f32, v as f32)]));
        for (u, v) in [(2.0, 3.0), (3.25, 2.5), (4.875, 4.125)] {
            let got = sample_bicubic(&image, u, v, Border::Replicate);
            assert!((got - f(u as f32, v as f32)).abs() < 1e-5);
        }
    }

    #[test]
    fn strange_coordinates_have_a_value() {
        let image = GrayImage32::from_pixel(3, 2, image::Luma([0.5]));
        for sample in [sample_bilinear, sample_bicubic] {
            assert_eq!(sample(&image, 1e300, -1e300, Border::Replicate), 0.5);
            assert_eq!(sample(&image, f64::NAN, 0.0, Border::Replicate), 0.0);
            assert_eq!(
                sample(&image, 0.0, f64::INFINITY, Border::Constant(0.25)),
                0.25
            );
            assert_eq!(sample(&image, -40.0, 0.0, Border::Constant(0.25)), 0.25);
            assert_eq!(
                sample(&GrayImage32::new(0, 0), 0.0, 0.0, Border::Reflect101),
                0.0
            );
            let single = GrayImage32::from_pixel(1, 1, image::Luma([0.75]));
            let value = sample(&single, 0.3, 0.7, Border::Reflect101);
            assert!((value - 0.75).abs() < 1e-6);
        }
    }
}
