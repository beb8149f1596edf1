//! The long computation behind `disparity-map`: the pair, its true disparity, and what is found.

use crate::contract::{Problem, Progress};
use epipole::Error;
use epipole::camera::{Camera, RigidTransform};
use epipole::imaging::rgb_to_gray;
use epipole::stereo::{DisparityImage, StereoBm, StereoSgm, depth_from_disparity};
use epipole::synthetic::{Photograph, Sampling, Scene, still_life_camera};
use image::{GrayImage, ImageBuffer, Luma, RgbImage};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Size of the photographs, pixels.
pub(super) const SIZE: (u32, u32) = (320, 240);
/// An answer that is further off is bad, pixels.
pub(super) const BAD_PX: f32 = 2.0;
/// Disparities of the two photographs that differ by more belong to different surfaces, pixels.
const SAME_SURFACE_PX: f32 = 1.0;

/// How disparities are found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum Method {
    /// Block matching with windows of this side, pixels.
    Blocks(u32),
    /// Semi-global matching.
    SemiGlobal,
}

/// Everything that the answer depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    pub(super) baseline_m: f64,
    pub(super) method: Method,
    /// Disparities from 0 up to this are looked for.
    pub(super) num_disparities: u32,
    /// Whether uncertain answers are left out.
    pub(super) checks: bool,
}

/// What the computation finds, as it travels.
#[derive(Serialize, Deserialize)]
struct Wire {
    pictures: [Vec<u8>; 2],
    truth: Vec<f32>,
    hidden: Vec<bool>,
    found: Vec<f32>,
}

/// What the computation finds.
pub(super) struct Answer {
    pub(super) pictures: [RgbImage; 2],
    /// True disparities of the left photograph.
    pub(super) truth: DisparityImage,
    /// Disparities found.
    pub(super) found: DisparityImage,
    hidden: Vec<bool>,
    baseline_m: f64,
    num_disparities: u32,
    /// The share of what both cameras see that has an answer.
    pub(super) coverage: f64,
    /// The share of these answers that is bad.
    pub(super) bad: f64,
    /// Their mean error, pixels.
    pub(super) mean_error_px: f64,
}

/// The focal length of both cameras, pixels.
pub(super) fn focal_px() -> f64 {
    still_life_camera(SIZE.0, SIZE.1).intrinsics.fu_px()
}

/// The left camera, and the right one a baseline further along its rows.
fn cameras(baseline_m: f64) -> [Camera; 2] {
    let left = still_life_camera(SIZE.0, SIZE.1);
    // Left of the composition's own viewpoint, so that both see the table.
    let shifted = |x_m: f64| Camera {
        cam_from_world: RigidTransform::translation(-x_m, 0.0, 0.0) * left.cam_from_world,
        ..left
    };
    [shifted(-0.5 * baseline_m), shifted(0.5 * baseline_m)]
}

impl Request {
    pub(super) fn to_bytes(self) -> Vec<u8> {
        postcard::to_allocvec(&self).unwrap_or_default()
    }

    /// Carries out the computation.
    ///
    /// # Errors
    /// A sentence about the settings, or that the work was ended.
    pub(super) fn compute(bytes: &[u8], progress: Progress<'_>) -> Result<Vec<u8>, Problem> {
        let unreadable = |_| Error::Degenerate {
            what: "the disparity",
            why: "the request cannot be read",
        };
        let request: Self = postcard::from_bytes(bytes).map_err(unreadable)?;
        let mut tell = |share: f64| match progress(share) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Error::Canceled),
        };
        tell(0.0)?;
        if !(request.baseline_m > 0.0 && request.baseline_m < 1.0) {
            return Err(Error::OutOfRange {
                what: "the baseline",
                requirement: "between 0 and 1 meters",
                value: request.baseline_m,
            }
            .into());
        }
        let scene = Scene::still_life();
        let mut photos = Vec::new();
        for camera in cameras(request.baseline_m) {
            photos.push(scene.render(&camera, SIZE.0, SIZE.1, Sampling::Full)?);
            tell(0.3 * photos.len() as f64)?;
        }
        let gray = |photo: &Photograph| rgb_to_gray(&photo.image);
        let found = request.search(&gray(&photos[0]), &gray(&photos[1]), &mut |share| {
            progress(0.6 + 0.4 * f64::from(share))
        })?;
        let truth = photos
            .iter()
            .map(|photo| true_disparity(&photo.depth_m, request.baseline_m))
            .collect::<Vec<_>>();
        let wire = Wire {
            hidden: hidden(&truth[0], &truth[1]),
            truth: truth[0].clone(),
            found: found.as_raw().to_vec(),
            pictures: [0, 1].map(|n: usize| photos[n].image.as_raw().clone()),
        };
        Ok(postcard::to_allocvec(&wire).unwrap_or_default())
    }

    fn search(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<DisparityImage, Error> {
        match self.method {
            Method::Blocks(window_px) => {
                let mut matcher = StereoBm {
                    num_disparities: self.num_disparities,
                    window_px,
                    ..StereoBm::default()
                };
                if !self.checks {
                    matcher.left_right_max_px = None;
                    matcher.uniqueness_percent = 0;
                    matcher.min_texture = 0.0;
                    matcher.speckle_size = 0;
                }
                matcher.compute_with(left, right, progress)
            }
            Method::SemiGlobal => {
                let mut matcher = StereoSgm {
                    num_disparities: self.num_disparities,
                    ..StereoSgm::default()
                };
                if !self.checks {
                    matcher.left_right_max_px = None;
                    matcher.uniqueness_percent = 0;
                    matcher.speckle_size = 0;
                }
                matcher.compute_with(left, right, progress)
            }
        }
    }
}

