//! Alignment of the reconstruction with known camera positions.

use super::Builder;
use crate::sfm::alignment::{AlignmentKind, align_points};
use crate::sfm::loop_closure::estimate_similarity_of_points;
use crate::sfm::reconstruction::moved_pose;

/// Number of standard deviations beyond which a known position counts as wrong.
const WRONG_SIGMAS: f64 = 4.0;

impl Builder {
    /// Aligns cameras and points with the known positions, if at least three are not on one line.
    /// Some may be wrong.
    pub(in crate::sfm) fn place_in_world(&mut self) -> bool {
        if self.rig.is_some() {
            return false;
        }
        let (mut found, mut known, mut sigma) = (Vec::new(), Vec::new(), 0.0f64);
        for (image, camera) in self.images.iter().zip(&self.cameras) {
            if let (Some(position), Some(camera)) = (&image.position, camera) {
                found.push(camera.center_in_world());
                known.push(position.center_in_world);
                sigma = sigma.max(position.sigma.norm());
            }
        }
        // Falls back to all positions if no four agree.
        let to_from_world =
            estimate_similarity_of_points(&found, &known, WRONG_SIGMAS * sigma, self.options.seed)
                .map(|(to_from_world, _)| to_from_world)
                .or_else(|_| align_points(&found, &known, AlignmentKind::Similarity));
        let Ok(to_from_world) = to_from_world else {
            return false;
        };
        for camera in self.cameras.iter_mut().flatten() {
            camera.cam_from_world = moved_pose(&camera.cam_from_world, &to_from_world);
        }
        for point in self.points.iter_mut().flatten() {
            point.position = to_from_world * point.position;
        }
        self.is_placed = true;
        true
    }
}
