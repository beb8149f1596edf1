//! SIFT directions and descriptors at given positions.

use super::descriptor::Samples;
use super::options::{SiftOptions, check};
use super::scale_space::{Octave, OctaveGrid};
use super::{descriptor, orientation};
use crate::feature::{Descriptors, Keypoint};
use crate::imaging::{GrayImage32, require_finite};
use crate::math::order::order_by;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};

/// Computes SIFT descriptors at given positions, scales and directions, one per keypoint, as
/// [`detect_sift`](super::detect_sift) does at its keypoints.
///
/// * `keypoints`: with `u`, `v`, `scale_px` (> 0) and `angle_rad`. If two octaves contain layers of
///   this blur, `octave` selects one; a blur beyond all layers takes the nearest layer.
///
/// There is no gradient outside the image, so a position far outside gives zeros. An image too
/// small for an octave gives zeros everywhere. The only stage is [`Stage::FeatureDetection`].
///
/// # Errors
/// [`Error::OutOfRange`] for an option or a scale outside its range, [`Error::NotFinite`] for an
/// invalid pixel or position, [`Error::Canceled`].
///
/// Source: Lowe 2004, "Distinctive image features from scale-invariant keypoints", §6.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Keypoint, SiftOptions, describe_sift};
/// use epipole::imaging::GrayImage32;
/// // Brighter to the right: all gradients are along the rows, in the first of eight directions.
/// let ramp = GrayImage32::from_fn(64, 64, |u, _| image::Luma([u as f32 / 64.0]));
/// let middle = Keypoint { scale_px: 3.0, ..Keypoint::at(32.0, 32.0, 1.0) };
/// let options = SiftOptions::default();
/// let descriptor = describe_sift(&ramp, &[middle], &options, &mut ())?.get(0).unwrap();
/// assert!(descriptor.iter().enumerate().all(|(k, &v)| (v > 0.0) == (k % 8 == 0)));
/// # Ok(()) }
/// ```
pub fn describe_sift(
    image: &GrayImage32,
    keypoints: &[Keypoint],
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<Descriptors> {
    let mut bytes = vec![0u8; 128 * keypoints.len()];
    at_layers(
        image,
        keypoints,
        options,
        monitor,
        |index, layer, center, sigma, scratch| {
            // The histogram takes directions in [−π, π].
            let angle = libm::remainderf(keypoints[index].angle_rad, std::f32::consts::TAU);
            let sums = descriptor::histogram(layer, center, sigma, angle, scratch);
            let normalized = descriptor::normalize(sums, options.normalization);
            bytes[128 * index..128 * (index + 1)].copy_from_slice(&normalized);
        },
    )?;
    Descriptors::from_bytes(128, bytes)
}

/// Computes the dominant gradient directions around given positions, strongest first, in (−π, π],
/// as used by [`detect_sift`](super::detect_sift). At most `options.max_orientations` each.
///
/// Arguments, errors and the border are as for [`describe_sift`]; without any gradient the
/// direction is 0. The only stage is [`Stage::FeatureDetection`].
///
/// Source: Lowe 2004, §5.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Keypoint, SiftOptions, sift_directions};
/// use epipole::imaging::GrayImage32;
/// let ramp = GrayImage32::from_fn(64, 64, |_, v| image::Luma([v as f32 / 64.0]));
/// let middle = Keypoint { scale_px: 3.0, ..Keypoint::at(32.0, 32.0, 1.0) };
/// let directions = sift_directions(&ramp, &[middle], &SiftOptions::default(), &mut ())?;
/// assert!((directions[0][0] - std::f32::consts::FRAC_PI_2).abs() < 0.01);
/// # Ok(()) }
/// ```
pub fn sift_directions(
    image: &GrayImage32,
    keypoints: &[Keypoint],
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Vec<f32>>> {
    let mut found = vec![vec![0.0]; keypoints.len()];
    at_layers(
        image,
        keypoints,
        options,
        monitor,
        |index, layer, center, sigma, scratch| {
            found[index] = orientation::directions(layer, center, sigma, options, scratch);
        },
    )?;
    Ok(found)
}

/// Computes the histograms whose peaks are [`sift_directions`], one per position: 36 sums of
/// gradients, smoothed. Bin k is at an angle of `k · 10° − 180°`.
///
/// Arguments, errors and the border are as for [`describe_sift`]; without any gradient all sums
/// are 0. The only stage is [`Stage::FeatureDetection`].
///
/// Source: Lowe 2004, §5.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Keypoint, SiftOptions, sift_orientation_histograms};
/// use epipole::imaging::GrayImage32;
/// let ramp = GrayImage32::from_fn(64, 64, |_, v| image::Luma([v as f32 / 64.0]));
/// let middle = Keypoint { scale_px: 3.0, ..Keypoint::at(32.0, 32.0, 1.0) };
/// let found = sift_orientation_histograms(&ramp, &[middle], &SiftOptions::default(), &mut ())?;
/// // All gradients point down, at 90°: 27 · 10° − 180°. Smoothing spreads them to both sides.
/// let [before, at, after] = [26, 27, 28].map(|bin: usize| found[0][bin]);
/// assert!(at > before && (before - after).abs() < 0.01 * at && found[0][9] == 0.0);
/// # Ok(()) }
/// ```
pub fn sift_orientation_histograms(
    image: &GrayImage32,
    keypoints: &[Keypoint],
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<[f32; 36]>> {
    let mut found = vec![[0.0; orientation::NUM_BINS]; keypoints.len()];
    at_layers(
        image,
        keypoints,
        options,
        monitor,
        |index, layer, center, sigma, scratch| {
            found[index] = orientation::histogram(layer, center, sigma, scratch);
        },
    )?;
    Ok(found)
}

/// Visits each keypoint with the layer of its blur: passes index, layer, and position and blur in
/// samples of the layer.
fn at_layers(
    image: &GrayImage32,
    keypoints: &[Keypoint],
    options: &SiftOptions,
    monitor: &mut dyn Monitor,
    mut visit: impl FnMut(usize, &GrayImage32, (f32, f32), f32, &mut Samples),
) -> Result<()> {
    check(options)?;
    require_finite(image)?;
    for keypoint in keypoints {
        if !(keypoint.scale_px > 0.0 && keypoint.scale_px < 1e6) {
            return Err(Error::OutOfRange {
                what: "the scale of a keypoint in pixels",
                requirement: "greater than 0",
                value: f64::from(keypoint.scale_px),
            });
        }
        if ![keypoint.u, keypoint.v, f64::from(keypoint.angle_rad)]
            .iter()
            .all(|x| x.abs() < 1e9)
        {
            return Err(Error::NotFinite {
                what: "the place and direction of a keypoint",
            });
        }
    }
    let homes: Vec<(i32, usize)> = (keypoints.iter())
        .map(|keypoint| home(keypoint, options))
        .collect();
    let order = order_by(homes.len(), &mut |a, b| homes[a].cmp(&homes[b]));
    let mut waiting = (order.into_iter())
        .map(|index| (homes[index].0, homes[index].1, index))
        .peekable();
    let (mut memory, mut scratch) = (Default::default(), Samples::default());
    let stage = Stage::FeatureDetection;
    let (mut visited, count) = (0, keypoints.len().max(1) as f32);
    let first = &mut Part::new(monitor, 0.0, 0.0).of_stage(stage);
    let mut next = OctaveGrid::first(image, options, first)?;
    while let Some(grid) = next.filter(|_| waiting.peek().is_some()) {
        let mut octave = Octave::new(grid, memory, options);
        // Computing blurs does not advance the progress, which counts keypoints.
        let fraction = visited as f32 / count;
        let blur = &mut Part::new(monitor, fraction, fraction).of_stage(stage);
        octave.advance_to(1, blur)?;
        next = octave.next_grid(blur)?;
        let (number, is_last) = (octave.grid().octave, next.is_none());
        let is_here = |home: &(i32, usize, usize)| home.0 == number || is_last;
        while let Some((of, layer, index)) = waiting.next_if(is_here) {
            // Octaves beyond the last have larger blurs than any of its layers.
            let largest = options.layers_per_octave + 1;
            let layer = if of > number { largest } else { layer };
            let fraction = visited as f32 / count;
            report(monitor, stage, fraction)?;
            let blur = &mut Part::new(monitor, fraction, fraction).of_stage(stage);
            octave.advance_to(layer.max(3) - 2, blur)?;
            let (grid, keypoint) = (octave.grid(), &keypoints[index]);
            let x = ((keypoint.u - grid.origin_u) / grid.step) as f32;
            let y = ((keypoint.v - grid.origin_v) / grid.step) as f32;
            let sigma = (f64::from(keypoint.scale_px) / grid.step) as f32;
            visit(index, octave.layer(layer), (x, y), sigma, &mut scratch);
            visited += 1;
        }
        memory = octave.into_memory();
    }
    Ok(())
}

/// Returns the octave and the layer of a keypoint's blur.
fn home(keypoint: &Keypoint, options: &SiftOptions) -> (i32, usize) {
    let first = if options.upsample { -1 } else { 0 };
    let n = options.layers_per_octave as f64;
    let octaves = libm::log2(f64::from(keypoint.scale_px) / options.sigma_px);
    let layer = |octave: i32| (n * (octaves - f64::from(octave))).round();
    let named = layer(keypoint.octave.max(first));
    if keypoint.octave >= first && (0.0..=n + 1.0).contains(&named) {
        return (keypoint.octave, named as usize);
    }
    // Layers 1 to n are searched for extrema.
    let octave = (libm::floor(octaves - 0.5 / n) as i32).max(first);
    (octave, layer(octave).clamp(0.0, n + 1.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::detect_sift;
    use crate::imaging::{fixture, gray_to_f32};

    #[test]
    fn detected_features_are_described_as_they_were() {
        let image = gray_to_f32(&fixture::gray8("sift_image.npy"));
        for upsample in [true, false] {
            let options = SiftOptions {
                upsample,
                max_orientations: 1,
                ..SiftOptions::default()
            };
            let found = detect_sift(&image, &options, &mut ()).unwrap();
            assert!(found.keypoints.len() > 20, "{}", found.keypoints.len());
            let again = describe_sift(&image, &found.keypoints, &options, &mut ()).unwrap();
            assert_eq!(again, found.descriptors);
            let directions = sift_directions(&image, &found.keypoints, &options, &mut ()).unwrap();
            for (keypoint, directions) in found.keypoints.iter().zip(directions) {
                assert_eq!(directions, [keypoint.angle_rad]);
            }
        }
    }

    /// OpenCV and scikit-image weight and interpolate the gradients of the same layers equally, but
    /// OpenCV crops the window at a rounded radius, and scikit-image rounds to integers.
    #[test]
    fn descriptors_equal_those_of_opencv_and_scikit_image() {
        let image = gray_to_f32(&fixture::gray8("sift_image.npy"));
        let opencv = fixture::floats("sift_described.npy");
        let rows: Vec<&[f32]> = opencv.values.chunks_exact(132).collect();
        let scikit_image = fixture::floats("sift_described_by_scikit_image.npy");
        let keypoints: Vec<Keypoint> = (rows.iter())
            .map(|row| Keypoint {
                scale_px: row[2],
                angle_rad: row[3].to_radians(),
                ..Keypoint::at(f64::from(row[0]), f64::from(row[1]), 1.0)
            })
            .collect();
        let options = SiftOptions {
            upsample: false,
            input_blur_px: 0.5,
            ..SiftOptions::default()
        };
        let ours = describe_sift(&image, &keypoints, &options, &mut ()).unwrap();
        assert_eq!(rows.len(), 24);
        let relative = |ours: &[f32], theirs: &[f32]| -> f32 {
            let apart = ours.iter().zip(theirs).map(|(a, b)| (a - b) * (a - b));
            let norm: f32 = theirs.iter().map(|b| b * b).sum();
            (apart.sum::<f32>() / norm).sqrt()
        };
        let peers = rows.iter().zip(scikit_image.values.chunks_exact(128));
        for (index, (row, theirs)) in peers.enumerate() {
            let ours = ours.get(index).unwrap();
            let [opencv, scikit_image] = [&row[4..], theirs].map(|theirs| relative(&ours, theirs));
            assert!(opencv < 0.02, "{index}: {opencv} from OpenCV");
            assert!(
                scikit_image < 0.02,
                "{index}: {scikit_image} from scikit-image"
            );
        }
    }

    #[test]
    fn bad_keypoints_are_refused_and_far_ones_are_empty() {
        let image = fixture::gray32("texture.npy");
        let options = SiftOptions::default();
        let keypoint = Keypoint::at(20.0, 20.0, 1.0);
        for bad in [
            Keypoint {
                u: f64::NAN,
                ..keypoint
            },
            Keypoint {
                scale_px: 0.0,
                ..keypoint
            },
            Keypoint {
                scale_px: f32::NAN,
                ..keypoint
            },
            Keypoint {
                angle_rad: f32::INFINITY,
                ..keypoint
            },
        ] {
            assert!(describe_sift(&image, &[bad], &options, &mut ()).is_err());
        }
        let far = Keypoint::at(-5e4, 7e5, 1.0);
        let huge = Keypoint {
            scale_px: 5e3,
            ..keypoint
        };
        let tiny = Keypoint {
            scale_px: 1e-3,
            ..keypoint
        };
        let described = describe_sift(&image, &[far, huge, tiny], &options, &mut ()).unwrap();
        assert_eq!(described.get(0).unwrap(), vec![0.0; 128]);
        assert_eq!(described.len(), 3);
        let small = GrayImage32::new(3, 3);
        assert_eq!(
            sift_directions(&small, &[keypoint], &options, &mut ()).unwrap(),
            [[0.0]]
        );
    }
}
