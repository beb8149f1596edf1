//! Patch descriptors: the gray values around a keypoint.

use super::{Descriptors, Keypoint};
use crate::imaging::{Border, GrayImage32, require_finite, sample_bilinear};
use crate::math::monitored;
use crate::progress::{Monitor, Stage};
use crate::{Error, Result};

/// Computes the gray values in a square around each keypoint, with mean removed and scaled to unit
/// length: invariant only to brightness and contrast.
///
/// * `size`: samples along a side, 2 to 64; the descriptor has `size²` numbers, rows first
/// * `spacing_px`: distance between samples, pixels, > 0
///
/// The inner product of two descriptors is their normalized cross-correlation. Border pixels are
/// repeated outside. A flat patch gives zeros. The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::OutOfRange`] for a size or spacing outside its range, [`Error::NotFinite`] for an
/// invalid pixel.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Keypoint, describe_patches};
/// use epipole::imaging::gray_from_values;
/// let image = gray_from_values(2, 2, vec![0.0, 1.0, 1.0, 0.0])?;
/// let patch = describe_patches(&image, &[Keypoint::at(0.5, 0.5, 1.0)], 2, 1.0, &mut ())?;
/// assert_eq!(patch.get(0), Some(vec![-0.5, 0.5, 0.5, -0.5]));
/// # Ok(()) }
/// ```
pub fn describe_patches(
    image: &GrayImage32,
    keypoints: &[Keypoint],
    size: usize,
    spacing_px: f64,
    monitor: &mut dyn Monitor,
) -> Result<Descriptors> {
    require_finite(image)?;
    if !(2..=64).contains(&size) {
        return Err(Error::OutOfRange {
            what: "the side of a patch in samples",
            requirement: "between 2 and 64",
            value: size as f64,
        });
    }
    if !(spacing_px > 0.0 && spacing_px.is_finite()) {
        return Err(Error::OutOfRange {
            what: "the spacing of a patch's samples in pixels",
            requirement: "greater than 0",
            value: spacing_px,
        });
    }
    let mut values = vec![0.0; keypoints.len() * size * size];
    let middle = (size as f64 - 1.0) / 2.0;
    let stage = Stage::FeatureDetection;
    monitored::for_each_chunk(&mut values, size * size, stage, monitor, |first, patch| {
        let keypoint = &keypoints[first / (size * size)];
        for (j, row) in patch.chunks_exact_mut(size).enumerate() {
            for (i, value) in row.iter_mut().enumerate() {
                let u = keypoint.u + (i as f64 - middle) * spacing_px;
                let v = keypoint.v + (j as f64 - middle) * spacing_px;
                *value = sample_bilinear(image, u, v, Border::Replicate);
            }
        }
        normalize(patch);
    })?;
    Descriptors::from_floats(size * size, values)
}

fn normalize(patch: &mut [f32]) {
    let count = patch.len() as f64;
    let mean = patch.iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let spread = patch
        .iter()
        .map(|&v| (f64::from(v) - mean) * (f64::from(v) - mean));
    let norm = spread.sum::<f64>().sqrt();
    // At most what rounding makes of a constant patch.
    let flat = norm <= 1e-6 * count.sqrt() * mean.abs().max(1e-12);
    for v in patch {
        *v = if flat {
            0.0
        } else {
            ((f64::from(*v) - mean) / norm) as f32
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_and_contrast_do_not_matter() {
        let image = crate::imaging::fixture::gray32("texture.npy");
        let mut other = image.clone();
        other.as_mut().iter_mut().for_each(|v| *v = 0.3 * *v + 0.2);
        let keypoints = [Keypoint::at(12.3, 9.8, 1.0), Keypoint::at(0.0, 30.0, 1.0)];
        let a = describe_patches(&image, &keypoints, 8, 1.5, &mut ()).unwrap();
        let b = describe_patches(&other, &keypoints, 8, 1.5, &mut ()).unwrap();
        for (x, y) in a.to_floats().iter().zip(b.to_floats()) {
            assert!((x - y).abs() < 1e-5);
        }
        let norm: f32 = a.get(0).unwrap().iter().map(|v| v * v).sum();
        assert!((norm - 1.0).abs() < 1e-5);
    }

    #[test]
    fn flat_patches_and_bad_sizes() {
        let image = GrayImage32::from_pixel(5, 5, image::Luma([0.7]));
        let keypoints = [Keypoint::at(2.2, 2.7, 1.0)];
        let flat = describe_patches(&image, &keypoints, 4, 0.7, &mut ()).unwrap();
        assert!(flat.to_floats().iter().all(|&v| v == 0.0));
        assert!(describe_patches(&image, &keypoints, 1, 1.0, &mut ()).is_err());
        assert!(describe_patches(&image, &keypoints, 4, 0.0, &mut ()).is_err());
        assert!(
            describe_patches(&image, &[], 4, 1.0, &mut ())
                .unwrap()
                .is_empty()
        );
    }
}
