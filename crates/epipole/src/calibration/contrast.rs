//! Contrast of an image.

use crate::imaging::GrayImage32;
use image::Luma;

/// Fraction of the pixels ignored at either end of the range in use.
const BEYOND: f64 = 0.005;

/// Maximum range to stretch.
const NARROW: f32 = 0.4;

/// Minimum range: smaller ones are a single gray value of an 8-bit sensor.
const NOTHING: f32 = 4.0 / 255.0;

/// Stretches the gray values in use to the range 0 to 1, if it is narrow, as from thermal cameras
/// or in fog. Positions do not change.
pub(super) fn stretch_contrast(image: &GrayImage32) -> Option<GrayImage32> {
    let mut values = image.as_raw().clone();
    let last = values.len().checked_sub(1)?;
    let beyond = (BEYOND * last as f64) as usize;
    let mut at = |place: usize| *values.select_nth_unstable_by(place, f32::total_cmp).1;
    let (low, high) = (at(beyond), at(last - beyond));
    let range = high - low;
    if !(NOTHING..NARROW).contains(&range) {
        return None;
    }
    let mut stretched = image.clone();
    for Luma([value]) in stretched.pixels_mut() {
        *value = ((*value - low) / range).clamp(0.0, 1.0);
    }
    Some(stretched)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_range_is_stretched() {
        let of = |low: f32, high: f32| {
            let gray = |u: u32, _| Luma([low + (high - low) * (u % 2) as f32]);
            GrayImage32::from_fn(40, 30, gray)
        };
        let image = stretch_contrast(&of(0.4, 0.45)).unwrap();
        assert_eq!((image.as_raw()[0], image.as_raw()[1]), (0.0, 1.0));
        assert!(
            stretch_contrast(&of(0.1, 0.9)).is_none() && stretch_contrast(&of(0.5, 0.5)).is_none()
        );
        assert!(stretch_contrast(&GrayImage32::new(0, 0)).is_none());
    }
}
