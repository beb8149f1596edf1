//! Features: corners, scale-invariant keypoints, their descriptors, matching and tracking.

mod corners;
mod descriptors;
mod detect;
mod keypoints;
mod matching;
mod scale_space;
mod tensor;
mod track;
mod window;

pub(crate) use descriptors::{descriptors, give_descriptors};
pub(crate) use keypoints::{Keypoints, keypoints};

use crate::register::{classes, functions};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::feature::StructureTensorOptions::default())?;
    crate::options::declare(module, &epipole::feature::SiftOptions::default())?;
    crate::options::declare(module, &epipole::feature::FeatureOptions::default())?;
    crate::options::declare(module, &epipole::feature::OrbOptions::default())?;
    crate::options::declare(module, &epipole::feature::GoodFeaturesOptions::default())?;
    crate::options::declare(module, &epipole::feature::RefineOptions::default())?;
    crate::options::declare(module, &epipole::feature::MatchOptions::default())?;
    crate::options::declare(module, &epipole::feature::TrackOptions::default())?;
    classes!(module:
        keypoints::{Keypoints},
        descriptors::{Features},
        matching::{Matches, Neighbors},
        scale_space::{ScaleOctave, ScaleSpace},
        tensor::{StructureTensor},
        window::{ShiftSurface, WindowTensor},
        track::{Tracks}
    );
    functions!(module:
        detect::{
            photo_to_gray, detect_features, detect_sift, detect_orb, describe_sift, sift_directions,
            describe_patches
        },
        scale_space::{scale_space},
        corners::{
            harris_response, min_eigenvalue_response, good_features_to_track,
            non_maximum_suppression, refine_corners
        },
        tensor::{structure_tensor},
        window::{shift_surface},
        matching::{match_descriptors, nearest_two, nearest_few},
        track::{track_lucas_kanade}
    );
    Ok(())
}
