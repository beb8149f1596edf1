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

use crate::register::{classes, functions};
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
    classes!(module:
        similarity::{Similarity3},
        alignment::{ErrorStatistics, RelativePoseError},
        bundle::{Sensor, Bundle},
        bal::{BalProblem},
        images::{PositionPrior, SfmImage, PairMatches, SfmInput},
        photos::{Photo},
        photo_features::{PhotoFeatures},
        reconstruction::{Reconstruction, Localization},
        incremental::{SfmStep, SfmResult, IncrementalReconstruction, WhyUnregistered},
        odometry::{OdometryResult, Odometry},
        pose_graph::{PoseGraph, PoseGraphReport},
        loops::{LoopClosure, ClosedPath},
        tracks::{VerifiedPair},
        two_view::{TwoViewReconstruction}
    );
    functions!(module:
        alignment::{align_points, absolute_trajectory_error, relative_pose_error},
        bundle::{adjust_bundle},
        bal::{adjust_bal},
        incremental::{reconstruct, why_unregistered},
        known_poses::{triangulate_tracks},
        photos::{photo_features, match_features, match_photos, match_rectified, reconstruct_photos},
        odometry::{monocular_odometry, stereo_odometry},
        loops::{close_loops, estimate_similarity_of_points, average_rotations},
        tracks::{build_tracks, verify_matches},
        two_view::{two_view_reconstruction}
    );
    Ok(())
}
