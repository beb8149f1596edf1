//! Incremental structure from motion: start from two photographs, add one after the other.
//!
//! The file is long because the stages share one state.

use super::bundle::{Bundle, BundleOptions, Observation, RadialDistortion, adjust_bundle};
use super::reconstruction::{Reconstruction, ScenePoint, SfmImage};
use super::resection::find_camera;
use super::tracks::{PairMatches, TrackElement, build_tracks};
use super::triangulate_track::{Sight, triangulate_track, widest_angle_rad};
use super::two_view_start::{VerifiedPair, verify_pair};
use crate::camera::{Camera, Intrinsics, RigidTransform};
use crate::optim::{Iteration, LmOptions, RobustLoss};
use crate::robust::RansacOptions;
use crate::{Error, Result};
use nalgebra::{Point2, Point3};
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
    /// Largest distance of a match from its epipolar geometry, pixels. 2.
    pub max_epipolar_error_px: f64,
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
    /// Refine one factor for all focal lengths. False.
    pub refine_focal: bool,
    /// Refine two radial terms that all images share. False.
    pub refine_distortion: bool,
    /// The distortion to start with, or to keep. None.
    pub distortion: RadialDistortion,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
}

impl Default for SfmOptions {
    fn default() -> Self {
        Self {
            max_epipolar_error_px: 2.0,
            max_registration_error_px: 6.0,
            max_reprojection_error_px: 4.0,
            min_num_inliers: 15,
            min_angle_deg: 1.5,
            min_start_angle_deg: 16.0,
            refine_focal: false,
            refine_distortion: false,
            distortion: RadialDistortion::default(),
            seed: 0,
        }
    }
}

/// How far the work is.
#[derive(Debug, Clone, PartialEq)]
pub enum SfmProgress {
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
    pub cancelled: bool,
}

/// Hears of progress and says whether to go on.
pub type SfmObserver<'a> = &'a mut dyn FnMut(&SfmProgress) -> ControlFlow<()>;

/// A point and the elements of its track that agree with it.
#[derive(Debug, Clone)]
struct TrackPoint {
    position: Point3<f64>,
    seen: Vec<TrackElement>,
}

struct Builder<'a> {
    images: &'a [SfmImage],
    options: &'a SfmOptions,
    /// Distortion undone.
    pixels: Vec<Vec<Point2<f64>>>,
    intrinsics: Vec<Intrinsics>,
    distortion: RadialDistortion,
    tracks: &'a [Vec<TrackElement>],
    /// Track of each keypoint, `u32::MAX` if none.
    track_of: &'a [Vec<u32>],
    /// Images that earlier components have.
    taken: Vec<bool>,
    cameras: Vec<Option<Camera>>,
    points: Vec<Option<TrackPoint>>,
}

/// Asks the observer, and remembers that it wanted to stop.
struct Reporter<'a> {
    observer: SfmObserver<'a>,
    cancelled: bool,
}

impl Reporter<'_> {
    /// Whether to go on.
    fn tell(&mut self, progress: &SfmProgress) -> bool {
        if !self.cancelled && (self.observer)(progress).is_break() {
            self.cancelled = true;
        }
        !self.cancelled
    }
}

