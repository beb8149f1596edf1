//! Inversion of any smooth lens distortion.

use nalgebra::{Matrix2, Point2};

/// Maximum number of undistortion steps; five are usual.
const MAX_STEPS: usize = 50;
/// Residual at which undistortion stops, in units of the focal length: 1e-9 px or better.
pub(super) const RESIDUAL: f64 = 1e-13;

/// Runs Newton's method for the ray imaged at a position; returns it with its residual. Steps that
/// do not help, or lead to the fold, are halved.
///
/// * `fold_sq`: squared radius that bounds the rays
/// * `distort`, `jacobian`: position of a ray's image, and its derivative
pub(super) fn descend(
    distorted: &Point2<f64>,
    start: Point2<f64>,
    fold_sq: f64,
    distort: impl Fn(&Point2<f64>) -> Point2<f64>,
    jacobian: impl Fn(&Point2<f64>) -> Matrix2<f64>,
) -> (Point2<f64>, f64) {
    let mut ray = start;
    let mut error = (distort(&ray) - distorted).norm();
    let tolerance = RESIDUAL * (1.0 + distorted.coords.norm());
    for _ in 0..MAX_STEPS {
        if error <= tolerance {
            break;
        }
        let Some(inverse) = jacobian(&ray).try_inverse() else {
            break;
        };
        let step = inverse * (distort(&ray) - distorted);
        let mut scale = 1.0;
        let better = loop {
            let candidate = ray - step * scale;
            let candidate_error = (distort(&candidate) - distorted).norm();
            if candidate_error < error && candidate.coords.norm_squared() < fold_sq {
                break Some((candidate, candidate_error));
            }
            scale *= 0.5;
            if scale < 1e-6 {
                break None;
            }
        };
        match better {
            Some((candidate, candidate_error)) => (ray, error) = (candidate, candidate_error),
            None => break,
        }
    }
    (ray, error)
}

/// Returns the ray inside the fold imaged at a position by the radial terms alone, or a ray next to
/// the fold.
///
/// * `bent`: distorted radius of a ray with a given radius
pub(super) fn radial_start(
    distorted: &Point2<f64>,
    fold_sq: f64,
    bent: impl Fn(f64) -> f64,
) -> Point2<f64> {
    let radius = distorted.coords.norm();
    // Just inside, so that a step from there is possible.
    let mut high = if fold_sq.is_finite() {
        fold_sq.sqrt() * (1.0 - 1e-9)
    } else {
        // Without a fold it eventually grows at least linearly.
        let mut high = radius.max(f64::MIN_POSITIVE);
        for _ in 0..100 {
            if bent(high) >= radius {
                break;
            }
            high *= 2.0;
        }
        high
    };
    let mut low = 0.0;
    if bent(high) > radius {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if bent(middle) < radius {
                low = middle;
            } else {
                high = middle;
            }
        }
    }
    if radius > 0.0 {
        Point2::from(distorted.coords * (high / radius))
    } else {
        *distorted
    }
}
