//! Epipolar geometry.

mod estimate;
mod geometry;
mod relative_pose;
mod solvers;

pub(crate) use relative_pose::RelativePose;

use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<RelativePose>()?;
    module.add_class::<relative_pose::PoseWithFocal>()?;
    module.add_class::<relative_pose::EssentialWithFocal>()?;
    module.add_class::<relative_pose::SelectedPose>()?;
    module.add_class::<solvers::EightPoint>()?;
    module.add_function(wrap_pyfunction!(estimate::estimate_fundamental, module)?)?;
    module.add_function(wrap_pyfunction!(estimate::estimate_essential, module)?)?;
    module.add_function(wrap_pyfunction!(estimate::estimate_relative_pose, module)?)?;
    module.add_function(wrap_pyfunction!(
        estimate::estimate_relative_pose_with_gravity,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(
        estimate::estimate_relative_pose_and_focal,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(solvers::fundamental_7point, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::fundamental_8point, module)?)?;
    module.add_function(wrap_pyfunction!(
        solvers::fundamental_8point_explained,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(
        solvers::fundamental_8point_unnormalized,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(solvers::essential_5point, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::essential_8point, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::essential_6point, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::relative_pose_3point, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::refine_fundamental, module)?)?;
    module.add_function(wrap_pyfunction!(solvers::refine_relative_pose, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::sampson_px, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::tangent_sampson_px, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::symmetric_epipolar_px, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::epipolar_row, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::epipolar_line1, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::epipolar_line2, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::epipoles, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::enforce_rank2, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::project_to_essential, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::decompose_essential, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::select_pose, module)?)?;
    module.add_function(wrap_pyfunction!(geometry::essential_from_motion, module)?)?;
    module.add_function(wrap_pyfunction!(
        geometry::fundamental_from_cameras,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(
        geometry::fundamental_from_essential,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(
        geometry::essential_from_fundamental,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(
        geometry::focal_lengths_from_fundamental,
        module
    )?)?;
    Ok(())
}