fn check(input: &SfmInput, options: &SfmOptions) -> Result<Vec<Intrinsics>> {
    let count = input.images.len();
    if count < 2 {
        return Err(Error::TooFew {
            what: "structure from motion from photographs",
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
        ("the largest epipolar error", options.max_epipolar_error_px),
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
    if !(options.distortion.k1.is_finite() && options.distortion.k2.is_finite()) {
        return Err(Error::NotFinite {
            what: "the lens distortion",
        });
    }
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
/// * `observer`: hears of every step; answer [`ControlFlow::Break`] to stop with what is there
///
/// The result can be empty: then no pair of photographs had enough matches in common.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two photographs, [`Error::SizeMismatch`] unless there is one
/// set of intrinsics or one a photograph, [`Error::OutOfRange`] for options out of range or
/// matches that refer to what is not there, [`Error::NotFinite`] for NaN and infinities.
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited".
pub fn reconstruct(
    input: &SfmInput,
    options: &SfmOptions,
    observer: SfmObserver<'_>,
) -> Result<SfmResult> {
    let intrinsics = check(input, options)?;
    let images = &input.images;
    let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
    // Bad indices are found before the work begins.
    build_tracks(&counts, &input.pairs)?;
    let mut reporter = Reporter {
        observer,
        cancelled: false,
    };
    let pixels = undistorted(images, &intrinsics, options.distortion);
    let verified = verify(input, options, &intrinsics, &pixels, &mut reporter);
    let surviving: Vec<PairMatches> = verified.iter().map(|v| v.pair.clone()).collect();
    let tracks = build_tracks(&counts, &surviving)?;
    let mut track_of: Vec<Vec<u32>> = counts.iter().map(|n| vec![u32::MAX; *n]).collect();
    for (index, track) in tracks.iter().enumerate() {
        for element in track {
            track_of[element.image as usize][element.keypoint as usize] = index as u32;
        }
    }
    let mut result = SfmResult::default();
    let mut taken = vec![false; images.len()];
    while !reporter.cancelled {
        let mut builder = Builder {
            images,
            options,
            pixels: pixels.clone(),
            intrinsics: intrinsics.clone(),
            distortion: options.distortion,
            tracks: &tracks,
            track_of: &track_of,
            taken: taken.clone(),
            cameras: vec![None; images.len()],
            points: vec![None; tracks.len()],
        };
        if !builder.start(&verified, &mut reporter) {
            break;
        }
        builder.grow(&mut reporter);
        let reconstruction = builder.finish();
        for (image, camera) in reconstruction.cameras.iter().enumerate() {
            taken[image] |= camera.is_some();
        }
        result.components.push(reconstruction);
    }
    result
        .components
        .sort_by_key(|component| std::cmp::Reverse(component.num_registered()));
    result.unregistered = (0..images.len()).filter(|&image| !taken[image]).collect();
    result.cancelled = reporter.cancelled;
    Ok(result)
}

/// All keypoints as a camera without distortion would show them.
fn undistorted(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    distortion: RadialDistortion,
) -> Vec<Vec<Point2<f64>>> {
    images
        .iter()
        .zip(intrinsics)
        .map(|(image, k)| {
            if distortion.is_none() {
                return image.keypoints.clone();
            }
            let center = k.principal_point();
            image
                .keypoints
                .iter()
                .map(|pixel| {
                    let ray = k.ray(pixel);
                    let straight = distortion.undistort(&Point2::new(ray.x, ray.y));
                    Point2::new(
                        k.fu_px() * straight.x + center.x,
                        k.fv_px() * straight.y + center.y,
                    )
                })
                .collect()
        })
        .collect()
}

fn verify(
    input: &SfmInput,
    options: &SfmOptions,
    intrinsics: &[Intrinsics],
    pixels: &[Vec<Point2<f64>>],
    reporter: &mut Reporter<'_>,
) -> Vec<VerifiedPair> {
    let total = input.pairs.len();
    let mut verified = Vec::new();
    // In groups, so that the observer hears of progress between them.
    for (group, pairs) in input.pairs.chunks(8).enumerate() {
        let mut found: Vec<Option<VerifiedPair>> = vec![None; pairs.len()];
        crate::optim::parallel::for_each_chunk(&mut found, 1, |n, found| {
            let pair = &pairs[n];
            let (a, b) = (pair.image1, pair.image2);
            let ransac = RansacOptions {
                max_error_px: options.max_epipolar_error_px,
                seed: options.seed,
                ..RansacOptions::default()
            };
            found[0] = verify_pair(
                pair,
                [&pixels[a], &pixels[b]],
                [&intrinsics[a], &intrinsics[b]],
                &ransac,
                options.min_num_inliers,
            );
        });
        verified.extend(found.into_iter().flatten());
        let done = (group * 8 + pairs.len()).min(total);
        if !reporter.tell(&SfmProgress::Verified { done, total }) {
            break;
        }
    }
    verified
}

impl Builder<'_> {
    fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }

    fn num_points(&self) -> usize {
        self.points.iter().flatten().count()
    }

    fn pixel(&self, element: TrackElement) -> Point2<f64> {
        self.pixels[element.image as usize][element.keypoint as usize]
    }

    fn sight(&self, element: TrackElement) -> Option<Sight> {
        self.cameras[element.image as usize].map(|camera| Sight {
            camera,
            pixel: self.pixel(element),
        })
    }

    /// Starts from the best pair that works.
    fn start(&mut self, verified: &[VerifiedPair], reporter: &mut Reporter<'_>) -> bool {
        let mut wanted_rad = self.options.min_start_angle_deg.to_radians();
        let mut tried = vec![false; verified.len()];
        // Below a quarter of a degree a pair says nothing about depth.
        while wanted_rad > 0.25f64.to_radians() {
            let mut order: Vec<usize> = (0..verified.len())
                .filter(|&n| {
                    let v = &verified[n];
                    !tried[n]
                        && v.median_angle_rad >= wanted_rad
                        && !self.taken[v.pair.image1]
                        && !self.taken[v.pair.image2]
                })
                .collect();
            order.sort_by_key(|&n| (std::cmp::Reverse(verified[n].pair.matches.len()), n));
            for n in order {
                tried[n] = true;
                if self.start_from(&verified[n]) {
                    let pair = &verified[n].pair;
                    reporter.tell(&SfmProgress::Started {
                        images: [pair.image1, pair.image2],
                        num_points: self.num_points(),
                    });
                    return true;
                }
                if reporter.cancelled {
                    return false;
                }
            }
            wanted_rad *= 0.5;
        }
        false
    }

    fn start_from(&mut self, verified: &VerifiedPair) -> bool {
        let (a, b) = (verified.pair.image1, verified.pair.image2);
        let camera = |intrinsics, cam_from_world| {
            Some(Camera {
                intrinsics,
                cam_from_world,
            })
        };
        self.cameras[a] = camera(self.intrinsics[a], RigidTransform::identity());
        self.cameras[b] = camera(self.intrinsics[b], verified.cam2_from_cam1);
        self.triangulate();
        if self.num_points() >= self.options.min_num_inliers {
            self.adjust(None, 20, false);
            self.filter();
            self.triangulate();
        }
        if self.num_points() >= self.options.min_num_inliers && self.num_registered() == 2 {
            return true;
        }
        self.cameras.fill(None);
        self.points.fill(None);
        false
    }

    /// Adds images while there are any that can be added.
    fn grow(&mut self, reporter: &mut Reporter<'_>) {
        // Points that an image saw when it could not be registered: it is tried again with more.
        let mut failed_with = vec![0; self.images.len()];
        let mut adjusted_at = self.num_registered();
        while !reporter.cancelled {
            let Some(image) = self.next_image(&failed_with) else {
                break;
            };
            let Some(num_visible) = self.register(image) else {
                failed_with[image] = self.visible(image).len();
                continue;
            };
            debug_assert!(num_visible > 0);
            self.triangulate_of(Some(image));
            let num_registered = self.num_registered();
            // Everything is refined while it is small, later whenever it has grown by a tenth.
            let everything = num_registered <= 12 || num_registered * 10 >= adjusted_at * 11;
            let cost = if everything {
                adjusted_at = num_registered;
                self.adjust(None, 15, num_registered >= 4)
            } else {
                let near = self.neighborhood(image, 6);
                self.adjust(Some(&near), 15, false)
            };
            self.filter();
            if everything {
                self.complete();
                self.triangulate();
            }
            if let Some(cost) = cost {
                reporter.tell(&SfmProgress::Adjusted { cost });
            }
            reporter.tell(&SfmProgress::Registered {
                image,
                num_registered: self.num_registered(),
                num_points: self.num_points(),
            });
        }
        if reporter.cancelled {
            return;
        }
        for _ in 0..2 {
            self.complete();
            self.triangulate();
            let cost = self.adjust(None, 50, true);
            self.filter();
            if let Some(cost) = cost
                && !reporter.tell(&SfmProgress::Adjusted { cost })
            {
                return;
            }
        }
    }

    /// The points that an image sees through its tracks.
    fn visible(&self, image: usize) -> Vec<(TrackElement, usize)> {
        let mut visible = Vec::new();
        for (keypoint, &track) in self.track_of[image].iter().enumerate() {
            if track != u32::MAX && self.points[track as usize].is_some() {
                let element = TrackElement {
                    image: image as u32,
                    keypoint: keypoint as u32,
                };
                visible.push((element, track as usize));
            }
        }
        visible
    }

    /// The image whose view of the points is best: many, and spread over the picture.
    ///
    /// Source: Schönberger & Frahm 2016, §4.2.
    fn next_image(&self, failed_with: &[usize]) -> Option<usize> {
        let mut best = None;
        for image in 0..self.images.len() {
            if self.cameras[image].is_some() || self.taken[image] {
                continue;
            }
            let visible = self.visible(image);
            let again = failed_with[image];
            if visible.len() < self.options.min_num_inliers.max(again + again / 4 + 1) {
                continue;
            }
            let (width, height) = (self.images[image].width, self.images[image].height);
            let mut score = 0;
            for level in 1..=4 {
                let side = 1usize << level;
                let mut occupied = vec![false; side * side];
                for (element, _) in &visible {
                    let pixel = self.images[image].keypoints[element.keypoint as usize];
                    let cell = |x: f64, size: u32| {
                        let share = (x + 0.5) / f64::from(size.max(1));
                        ((share * side as f64) as usize).min(side - 1)
                    };
                    occupied[cell(pixel.y, height) * side + cell(pixel.x, width)] = true;
                }
                score += side * side * occupied.iter().filter(|x| **x).count();
            }
            let rank = (score, visible.len());
            if best.is_none_or(|(other, _)| rank > other) {
                best = Some((rank, image));
            }
        }
        best.map(|(_, image)| image)
    }

    /// Finds the camera of an image from the points it sees, and adds its observations.
    fn register(&mut self, image: usize) -> Option<usize> {
        let visible = self.visible(image);
        let (mut pixels, mut positions) = (Vec::new(), Vec::new());
        for (element, track) in &visible {
            if let Some(point) = &self.points[*track] {
                pixels.push(self.pixel(*element));
                positions.push(point.position);
            }
        }
        let ransac = RansacOptions {
            max_error_px: self.options.max_registration_error_px,
            seed: self.options.seed,
            ..RansacOptions::default()
        };
        let found = find_camera(&pixels, &positions, &self.intrinsics[image], &ransac)?;
        if found.num_inliers < self.options.min_num_inliers {
            return None;
        }
        self.cameras[image] = Some(found.camera);
        for ((element, track), inlier) in visible.iter().zip(&found.inliers) {
            if *inlier && let Some(point) = &mut self.points[*track] {
                insert(&mut point.seen, *element);
            }
        }
        Some(found.num_inliers)
    }

    fn triangulate(&mut self) {
        self.triangulate_of(None);
    }

    /// Triangulates tracks without a point, all or those of one image.
    fn triangulate_of(&mut self, image: Option<usize>) {
        let candidates: Vec<usize> = match image {
            Some(image) => self.track_of[image]
                .iter()
                .filter(|&&track| track != u32::MAX)
                .map(|&track| track as usize)
                .collect(),
            None => (0..self.tracks.len()).collect(),
        };
        let candidates: Vec<usize> = candidates
            .into_iter()
            .filter(|&track| self.points[track].is_none())
            .collect();
        let mut found: Vec<Option<TrackPoint>> = vec![None; candidates.len()];
        let this = &*self;
        crate::optim::parallel::for_each(&mut found, |n, found| {
            let (elements, sights): (Vec<_>, Vec<_>) = this.tracks[candidates[n]]
                .iter()
                .filter_map(|element| Some((*element, this.sight(*element)?)))
                .unzip();
            if sights.len() < 2 {
                return;
            }
            *found = triangulate_track(
                &sights,
                this.options.max_reprojection_error_px,
                this.options.min_angle_deg.to_radians(),
            )
            .map(|(position, inliers)| TrackPoint {
                position,
                seen: elements
                    .into_iter()
                    .zip(inliers)
                    .filter(|(_, inlier)| *inlier)
                    .map(|(element, _)| element)
                    .collect(),
            });
        });
        for (track, point) in candidates.into_iter().zip(found) {
            self.points[track] = point;
        }
    }

    /// Picks up observations that fit their point after all.
    fn complete(&mut self) {
        let max_error_sq = {
            let max_error_px = self.options.max_reprojection_error_px;
            max_error_px * max_error_px
        };
        for track in 0..self.tracks.len() {
            let Some(mut point) = self.points[track].take() else {
                continue;
            };
            for element in &self.tracks[track] {
                if !point.seen.contains(element)
                    && let Some(sight) = self.sight(*element)
                    && sight.error_sq(&point.position) <= max_error_sq
                {
                    insert(&mut point.seen, *element);
                }
            }
            self.points[track] = Some(point);
        }
    }

    /// Drops observations that fit badly, points seen under too small an angle, and cameras that
    /// see too little.
    fn filter(&mut self) {
        let max_error_px = self.options.max_reprojection_error_px;
        let min_angle_rad = self.options.min_angle_deg.to_radians();
        loop {
            let mut points = std::mem::take(&mut self.points);
            let this = &*self;
            crate::optim::parallel::for_each(&mut points, |_, slot| {
                let Some(point) = slot else { return };
                let position = point.position;
                point.seen.retain(|element| {
                    this.sight(*element).is_some_and(|sight| {
                        sight.error_sq(&position) <= max_error_px * max_error_px
                    })
                });
                let centers = point
                    .seen
                    .iter()
                    .filter_map(|element| this.cameras[element.image as usize])
                    .map(|camera| camera.center_in_world());
                if point.seen.len() < 2 || widest_angle_rad(&position, centers) < min_angle_rad {
                    *slot = None;
                }
            });
            self.points = points;
            let mut counts = vec![0; self.cameras.len()];
            for element in self.points.iter().flatten().flat_map(|point| &point.seen) {
                counts[element.image as usize] += 1;
            }
            let mut dropped = false;
            for (camera, count) in self.cameras.iter_mut().zip(counts) {
                if camera.is_some() && count < 6 {
                    *camera = None;
                    dropped = true;
                }
            }
            if !dropped {
                break;
            }
        }
    }

    /// The image itself and those that share most points with it.
    fn neighborhood(&self, image: usize, count: usize) -> Vec<usize> {
        let mut shared = vec![0; self.images.len()];
        for point in self.points.iter().flatten() {
            if point
                .seen
                .iter()
                .any(|element| element.image as usize == image)
            {
                for element in &point.seen {
                    shared[element.image as usize] += 1;
                }
            }
        }
        let mut order: Vec<usize> = (0..self.images.len()).filter(|&i| shared[i] > 0).collect();
        order.sort_by_key(|&i| (std::cmp::Reverse(shared[i]), i));
        order.truncate(count);
        order
    }

    /// Bundle adjustment of everything, or of some images with the points that they see; returns
    /// the cost.
    fn adjust(
        &mut self,
        free: Option<&[usize]>,
        max_iterations: usize,
        with_intrinsics: bool,
    ) -> Option<f64> {
        let is_free = |image: usize| free.is_none_or(|list| list.contains(&image));
        let mut bundle = Bundle {
            distortion: self.distortion,
            ..Bundle::default()
        };
        let mut camera_of = vec![usize::MAX; self.images.len()];
        let mut image_of = Vec::new();
        let mut track_of = Vec::new();
        let mut options = BundleOptions {
            lm: LmOptions {
                max_iterations,
                cost_tolerance: 1e-7,
                ..LmOptions::default()
            },
            // A pixel and a half: beyond it matches are more often wrong than imprecise.
            loss: RobustLoss::Cauchy { width: 1.5 },
            refine_focal: with_intrinsics && self.options.refine_focal,
            refine_distortion: with_intrinsics && self.options.refine_distortion,
            ..BundleOptions::default()
        };
        for (track, point) in self.points.iter().enumerate() {
            let Some(point) = point else { continue };
            if !point
                .seen
                .iter()
                .any(|element| is_free(element.image as usize))
            {
                continue;
            }
            for element in &point.seen {
                let image = element.image as usize;
                let Some(camera) = self.cameras[image] else {
                    continue;
                };
                if camera_of[image] == usize::MAX {
                    camera_of[image] = bundle.cameras.len();
                    bundle.cameras.push(camera);
                    image_of.push(image);
                    options.held_cameras.push(!is_free(image));
                }
                bundle.observations.push(Observation {
                    camera: camera_of[image],
                    point: bundle.points.len(),
                    pixel: self.images[image].keypoints[element.keypoint as usize],
                });
            }
            bundle.points.push(point.position);
            track_of.push(track);
        }
        let mut go_on = |_: &Iteration| ControlFlow::Continue(());
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).ok()?;
        for (image, camera) in image_of.into_iter().zip(&bundle.cameras) {
            self.cameras[image] = Some(*camera);
        }
        for (track, position) in track_of.into_iter().zip(&bundle.points) {
            if let Some(point) = &mut self.points[track] {
                point.position = *position;
            }
        }
        if options.refine_focal || options.refine_distortion {
            self.share_intrinsics(&bundle);
        }
        Some(report.final_cost)
    }

    /// Gives refined intrinsics to the images that are still to come.
    fn share_intrinsics(&mut self, bundle: &Bundle) {
        let registered = (0..self.images.len()).find(|&image| self.cameras[image].is_some());
        if let Some(camera) = registered.and_then(|image| self.cameras[image])
            && let Some(image) = registered
        {
            let factor = camera.intrinsics.fu_px() / self.intrinsics[image].fu_px();
            for k in &mut self.intrinsics {
                let center = k.principal_point();
                if let Ok(refined) =
                    Intrinsics::new(k.fu_px() * factor, k.fv_px() * factor, center.x, center.y)
                {
                    *k = refined;
                }
            }
        }
        for (camera, intrinsics) in self.cameras.iter_mut().zip(&self.intrinsics) {
            if let Some(camera) = camera {
                camera.intrinsics = *intrinsics;
            }
        }
        self.distortion = bundle.distortion;
        self.pixels = undistorted(self.images, &self.intrinsics, self.distortion);
    }

    fn finish(mut self) -> Reconstruction {
        let mut reconstruction = Reconstruction {
            distortion: self.distortion,
            points: self
                .points
                .drain(..)
                .flatten()
                .map(|point| ScenePoint {
                    position: point.position,
                    color: [128; 3],
                    track: point.seen,
                    error_px: 0.0,
                })
                .collect(),
            cameras: self.cameras,
        };
        reconstruction.finish_points(self.images);
        reconstruction
    }
}

/// Inserts into a list sorted by image.
fn insert(seen: &mut Vec<TrackElement>, element: TrackElement) {
    if let Err(place) = seen.binary_search(&element) {
        seen.insert(place, element);
    }
}
