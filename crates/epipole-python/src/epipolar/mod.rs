//! Epipolar geometry.

mod estimate;
mod geometry;
mod relative_pose;
mod solvers;

pub(crate) use relative_pose::RelativePose;

use crate::register::{classes, functions};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module:
        RelativePose, relative_pose::PoseWithFocal, relative_pose::EssentialWithFocal,
        relative_pose::SelectedPose, solvers::EightPoint
    );
    functions!(module:
        estimate::estimate_fundamental, estimate::estimate_essential,
        estimate::estimate_relative_pose, estimate::estimate_relative_pose_with_gravity,
        estimate::estimate_relative_pose_and_focal, solvers::fundamental_7point,
        solvers::fundamental_8point, solvers::fundamental_8point_explained,
        solvers::fundamental_8point_unnormalized, solvers::essential_5point,
        solvers::essential_8point, solvers::essential_6point, solvers::relative_pose_3point,
        solvers::refine_fundamental, solvers::refine_relative_pose, geometry::sampson_px,
        geometry::tangent_sampson_px, geometry::symmetric_epipolar_px, geometry::epipolar_row,
        geometry::epipolar_line1, geometry::epipolar_line2, geometry::epipoles,
        geometry::enforce_rank2, geometry::project_to_essential, geometry::decompose_essential,
        geometry::select_pose, geometry::essential_from_motion, geometry::fundamental_from_cameras,
        geometry::fundamental_from_essential, geometry::essential_from_fundamental,
        geometry::focal_lengths_from_fundamental
    );
    Ok(())
}
