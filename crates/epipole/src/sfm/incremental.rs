//! Incremental structure from motion: start from two photographs, add one after the other.

use super::builder::Builder;
use super::bundle::PositionPrior;
use super::reconstruction::{Reconstruction, SfmImage};
use super::shares::{Begin, Shares};
use super::tracks::{PairMatches, build_tracks, track_of_keypoints};
use super::two_view_start::{VerifiedPair, pair_ransac, verify_pair};
use super::views::Views;
use crate::camera::{Intrinsics, Lens};
use crate::progress::Progress;
use crate::robust::RansacOptions;
use crate::two_view::PHOTO_MAX_ERROR_PX;
use crate::{Error, Result};
use std::ops::ControlFlow;

/// What [`reconstruct`] needs: photographs, reduced to keypoints, and matches between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmInput {
    /// The photographs.
    pub images: Vec<SfmImage>,
    /// The intrinsics of each photograph, or one for all.
    pub intrinsics: Vec<Intrinsics>,
    /// Matches between photographs, wrong ones among them.
    pub pairs: Vec<PairMatches>,
}

/// How to reconstruct.
#[derive(Debug, Clone, PartialEq)]
pub struct SfmOptions {
    /// How a pair's matches are tested, by E, and with a threshold and a sampler of its own how an image is
    /// registered. Its threshold is 2 pixels, and its seed is not looked at.
    pub ransac: RansacOptions,
    /// Largest reprojection error when an image is registered, pixels. 6.
    pub max_registration_error_px: f64,
    /// Largest reprojection error of an observation that is kept, pixels. 4.
    pub max_reprojection_error_px: f64,
    /// Fewest matches that connect two images, and fewest points that register one. 15.
    pub min_num_inliers: usize,
    /// Smallest angle under which a point must be seen, degrees. 1.5.
    pub min_angle_deg: f64,
    /// Median angle that the two first images should have, degrees; halved, again and again, if
    /// no pair has it. 16.
    pub min_start_angle_deg: f64,
    /// Fewest images that must see a point which is kept in the end. 2.
    pub min_track_length: usize,
    /// Refine one factor for the focal lengths of each lens. False.
    pub refine_focal: bool,
    /// Refine where the principal points are, one shift for each lens. False: turning a camera looks much the same.
    pub refine_principal_point: bool,
    /// Refine the radial terms of each lens, as
    /// [`BundleOptions::refine_distortion`](super::BundleOptions::refine_distortion) has them. False.
    pub refine_distortion: bool,
    /// Refine the tangential terms p1 and p2 of each lens that has them. False.
    pub refine_tangential: bool,
    /// The lenses to start with, or to keep, by their number ([`SfmImage::lens`]); missing ones bend nothing. None.
    pub lenses: Vec<Lens>,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
}

impl Default for SfmOptions {
    fn default() -> Self {
        Self {
            ransac: RansacOptions::default().within(PHOTO_MAX_ERROR_PX),
            max_registration_error_px: 6.0,
            max_reprojection_error_px: 4.0,
            min_num_inliers: 15,
            min_angle_deg: 1.5,
            min_start_angle_deg: 16.0,
            min_track_length: 2,
            refine_focal: false,
            refine_principal_point: false,
            refine_distortion: false,
            refine_tangential: false,
            lenses: Vec::new(),
            seed: 0,
        }
    }
}

/// One step of structure from motion.
#[derive(Debug, Clone, PartialEq)]
pub enum SfmStep {
    /// Features of a photograph were found.
    Detected {
        /// Photographs done.
        done: usize,
        /// Photographs in all.
        total: usize,
    },
    /// Features of a pair of photographs were matched.
    Matched {
        /// Pairs done.
        done: usize,
        /// Pairs in all.
        total: usize,
    },
    /// A pair of images was tested.
    Verified {
        /// Pairs done.
        done: usize,
        /// Pairs in all.
        total: usize,
    },
    /// A reconstruction was started from two images.
    Started {
        /// The images.
        images: [usize; 2],
        /// Its points.
        num_points: usize,
    },
    /// An image was added.
    Registered {
        /// The image.
        image: usize,
        /// Images registered so far, in this component.
        num_registered: usize,
        /// Points so far, in this component.
        num_points: usize,
    },
    /// A step of refining cameras and points together was taken, one of several.
    Refined {
        /// `½ Σ ρ(‖r‖²)` of what is refined, square pixels.
        cost: f64,
    },
    /// Cameras and points were refined together.
    Adjusted {
        /// `½ Σ ρ(‖r‖²)`, square pixels.
        cost: f64,
    },
}

