//! The job of `track`: renders the frames, detects corners in the first, and tracks them.

use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use crate::kit::scenes::still_life;
use crate::kit::sequence::{self, NUM_FRAMES, SIZE};
use epipole::feature::{
    GoodFeaturesOptions, TrackOptions, good_features_to_track, track_lucas_kanade,
};
use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
use epipole_scenes::Transfer;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Maximum number of corners, and their minimum distance, pixels.
const NUM_CORNERS: usize = 60;
const APART_PX: f64 = 10.0;
/// Maximum stride over frames.
pub(super) const MAX_STRIDE: usize = 8;

/// Frames used, and settings for tracking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    /// Stride over the frames.
    pub(super) stride: usize,
    pub(super) num_levels: usize,
    /// Half of a window's side without its center, pixels.
    pub(super) half: usize,
    /// Whether points are tracked back, and dropped if they end elsewhere.
    pub(super) is_checked: bool,
}

/// A point in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Sighting {
    /// Column and row found.
    pub(super) place: (f64, f64),
    /// Distance from the true position, pixels; `None` if the object is hidden or outside of the
    /// picture.
    pub(super) error_px: Option<f64>,
}

/// Frames used, and each point in all frames until it was lost.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) frames: Vec<Picture>,
    pub(super) tracks: Vec<Vec<Sighting>>,
}

impl Question {
    /// Returns the number of frames used.
    pub(super) fn num_frames(&self) -> usize {
        (NUM_FRAMES - 1) / self.stride.clamp(1, MAX_STRIDE) + 1
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Following corners through the frames";
    const FAILED: &'static str = "Nothing was followed";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let frames = sequence::frames(&mut |share| progress(0.7 * share))?;
        let stride = self.stride.clamp(1, MAX_STRIDE);
        let used: Vec<usize> = (0..NUM_FRAMES).step_by(stride).collect();
        let gray: Vec<_> = (used.iter())
            .map(|frame| rgb_to_gray_f32(&frames[*frame], &BT601_WEIGHTS))
            .collect();
        let corners = GoodFeaturesOptions::default()
            .with_max_corners(NUM_CORNERS)
            .with_min_distance_px(APART_PX);
        let corners = good_features_to_track(&gray[0], &corners, &mut ())?;
        let start: Vec<_> = corners.iter().map(|corner| corner.point()).collect();
        let options = TrackOptions::default()
            .with_half_window(self.half)
            .with_num_levels(self.num_levels)
            .with_max_forward_backward_px(self.is_checked.then_some(1.0));
        let mut tracks: Vec<Vec<Sighting>> = (start.iter())
            .map(|corner| vec![sighting(corner, Some(*corner))])
            .collect();
        let mut alive: Vec<(usize, Point2<f64>)> = start.iter().copied().enumerate().collect();
        for index in 1..used.len() {
            tell(progress, 0.7 + 0.3 * index as f64 / used.len() as f64)?;
            let places: Vec<_> = alive.iter().map(|(_, place)| *place).collect();
            let found =
                track_lucas_kanade(&gray[index - 1], &gray[index], &places, &options, &mut ())?;
            alive = (alive.iter().zip(found))
                .filter_map(|((corner, _), found)| Some((*corner, found?.point)))
                .collect();
            for (corner, place) in &alive {
                tracks[*corner].push(sighting(place, truth(&start[*corner], used[index])));
            }
        }
        let frames = used.iter().map(|frame| frames[*frame].clone().into());
        Ok(Answer {
            frames: frames.collect(),
            tracks,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let is_finite = |sighting: &Sighting| {
            let (u, v) = sighting.place;
            [u, v, sighting.error_px.unwrap_or(0.0)]
                .iter()
                .all(|number| number.is_finite())
        };
        let mut tracks = answer.tracks.iter();
        answer.frames.len() == self.num_frames()
            && answer.frames.iter().all(|frame| frame.size() == SIZE)
            && tracks.all(|track| {
                !track.is_empty()
                    && track.len() <= answer.frames.len()
                    && track.iter().all(is_finite)
            })
    }
}

fn sighting(place: &Point2<f64>, truth: Option<Point2<f64>>) -> Sighting {
    Sighting {
        place: (place.x, place.y),
        error_px: truth.map(|truth| (place - truth).norm()),
    }
}

/// Returns the true position in a frame of the surface point at a pixel of the first frame; `None`
/// if it is hidden or outside of the picture.
fn truth(start: &Point2<f64>, frame: usize) -> Option<Point2<f64>> {
    let cameras = [0, frame].map(sequence::camera);
    let Transfer::Visible { pixel2, .. } = still_life().transfer(&cameras[0], &cameras[1], start)
    else {
        return None;
    };
    let is_inside = |at: f64, size: u32| (-0.5..f64::from(size) - 0.5).contains(&at);
    (is_inside(pixel2.x, SIZE.0) && is_inside(pixel2.y, SIZE.1)).then_some(pixel2)
}
