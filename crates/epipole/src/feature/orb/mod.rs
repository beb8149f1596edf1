//! ORB: oriented FAST corners in a pyramid, with binary descriptors of 256 comparisons.

mod fast;
mod pattern;

use super::keypoint::Keypoint;
use super::{Descriptors, Features};
use crate::imaging::{Border, GrayImage32, gaussian_blur_u8, gray_to_u8, require_finite, resize};
use crate::math::monitored::{self, Reporter};
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;
use image::GrayImage;
use pattern::{Pattern, RADIUS};
use std::sync::{Mutex, PoisonError};

/// Width of a level's border without corners, pixels: the descriptor's disc must fit.
const MARGIN: u32 = RADIUS as u32 + 2;

/// Options of [`detect_orb`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct OrbOptions {
    /// Maximum number of features over all levels, ≥ 1.
    pub max_features: usize,
    /// Ratio of the sizes of successive levels, above 1 and at most 2.
    pub scale_factor: f64,
    /// Number of levels of the pyramid, 1 to 16.
    pub num_levels: usize,
    /// Minimum contrast of nine consecutive pixels, for gray values in [0, 1].
    pub fast_threshold: f32,
    /// Assume direction 0, for upright cameras.
    pub upright: bool,
}

impl Default for OrbOptions {
    /// Returns 1000 features, 8 levels with ratio 1.2, threshold 20 of 255.
    fn default() -> Self {
        Self {
            max_features: 1000,
            scale_factor: 1.2,
            num_levels: 8,
            fast_threshold: 20.0 / 255.0,
            upright: false,
        }
    }
}

/// Detects the oriented FAST corners of an image, strongest first, each with 256 comparisons of
/// blurred gray values around it.
///
/// Corners are found at several sizes of the image, ranked by the Harris measure, and refined by a
/// parabola through their scores. The direction points from the corner to the intensity centroid of
/// the disc around it. `scale_px` is the size of the level relative to the image, `octave` its
/// number. An image smaller than 35×35 pixels has no features.
///
/// # Errors
/// [`Error::NotFinite`] for an invalid pixel, [`Error::OutOfRange`] for an option outside its
/// range, [`Error::Canceled`].
///
/// Source: Rublee, Rabaud, Konolige & Bradski 2011, "ORB: an efficient alternative to SIFT or
/// SURF"; Rosten & Drummond 2006 for FAST; Calonder et al. 2010 for the comparisons.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{OrbOptions, detect_orb};
/// use epipole::imaging::GrayImage32;
/// let inside = |x: u32| (30..60).contains(&x);
/// let square = GrayImage32::from_fn(90, 90, |u, v| {
///     image::Luma([if inside(u) && inside(v) { 1.0 } else { 0.0 }])
/// });
/// let features = detect_orb(&square, &OrbOptions::default().with_num_levels(1), &mut ())?;
/// assert_eq!(features.keypoints.len(), 4);
/// # Ok(()) }
/// ```
pub fn detect_orb(
    image: &GrayImage32,
    options: &OrbOptions,
    monitor: &mut dyn Monitor,
) -> Result<Features> {
    check(options)?;
    require_finite(image)?;
    let levels: Vec<usize> = (0..options.num_levels).collect();
    let pattern = Pattern::new();
    // The number of features per level is proportional to its side.
    let shrink = 1.0 / options.scale_factor;
    let total: f64 = levels.iter().map(|&k| power(shrink, k)).sum();
    let describe = |k: usize, reporter: &mut Reporter| {
        let target = options.max_features as f64 * power(shrink, k) / total;
        let quota = (target.ceil() as usize).min(options.max_features);
        let pattern = &pattern;
        describe_level(image, options, pattern, (k, quota), reporter)
    };
    let stage = Stage::FeatureDetection;
    let found: Vec<_> = levels.iter().map(|_| Mutex::new(Ok(Vec::new()))).collect();
    monitored::for_each(levels.len(), stage, monitor, &|level, reporter| {
        let described = describe(level, reporter);
        let canceled = described == Err(Error::Canceled);
        // Never blocks: each level is locked once.
        if let Ok(mut found) = found[level].lock() {
            *found = described;
        }
        if canceled {
            Err(Error::Canceled)
        } else {
            Ok(())
        }
    })?;
    let mut features: Vec<(Keypoint, [u64; 4])> = Vec::new();
    for level in found {
        features.extend(level.into_inner().unwrap_or_else(PoisonError::into_inner)?);
    }
    report(monitor, stage, 1.0)?;
    features.sort_by(|a, b| super::nms::stronger(&a.0, &b.0));
    features.truncate(options.max_features);
    let (keypoints, bits) = features.into_iter().unzip();
    Ok(Features {
        keypoints,
        descriptors: Descriptors::from_bits(bits),
    })
}

