//! Corners tracked from frame to frame, and replaced when lost.

use crate::contract::Progress;
use crate::kit::question::tell;
use epipole::Error;
use epipole::feature::{
    GoodFeaturesOptions, Match, TrackOptions, good_features_to_track, track_lucas_kanade,
};
use epipole::imaging::GrayImage32;
use epipole::sfm::PairMatches;
use nalgebra::Point2;
use std::collections::HashMap;

/// Minimum distance between corners, pixels.
const APART_PX: f64 = 7.0;
/// Half of a window's side without its center, pixels.
const HALF_WINDOW: usize = 5;
/// Maximum distance from the start after tracking back, pixels.
const MAX_BACK_PX: f64 = 0.3;
/// Number of earlier frames matched with each frame.
const NUM_NEIGHBORS: usize = 4;

/// Corners of all frames.
pub(super) struct Corners {
    /// Positions in each frame, pixels.
    pub(super) places: Vec<Vec<Point2<f64>>>,
    /// Track number of each corner.
    tracks: Vec<Vec<usize>>,
    num_tracks: usize,
}

impl Corners {
    /// Tracks corners through the frames.
    ///
    /// * `most`: maximum number of corners per frame
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
    pub(super) fn follow(
        frames: &[GrayImage32],
        most: usize,
        progress: Progress<'_>,
    ) -> Result<Self, Error> {
        let mut corners = Self {
            places: Vec::new(),
            tracks: Vec::new(),
            num_tracks: 0,
        };
        for (index, frame) in frames.iter().enumerate() {
            tell(progress, index as f64 / frames.len() as f64)?;
            let (mut places, mut tracks) = (Vec::new(), Vec::new());
            if let (Some(before), Some(known)) = (corners.places.last(), corners.tracks.last()) {
                let found = follow(&frames[index - 1], frame, before)?;
                for (track, place) in known.iter().zip(found) {
                    if let Some(place) = place {
                        places.push(place);
                        tracks.push(*track);
                    }
                }
            }
            for corner in strongest(frame, most)? {
                let is_new = places
                    .iter()
                    .all(|place| (place - corner).norm() >= APART_PX);
                if is_new && places.len() < most {
                    places.push(corner);
                    tracks.push(corners.num_tracks);
                    corners.num_tracks += 1;
                }
            }
            corners.places.push(places);
            corners.tracks.push(tracks);
        }
        Ok(corners)
    }

    /// Returns the matches of each frame with the frames just before it.
    pub(super) fn pairs(&self) -> Vec<PairMatches> {
        let mut pairs = Vec::new();
        for image2 in 1..self.tracks.len() {
            for image1 in image2.saturating_sub(NUM_NEIGHBORS)..image2 {
                let of_track: HashMap<usize, usize> = (self.tracks[image1].iter().copied())
                    .enumerate()
                    .map(|(index, track)| (track, index))
                    .collect();
                let matches = (self.tracks[image2].iter().enumerate())
                    .filter_map(|(index2, track)| Some(matched(*of_track.get(track)?, index2)));
                pairs.push(PairMatches {
                    image1,
                    image2,
                    matches: matches.collect(),
                });
            }
        }
        pairs
    }
}

fn matched(index1: usize, index2: usize) -> Match {
    Match {
        index1,
        index2,
        distance: 0.0,
        ratio: 0.0,
    }
}

fn follow(
    from: &GrayImage32,
    to: &GrayImage32,
    places: &[Point2<f64>],
) -> Result<Vec<Option<Point2<f64>>>, Error> {
    let options = TrackOptions::default()
        .with_half_window(HALF_WINDOW)
        .with_max_forward_backward_px(Some(MAX_BACK_PX));
    let found = track_lucas_kanade(from, to, places, &options, &mut ())?;
    Ok(found
        .iter()
        .map(|track| track.map(|track| track.point))
        .collect())
}

fn strongest(frame: &GrayImage32, most: usize) -> Result<Vec<Point2<f64>>, Error> {
    let options = GoodFeaturesOptions::default()
        .with_max_corners(most)
        .with_min_distance_px(APART_PX);
    let corners = good_features_to_track(frame, &options, &mut ())?;
    Ok(corners.iter().map(|corner| corner.point()).collect())
}