/// `d = f B / Z` at every pixel.
fn true_disparity(depth_m: &ImageBuffer<Luma<f32>, Vec<f32>>, baseline_m: f64) -> Vec<f32> {
    let scale = focal_px() * baseline_m;
    depth_m
        .as_raw()
        .iter()
        .map(|&z| (scale / f64::from(z)) as f32)
        .collect()
}

/// Which pixels of the left photograph the right camera does not see.
fn hidden(left: &[f32], right: &[f32]) -> Vec<bool> {
    let width = SIZE.0 as usize;
    let is_hidden = |index: usize| {
        let (row, u) = (index / width, (index % width) as f32);
        let there = (u - left[index]).round();
        if there < 0.0 {
            return true;
        }
        // A surface in front has a larger disparity.
        let before = right[row * width + (there as usize).min(width - 1)] - left[index];
        before > SAME_SURFACE_PX
    };
    (0..left.len()).map(is_hidden).collect()
}

impl Answer {
    /// Reads the answer to `request`; `None` if it is no answer.
    pub(super) fn from_bytes(bytes: &[u8], request: &Request) -> Option<Self> {
        let wire: Wire = postcard::from_bytes(bytes).ok()?;
        let [left, right] = wire.pictures;
        let picture = |bytes| RgbImage::from_raw(SIZE.0, SIZE.1, bytes);
        let map = |values| DisparityImage::from_raw(SIZE.0, SIZE.1, values).ok();
        let mut answer = Self {
            pictures: [picture(left)?, picture(right)?],
            truth: map(wire.truth)?,
            found: map(wire.found)?,
            hidden: wire.hidden,
            baseline_m: request.baseline_m,
            num_disparities: request.num_disparities,
            coverage: 0.0,
            bad: 0.0,
            mean_error_px: 0.0,
        };
        (answer.hidden.len() == answer.found.as_raw().len()).then_some(())?;
        answer.judge();
        Some(answer)
    }

    fn judge(&mut self) {
        let (mut seen, mut answered, mut bad, mut sum) = (0.0, 0.0, 0.0, 0.0);
        for v in 0..SIZE.1 {
            for u in 0..SIZE.0 {
                if self.is_hidden(u, v) {
                    continue;
                }
                seen += 1.0;
                if let Some(error_px) = self.error_px(u, v) {
                    answered += 1.0;
                    sum += f64::from(error_px.abs());
                    bad += f64::from(u8::from(error_px.abs() > BAD_PX));
                }
            }
        }
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        self.coverage = share(answered, seen);
        self.bad = share(bad, answered);
        self.mean_error_px = share(sum, answered);
    }

    /// Whether the right camera does not see what the left one sees here.
    pub(super) fn is_hidden(&self, u: u32, v: u32) -> bool {
        let index = v as usize * SIZE.0 as usize + u as usize;
        self.hidden.get(index).copied().unwrap_or(false)
    }

    /// Disparity found minus true disparity, pixels; none without an answer.
    pub(super) fn error_px(&self, u: u32, v: u32) -> Option<f32> {
        Some(self.found.get(u, v)? - self.truth.get(u, v)?)
    }

    /// The depth of a disparity, meters; none for one that has none.
    pub(super) fn depth_m(&self, disparity_px: f32) -> Option<f64> {
        depth_from_disparity(focal_px(), self.baseline_m, f64::from(disparity_px)).ok()
    }

    /// The disparity at the end of the color scale, pixels.
    pub(super) fn scale_px(&self) -> f32 {
        let nearest = self.truth.range_px().map_or(0.0, |(_, most)| most);
        nearest.max(1.0)
    }

    /// The largest true disparity, and whether the search reaches it.
    pub(super) fn reaches_nearest(&self) -> bool {
        self.scale_px() < self.num_disparities as f32 - 1.0
    }
}