/// What structure from motion found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmResult {
    /// Reconstructions that could not be connected, largest first; each has its own frame.
    pub components: Vec<Reconstruction>,
    /// Images that are in none.
    pub unregistered: Vec<usize>,
    /// Whether the caller ended the work early; what is there is valid.
    pub canceled: bool,
}

/// Hears of every step and says whether to go on.
pub type SfmObserver<'a> = &'a mut dyn FnMut(&SfmStep) -> ControlFlow<()>;

/// Sees cameras and points while they become more, and says whether to go on.
pub type SfmWatcher<'a> = &'a mut dyn FnMut(Reconstruction) -> ControlFlow<()>;

/// Asks the observer, and remembers that it wanted to stop.
pub(super) struct Reporter<'a> {
    pub(super) observer: SfmObserver<'a>,
    pub(super) watcher: Option<SfmWatcher<'a>>,
    pub(super) canceled: bool,
}

impl Reporter<'_> {
    /// Whether to go on.
    pub(super) fn tell(&mut self, step: &SfmStep) -> bool {
        if !self.canceled && (self.observer)(step).is_break() {
            self.canceled = true;
        }
        !self.canceled
    }

    /// Shows what there is so far, which is put together only if somebody watches.
    pub(super) fn show(&mut self, so_far: impl FnOnce() -> Reconstruction) {
        if let Some(watcher) = &mut self.watcher
            && !self.canceled
            && watcher(so_far()).is_break()
        {
            self.canceled = true;
        }
    }
}

/// What is asked for of photographs, as an error of too few says.
pub(super) const OF_PHOTOGRAPHS: &str = "structure from motion from photographs";

/// * `what`: what is asked for, for the error of too few
pub(super) fn check(
    what: &'static str,
    input: &SfmInput,
    options: &SfmOptions,
) -> Result<Vec<Intrinsics>> {
    let count = input.images.len();
    if count < 2 {
        return Err(Error::TooFew {
            what,
            needed: 2,
            got: count,
        });
    }
    if input.intrinsics.len() != 1 && input.intrinsics.len() != count {
        return Err(Error::SizeMismatch {
            what: "the lists of photographs and of their intrinsics",
            first: count,
            second: input.intrinsics.len(),
        });
    }
    for image in &input.images {
        if !image
            .keypoints
            .iter()
            .all(|p| p.x.is_finite() && p.y.is_finite())
        {
            return Err(Error::NotFinite {
                what: "a keypoint's pixel",
            });
        }
        if !image.colors.is_empty() && image.colors.len() != image.keypoints.len() {
            return Err(Error::SizeMismatch {
                what: "the lists of keypoints and of their colors",
                first: image.keypoints.len(),
                second: image.colors.len(),
            });
        }
    }
    for (what, value) in [
        (
            "the largest registration error",
            options.max_registration_error_px,
        ),
        (
            "the largest reprojection error",
            options.max_reprojection_error_px,
        ),
        ("the smallest angle of a point", options.min_angle_deg),
        ("the smallest angle of a start", options.min_start_angle_deg),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::OutOfRange {
                what,
                requirement: "greater than 0 and finite",
                value,
            });
        }
    }
    pair_ransac(options).check()?;
    options.lenses.iter().try_for_each(Lens::check)?;
    (input.images.iter())
        .filter_map(|image| image.position.as_ref())
        .try_for_each(PositionPrior::check)?;
    Ok(if input.intrinsics.len() == 1 {
        vec![input.intrinsics[0]; count]
    } else {
        input.intrinsics.clone()
    })
}

