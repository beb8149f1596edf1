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
        matcher::StereoBm, matcher::StereoSgm, depth::DepthInterval, depth::PointCloud,
        pixel_map::PixelMap, rectify::PixelRect, rectify::Rectification, pair::RectifiedPair,
        uncalibrated::UncalibratedRectification
    );
    functions!(module:
        rectify::rectify_calibrated, rectify::q_from_rig, uncalibrated::rectify_uncalibrated,
        disparity::remove_speckles, disparity::fill_gaps, depth::depth_from_disparity,
        depth::depth_interval, depth::depth_image, depth::point_cloud
    );
    Ok(())
}
