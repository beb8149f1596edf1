//! Sub-pixel refinement of corners.

use crate::imaging::{Border, GrayImage32, require_finite, sample_bilinear};
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::Point2;

/// Options of [`refine_corners`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct RefineOptions {
    /// Half the side of the window, pixels, 1 to 50: the window is `2 half + 1` wide.
    pub half_window: usize,
    /// Maximum number of steps.
    pub max_iterations: usize,
    /// Step length at which the refinement ends, pixels.
    pub tolerance_px: f64,
}

impl Default for RefineOptions {
    /// Returns an 11×11 window and at most 40 steps, to 10⁻³ pixels.
    fn default() -> Self {
        Self {
            half_window: 5,
            max_iterations: 40,
            tolerance_px: 1e-3,
        }
    }
}

/// Moves each corner to the point where the surrounding gradients are perpendicular to the
/// directions from it: `q` that solves `Σ w g gᵀ (q − p) = 0` over the pixels p of the window.
///
/// The weights are `exp(−(x² + y²)/half²)`. `None` for a corner whose window is flat or has a
/// single edge, if the point leaves its window, or if it is outside the image. The only stage is
/// [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::NotFinite`] for an invalid pixel, [`Error::OutOfRange`] for a window or a tolerance
/// outside its range, [`Error::Canceled`].
///
/// Source: Förstner & Gülch 1987, "A fast operator for detection and precise location of distinct
/// points, corners and centres of circular features", §4.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{RefineOptions, refine_corners};
/// use epipole::imaging::GrayImage32;
/// use nalgebra::Point2;
/// // Four squares meet between the pixels 9 and 10.
/// let board = GrayImage32::from_fn(20, 20, |u, v| image::Luma([f32::from((u < 10) == (v < 10))]));
/// let start = [Point2::new(9.0, 10.0)];
/// let refined = refine_corners(&board, &start, &RefineOptions::default(), &mut ())?;
/// let corner = refined[0].expect("a corner");
/// assert!((corner - Point2::new(9.5, 9.5)).norm() < 1e-3);
/// # Ok(()) }
/// ```
pub fn refine_corners(
    image: &GrayImage32,
    corners: &[Point2<f64>],
    options: &RefineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Option<Point2<f64>>>> {
    require_finite(image)?;
    if !(1..=50).contains(&options.half_window) {
        return Err(Error::OutOfRange {
            what: "half the window around a corner in pixels",
            requirement: "between 1 and 50",
            value: options.half_window as f64,
        });
    }
    if options.tolerance_px.is_nan() || options.tolerance_px <= 0.0 {
        return Err(Error::OutOfRange {
            what: "the tolerance of a corner in pixels",
            requirement: "greater than 0",
            value: options.tolerance_px,
        });
    }
    let half = options.half_window as isize;
    let weights: Vec<f64> = (-half..=half)
        .map(|x| {
            let x = x as f64 / half as f64;
            libm::exp(-x * x)
        })
        .collect();
    monitored::map(corners, Stage::FeatureDetection, monitor, |corner| {
        refine(image, corner, &weights, options)
    })
}

fn refine(
    image: &GrayImage32,
    start: &Point2<f64>,
    weights: &[f64],
    options: &RefineOptions,
) -> Option<Point2<f64>> {
    let half = options.half_window as f64;
    let (right, bottom) = (
        f64::from(image.width()) - 0.5,
        f64::from(image.height()) - 0.5,
    );
    let side = weights.len() + 2;
    let mut patch = vec![0.0f64; side * side];
    let mut corner = *start;
    for _ in 0..options.max_iterations.max(1) {
        let inside = corner.x >= -0.5 && corner.y >= -0.5 && corner.x < right && corner.y < bottom;
        // Also false for NaN.
        if !inside {
            return None;
        }
        for (k, value) in patch.iter_mut().enumerate() {
            let u = corner.x + (k % side) as f64 - half - 1.0;
            let v = corner.y + (k / side) as f64 - half - 1.0;
            *value = f64::from(sample_bilinear(image, u, v, Border::Replicate));
        }
        // Sums of w gᵤ², w gᵤ gᵥ, w gᵥ² and of the right side, relative to the corner.
        let [mut a, mut b, mut c, mut p, mut q] = [0.0; 5];
        for (j, wv) in weights.iter().enumerate() {
            for (i, wu) in weights.iter().enumerate() {
                let at = (j + 1) * side + i + 1;
                let gu = patch[at + 1] - patch[at - 1];
                let gv = patch[at + side] - patch[at - side];
                let (x, y) = (i as f64 - half, j as f64 - half);
                let w = wu * wv;
                let (uu, uv, vv) = (w * gu * gu, w * gu * gv, w * gv * gv);
                a += uu;
                b += uv;
                c += vv;
                p += uu * x + uv * y;
                q += uv * x + vv * y;
            }
        }
        let determinant = a * c - b * b;
        // An edge does not determine the point along itself.
        if determinant <= 1e-6 * (a + c) * (a + c) {
            return None;
        }
        let step = Point2::new((c * p - b * q) / determinant, (a * q - b * p) / determinant);
        corner = Point2::new(corner.x + step.x, corner.y + step.y);
        if (corner.x - start.x).abs() > half || (corner.y - start.y).abs() > half {
            return None;
        }
        if step.x * step.x + step.y * step.y <= options.tolerance_px * options.tolerance_px {
            break;
        }
    }
    Some(corner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::fixture;

    #[test]
    fn refined_corners_equal_opencv() {
        let image = fixture::gray32("corners.npy");
        let points = |name| {
            let list = fixture::floats(name).values;
            let pairs = list.chunks_exact(2);
            pairs
                .map(|p| Point2::new(f64::from(p[0]), f64::from(p[1])))
                .collect::<Vec<_>>()
        };
        let (start, expected) = (points("subpix_start.npy"), points("subpix_refined.npy"));
        let options = RefineOptions {
            half_window: 4,
            max_iterations: 100,
            tolerance_px: 1e-5,
        };
        let refined = refine_corners(&image, &start, &options, &mut ()).unwrap();
        let mut compared = 0;
        for ((got, want), from) in refined.iter().zip(&expected).zip(&start) {
            // For a diverging corner OpenCV returns the initial position.
            let Some(got) = got else { continue };
            if (want - from).norm() > 0.0 {
                assert!((got - want).norm() < 2e-3, "{got} {want}");
                compared += 1;
            }
        }
        assert!(compared >= 18, "{compared}");
    }

    #[test]
    fn flat_edge_outside_and_nan_give_none() {
        let edge = GrayImage32::from_fn(20, 20, |u, _| image::Luma([f32::from(u < 10)]));
        let flat = GrayImage32::new(20, 20);
        let options = RefineOptions::default();
        for (image, point) in [
            (&edge, Point2::new(9.0, 9.0)),
            (&flat, Point2::new(9.0, 9.0)),
            (&edge, Point2::new(-4.0, 9.0)),
            (&edge, Point2::new(f64::NAN, 9.0)),
        ] {
            assert_eq!(
                refine_corners(image, &[point], &options, &mut ()).unwrap(),
                [None]
            );
        }
        let empty = GrayImage32::new(0, 0);
        assert_eq!(
            refine_corners(&empty, &[Point2::origin()], &options, &mut ()).unwrap(),
            [None]
        );
        assert!(
            refine_corners(&flat, &[], &options, &mut ())
                .unwrap()
                .is_empty()
        );
    }

    #[test]
    fn bad_options_are_refused() {
        let image = GrayImage32::new(5, 5);
        for (half_window, tolerance_px) in [(0, 1e-3), (51, 1e-3), (3, 0.0), (3, f64::NAN)] {
            let options = RefineOptions {
                half_window,
                tolerance_px,
                ..RefineOptions::default()
            };
            assert!(refine_corners(&image, &[], &options, &mut ()).is_err());
        }
    }
}