/// Cameras and points from matches between photographs.
///
/// Pairs are tested by their epipolar geometry, surviving matches joined into tracks. A pair with
/// many matches under a wide angle starts the reconstruction; then the image that sees most of
/// its points, well spread, is registered by P3P and RANSAC, its tracks are triangulated, and all
/// is refined by bundle adjustment; observations that fit badly are dropped, others picked up
/// again. Images that cannot be added start further components.
///
/// Where [`SfmImage::position`] is known for three images of a component that are not on one line, it is moved there
/// in the end, and refined once more with these positions; some may be wrong.
///
/// * `observer`: hears of every step; answer [`ControlFlow::Break`] to stop with what is there
///
/// The result can be empty: then no pair of photographs had enough matches in common.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two photographs, [`Error::SizeMismatch`] unless there is one
/// set of intrinsics or one a photograph, [`Error::OutOfRange`] for options out of range or
/// matches that refer to what is not there, [`Error::NotFinite`] for NaN and infinities, in a lens as well.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited".
pub fn reconstruct(
    input: &SfmInput,
    options: &SfmOptions,
    observer: SfmObserver<'_>,
) -> Result<SfmResult> {
    let reporter = Reporter {
        observer,
        watcher: None,
        canceled: false,
    };
    reconstruct_telling(input, options, reporter)
}

/// As [`reconstruct`], with the same result, telling `progress` how far it is.
///
/// Its stages are [`Stage::PairVerification`](crate::progress::Stage::PairVerification), then by turns
/// [`Stage::Registration`](crate::progress::Stage::Registration) and
/// [`Stage::BundleAdjustment`](crate::progress::Stage::BundleAdjustment). Whoever breaks gets what there is so far,
/// as [`SfmResult::canceled`] says.
///
/// # Errors
/// As [`reconstruct`].
///
/// Source: as [`reconstruct`].
///
/// ```
/// use epipole::sfm::{SfmInput, SfmOptions, reconstruct_with_progress};
/// use std::ops::ControlFlow;
/// let mut show = |status: epipole::progress::Status| {
///     println!("{}, {:.0} %", status.stage.words(), 100.0 * status.share);
///     ControlFlow::Continue(())
/// };
/// let nothing = SfmInput::default();
/// assert!(reconstruct_with_progress(&nothing, &SfmOptions::default(), &mut show).is_err());
/// ```
pub fn reconstruct_with_progress(
    input: &SfmInput,
    options: &SfmOptions,
    progress: Progress<'_>,
) -> Result<SfmResult> {
    let mut shares = Shares::new(progress, Begin::Matches, input.images.len());
    reconstruct(input, options, &mut |step| shares.tell(step))
}

/// As [`reconstruct`], with the same result, showing `watcher` what there is after the first two images and after
/// each one that was added. Each component starts anew.
///
/// # Errors
/// As [`reconstruct`].
///
/// Source: as [`reconstruct`].
pub fn reconstruct_with(
    input: &SfmInput,
    options: &SfmOptions,
    observer: SfmObserver<'_>,
    watcher: SfmWatcher<'_>,
) -> Result<SfmResult> {
    let reporter = Reporter {
        observer,
        watcher: Some(watcher),
        canceled: false,
    };
    reconstruct_telling(input, options, reporter)
}

fn reconstruct_telling(
    input: &SfmInput,
    options: &SfmOptions,
    mut reporter: Reporter<'_>,
) -> Result<SfmResult> {
    let intrinsics = check(OF_PHOTOGRAPHS, input, options)?;
    let images = &input.images;
    let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
    // Bad indices are found before the work begins.
    build_tracks(&counts, &input.pairs)?;
    let views = Views::new(images, &intrinsics, &lenses(images, options));
    let verified = verify(input, options, &intrinsics, &views, &mut reporter);
    grow(images, &intrinsics, &views, &verified, options, reporter)
}

