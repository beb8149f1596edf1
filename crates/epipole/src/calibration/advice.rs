//! Warnings about a set of views.

use super::calibrated_view::CalibratedView;
use nalgebra::Vector3;

/// A property of the views that makes a calibration less certain than its errors suggest.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationWarning {
    /// All boards have nearly the same orientation: focal length and distance are hardly
    /// distinguishable.
    #[error(
        "the boards are nearly parallel: no two differ by more than {angle_deg:.0}°. Turn the board by 30° to \
         45° about several axes"
    )]
    Parallel {
        /// Largest angle between two boards, degrees.
        angle_deg: f64,
    },
    /// The focal length is uncertain.
    #[error(
        "the focal length is sure to {percent:.1}% only. More views help, turned in other directions and larger in the \
         picture"
    )]
    UncertainFocal {
        /// Standard deviation in percent of the focal length.
        percent: f64,
    },
    /// Much of the image has no marks, and the lens model extrapolates there.
    #[error(
        "the boards reach {percent:.0}% of the picture, and elsewhere the distortion is a guess. Move the board to \
         the edges and corners, too"
    )]
    LowCoverage {
        /// Covered fraction of the image's area, percent.
        percent: f64,
    },
    /// One view fits much worse than the others.
    #[error(
        "view {number} fits with {rms_px:.2} px, the others with {median_px:.2} px: blurred, bent, or of another board"
    )]
    BadView {
        /// Number of the view, from 1.
        number: usize,
        /// RMS error of the view, pixels.
        rms_px: f64,
        /// Median over all views, pixels.
        median_px: f64,
    },
}

const LEAST_ANGLE_DEG: f64 = 15.0;
const LARGEST_DEVIATION: f64 = 0.01;
const LEAST_COVERAGE: f64 = 0.4;
/// Minimum error of a bad view, as a multiple of the median, and excess over it, pixels.
const BAD_VIEW: (f64, f64) = (3.0, 0.3);

pub(super) fn warnings(
    views: &[Option<CalibratedView>],
    focal_deviation: f64,
    coverage: f64,
) -> Vec<CalibrationWarning> {
    let mut warnings = Vec::new();
    let used: Vec<&CalibratedView> = views.iter().flatten().collect();
    let angle_deg = largest_angle_deg(&used);
    if angle_deg < LEAST_ANGLE_DEG {
        warnings.push(CalibrationWarning::Parallel { angle_deg });
    }
    if focal_deviation > LARGEST_DEVIATION {
        warnings.push(CalibrationWarning::UncertainFocal {
            percent: 100.0 * focal_deviation,
        });
    }
    if coverage < LEAST_COVERAGE {
        warnings.push(CalibrationWarning::LowCoverage {
            percent: 100.0 * coverage,
        });
    }
    let mut errors: Vec<f64> = used.iter().map(|view| view.rms_px).collect();
    errors.sort_by(f64::total_cmp);
    if let Some(&median_px) = errors.get(errors.len() / 2) {
        let (times, by) = BAD_VIEW;
        for (index, view) in views.iter().enumerate() {
            if let Some(view) = view
                && view.rms_px > times * median_px
                && view.rms_px > median_px + by
            {
                warnings.push(CalibrationWarning::BadView {
                    number: index + 1,
                    rms_px: view.rms_px,
                    median_px,
                });
            }
        }
    }
    warnings
}

/// Returns the largest angle between the normals of two boards.
fn largest_angle_deg(views: &[&CalibratedView]) -> f64 {
    let normals: Vec<Vector3<f64>> = views
        .iter()
        .map(|view| view.cam_from_board.rotation * Vector3::z())
        .collect();
    let mut largest: f64 = 0.0;
    for (i, a) in normals.iter().enumerate() {
        for b in &normals[..i] {
            largest = largest.max(libm::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    largest.to_degrees()
}
