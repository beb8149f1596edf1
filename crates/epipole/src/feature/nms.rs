//! Non-maximum suppression.

use super::Keypoint;
use crate::imaging::{GrayImage32, require_finite};
use crate::math::order::order_by;
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};

/// Finds the pixels whose response exceeds `threshold` and every other response within `radius`
/// columns and rows, strongest first.
///
/// * `radius`: pixels, ≥ 1; the window is `2 radius + 1` wide and is cropped at the image border
///
/// Of equal maxima within a window, the first in reading order is kept; a suppressed maximum
/// suppresses no equal ones. Positions are integers. The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::NotFinite`] for a NaN or infinite response or threshold, [`Error::OutOfRange`] for a
/// radius of 0, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::non_maximum_suppression;
/// use epipole::imaging::gray_from_values;
/// let response = gray_from_values(5, 1, vec![0.0, 2.0, 1.0, 0.5, 3.0])?;
/// let peaks = non_maximum_suppression(&response, 1, 0.9, &mut ())?;
/// assert_eq!(peaks.iter().map(|p| p.u).collect::<Vec<_>>(), [4.0, 1.0]);
/// # Ok(()) }
/// ```
pub fn non_maximum_suppression(
    response: &GrayImage32,
    radius: usize,
    threshold: f32,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Keypoint>> {
    require_finite(response)?;
    if !threshold.is_finite() {
        return Err(Error::NotFinite {
            what: "the threshold of the response",
        });
    }
    if radius == 0 {
        return Err(Error::OutOfRange {
            what: "the radius of non-maximum suppression in pixels",
            requirement: "at least 1",
            value: 0.0,
        });
    }
    let (width, height) = (response.width() as usize, response.height() as usize);
    let values = response.as_raw();
    let mut peaks = Vec::new();
    let mut stays = vec![false; values.len()];
    for v in 0..height {
        let fraction = v as f32 / height as f32;
        report(monitor, Stage::FeatureDetection, fraction)?;
        let row = &values[v * width..(v + 1) * width];
        for (u, &value) in row.iter().enumerate() {
            if value > threshold && is_peak(values, &stays, width, height, u, v, radius) {
                stays[v * width + u] = true;
                peaks.push(Keypoint::at(u as f64, v as f64, value));
            }
        }
    }
    strongest_first(&mut peaks);
    Ok(peaks)
}

/// Sorts by response, then by position, for a deterministic order.
pub(crate) fn strongest_first(keypoints: &mut [Keypoint]) {
    let mut by_strength = |a: usize, b: usize| stronger(&keypoints[a], &keypoints[b]);
    let order = order_by(keypoints.len(), &mut by_strength);
    let sorted: Vec<Keypoint> = order.into_iter().map(|index| keypoints[index]).collect();
    keypoints.copy_from_slice(&sorted);
}

/// Compares two keypoints as in [`strongest_first`].
pub(crate) fn stronger(a: &Keypoint, b: &Keypoint) -> std::cmp::Ordering {
    b.response
        .total_cmp(&a.response)
        .then(a.v.total_cmp(&b.v))
        .then(a.u.total_cmp(&b.u))
        .then(a.octave.cmp(&b.octave))
        .then(a.scale_px.total_cmp(&b.scale_px))
        .then(a.angle_rad.total_cmp(&b.angle_rad))
}

/// * `stays`: whether each previous pixel, in reading order, is a peak
fn is_peak(
    values: &[f32],
    stays: &[bool],
    width: usize,
    height: usize,
    u: usize,
    v: usize,
    radius: usize,
) -> bool {
    let value = values[v * width + u];
    let columns = u.saturating_sub(radius)..=(u.saturating_add(radius)).min(width - 1);
    for y in v.saturating_sub(radius)..=(v.saturating_add(radius)).min(height - 1) {
        for x in columns.clone() {
            let other = values[y * width + x];
            if other > value || (other == value && stays[y * width + x]) {
                return false;
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plateau_keeps_one_pixel_a_window() {
        let flat = GrayImage32::from_pixel(6, 5, image::Luma([1.0]));
        let peaks = non_maximum_suppression(&flat, 5, 0.5, &mut ()).unwrap();
        assert_eq!(peaks.len(), 1);
        assert_eq!((peaks[0].u, peaks[0].v), (0.0, 0.0));
        let peaks = non_maximum_suppression(&flat, 2, 0.5, &mut ()).unwrap();
        let places: Vec<_> = peaks.iter().map(|p| (p.u, p.v)).collect();
        assert_eq!(places, [(0.0, 0.0), (3.0, 0.0), (0.0, 3.0), (3.0, 3.0)]);
        assert!(
            non_maximum_suppression(&flat, 2, 1.0, &mut ())
                .unwrap()
                .is_empty()
        );
    }

    /// The window of the plateau's second pixel contains only the first pixel, which the peak has
    /// suppressed.
    #[test]
    fn what_is_suppressed_suppresses_nothing_equal() {
        let values = vec![5.0, 0.0, 3.0, 3.0, 0.0, 0.0];
        let row = crate::imaging::gray_from_values(6, 1, values).unwrap();
        let peaks = non_maximum_suppression(&row, 2, 1.0, &mut ()).unwrap();
        assert_eq!(peaks.iter().map(|p| p.u).collect::<Vec<_>>(), [0.0, 3.0]);
    }

    #[test]
    fn peaks_are_the_maxima_of_their_windows() {
        let image = crate::imaging::fixture::gray32("texture.npy");
        let peaks = non_maximum_suppression(&image, 3, 0.0, &mut ()).unwrap();
        assert!(peaks.len() > 5);
        for p in &peaks {
            for q in &peaks {
                assert!(p == q || (p.u - q.u).abs() > 3.0 || (p.v - q.v).abs() > 3.0);
            }
            for (u, v, value) in image.enumerate_pixels() {
                let near = (f64::from(u) - p.u).abs() <= 3.0 && (f64::from(v) - p.v).abs() <= 3.0;
                assert!(!near || value.0[0] <= p.response);
            }
        }
        assert!(peaks.is_sorted_by(|a, b| a.response >= b.response));
    }

    #[test]
    fn bad_input_is_refused_and_empty_is_empty() {
        let image = GrayImage32::new(3, 3);
        assert!(non_maximum_suppression(&image, 0, 0.0, &mut ()).is_err());
        assert!(non_maximum_suppression(&image, 1, f32::NAN, &mut ()).is_err());
        let nan = GrayImage32::from_pixel(3, 3, image::Luma([f32::NAN]));
        assert!(non_maximum_suppression(&nan, 1, 0.0, &mut ()).is_err());
        let empty = non_maximum_suppression(&GrayImage32::new(0, 0), 1, 0.0, &mut ()).unwrap();
        assert!(empty.is_empty());
        let huge =
            non_maximum_suppression(&GrayImage32::new(3, 3), usize::MAX, -1.0, &mut ()).unwrap();
        assert_eq!(huge.len(), 1);
    }
}
