//! Rectification, dense disparity, depth and point clouds of two views.

mod depth;
mod disparity;
mod matcher;
mod pair;
mod pixel_map;
mod rectify;
mod uncalibrated;

pub(crate) use depth::PointCloud;

use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::stereo::RectifyOptions::default())?;
    crate::options::declare(module, &epipole::stereo::StereoBm::default())?;
    crate::options::declare(module, &epipole::stereo::StereoSgm::default())?;
    module.add_class::<matcher::StereoBm>()?;
    module.add_class::<matcher::StereoSgm>()?;
    module.add_class::<depth::DepthInterval>()?;
    module.add_class::<depth::PointCloud>()?;
    module.add_class::<pixel_map::PixelMap>()?;
    module.add_class::<rectify::PixelRect>()?;
    module.add_class::<rectify::Rectification>()?;
    module.add_class::<pair::RectifiedPair>()?;
    module.add_class::<uncalibrated::UncalibratedRectification>()?;
    module.add_function(wrap_pyfunction!(rectify::rectify_calibrated, module)?)?;
    module.add_function(wrap_pyfunction!(rectify::q_from_rig, module)?)?;
    module.add_function(wrap_pyfunction!(
        uncalibrated::rectify_uncalibrated,
        module
    )?)?;
    module.add_function(wrap_pyfunction!(disparity::remove_speckles, module)?)?;
    module.add_function(wrap_pyfunction!(disparity::fill_gaps, module)?)?;
    module.add_function(wrap_pyfunction!(depth::depth_from_disparity, module)?)?;
    module.add_function(wrap_pyfunction!(depth::depth_interval, module)?)?;
    module.add_function(wrap_pyfunction!(depth::depth_image, module)?)?;
    module.add_function(wrap_pyfunction!(depth::point_cloud, module)?)
}
