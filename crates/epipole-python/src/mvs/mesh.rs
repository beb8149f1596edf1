//! Meshes from depth maps.

use super::depth_map::DepthMap;
use super::view::MvsView;
use crate::io::give_cloud;
use crate::progress;
use crate::record::plain_class;
use crate::stereo::PointCloud;
use epipole::mvs;
use numpy::PyArray2;
use numpy::prelude::*;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Triangle mesh.
///
/// Parameters
/// ----------
/// vertices : epipole.stereo.PointCloud
///     Points with normals and colors.
/// triangles : ndarray of uint32, shape (M, 3)
///     Indices of the vertices, counterclockwise when viewed from outside.
#[pyclass(frozen, get_all, module = "epipole.mvs")]
pub(super) struct Mesh {
    /// Vertices.
    vertices: Py<PointCloud>,
    /// Indices of the vertices, uint32 of shape (M, 3), counterclockwise when viewed from outside.
    triangles: Py<PyArray2<u32>>,
}

plain_class!(Mesh: vertices, triangles);

#[pymethods]
impl Mesh {
    #[new]
    fn new(vertices: Py<PointCloud>, triangles: Py<PyArray2<u32>>) -> Self {
        Self {
            vertices,
            triangles,
        }
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.triangles.bind(py).shape()[0]
    }
}

/// Fuses depth maps to a mesh with normals and colors.
///
/// The surface has holes where no photo shows it.
///
/// Parameters
/// ----------
/// views : list of MvsView
/// maps : list of DepthMap
///     See `estimate_depth_maps`.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MeshOptions
///
/// Returns
/// -------
/// Mesh
///
/// Raises
/// ------
/// epipole.TooFewError
///     If no pixel has a depth.
/// ValueError
///     If the voxels are too small for the scene.
#[pyfunction]
#[pyo3(signature = (views, maps, *, progress=None, **options))]
pub(super) fn mesh_depth_maps<'py>(
    py: Python<'py>,
    views: Vec<MvsView>,
    maps: Vec<DepthMap>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Mesh> {
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let maps: Vec<mvs::DepthMap> = maps.into_iter().map(|map| map.0).collect();
    let mesh = progress::run_with(py, progress, options, |options, monitor| {
        mvs::mesh_depth_maps(&views, &maps, options, monitor)
    })?;
    let triangles: Vec<Vec<u32>> = mesh.triangles.iter().map(|row| row.to_vec()).collect();
    let triangles = match triangles.is_empty() {
        true => PyArray2::zeros(py, [0, 3], false),
        false => PyArray2::from_vec2(py, &triangles)?,
    };
    let vertices = give_cloud(py, &mesh.vertices)?;
    Ok(Mesh {
        vertices: vertices.cast_into::<PointCloud>()?.unbind(),
        triangles: triangles.unbind(),
    })
}