fn power(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}

fn describe_level(
    image: &GrayImage32,
    options: &OrbOptions,
    pattern: &Pattern,
    (level, quota): (usize, usize),
    reporter: &mut Reporter,
) -> Result<Vec<(Keypoint, [u64; 4])>> {
    let scale = power(options.scale_factor, level);
    let side = |size: u32| (f64::from(size) / scale).round() as u32;
    let (width, height) = (side(image.width()), side(image.height()));
    if width.min(height) <= 2 * MARGIN {
        return Ok(Vec::new());
    }
    let pixels = if level == 0 {
        gray_to_u8(image)
    } else {
        gray_to_u8(&resize(image, width, height)?)
    };
    let threshold = (options.fast_threshold * 255.0).round() as u8;
    let corners = fast::corners(&pixels, threshold, MARGIN as usize, quota, reporter)?;
    let blurred = gaussian_blur_u8(&pixels, Some(7), 2.0, Border::Reflect101)?;
    let (step_u, step_v) = (
        f64::from(image.width()) / f64::from(width),
        f64::from(image.height()) / f64::from(height),
    );
    Ok(corners
        .into_iter()
        .map(|corner| {
            let (x, y) = (corner.u.round() as usize, corner.v.round() as usize);
            let angle_rad = if options.upright {
                0.0
            } else {
                direction(&pixels, x, y)
            };
            let bits = pattern.compare(&blurred, x, y, angle_rad);
            let keypoint = Keypoint {
                u: (corner.u + 0.5) * step_u - 0.5,
                v: (corner.v + 0.5) * step_v - 0.5,
                scale_px: scale as f32,
                angle_rad,
                response: corner.response,
                octave: level as i32,
            };
            (keypoint, bits)
        })
        .collect())
}

/// Returns the direction from a pixel to the intensity centroid of the disc around it.
fn direction(image: &GrayImage, x: usize, y: usize) -> f32 {
    let width = image.width() as usize;
    let r = RADIUS as isize;
    let (mut along_u, mut along_v) = (0i32, 0i32);
    for dy in -r..=r {
        let half = ((r * r - dy * dy) as f64).sqrt() as usize;
        let from = (y as isize + dy) as usize * width + x - half;
        let row = &image.as_raw()[from..=from + 2 * half];
        let (mut sum, mut moment) = (0i32, 0i32);
        for (k, &value) in row.iter().enumerate() {
            sum += i32::from(value);
            moment += (k as i32 - half as i32) * i32::from(value);
        }
        along_u += moment;
        along_v += dy as i32 * sum;
    }
    libm::atan2(f64::from(along_v), f64::from(along_u)) as f32
}

