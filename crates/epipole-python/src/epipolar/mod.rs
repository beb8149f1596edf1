//! Epipolar geometry.

mod estimate;
mod geometry;
mod relative_pose;
mod solvers;

use crate::register::{classes, functions};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module:
        relative_pose::{RelativePose, PoseWithFocal, EssentialWithFocal, SelectedPose},
        solvers::{EightPoint}
    );
    functions!(module:
        estimate::{
            estimate_fundamental, estimate_essential, estimate_relative_pose,
            estimate_relative_pose_with_gravity, estimate_relative_pose_and_focal
        },
        solvers::{
            fundamental_7point, fundamental_8point, fundamental_8point_explained,
            fundamental_8point_unnormalized, essential_5point, essential_8point, essential_6point,
            relative_pose_3point, refine_fundamental, refine_relative_pose
        },
        geometry::{
            sampson_px, tangent_sampson_px, symmetric_epipolar_px, epipolar_row, epipolar_line1,
            epipolar_line2, epipoles, enforce_rank2, project_to_essential, decompose_essential,
            select_pose, essential_from_motion, fundamental_from_cameras,
            fundamental_from_essential, essential_from_fundamental, focal_lengths_from_fundamental
        }
    );
    Ok(())
}
