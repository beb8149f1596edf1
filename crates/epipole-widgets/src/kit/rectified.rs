//! A rectified pair of photographs of the still life, with its true disparities.

use crate::canvas::{Canvas, Place, Stroke};
use crate::contract::{Problem, Progress, Rect};
use crate::kit::picture::Picture;
use crate::kit::question::{Question, tell};
use crate::theme::Role;
use epipole::Error;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::stereo::depth_from_disparity;
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};
use serde::{Deserialize, Serialize};

/// Size of the photographs, pixels.
pub(crate) const SIZE: (u32, u32) = (320, 240);
/// Disparities that differ by more belong to different surfaces, pixels.
const SAME_SURFACE_PX: f32 = 1.0;

/// One value per pixel, row by row; NaN without a value.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Map(pub(crate) Vec<f32>);

impl Map {
    pub(crate) fn get(&self, u: u32, v: u32) -> Option<f32> {
        let value = self.0.get(index(u, v)).filter(|_| u < SIZE.0)?;
        value.is_finite().then_some(*value)
    }

    /// Returns whether there is a value for every pixel.
    pub(crate) fn fits(&self) -> bool {
        self.0.len() == NUM_PIXELS
    }
}

const NUM_PIXELS: usize = (SIZE.0 * SIZE.1) as usize;

fn index(u: u32, v: u32) -> usize {
    v as usize * SIZE.0 as usize + u as usize
}

/// The photographs of the left and the right camera, and the ground truth of the left one.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct RectifiedPair {
    pub(crate) pictures: [Picture; 2],
    /// True disparities of the left photograph.
    pub(crate) truth: Map,
    /// Whether each pixel of the left photograph is hidden from the right camera.
    pub(crate) hidden: Vec<bool>,
}

impl RectifiedPair {
    /// Renders the pair.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the baseline, and [`Error::Canceled`] if `progress`
    /// cancels.
    pub(crate) fn render(baseline_m: f64, progress: Progress<'_>) -> Result<Self, Problem> {
        tell(progress, 0.0)?;
        if !(baseline_m > 0.0 && baseline_m < 1.0) {
            return Err(Error::OutOfRange {
                what: "the baseline",
                requirement: "between 0 and 1 meters",
                value: baseline_m,
            }
            .into());
        }
        let scene = Scene::still_life();
        let [left, right] = cameras(baseline_m);
        let left = scene.render(&left, SIZE.0, SIZE.1, Sampling::Full)?;
        tell(progress, 0.5)?;
        let right = scene.render(&right, SIZE.0, SIZE.1, Sampling::Full)?;
        tell(progress, 1.0)?;
        let [truth, seen] = [&left, &right].map(|photo| true_disparity(photo, baseline_m));
        Ok(Self {
            hidden: hidden(&truth.0, &seen.0),
            truth,
            pictures: [left.image.into(), right.image.into()],
        })
    }

    /// Returns whether its sizes are those of a pair.
    pub(crate) fn fits(&self) -> bool {
        let mut pictures = self.pictures.iter();
        pictures.all(|picture| picture.size() == SIZE)
            && self.truth.fits()
            && self.hidden.len() == NUM_PIXELS
    }

    /// Whether a pixel of the left photograph is hidden from the right camera.
    pub(crate) fn is_hidden(&self, u: u32, v: u32) -> bool {
        self.hidden.get(index(u, v)).copied().unwrap_or(false)
    }
}

/// The request for the pair at a baseline of [`BASELINE_M`]; it has no parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PairQuestion;

/// Distance between the cameras of a [`PairQuestion`], meters.
pub(crate) const BASELINE_M: f64 = 0.08;

impl Question for PairQuestion {
    type Answer = RectifiedPair;
    const LABEL: &'static str = "Taking the photographs";
    const FAILED: &'static str = "There are no photographs";

    fn answer(&self, progress: Progress<'_>) -> Result<RectifiedPair, Problem> {
        RectifiedPair::render(BASELINE_M, progress)
    }

    fn fits(&self, answer: &RectifiedPair) -> bool {
        answer.fits()
    }
}

/// Returns the depth of a disparity, meters; `None` unless the disparity is positive.
pub(crate) fn depth_m(baseline_m: f64, disparity_px: f64) -> Option<f64> {
    depth_from_disparity(focal_px(), baseline_m, disparity_px).ok()
}

/// Returns the focal length of both cameras, pixels.
fn focal_px() -> f64 {
    still_life_camera(SIZE.0, SIZE.1).camera.intrinsics.fu_px()
}

/// Returns the left camera and the right one, a baseline apart along the rows.
fn cameras(baseline_m: f64) -> [PosedCamera; 2] {
    let left = still_life_camera(SIZE.0, SIZE.1);
    // The cameras are half a baseline to either side of the composition's viewpoint, so both see
    // the table.
    let shifted = |x_m: f64| PosedCamera {
        cam_from_world: RigidTransform::translation(-x_m, 0.0, 0.0) * left.cam_from_world,
        ..left
    };
    [shifted(-0.5 * baseline_m), shifted(0.5 * baseline_m)]
}

/// Returns the true disparity of every pixel, `d = f B / Z`.
fn true_disparity(photograph: &Photograph, baseline_m: f64) -> Map {
    let scale = focal_px() * baseline_m;
    let depths = photograph.depth_m.as_raw().iter();
    Map(depths.map(|&z| (scale / f64::from(z)) as f32).collect())
}

/// Returns, for each pixel of the left photograph, whether it is hidden from the right camera.
fn hidden(left: &[f32], right: &[f32]) -> Vec<bool> {
    let width = SIZE.0 as usize;
    let is_hidden = |index: usize| {
        let (row, u) = (index / width, (index % width) as f32);
        let there = (u - left[index]).round();
        if there < 0.0 {
            return true;
        }
        // An occluding surface has a larger disparity.
        let before = right[row * width + (there as usize).min(width - 1)] - left[index];
        before > SAME_SURFACE_PX
    };
    (0..left.len()).map(is_hidden).collect()
}

/// Draws the outline of a window, with its pixels visible, and four ticks to make it easy to find.
pub(crate) fn draw_window(canvas: &mut Canvas, (x, y): Place, half: f64) {
    let stroke = Stroke::solid(Role::Grip, 2.0).cased();
    for (along, across) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let at = |distance: f64| (x + along * distance, y + across * distance);
        canvas.line(at(half + 2.0), at(half + 11.0), stroke);
    }
    canvas.stroke_rect(Rect::around((x, y), half), stroke);
}
