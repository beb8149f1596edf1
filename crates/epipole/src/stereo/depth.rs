//! Depth from disparity, and its uncertainty.

use crate::{Error, Result};

/// Computes the depth of a point seen by a rectified stereo pair, `Z = f B / d`.
///
/// * `focal_px`: focal length shared by both cameras, pixels
/// * `baseline_m`: distance between the camera centers, meters, > 0
/// * `disparity_px`: `u_left − u_right`, pixels
///
/// Returns the depth along the left optical axis, meters. A disparity error of δ px costs about
/// `Z² δ / (f B)` meters, so depth degrades with the square of distance.
///
/// # Errors
/// [`Error::PointAtInfinity`] if `disparity_px <= 0`: the rays are parallel, or the match is
/// wrong. [`Error::OutOfRange`] for a focal length or baseline ≤ 0, [`Error::NotFinite`] for NaN
/// and infinities.
///
/// Source: Hartley & Zisserman 2004, §11.12.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// let depth_m = epipole::stereo::depth_from_disparity(700.0, 0.12, 30.0)?;
/// assert!((depth_m - 2.8).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn depth_from_disparity(focal_px: f64, baseline_m: f64, disparity_px: f64) -> Result<f64> {
    check_rig(focal_px, baseline_m)?;
    check_finite("the disparity", disparity_px)?;
    finite_depth(focal_px * baseline_m, disparity_px).ok_or(Error::PointAtInfinity)
}

/// Interval of depths for a disparity with bounded error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthInterval {
    /// Minimum depth, meters.
    pub near_m: f64,
    /// Maximum depth, meters; `None` if the interval reaches infinity.
    pub far_m: Option<f64>,
}

/// Computes the depths between `f B / (d + δ)` and `f B / (d − δ)`.
///
/// * `focal_px`, `baseline_m`, `disparity_px`: as for [`depth_from_disparity`]
/// * `error_px`: δ, maximum error of the disparity, pixels, ≥ 0
///
/// If `d − δ <= 0`, even parallel rays are possible, and [`DepthInterval::far_m`] is `None`.
///
/// # Errors
/// [`Error::PointAtInfinity`] if `disparity_px + error_px <= 0`: no depth is possible.
/// [`Error::OutOfRange`] for a focal length or baseline ≤ 0 or an error < 0,
/// [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Hartley & Zisserman 2004, §11.12.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::depth_interval;
/// let interval = depth_interval(800.0, 0.1, 4.0, 1.0)?; // f B = 80
/// assert!((interval.near_m - 16.0).abs() < 1e-12);
/// assert!((interval.far_m.unwrap_or(0.0) - 80.0 / 3.0).abs() < 1e-12);
/// assert_eq!(depth_interval(800.0, 0.1, 0.5, 1.0)?.far_m, None);
/// # Ok(()) }
/// ```
pub fn depth_interval(
    focal_px: f64,
    baseline_m: f64,
    disparity_px: f64,
    error_px: f64,
) -> Result<DepthInterval> {
    check_rig(focal_px, baseline_m)?;
    check_finite("the disparity", disparity_px)?;
    check_finite("the disparity's error", error_px)?;
    if error_px < 0.0 {
        return Err(Error::OutOfRange {
            what: "the disparity's error",
            requirement: "at least 0 pixels",
            value: error_px,
        });
    }
    let product = focal_px * baseline_m;
    Ok(DepthInterval {
        near_m: finite_depth(product, disparity_px + error_px).ok_or(Error::PointAtInfinity)?,
        far_m: finite_depth(product, disparity_px - error_px),
    })
}

fn finite_depth(product: f64, disparity_px: f64) -> Option<f64> {
    let depth_m = product / disparity_px;
    (disparity_px > 0.0 && depth_m.is_finite()).then_some(depth_m)
}

fn check_rig(focal_px: f64, baseline_m: f64) -> Result<()> {
    check_finite("the focal length", focal_px)?;
    check_finite("the baseline", baseline_m)?;
    for (what, requirement, value) in [
        ("the focal length", "greater than 0 pixels", focal_px),
        ("the baseline", "greater than 0 meters", baseline_m),
    ] {
        if value <= 0.0 {
            return Err(Error::OutOfRange {
                what,
                requirement,
                value,
            });
        }
    }
    Ok(())
}

fn check_finite(what: &'static str, value: f64) -> Result<()> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Error::NotFinite { what })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_grows_with_the_square_of_depth() {
        let width = |disparity_px: f64| {
            let interval = depth_interval(700.0, 0.12, disparity_px, 0.1).unwrap();
            interval.far_m.unwrap() - interval.near_m
        };
        // Half the disparity means twice the depth, so four times the uncertainty.
        assert!((width(15.0) / width(30.0) - 4.0).abs() < 1e-3);
    }

    #[test]
    fn impossible_values_are_refused() {
        for (focal_px, baseline_m, disparity_px) in [
            (0.0, 0.1, 1.0),
            (700.0, 0.0, 1.0),
            (700.0, -0.1, 1.0),
            (700.0, 0.1, 0.0),
            (700.0, 0.1, -3.0),
            (700.0, 0.1, 1e-320),
            (f64::NAN, 0.1, 1.0),
            (700.0, f64::INFINITY, 1.0),
            (700.0, 0.1, f64::NAN),
        ] {
            assert!(depth_from_disparity(focal_px, baseline_m, disparity_px).is_err());
            assert!(depth_interval(focal_px, baseline_m, disparity_px, 0.0).is_err());
        }
        assert!(depth_interval(700.0, 0.1, 5.0, -1.0).is_err());
        assert!(depth_interval(700.0, 0.1, 5.0, f64::NAN).is_err());
        assert_eq!(
            depth_interval(700.0, 0.1, -5.0, 1.0),
            Err(Error::PointAtInfinity)
        );
    }

    #[test]
    fn no_error_means_one_depth() {
        let interval = depth_interval(700.0, 0.12, 30.0, 0.0).unwrap();
        assert_eq!(interval.far_m, Some(interval.near_m));
    }
}
