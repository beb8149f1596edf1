//! Rectification, dense disparity, depth and point clouds of two views.

mod depth;
mod disparity;
mod matcher;
mod pair;
mod pixel_map;
mod rectify;
mod uncalibrated;

pub(crate) use depth::PointCloud;

use crate::register::{classes, functions};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::stereo::RectifyOptions::default())?;
    crate::options::declare(module, &epipole::stereo::StereoBm::default())?;
    crate::options::declare(module, &epipole::stereo::StereoSgm::default())?;
    classes!(module:
        matcher::{StereoBm, StereoSgm},
        depth::{DepthInterval, PointCloud},
        pixel_map::{PixelMap},
        rectify::{PixelRect, Rectification},
        pair::{RectifiedPair},
        uncalibrated::{UncalibratedRectification}
    );
    functions!(module:
        rectify::{rectify_calibrated, q_from_rig},
        uncalibrated::{rectify_uncalibrated},
        disparity::{remove_speckles, fill_gaps},
        depth::{depth_from_disparity, depth_interval, depth_image, point_cloud}
    );
    Ok(())
}
