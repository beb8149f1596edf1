//! Pixels in units that do not fit their camera.

use crate::context::Context;
use epipole::camera::Intrinsics;
use nalgebra::Point2;

/// Bound of coordinates that are fractions of an image or rays, not pixels.
const MAX_FRACTION: f64 = 2.0;

/// Factor of the principal point beyond which a pixel is outside the image.
const BEYOND: f64 = 3.0;

/// Warns of coordinates that are not pixels, without a camera.
///
/// * `max_error_px`: maximum error of an inlier; a small one shows that the unit is intended
pub(crate) fn warn_of_fractions(pixels: &[&[Point2<f64>]], max_error_px: f64, context: &Context) {
    let all = pixels.iter().copied().flatten();
    let reach = all.map(|pixel| pixel.coords.amax()).fold(0.0, f64::max);
    if reach > 0.0 && reach <= MAX_FRACTION && max_error_px > reach / 10.0 {
        context.warn(&format!(
            "all coordinates are within ± {reach:.2}: they look like fractions of the image or rays, not pixels. \
             Multiply them by the size of the image, or give a --max-error-px of their unit"
        ));
    }
}

/// Warns of pixels that do not fit the camera.
pub(crate) fn warn_of_units(pixels: &[Point2<f64>], k: &Intrinsics, context: &Context) {
    let center = k.principal_point();
    let reach = pixels
        .iter()
        .map(|pixel| pixel.coords.amax())
        .fold(0.0, f64::max);
    if reach <= MAX_FRACTION && k.fu_px() > 10.0 * MAX_FRACTION {
        context.warn(&format!(
            "all coordinates are within ± {reach:.2}: they look like fractions of the image or rays, not pixels. \
             Multiply them by the size of the image, or give --k 1,1,0,0 with a small \
             --max-error-px for rays"
        ));
    }
    let beyond = |at: fn(&Point2<f64>) -> f64| {
        let most = pixels.iter().map(at).fold(0.0, f64::max);
        (at(&center) > 0.0 && most > BEYOND * at(&center)).then_some((most, at(&center)))
    };
    if let Some((most, center)) = beyond(|pixel| pixel.x).or(beyond(|pixel| pixel.y)) {
        context.warn(&format!(
            "pixels reach {most:.0}, but the principal point at {center:.0} belongs to an image of about {:.0} pixels: \
             the intrinsics must be those of the image with the pixels",
            2.0 * center
        ));
    }
}