fn check(options: &OrbOptions) -> Result<()> {
    let ranges = [
        (
            "the number of features",
            "at least 1",
            options.max_features as f64,
            options.max_features >= 1,
        ),
        (
            "the scale factor between levels",
            "greater than 1 and at most 2",
            options.scale_factor,
            options.scale_factor > 1.0 && options.scale_factor <= 2.0,
        ),
        (
            "the number of levels",
            "between 1 and 16",
            options.num_levels as f64,
            (1..=16).contains(&options.num_levels),
        ),
        (
            "the FAST threshold",
            "between 0 and 1",
            f64::from(options.fast_threshold),
            (0.0..=1.0).contains(&options.fast_threshold),
        ),
    ];
    Error::check_rules(&ranges)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::{MatchOptions, match_descriptors};
    use crate::imaging::{Interpolation, WarpOptions, warp_affine};
    use crate::math::random::Random;
    use nalgebra::Matrix2x3;

    fn scene(width: u32, height: u32) -> GrayImage32 {
        let mut random = Random::new(3);
        let mut image = GrayImage32::from_pixel(width, height, image::Luma([0.5]));
        for _ in 0..120 {
            let (x, y) = (
                random.below(width as usize) as u32,
                random.below(height as usize) as u32,
            );
            let (w, h) = (random.below(40) as u32 + 5, random.below(40) as u32 + 5);
            let gray = random.unit() as f32;
            for v in y..(y + h).min(height) {
                for u in x..(x + w).min(width) {
                    image.put_pixel(u, v, image::Luma([gray]));
                }
            }
        }
        crate::imaging::gaussian_blur(&image, 0.7, Border::Reflect101, &mut ()).unwrap()
    }

    #[test]
    fn a_rotated_and_scaled_scene_is_matched() {
        let image = scene(320, 240);
        let (cos, sin) = (libm::cos(0.6) * 0.8, libm::sin(0.6) * 0.8);
        let map = Matrix2x3::new(cos, -sin, 120.0, sin, cos, -30.0);
        let options = WarpOptions {
            interpolation: Interpolation::Bicubic,
            ..WarpOptions::new(320, 240)
        };
        let other = warp_affine(&image, &map, &options, &mut ()).unwrap();
        let a = detect_orb(&image, &OrbOptions::default(), &mut ()).unwrap();
        let b = detect_orb(&other, &OrbOptions::default(), &mut ()).unwrap();
        let matches = match_descriptors(
            &a.descriptors,
            &b.descriptors,
            &MatchOptions::default(),
            &mut (),
        )
        .unwrap();
        let right = matches.iter().filter(|m| {
            let (p, q) = (a.keypoints[m.index1], b.keypoints[m.index2]);
            let u = cos * p.u - sin * p.v + 120.0;
            let v = sin * p.u + cos * p.v - 30.0;
            (u - q.u).abs() < 3.0 && (v - q.v).abs() < 3.0
        });
        let right = right.count();
        assert!(
            right > 60 && right * 10 > matches.len() * 8,
            "{right} of {}",
            matches.len()
        );
    }

    #[test]
    fn a_half_turn_rotates_the_keypoints() {
        let image = scene(201, 151);
        let a = detect_orb(&image, &OrbOptions::default(), &mut ()).unwrap();
        let b = detect_orb(
            &image::imageops::rotate180(&image),
            &OrbOptions::default(),
            &mut (),
        )
        .unwrap();
        let near = a.keypoints.iter().filter(|p| {
            b.keypoints
                .iter()
                .any(|q| (200.0 - p.u - q.u).abs() < 0.02 && (150.0 - p.v - q.v).abs() < 0.02)
        });
        assert!(near.count() * 100 >= a.keypoints.len() * 98);
    }

    #[test]
    fn limits_order_and_nothing_to_find() {
        let image = scene(320, 240);
        let few = detect_orb(
            &image,
            &OrbOptions {
                max_features: 37,
                ..OrbOptions::default()
            },
            &mut (),
        );
        let few = few.unwrap();
        assert_eq!((few.keypoints.len(), few.descriptors.len()), (37, 37));
        assert!(few.keypoints.is_sorted_by(|a, b| a.response >= b.response));
        for (w, h) in [(0, 0), (1, 50), (50, 1), (34, 34), (90, 60)] {
            let flat = GrayImage32::from_pixel(w, h, image::Luma([0.5]));
            let none = detect_orb(&flat, &OrbOptions::default(), &mut ()).unwrap();
            assert!(none.keypoints.is_empty() && none.descriptors.is_empty());
        }
    }

    #[test]
    fn bad_pixels_and_options_are_refused() {
        let bad = |change: fn(&mut OrbOptions)| {
            let mut options = OrbOptions::default();
            change(&mut options);
            assert!(detect_orb(&GrayImage32::new(50, 50), &options, &mut ()).is_err());
        };
        bad(|o| o.max_features = 0);
        bad(|o| o.scale_factor = 1.0);
        bad(|o| o.scale_factor = f64::NAN);
        bad(|o| o.num_levels = 0);
        bad(|o| o.num_levels = 99);
        bad(|o| o.fast_threshold = -0.1);
        let nan = GrayImage32::from_pixel(60, 60, image::Luma([f32::NAN]));
        assert!(detect_orb(&nan, &OrbOptions::default(), &mut ()).is_err());
    }
}
