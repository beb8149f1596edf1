//! Textures of meshes.

use super::view::MvsView;
use crate::images::from_rgb;
use crate::io::take_mesh;
use crate::record::record;
use crate::{options, progress};
use epipole::mvs;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Texture of a mesh: an image, with a pixel position for each corner of each triangle.
    "epipole.mvs" MeshTexture {
        /// Red, green and blue, uint8 of shape (H, W, 3).
        image: Py<PyArray3<u8>>,
        /// Pixel of each corner of each triangle, centers at integers, float32 of shape (M, 3, 2).
        corners: Py<PyArray3<f32>>,
    }
}

/// Textures a mesh with the photos.
///
/// Each triangle is textured from the photo that shows it at the largest size, with few seams;
/// colors are adjusted to agree along seams.
///
/// Parameters
/// ----------
/// mesh : Mesh
/// views : list of MvsView
///     See `prepare_views`.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : TextureOptions
///
/// Returns
/// -------
/// MeshTexture
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no views or no triangles.
/// ValueError
///     If an option is out of range, or a triangle refers to a missing vertex.
#[pyfunction]
#[pyo3(signature = (mesh, views, *, progress=None, **options))]
pub(super) fn texture_mesh(
    py: Python<'_>,
    mesh: &Bound<'_, PyAny>,
    views: Vec<MvsView>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<MeshTexture> {
    let options = options::read(options)?;
    let mesh = take_mesh(mesh)?;
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let texture = progress::run(py, progress, |monitor| {
        mvs::texture_mesh(&mesh, &views, &options, monitor)
    })?;
    let corners = texture.corners.as_flattened().iter();
    let flat: Vec<f32> = corners.flat_map(|pixel| [pixel.x, pixel.y]).collect();
    let corners = PyArray1::from_vec(py, flat).reshape([texture.corners.len(), 3, 2])?;
    Ok(MeshTexture {
        image: from_rgb(py, texture.image)?.unbind(),
        corners: corners.unbind(),
    })
}
