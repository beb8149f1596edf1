//! Incremental structure from motion: starts from two images, registers the others one by one.

use super::builder::Builder;
use super::options::{OF_IMAGES, SfmInput, SfmOptions, check};
use super::reconstruction::Reconstruction;
use super::tracks::{PairMatches, build_tracks};
use super::two_view_start::{VerifiedPair, verify_pairs};
use crate::Result;
use crate::progress::{Monitor, Part, Stage, report};

/// Progress of [`reconstruct`] when all pairs are verified, measured with some dozens of images.
const VERIFIED: f32 = 0.25;

/// Final rounds of global bundle adjustment per component.
const FINAL_ROUNDS: usize = 2;

/// One step of structure from motion or of odometry.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SfmStep {
    /// Start of a component from two images.
    Started {
        /// The images.
        images: [usize; 2],
        /// Number of points.
        num_points: usize,
    },
    /// Registration of an image.
    Registered {
        /// The image.
        image: usize,
        /// Number of registered images in this component.
        num_registered: usize,
        /// Number of points in this component.
        num_points: usize,
        /// `½ Σ ρ(‖r‖²)` of the refinement afterwards, square pixels; `None` if it failed.
        cost: Option<f64>,
    },
    /// Refinement of all cameras and points of a component.
    Adjusted {
        /// `½ Σ ρ(‖r‖²)`, square pixels.
        cost: f64,
    },
}

impl SfmStep {
    /// Returns the cost of the refinement of this step, square pixels.
    pub fn cost(&self) -> Option<f64> {
        match *self {
            Self::Started { .. } => None,
            Self::Registered { cost, .. } => cost,
            Self::Adjusted { cost } => Some(cost),
        }
    }
}

/// Result of structure from motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmResult {
    /// Reconstructions that could not be connected, largest first; each has its own frame.
    pub components: Vec<Reconstruction>,
    /// Images in no component.
    pub unregistered: Vec<usize>,
    /// Steps taken, in order.
    pub steps: Vec<SfmStep>,
    /// Whether every image was tried; false for [`IncrementalReconstruction::finish`] before the
    /// last step.
    pub is_complete: bool,
}