/// As [`reconstruct`], from pairs that [`verify_matches`](super::verify_matches) has tested already, wherever and in
/// whatever order.
///
/// * `images`, `intrinsics`: the photographs, and the intrinsics of each, or one for all
///
/// # Errors
/// As [`reconstruct`].
///
/// Source: as [`reconstruct`].
pub fn reconstruct_verified(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    verified: &[VerifiedPair],
    options: &SfmOptions,
    observer: SfmObserver<'_>,
) -> Result<SfmResult> {
    let input = SfmInput {
        images: images.to_vec(),
        intrinsics: intrinsics.to_vec(),
        pairs: Vec::new(),
    };
    let intrinsics = check(OF_PHOTOGRAPHS, &input, options)?;
    let views = Views::new(images, &intrinsics, &lenses(images, options));
    let reporter = Reporter {
        observer,
        watcher: None,
        canceled: false,
    };
    grow(images, &intrinsics, &views, verified, options, reporter)
}

/// Of each image, as it is at the start.
pub(super) fn lenses(images: &[SfmImage], options: &SfmOptions) -> Vec<Lens> {
    let of = |image: &SfmImage| options.lenses.get(image.lens).copied().unwrap_or_default();
    images.iter().map(of).collect()
}

fn grow(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    views: &Views,
    verified: &[VerifiedPair],
    options: &SfmOptions,
    mut reporter: Reporter<'_>,
) -> Result<SfmResult> {
    let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
    let surviving: Vec<PairMatches> = verified.iter().map(|v| v.pair.clone()).collect();
    let tracks = build_tracks(&counts, &surviving)?;
    let track_of = track_of_keypoints(&counts, &tracks);
    let mut result = SfmResult::default();
    let mut taken = vec![false; images.len()];
    while !reporter.canceled {
        let mut builder = Builder {
            images,
            options,
            views: views.clone(),
            intrinsics: intrinsics.to_vec(),
            lenses: lenses(images, options),
            tracks: &tracks,
            track_of: &track_of,
            taken: taken.clone(),
            rig: None,
            cameras: vec![None; images.len()],
            points: vec![None; tracks.len()],
            is_placed: false,
        };
        let Some(first_two) = builder.start(verified, &mut reporter) else {
            break;
        };
        reporter.show(|| builder.so_far());
        builder.grow(&mut reporter);
        let reconstruction = builder.finish();
        if reconstruction.num_registered() == 0 {
            // All fell away again, as where no point is seen by as many images as are asked for. The same two would
            // end in the same way.
            for image in first_two {
                taken[image] = true;
            }
            continue;
        }
        for (image, camera) in reconstruction.cameras.iter().enumerate() {
            taken[image] |= camera.is_some();
        }
        result.components.push(reconstruction);
    }
    result
        .components
        .sort_by_key(|component| std::cmp::Reverse(component.num_registered()));
    let is_registered = |image: &usize| {
        let mut components = result.components.iter();
        components.any(|component| component.cameras[*image].is_some())
    };
    result.unregistered = (0..images.len())
        .filter(|image| !is_registered(image))
        .collect();
    result.canceled = reporter.canceled;
    Ok(result)
}

pub(super) fn verify(
    input: &SfmInput,
    options: &SfmOptions,
    intrinsics: &[Intrinsics],
    views: &Views,
    reporter: &mut Reporter<'_>,
) -> Vec<VerifiedPair> {
    let total = input.pairs.len();
    let mut verified = Vec::new();
    // In groups, so that the observer hears of progress between them.
    for (group, pairs) in input.pairs.chunks(8).enumerate() {
        let mut found: Vec<Option<VerifiedPair>> = vec![None; pairs.len()];
        crate::optim::parallel::for_each_chunk(&mut found, 1, |n, found| {
            found[0] = verify_pair(
                &pairs[n],
                views,
                intrinsics,
                &pair_ransac(options),
                options.min_num_inliers,
            );
        });
        verified.extend(found.into_iter().flatten());
        let done = (group * 8 + pairs.len()).min(total);
        if !reporter.tell(&SfmStep::Verified { done, total }) {
            break;
        }
    }
    verified
}
