//! Points of a growing reconstruction: triangulation, completion and filtering.

use super::{Builder, TrackPoint, insert};
use crate::sfm::tracks::TrackElement;
use crate::sfm::triangulate_track::{triangulate_track, widest_angle_rad};

impl Builder {
    /// Triangulates all tracks without a point.
    pub(in crate::sfm) fn triangulate(&mut self) {
        self.triangulate_of(None);
    }

    /// Triangulates tracks without a point, all or those of one image.
    pub(in crate::sfm) fn triangulate_of(&mut self, image: Option<usize>) {
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
        crate::math::parallel::for_each(&mut found, |n, found| {
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
                elements: elements
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

    /// Returns whether the rays of two keypoints meet in front of their cameras, at any angle.
    pub(in crate::sfm) fn meet(&self, first: TrackElement, second: TrackElement) -> bool {
        let (Some(first), Some(second)) = (self.sight(first), self.sight(second)) else {
            return false;
        };
        let max_error_px = self.options.max_reprojection_error_px;
        triangulate_track(&[first, second], max_error_px, 0.0).is_some()
    }

    /// Adds observations that fit their point after all.
    pub(in crate::sfm) fn complete(&mut self) {
        let max_error_sq = {
            let max_error_px = self.options.max_reprojection_error_px;
            max_error_px * max_error_px
        };
        for track in 0..self.tracks.len() {
            let Some(mut point) = self.points[track].take() else {
                continue;
            };
            for element in &self.tracks[track] {
                if !point.elements.contains(element)
                    && let Some(sight) = self.sight(*element)
                    && sight.error_sq(&point.position) <= max_error_sq
                {
                    insert(&mut point.elements, *element);
                }
            }
            self.points[track] = Some(point);
        }
    }

    /// Drops points with fewer observations than the options require.
    pub(in crate::sfm) fn drop_short_tracks(&mut self) {
        for slot in &mut self.points {
            if (slot.as_ref())
                .is_some_and(|point| point.elements.len() < self.options.min_track_length)
            {
                *slot = None;
            }
        }
    }

    /// Drops observations with large errors, points with small triangulation angles, and cameras
    /// that see too few points.
    pub(in crate::sfm) fn filter(&mut self) {
        let max_error_px = self.options.max_reprojection_error_px;
        let min_angle_rad = self.options.min_angle_deg.to_radians();
        loop {
            let mut points = std::mem::take(&mut self.points);
            let this = &*self;
            crate::math::parallel::for_each(&mut points, |_, slot| {
                let Some(point) = slot else { return };
                let position = point.position;
                point.elements.retain(|element| {
                    this.sight(*element).is_some_and(|sight| {
                        sight.error_sq(&position) <= max_error_px * max_error_px
                    })
                });
                let centers = point
                    .elements
                    .iter()
                    .filter_map(|element| this.cameras[element.image as usize])
                    .map(|camera| camera.center_in_world());
                if point.elements.len() < 2 || widest_angle_rad(&position, centers) < min_angle_rad
                {
                    *slot = None;
                }
            });
            self.points = points;
            let mut counts = vec![0; self.cameras.len()];
            for element in self
                .points
                .iter()
                .flatten()
                .flat_map(|point| &point.elements)
            {
                counts[self.frame_of(element.image as usize).0] += 1;
            }
            let mut dropped = false;
            for (image, count) in counts.into_iter().enumerate() {
                if self.cameras[image].is_some() && self.frame_of(image).1 == 0 && count < 6 {
                    self.place(image, None);
                    dropped = true;
                }
            }
            if !dropped {
                break;
            }
        }
    }
}
