//! Multi-view stereo.

mod depth_map;
mod mesh;
mod texture;
mod view;

use crate::images::rgb;
use crate::io::give_cloud;
use crate::register::{classes, functions};
use crate::sfm::Reconstruction;
use crate::{options, progress};
use depth_map::DepthMap;
use epipole::image::RgbImage;
use epipole::mvs;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use view::MvsView;

/// Undistorts and downscales photos, and chooses neighbors and a depth range for each.
///
/// Photos without common points with another one at a sufficient angle are skipped.
///
/// Parameters
/// ----------
/// reconstruction : epipole.sfm.Reconstruction
/// photos : list of array_like
///     uint8 of shape (H, W, 3), one per image of the reconstruction, with its camera's size.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MvsOptions
///     Relevant here are ``max_size_px``, ``num_neighbors`` and ``min_angle_deg``.
///
/// Returns
/// -------
/// list of MvsView
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images with a camera, or no points.
/// epipole.DegenerateError
///     If no two photos show the same points from different positions.
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (reconstruction, photos, *, progress=None, **options))]
fn prepare_views(
    py: Python<'_>,
    reconstruction: &Reconstruction,
    photos: Vec<Bound<'_, PyAny>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<MvsView>> {
    let options = options::read(options)?;
    let read = |(place, photo): (usize, &Bound<'_, PyAny>)| rgb(&format!("photos[{place}]"), photo);
    let photos: Vec<RgbImage> = photos
        .iter()
        .enumerate()
        .map(read)
        .collect::<PyResult<_>>()?;
    let reconstruction = &reconstruction.0;
    let views = progress::run(py, progress, |monitor| {
        mvs::prepare_views(reconstruction, &photos, &options, monitor)
    })?;
    Ok(views.into_iter().map(MvsView).collect())
}

/// Estimates depth and normal of each pixel of each view by PatchMatch.
///
/// A depth is kept if enough views agree on it.
///
/// Parameters
/// ----------
/// views : list of MvsView
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MvsOptions
///
/// Returns
/// -------
/// list of DepthMap
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If a camera has distortion.
/// ValueError
///     If an option, neighbor or depth range is out of range.
#[pyfunction]
#[pyo3(signature = (views, /, *, progress=None, **options))]
fn estimate_depth_maps(
    py: Python<'_>,
    views: Vec<MvsView>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<DepthMap>> {
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let maps = progress::run_with(py, progress, options, |options, monitor| {
        mvs::estimate_depth_maps(&views, options, monitor)
    })?;
    Ok(maps.into_iter().map(DepthMap).collect())
}

/// Fuses depth maps to a point cloud with normals, colors and confidences.
///
/// Parameters
/// ----------
/// views : list of MvsView
/// maps : list of DepthMap
///     See `estimate_depth_maps`.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MvsOptions
///
/// Returns
/// -------
/// epipole.stereo.PointCloud
///
/// Raises
/// ------
/// ValueError
///     If an option is out of range.
#[pyfunction]
#[pyo3(signature = (views, maps, *, progress=None, **options))]
fn fuse_depth_maps<'py>(
    py: Python<'py>,
    views: Vec<MvsView>,
    maps: Vec<DepthMap>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let maps: Vec<mvs::DepthMap> = maps.into_iter().map(|map| map.0).collect();
    let cloud = progress::run_with(py, progress, options, |options, monitor| {
        mvs::fuse_depth_maps(&views, &maps, options, monitor)
    })?;
    give_cloud(py, &cloud)
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &mvs::MvsOptions::default())?;
    classes!(module: MvsView, DepthMap);
    functions!(module: prepare_views, estimate_depth_maps, fuse_depth_maps);
    crate::options::declare(module, &mvs::MeshOptions::default())?;
    classes!(module: mesh::Mesh);
    functions!(module: mesh::mesh_depth_maps);
    crate::options::declare(module, &mvs::TextureOptions::default())?;
    classes!(module: texture::MeshTexture);
    functions!(module: texture::texture_mesh);
    Ok(())
}
