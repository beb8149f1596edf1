//! Corner measures: Harris and Shi–Tomasi.

use super::structure_tensor::{StructureTensorOptions, with_tensor};
use crate::imaging::GrayImage32;
use crate::math::simd::dispatched;
use crate::progress::Monitor;
use crate::{Error, Result};

/// Computes the Harris response `R = det M − k (trace M)²` of the structure tensor M at each pixel:
/// positive at corners, negative along edges, near zero in flat regions. The only stage is
/// [`Stage::FeatureDetection`](crate::progress::Stage::FeatureDetection).
///
/// * `k`: in [0, 0.25), usually 0.04 to 0.06
///
/// # Errors
/// [`Error::OutOfRange`] for a k outside [0, 0.25), and as
/// [`structure_tensor`](super::structure_tensor()).
///
/// Source: Harris & Stephens 1988, "A combined corner and edge detector", eq. 13.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{StructureTensorOptions, harris_response};
/// use epipole::imaging::gray_from_values;
/// // A vertical step: M = [96 0; 0 0], so R = 0 − 0.05 · 96².
/// let step = gray_from_values(6, 3, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3))?;
/// let response = harris_response(&step, 0.05, &StructureTensorOptions::default(), &mut ())?;
/// assert!((response.get_pixel(2, 1).0[0] + 460.8).abs() < 1e-3);
/// # Ok(()) }
/// ```
pub fn harris_response(
    image: &GrayImage32,
    k: f32,
    options: &StructureTensorOptions,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    if !(0.0..0.25).contains(&k) {
        return Err(Error::OutOfRange {
            what: "the Harris constant k",
            requirement: "at least 0 and below 0.25",
            value: f64::from(k),
        });
    }
    let [response] = with_tensor(
        image,
        options,
        monitor,
        |[uu, uv, vv], [out]: [&mut [f32]; 1]| harris_row(uu, uv, vv, k, out),
    )?;
    Ok(response)
}

/// Computes the smaller eigenvalue of the structure tensor at each pixel, the measure of Shi and
/// Tomasi. The only stage is [`Stage::FeatureDetection`](crate::progress::Stage::FeatureDetection).
///
/// # Errors
/// As [`structure_tensor`](super::structure_tensor()).
///
/// Source: Shi & Tomasi 1994, "Good features to track", §4.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{StructureTensorOptions, min_eigenvalue_response};
/// use epipole::imaging::gray_from_values;
/// let step = gray_from_values(6, 3, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3))?;
/// let response = min_eigenvalue_response(&step, &StructureTensorOptions::default(), &mut ())?;
/// assert_eq!(response.get_pixel(2, 1).0[0], 0.0); // an edge is no corner
/// # Ok(()) }
/// ```
pub fn min_eigenvalue_response(
    image: &GrayImage32,
    options: &StructureTensorOptions,
    monitor: &mut dyn Monitor,
) -> Result<GrayImage32> {
    let [response] = with_tensor(
        image,
        options,
        monitor,
        |[uu, uv, vv], [out]: [&mut [f32]; 1]| min_eigenvalue_row(uu, uv, vv, out),
    )?;
    Ok(response)
}

dispatched! {
    fn harris_row(uu: &[f32], uv: &[f32], vv: &[f32], k: f32, out: &mut [f32]) {
        let n = out.len();
        let (uu, uv, vv) = (&uu[..n], &uv[..n], &vv[..n]);
        for x in 0..n {
            let (a, b, c) = (uu[x], uv[x], vv[x]);
            let trace = a + c;
            out[x] = a * c - b * b - k * trace * trace;
        }
    }
}
dispatched! {
    fn min_eigenvalue_row(uu: &[f32], uv: &[f32], vv: &[f32], out: &mut [f32]) {
        let n = out.len();
        let (uu, uv, vv) = (&uu[..n], &uv[..n], &vv[..n]);
        for x in 0..n {
            let (a, b, c) = (0.5 * uu[x], uv[x], 0.5 * vv[x]);
            let half = a - c;
            out[x] = (a + c) - (half * half + b * b).sqrt();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::{Scaling, Window};
    use crate::imaging::{DerivativeFilter, fixture};

    fn opencv(derivative: DerivativeFilter, block: usize) -> StructureTensorOptions {
        StructureTensorOptions {
            derivative,
            window: Window::Box(block),
            scaling: Scaling::OpenCv,
            ..StructureTensorOptions::default()
        }
    }

    #[test]
    fn responses_equal_opencv() {
        let image = fixture::gray32("corners.npy");
        for (name, k, options) in [
            ("harris_3_3.npy", 0.04, opencv(DerivativeFilter::Sobel3, 3)),
            ("harris_2_3.npy", 0.04, opencv(DerivativeFilter::Sobel3, 2)),
            ("harris_5_5.npy", 0.06, opencv(DerivativeFilter::Sobel5, 5)),
            (
                "harris_scharr.npy",
                0.04,
                opencv(DerivativeFilter::Scharr, 3),
            ),
        ] {
            let ours = harris_response(&image, k, &options, &mut ()).unwrap();
            fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
        }
        let ours =
            min_eigenvalue_response(&image, &opencv(DerivativeFilter::Sobel3, 3), &mut ()).unwrap();
        let name = "min_eigen_3_3.npy";
        fixture::assert_close(&ours, &fixture::gray32(name), 1e-6, name);
    }

    #[test]
    fn unusual_shapes_have_a_response() {
        for (w, h) in [(0, 0), (1, 1), (1, 40), (40, 1), (2, 2)] {
            let image = GrayImage32::from_fn(w, h, |u, v| image::Luma([(u + v) as f32]));
            let response =
                harris_response(&image, 0.04, &opencv(DerivativeFilter::Sobel5, 7), &mut ());
            let response = response.unwrap();
            assert_eq!(response.dimensions(), (w, h));
            assert!(crate::imaging::is_finite(&response));
        }
        let flat = GrayImage32::from_pixel(30, 20, image::Luma([0.4]));
        let response =
            harris_response(&flat, 0.04, &StructureTensorOptions::default(), &mut ()).unwrap();
        assert!(response.as_raw().iter().all(|&r| r == 0.0));
    }

    #[test]
    fn k_outside_its_range_is_refused() {
        let image = GrayImage32::new(3, 3);
        for k in [-0.1, 0.25, 3.0, f32::NAN] {
            assert!(
                harris_response(&image, k, &StructureTensorOptions::default(), &mut ()).is_err()
            );
        }
    }
}
