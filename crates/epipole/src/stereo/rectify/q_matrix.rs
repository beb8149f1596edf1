//! Matrix from pixels with disparities to points.

use crate::{Error, Result};
use nalgebra::{Matrix4, Vector2};

/// Returns Q of a parallel rig.
///
/// * `translation`: coordinate of t along the baseline's axis; −B for a second camera to the right
/// * `offset_px`: difference of the principal points along it
#[rustfmt::skip]
pub(super) fn q_matrix(focal_px: f64, center: &Vector2<f64>, translation: f64, offset_px: f64) -> Matrix4<f64> {
    Matrix4::new(
        1.0, 0.0, 0.0,                -center.x,
        0.0, 1.0, 0.0,                -center.y,
        0.0, 0.0, 0.0,                focal_px,
        0.0, 0.0, -1.0 / translation, offset_px / translation,
    )
}

/// Returns Q of a rectified pair with a common focal length and principal point:
/// `X = (u − cu) B/d`, `Y = (v − cv) B/d`, `Z = f B/d`.
///
/// * `focal_px`: pixels, > 0; `baseline_m`: meters, > 0
/// * `cu_px`, `cv_px`: principal point, pixels
///
/// # Errors
/// [`Error::OutOfRange`] for a focal length or baseline ≤ 0, [`Error::NotFinite`] for NaN or
/// infinities.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::stereo::q_from_rig;
/// let q = q_from_rig(700.0, 0.12, 320.0, 240.0)?;
/// let x = q * nalgebra::Vector4::new(420.0, 240.0, 30.0, 1.0);
/// assert!((x.z / x.w - 2.8).abs() < 1e-12); // 700 × 0.12 / 30
/// assert!((x.x / x.w - 0.4).abs() < 1e-12); // 100 × 0.12 / 30
/// # Ok(()) }
/// ```
pub fn q_from_rig(focal_px: f64, baseline_m: f64, cu_px: f64, cv_px: f64) -> Result<Matrix4<f64>> {
    for (what, value) in [
        ("the focal length", focal_px),
        ("the baseline", baseline_m),
        ("the principal point's u", cu_px),
        ("the principal point's v", cv_px),
    ] {
        if !value.is_finite() {
            return Err(Error::NotFinite { what });
        }
    }
    for (what, value) in [("the focal length", focal_px), ("the baseline", baseline_m)] {
        if value <= 0.0 {
            return Err(Error::OutOfRange {
                what,
                requirement: "greater than 0",
                value,
            });
        }
    }
    Ok(q_matrix(
        focal_px,
        &Vector2::new(cu_px, cv_px),
        -baseline_m,
        0.0,
    ))
}
