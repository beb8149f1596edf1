//! Conversion of photographs for the core's structure from motion: features with their colors.

use epipole::sfm::SfmImage;
use image::RgbImage;
use nalgebra::Point2;

/// Returns features of a photograph with their colors.
///
/// * `places`: positions of the features, pixels
pub(crate) fn sfm_image(photograph: &RgbImage, places: &[Point2<f64>]) -> SfmImage {
    let colors = places.iter().map(|place| color_at(photograph, place));
    SfmImage {
        keypoints: places.to_vec(),
        colors: colors.collect(),
        ..SfmImage::default()
    }
}

/// Returns the color of the pixel nearest to a position.
pub(crate) fn color_at(photograph: &RgbImage, place: &Point2<f64>) -> [u8; 3] {
    let inside = |x: f64, size: u32| (x.round().max(0.0) as u32).min(size.max(1) - 1);
    let (width, height) = photograph.dimensions();
    photograph
        .get_pixel(inside(place.x, width), inside(place.y, height))
        .0
}
