//! Structure from motion.

mod alignment;
mod bal;
mod bundle;
mod images;
mod incremental;
mod known_poses;
mod loops;
mod odometry;
mod photo_features;
mod photos;
mod pose_graph;
mod pose_rows;
mod reconstruction;
mod similarity;
mod tracks;
mod two_view;
pub(crate) mod wrapper;

pub(crate) use bal::BalProblem;
pub(crate) use images::SfmImage;
pub(crate) use pose_graph::PoseGraph;
pub(crate) use reconstruction::Reconstruction;

use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::sfm::BundleOptions::default())?;
    crate::options::declare(module, &epipole::sfm::LocalizeOptions::default())?;
    crate::options::declare(module, &epipole::sfm::OdometryOptions::default())?;
    crate::options::declare(module, &epipole::sfm::PhotoOptions::default())?;
    crate::options::declare(module, &epipole::sfm::SfmOptions::default())?;
    crate::options::declare(
        module,
        &epipole::sfm::TwoViewReconstructionOptions::default(),
    )?;
    module.add_class::<similarity::Similarity3>()?;
    module.add_class::<alignment::ErrorStatistics>()?;
    module.add_class::<alignment::RelativePoseError>()?;
    module.add_class::<bundle::Sensor>()?;
    module.add_class::<bundle::Bundle>()?;
    module.add_class::<BalProblem>()?;
    module.add_class::<images::PositionPrior>()?;
    module.add_class::<SfmImage>()?;
    module.add_class::<images::PairMatches>()?;
    module.add_class::<images::SfmInput>()?;
    module.add_class::<photos::Photo>()?;
    module.add_class::<photo_features::PhotoFeatures>()?;
    module.add_class::<Reconstruction>()?;
    module.add_class::<reconstruction::Localization>()?;
    module.add_class::<incremental::SfmStep>()?;
    module.add_class::<incremental::SfmResult>()?;
    module.add_class::<incremental::IncrementalReconstruction>()?;
    module.add_class::<incremental::WhyUnregistered>()?;
    module.add_class::<odometry::OdometryResult>()?;
    module.add_class::<odometry::Odometry>()?;
    module.add_class::<PoseGraph>()?;
    module.add_class::<pose_graph::PoseGraphReport>()?;
    module.add_class::<loops::LoopClosure>()?;
    module.add_class::<loops::ClosedPath>()?;
    module.add_class::<tracks::VerifiedPair>()?;
    module.add_class::<two_view::TwoViewReconstruction>()?;
    module.add_function(wrap_pyfunction!(alignment::align_points, module)?)?;
    module.add_function(wrap_pyfunction!(
        alignment::absolute_trajectory_error,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(alignment::relative_pose_error, module)?)?;
    module.add_function(wrap_pyfunction!(bundle::adjust_bundle, module)?)?;
    module.add_function(wrap_pyfunction!(bal::adjust_bal, module)?)?;
    module.add_function(wrap_pyfunction!(incremental::reconstruct, module)?)?;
    module.add_function(wrap_pyfunction!(incremental::why_unregistered, module)?)?;
    module.add_function(wrap_pyfunction!(known_poses::triangulate_tracks, module)?)?;
    module.add_function(wrap_pyfunction!(photos::photo_features, module)?)?;
    module.add_function(wrap_pyfunction!(photos::match_features, module)?)?;
    module.add_function(wrap_pyfunction!(photos::match_photos, module)?)?;
    module.add_function(wrap_pyfunction!(photos::match_rectified, module)?)?;
    module.add_function(wrap_pyfunction!(photos::reconstruct_photos, module)?)?;
    module.add_function(wrap_pyfunction!(odometry::monocular_odometry, module)?)?;
    module.add_function(wrap_pyfunction!(odometry::stereo_odometry, module)?)?;
    module.add_function(wrap_pyfunction!(loops::close_loops, module)?)?;
    module.add_function(wrap_pyfunction!(
        loops::estimate_similarity_of_points,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(loops::average_rotations, module)?)?;
    module.add_function(wrap_pyfunction!(tracks::build_tracks, module)?)?;
    module.add_function(wrap_pyfunction!(tracks::verify_matches, module)?)?;
    module.add_function(wrap_pyfunction!(two_view::two_view_reconstruction, module)?)
}