/// Reconstructs cameras and points from matches between images.
///
/// Pairs are verified by their epipolar geometry, and the remaining matches joined into tracks. A
/// pair with many matches and wide angles initializes the reconstruction; then the image that sees
/// most points, well spread, is registered by P3P and RANSAC, its tracks are triangulated, and
/// bundle adjustment refines everything. Observations that fit badly are dropped, others added
/// again. Images that cannot be registered start further components.
///
/// A component with three known positions ([`SfmImage::position`](crate::sfm::SfmImage::position))
/// that are not on one line is aligned with them at the end and refined once more; some positions
/// may be wrong.
///
/// * `monitor`: the stages are [`Stage::PairVerification`], then alternately
///   [`Stage::Registration`] and [`Stage::BundleAdjustment`]
///
/// The result is empty if no pair of images has enough common matches.
/// [`IncrementalReconstruction`] does the same step by step, and keeps the partial result when
/// canceled.
///
/// # Errors
/// [`TooFew`](crate::Error::TooFew) for fewer than two images,
/// [`SizeMismatch`](crate::Error::SizeMismatch) unless there is one camera or one per image,
/// [`OutOfRange`](crate::Error::OutOfRange) for options out of range or matches with invalid
/// indices, [`NotFinite`](crate::Error::NotFinite) for NaN and infinities, also in lenses,
/// [`Canceled`](crate::Error::Canceled).
///
/// Source: Schönberger & Frahm 2016, "Structure-from-motion revisited".
///
/// ```
/// use epipole::sfm::{SfmInput, SfmOptions, reconstruct};
/// use std::ops::ControlFlow;
/// let mut show = |status: epipole::progress::Status| {
///     println!("{}, {:.0} %", status.stage.words(), 100.0 * status.fraction);
///     ControlFlow::Continue(())
/// };
/// let nothing = SfmInput::default();
/// assert!(reconstruct(&nothing, &SfmOptions::default(), &mut show).is_err());
/// ```
pub fn reconstruct(
    input: &SfmInput,
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<SfmResult> {
    let mut run = IncrementalReconstruction::new(input, options, monitor)?;
    while run.step(monitor)?.is_some() {}
    Ok(run.finish())
}

/// Step-by-step [`reconstruct`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::sfm::{IncrementalReconstruction, SfmImage, SfmInput, SfmOptions};
/// let input = SfmInput {
///     images: vec![SfmImage::default(); 2],
///     cameras: vec![Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480)],
///     pairs: vec![],
/// };
/// let mut run = IncrementalReconstruction::new(&input, &SfmOptions::default(), &mut ())?;
/// while let Some(step) = run.step(&mut ())? {
///     println!("{step:?}: {:?} points", run.current().map(|found| found.points.len()));
/// }
/// assert_eq!(run.finish().unregistered, [0, 1]);
/// # Ok(()) }
/// ```
pub struct IncrementalReconstruction {
    builder: Builder,
    verified: Vec<VerifiedPair>,
    phase: Phase,
    components: Vec<Reconstruction>,
    steps: Vec<SfmStep>,
    fraction: f32,
}

/// Phase of the reconstruction.
enum Phase {
    Start,
    Grow {
        first_two: [usize; 2],
        /// Number of points that an image saw when its registration failed: it is tried again with
        /// more.
        failed_with: Vec<usize>,
        /// Number of registered images at the last global adjustment.
        adjusted_at: usize,
    },
    Refine {
        first_two: [usize; 2],
        round: usize,
    },
    Done,
}

impl IncrementalReconstruction {
    /// Verifies the pairs of `input`.
    ///
    /// * `monitor`: the only stage is [`Stage::PairVerification`]; progress is relative to the
    ///   whole reconstruction
    ///
    /// # Errors
    /// As [`reconstruct`].
    pub fn new(input: &SfmInput, options: &SfmOptions, monitor: &mut dyn Monitor) -> Result<Self> {
        let images = &input.images;
        let cameras = check(OF_IMAGES, images, &input.cameras, options)?;
        let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
        // Find invalid indices before the work begins.
        build_tracks(&counts, &input.pairs)?;
        let mut builder = Builder::new(images, cameras, options);
        let mut part = Part::new(monitor, 0.0, VERIFIED);
        let verified = verify_pairs(&input.pairs, &builder.views, options, &mut part)?;
        let surviving: Vec<PairMatches> = verified.iter().map(|v| v.pair.clone()).collect();
        builder.join_tracks(&surviving)?;
        Ok(Self {
            builder,
            verified,
            phase: Phase::Start,
            components: Vec::new(),
            steps: Vec::new(),
            fraction: VERIFIED,
        })
    }

    /// Takes the next step; `None` after the last.
    ///
    /// * `monitor`: the stages are [`Stage::Registration`] and [`Stage::BundleAdjustment`]
    ///
    /// # Errors
    /// [`Canceled`](crate::Error::Canceled); the partial result is valid, and the next call
    /// continues from there.
    pub fn step(&mut self, monitor: &mut dyn Monitor) -> Result<Option<SfmStep>> {
        loop {
            let taken = match self.phase {
                Phase::Start => self.start(monitor)?,
                Phase::Grow { .. } => self.add_image(monitor)?,
                Phase::Refine { .. } => self.refine(monitor)?,
                Phase::Done => return Ok(None),
            };
            let Some(step) = taken else { continue };
            self.steps.push(step);
            let stage = match step {
                SfmStep::Adjusted { .. } => Stage::BundleAdjustment,
                _ => Stage::Registration,
            };
            // A further component starts with two images again; progress does not go back.
            let num_registered = self.builder.num_registered();
            let whole = self.builder.images.len().max(num_registered);
            let grown = num_registered as f32 / whole as f32;
            self.fraction = (VERIFIED + (1.0 - VERIFIED) * grown).clamp(self.fraction, 1.0);
            report(monitor, stage, self.fraction)?;
            return Ok(Some(step));
        }
    }

    /// Returns the component under construction; `None` between two components.
    pub fn current(&self) -> Option<Reconstruction> {
        (self.builder.num_registered() > 0).then(|| self.builder.so_far())
    }

    /// Returns all components, including the current one.
    pub fn finish(mut self) -> SfmResult {
        self.components.extend(self.current());
        (self.components).sort_by_key(|component| std::cmp::Reverse(component.num_registered()));
        let is_registered = |image: &usize| {
            let mut components = self.components.iter();
            components.any(|component| component.cameras[*image].is_some())
        };
        let unregistered = (0..self.builder.images.len())
            .filter(|image| !is_registered(image))
            .collect();
        SfmResult {
            unregistered,
            components: self.components,
            steps: self.steps,
            is_complete: matches!(self.phase, Phase::Done),
        }
    }

    fn start(&mut self, monitor: &mut dyn Monitor) -> Result<Option<SfmStep>> {
        let mut part = Part::new(monitor, self.fraction, self.fraction);
        let Some(images) = self.builder.start(&self.verified, &mut part)? else {
            self.phase = Phase::Done;
            return Ok(None);
        };
        self.phase = Phase::Grow {
            first_two: images,
            failed_with: vec![0; self.builder.images.len()],
            adjusted_at: self.builder.num_registered(),
        };
        let num_points = self.builder.num_points();
        Ok(Some(SfmStep::Started { images, num_points }))
    }

    /// Adds the next image that can be registered.
    fn add_image(&mut self, monitor: &mut dyn Monitor) -> Result<Option<SfmStep>> {
        let Phase::Grow {
            first_two,
            failed_with,
            adjusted_at,
        } = &mut self.phase
        else {
            return Ok(None);
        };
        let builder = &mut self.builder;
        let Some(image) = builder.next_image(failed_with) else {
            self.phase = Phase::Refine {
                first_two: *first_two,
                round: 0,
            };
            return Ok(None);
        };
        report(monitor, Stage::Registration, self.fraction)?;
        if builder.register(image).is_none() {
            failed_with[image] = builder.visible(image).len();
            return Ok(None);
        }
        builder.triangulate_of(Some(image));
        let num_registered = builder.num_registered();
        let mut part = Part::new(monitor, self.fraction, self.fraction);
        // Refine everything while the model is small, later whenever it has grown by a tenth.
        let adjusts_all = num_registered <= 12 || num_registered * 10 >= *adjusted_at * 11;
        let cost = if adjusts_all {
            *adjusted_at = num_registered;
            builder.adjust(None, 15, num_registered >= 4, &mut part)
        } else {
            let near = builder.neighborhood(image, 6);
            builder.adjust(Some(&near), 15, false, &mut part)
        };
        builder.filter();
        if adjusts_all {
            builder.complete();
            builder.triangulate();
        }
        Ok(Some(SfmStep::Registered {
            image,
            num_registered: builder.num_registered(),
            num_points: builder.num_points(),
            cost: cost?,
        }))
    }

    /// Refines a complete component; the last round aligns it with the known positions.
    fn refine(&mut self, monitor: &mut dyn Monitor) -> Result<Option<SfmStep>> {
        let Phase::Refine { first_two, round } = self.phase else {
            return Ok(None);
        };
        let builder = &mut self.builder;
        let mut part = Part::new(monitor, self.fraction, self.fraction);
        let mut cost = None;
        if round < FINAL_ROUNDS {
            builder.complete();
            builder.triangulate();
            builder.drop_short_tracks();
            let adjusted = builder.adjust(None, 50, true, &mut part);
            builder.filter();
            builder.drop_short_tracks();
            cost = adjusted?;
        } else if builder.place_in_world() {
            let adjusted = builder.adjust(None, 50, true, &mut part);
            if !matches!(adjusted, Ok(None)) {
                builder.filter();
                builder.drop_short_tracks();
            }
            cost = adjusted?;
        }
        if round < FINAL_ROUNDS {
            self.phase = Phase::Refine {
                first_two,
                round: round + 1,
            };
        } else {
            self.end_component(first_two);
        }
        Ok(cost.map(|cost| SfmStep::Adjusted { cost }))
    }

    fn end_component(&mut self, first_two: [usize; 2]) {
        if let Some(component) = self.current() {
            let taken = &mut self.builder.taken;
            for (taken, camera) in taken.iter_mut().zip(&component.cameras) {
                *taken |= camera.is_some();
            }
            self.components.push(component);
        } else {
            // No point survived, as when no point has the required number of images. The same
            // initial pair would fail again.
            for image in first_two {
                self.builder.taken[image] = true;
            }
        }
        self.builder.clear();
        self.phase = Phase::Start;
    }
}
