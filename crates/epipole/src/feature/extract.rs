//! Feature extraction from images by any of the detectors.

use super::{
    FeatureKind, FeatureOptions, Features, Keypoint, RefineOptions, SiftOptions, describe_patches,
    detect_orb, detect_sift, good_features_to_track, refine_corners,
};
use crate::Result;
use crate::imaging::{GrayImage32, gray_to_f32, rgb_to_gray};
use crate::progress::{Monitor, Part};
use image::RgbImage;

/// Converts a photo to gray values in [0, 1] for feature detection: rounded to 8 bits, as OpenCV
/// does ([`rgb_to_gray`]), so that every command finds the same features.
///
/// ```
/// use image::{Rgb, RgbImage};
/// let red = RgbImage::from_pixel(1, 1, Rgb([255, 0, 0]));
/// assert_eq!(epipole::feature::photo_to_gray(&red).get_pixel(0, 0).0, [76.0 / 255.0]);
/// ```
pub fn photo_to_gray(photo: &RgbImage) -> GrayImage32 {
    gray_to_f32(&rgb_to_gray(photo))
}

/// Detects the features of an image, of the kind given by `options`, strongest first.
///
/// Harris corners are refined to sub-pixel positions; corners that cannot be are dropped. The only
/// stage is [`Stage::FeatureDetection`](crate::progress::Stage::FeatureDetection).
///
/// # Errors
/// [`Error::NotFinite`](crate::Error::NotFinite) for an invalid pixel,
/// [`Error::OutOfRange`](crate::Error::OutOfRange) for an option outside its range,
/// [`Error::Canceled`](crate::Error::Canceled).
///
/// Source: as [`detect_sift`](super::detect_sift), [`detect_orb`], [`good_features_to_track`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{FeatureKind, FeatureOptions, detect_features};
/// use epipole::imaging::GrayImage32;
/// // A bright square on dark background has four corners.
/// let square = GrayImage32::from_fn(64, 64, |u, v| {
///     let inside = |x: u32| (20..44).contains(&x);
///     image::Luma([if inside(u) && inside(v) { 0.9 } else { 0.1 }])
/// });
/// let options = FeatureOptions::default().with_kind(FeatureKind::Harris);
/// assert_eq!(detect_features(&square, &options, &mut ())?.keypoints.len(), 4);
/// # Ok(()) }
/// ```
pub fn detect_features(
    image: &GrayImage32,
    options: &FeatureOptions,
    monitor: &mut dyn Monitor,
) -> Result<Features> {
    match options.kind {
        FeatureKind::Sift | FeatureKind::RootSift => sift(image, options, monitor),
        FeatureKind::Orb => detect_orb(image, &options.orb(), monitor),
        FeatureKind::Harris => harris(image, options, monitor),
    }
}

/// Progress after the search at the original size, if a search at twice the size follows.
const OWN_SIZE_FRACTION: f32 = 0.2;

/// Runs SIFT, at twice the size if the image is small, or if the larger features leave room for
/// more.
fn sift(
    image: &GrayImage32,
    options: &FeatureOptions,
    monitor: &mut dyn Monitor,
) -> Result<Features> {
    let once = options.sift(image.width(), image.height());
    if once.upsample || options.max_upsampled_pixels == 0 {
        return detect_sift(image, &once, monitor);
    }
    let mut before = 0.0;
    if options.max_features > 0 {
        before = OWN_SIZE_FRACTION;
        let found = detect_sift(image, &once, &mut Part::new(monitor, 0.0, before))?;
        if found.keypoints.len() >= options.max_features {
            return Ok(found);
        }
    }
    let twice = SiftOptions {
        upsample: true,
        ..once
    };
    detect_sift(image, &twice, &mut Part::new(monitor, before, 1.0))
}

