//! Depth maps.

use crate::arrays::points3;
use crate::images::{disparity, from_gray, gray8};
use crate::record::plain_class;
use crate::sfm::wrapper::require_equal;
use epipole::mvs;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

/// Depth and normal of each pixel of a view.
///
/// Parameters
/// ----------
/// depth : array_like of float, shape (H, W)
///     Along the optical axis, in the unit of the reconstruction; NaN where unknown.
/// normals : array_like, shape (H, W, 3)
///     Unit normals in the camera's frame, towards the camera; zero where unknown.
/// num_views : array_like of uint8, shape (H, W)
///     Number of photos that agree on the depth, including this one; 0 where unknown.
///
/// Examples
/// --------
/// >>> normals = np.array([[[0, 0, -1.0], [0, 0, 0]]])
/// >>> DepthMap(np.array([[2.0, np.nan]]), normals, np.array([[3, 0]], np.uint8)).density
/// 0.5
#[pyclass(frozen, from_py_object, module = "epipole.mvs")]
#[derive(Clone)]
pub(super) struct DepthMap(pub(super) mvs::DepthMap);

plain_class!(DepthMap: depth, normals, num_views);

#[pymethods]
impl DepthMap {
    #[new]
    fn new(
        depth: &Bound<'_, PyAny>,
        normals: &Bound<'_, PyAny>,
        num_views: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let depth = disparity("depth", depth)?.into_image();
        let count = depth.as_raw().len();
        let numpy = normals.py().import("numpy")?;
        let rows = numpy.call_method1("reshape", (normals, (-1, 3)))?;
        let normals = points3("normals", &rows)?;
        let num_views = gray8("num_views", num_views)?.into_raw();
        require_equal(("depth", count), ("normals", normals.len()))?;
        require_equal(("depth", count), ("num_views", num_views.len()))?;
        Ok(Self(mvs::DepthMap {
            depth,
            normals: normals.iter().map(|normal| normal.coords.cast()).collect(),
            num_views,
        }))
    }

    /// Depth along the optical axis, float32 of shape (H, W); NaN where unknown.
    #[getter]
    fn depth<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        from_gray(py, self.0.depth.clone())
    }

    /// Unit normals in the camera's frame, float32 of shape (H, W, 3).
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let (width, height) = self.0.depth.dimensions();
        let values = self
            .0
            .normals
            .iter()
            .flat_map(|normal| [normal.x, normal.y, normal.z]);
        PyArray1::from_iter(py, values).reshape([height as usize, width as usize, 3])
    }

    /// Number of photos that agree on the depth, including this one, uint8 of shape (H, W).
    #[getter]
    fn num_views<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let (width, height) = self.0.depth.dimensions();
        PyArray1::from_slice(py, &self.0.num_views).reshape([height as usize, width as usize])
    }

    /// Fraction of pixels with a depth.
    #[getter]
    fn density(&self) -> f64 {
        self.0.density()
    }
}