fn harris(
    image: &GrayImage32,
    options: &FeatureOptions,
    monitor: &mut dyn Monitor,
) -> Result<Features> {
    let detect = &mut Part::new(monitor, 0.0, 0.4);
    let corners = good_features_to_track(image, &options.harris(), detect)?;
    let places: Vec<_> = corners.iter().map(Keypoint::point).collect();
    let refine = &mut Part::new(monitor, 0.4, 0.8);
    let refined = refine_corners(image, &places, &RefineOptions::default(), refine)?;
    // Drop corners that cannot be refined.
    let keypoints: Vec<Keypoint> = (corners.into_iter().zip(refined))
        .filter_map(|(corner, place)| {
            place.map(|place| Keypoint {
                u: place.x,
                v: place.y,
                ..corner
            })
        })
        .collect();
    let describe = &mut Part::new(monitor, 0.8, 1.0);
    let descriptors = describe_patches(image, &keypoints, options.patch_px, 1.0, describe)?;
    Ok(Features {
        keypoints,
        descriptors,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::feature::{MatchOptions, match_descriptors};
    use crate::progress::Status;
    use image::{Luma, Rgb};
    use std::ops::ControlFlow;

    /// Boxes of several sizes on a slope of gray.
    fn boxes() -> GrayImage32 {
        GrayImage32::from_fn(120, 100, |u, v| {
            let inside = |u0: u32, v0: u32, side: u32| {
                (u0..u0 + side).contains(&u) && (v0..v0 + side).contains(&v)
            };
            let value = match (inside(20, 15, 12), inside(60, 30, 25), inside(25, 60, 18)) {
                (true, ..) => 0.9,
                (_, true, _) => 0.1,
                (.., true) => 0.7,
                _ => 0.35,
            };
            Luma([value])
        })
    }

    const KINDS: [FeatureKind; 4] = [
        FeatureKind::Sift,
        FeatureKind::RootSift,
        FeatureKind::Orb,
        FeatureKind::Harris,
    ];

    #[test]
    fn every_kind_obeys_number_and_strength() {
        let image = boxes();
        let count = |options: &FeatureOptions| {
            detect_features(&image, options, &mut ())
                .unwrap()
                .keypoints
                .len()
        };
        for kind in KINDS {
            let with = |max_features, contrast_threshold| {
                count(&FeatureOptions {
                    kind,
                    max_features,
                    contrast_threshold,
                    ..FeatureOptions::default()
                })
            };
            let all = with(0, None);
            assert!(all > 3, "{kind:?} {all}");
            assert_eq!(with(8192, None), all, "{kind:?}");
            assert_eq!(with(3, None), 3, "{kind:?}");
            let strong = with(0, Some(0.5));
            assert!(strong < all, "{kind:?} {strong} of {all}");
        }
    }

    /// Boxes on a texture of ripples a few pixels wide, on which every option makes a difference.
    fn busy() -> GrayImage32 {
        let boxes = boxes();
        GrayImage32::from_fn(120, 100, |u, v| {
            let (x, y) = (u as f32, v as f32);
            let ripples = libm::sinf(0.9 * x + 0.011 * y * y) * libm::cosf(0.7 * y - 0.007 * x * x);
            Luma([boxes.get_pixel(u, v).0[0] + 0.08 * ripples])
        })
    }

    #[test]
    fn every_option_counts_for_its_kind_and_for_no_other() {
        let image = busy();
        let found = |options: FeatureOptions| detect_features(&image, &options, &mut ()).unwrap();
        let of = FeatureOptions::default();
        let sift = [FeatureKind::Sift, FeatureKind::RootSift].as_slice();
        let (orb, harris) = (&[FeatureKind::Orb][..], &[FeatureKind::Harris][..]);
        let directed = &KINDS[..3];
        let changed = [
            (
                "upright",
                FeatureOptions {
                    upright: true,
                    ..of
                },
                directed,
            ),
            (
                "max_upsampled_pixels",
                FeatureOptions {
                    max_upsampled_pixels: 0,
                    ..of
                },
                sift,
            ),
            (
                "input_blur_px",
                FeatureOptions {
                    input_blur_px: 0.3,
                    ..of
                },
                sift,
            ),
            (
                "sigma_px",
                FeatureOptions {
                    sigma_px: 1.2,
                    ..of
                },
                sift,
            ),
            (
                "layers_per_octave",
                FeatureOptions {
                    layers_per_octave: 4,
                    ..of
                },
                sift,
            ),
            (
                "edge_threshold",
                FeatureOptions {
                    edge_threshold: 1.5,
                    ..of
                },
                sift,
            ),
            (
                "max_orientations",
                FeatureOptions {
                    max_orientations: 1,
                    ..of
                },
                sift,
            ),
            (
                "orientation_peak_ratio",
                FeatureOptions {
                    orientation_peak_ratio: 0.4,
                    ..of
                },
                sift,
            ),
            (
                "num_levels",
                FeatureOptions {
                    num_levels: 2,
                    ..of
                },
                orb,
            ),
            (
                "scale_factor",
                FeatureOptions {
                    scale_factor: 1.5,
                    ..of
                },
                orb,
            ),
            (
                "harris_k",
                FeatureOptions {
                    harris_k: 0.2,
                    ..of
                },
                harris,
            ),
            (
                "min_distance_px",
                FeatureOptions {
                    min_distance_px: 20.0,
                    ..of
                },
                harris,
            ),
            (
                "tensor_window_px",
                FeatureOptions {
                    tensor_window_px: 7,
                    ..of
                },
                harris,
            ),
            ("patch_px", FeatureOptions { patch_px: 7, ..of }, harris),
        ];
        for kind in KINDS {
            let usual = found(FeatureOptions { kind, ..of });
            for (name, options, counts_for) in &changed {
                let differs = found(FeatureOptions { kind, ..*options }) != usual;
                assert_eq!(differs, counts_for.contains(&kind), "{name} {kind:?}");
            }
        }
    }

    /// The same image, treated as large or small.
    #[test]
    fn large_images_have_the_features_of_small_ones() {
        let image = busy();
        let found = |max_upsampled_pixels, max_features| {
            let options = FeatureOptions {
                max_upsampled_pixels,
                max_features,
                ..FeatureOptions::default()
            };
            let mut fractions = Vec::new();
            let found = detect_features(&image, &options, &mut |status: Status| {
                fractions.push(status.fraction);
                ControlFlow::Continue(())
            });
            assert!(
                fractions.is_sorted() && fractions[0] == 0.0,
                "{fractions:?}"
            );
            found.unwrap()
        };
        let num_pixels = 120 * 100;
        for max_features in [0, 8192] {
            let small = found(num_pixels, max_features);
            assert_eq!(found(num_pixels - 1, max_features), small);
        }
        // At the original size first, if those are enough.
        let own = found(0, 0);
        let enough = own.keypoints.len();
        assert_eq!(found(num_pixels - 1, enough), own);
        assert_eq!(
            found(num_pixels - 1, enough + 1),
            found(num_pixels, enough + 1)
        );
    }

    #[test]
    fn options_out_of_range_are_refused() {
        let of = FeatureOptions::default();
        let of_kind = |kind| FeatureOptions { kind, ..of };
        let (orb, harris) = (of_kind(FeatureKind::Orb), of_kind(FeatureKind::Harris));
        for options in [
            FeatureOptions {
                sigma_px: f64::NAN,
                ..of
            },
            FeatureOptions {
                sigma_px: 0.9,
                ..of
            },
            FeatureOptions {
                layers_per_octave: 0,
                ..of
            },
            FeatureOptions {
                max_orientations: 0,
                ..of
            },
            FeatureOptions {
                orientation_peak_ratio: 0.0,
                ..of
            },
            FeatureOptions {
                num_levels: 17,
                ..orb
            },
            FeatureOptions {
                scale_factor: 1.0,
                ..orb
            },
            FeatureOptions {
                harris_k: 0.25,
                ..harris
            },
            FeatureOptions {
                min_distance_px: -1.0,
                ..harris
            },
            FeatureOptions {
                tensor_window_px: 0,
                ..harris
            },
            FeatureOptions {
                patch_px: 1,
                ..harris
            },
        ] {
            let refused = detect_features(&boxes(), &options, &mut ());
            assert!(
                matches!(refused, Err(Error::OutOfRange { .. })),
                "{options:?}"
            );
        }
    }

    #[test]
    fn every_kind_matches_itself_and_no_kind_of_the_other_sort() {
        let image = boxes();
        let found = KINDS.map(|kind| {
            let options = FeatureOptions {
                kind,
                ..FeatureOptions::default()
            };
            detect_features(&image, &options, &mut ()).unwrap()
        });
        for features in &found {
            let to = &features.descriptors;
            let matches = match_descriptors(to, to, &MatchOptions::default(), &mut ()).unwrap();
            assert!(!matches.is_empty());
            assert!(matches.iter().all(|m| m.index1 == m.index2));
        }
        let [sift, _, orb, _] = &found;
        let options = MatchOptions::default();
        assert!(match_descriptors(&sift.descriptors, &orb.descriptors, &options, &mut ()).is_err());
        assert!(sift.descriptors.as_bits().is_none() && orb.descriptors.as_bits().is_some());
    }

    #[test]
    fn images_are_gray_as_in_8_bits() {
        let photo = RgbImage::from_fn(16, 16, |u, v| Rgb([(u * 16) as u8, (v * 16) as u8, 77]));
        let gray = photo_to_gray(&photo);
        for value in gray.as_raw() {
            let level = value * 255.0;
            assert!((level - level.round()).abs() < 1e-4, "{level}");
        }
    }
}
