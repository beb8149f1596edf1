//! Multi-view stereo.

use crate::arrays::points3;
use crate::camera::PosedCamera;
use crate::images::{disparity, from_gray, from_rgb, gray8, rgb};
use crate::io::give_cloud;
use crate::record::plain_class;
use crate::sfm::Reconstruction;
use crate::sfm::wrapper::{require_equal, wrapper};
use crate::{options, progress};
use epipole::image::RgbImage;
use epipole::mvs;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Photo without distortion, its neighbors and its range of depths.
///
/// Parameters
/// ----------
/// photo : int
///     Index of its image in the reconstruction.
/// camera : PosedCamera
///     Without distortion, of the size of the image.
/// image : array_like of uint8, shape (H, W, 3)
///     Red, green, blue.
/// neighbors : list of int
///     Indices of the views that it is compared with, best first.
/// depth_range : tuple of float
///     Smallest and largest depth that is looked for.
#[pyclass(frozen, from_py_object, module = "epipole.mvs")]
#[derive(Clone)]
struct MvsView(mvs::MvsView);

wrapper!(MvsView: photo, camera, image, neighbors, depth_range);

#[pymethods]
impl MvsView {
    #[new]
    fn new(
        photo: usize,
        camera: &PosedCamera,
        image: &Bound<'_, PyAny>,
        neighbors: Vec<usize>,
        depth_range: (f64, f64),
    ) -> PyResult<Self> {
        Ok(Self(mvs::MvsView {
            photo,
            camera: camera.0,
            image: rgb("image", image)?,
            neighbors,
            depth_range: depth_range.into(),
        }))
    }

    /// Index of its image in the reconstruction.
    #[getter]
    fn photo(&self) -> usize {
        self.0.photo
    }

    /// Camera without distortion.
    #[getter]
    fn camera(&self) -> PosedCamera {
        self.0.camera.into()
    }

    /// Pixels without distortion, uint8 of shape (H, W, 3).
    #[getter]
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        from_rgb(py, self.0.image.clone())
    }

    /// Indices of the views that it is compared with, best first.
    #[getter]
    fn neighbors(&self) -> Vec<usize> {
        self.0.neighbors.clone()
    }

    /// Smallest and largest depth that is looked for.
    #[getter]
    fn depth_range(&self) -> (f64, f64) {
        self.0.depth_range.into()
    }
}

/// Depth and normal of each pixel of a view.
///
/// Parameters
/// ----------
/// depth : array_like of float, shape (H, W)
///     Along the optical axis, in the unit of the reconstruction; NaN where unknown.
/// normals : array_like, shape (H, W, 3)
///     Unit normals in the camera's frame, towards the camera; zero where unknown.
/// num_views : array_like of uint8, shape (H, W)
///     Number of photos that agree on the depth, this one among them; 0 where unknown.
///
/// Examples
/// --------
/// >>> normals = np.array([[[0, 0, -1.0], [0, 0, 0]]])
/// >>> DepthMap(np.array([[2.0, np.nan]]), normals, np.array([[3, 0]], np.uint8)).density
/// 0.5
#[pyclass(frozen, from_py_object, module = "epipole.mvs")]
#[derive(Clone)]
struct DepthMap(mvs::DepthMap);

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

    /// Number of photos that agree on the depth, uint8 of shape (H, W).
    #[getter]
    fn num_views<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let (width, height) = self.0.depth.dimensions();
        PyArray1::from_slice(py, &self.0.num_views).reshape([height as usize, width as usize])
    }

    /// Share of pixels with a depth.
    #[getter]
    fn density(&self) -> f64 {
        self.0.density()
    }
}

/// Undistorts and downscales photos, and chooses the neighbors and the depth range of each.
///
/// Photos that share no points with another under a sufficient angle are left out.
///
/// Parameters
/// ----------
/// reconstruction : epipole.sfm.Reconstruction
/// photos : list of array_like
///     uint8 of shape (H, W, 3), one for each image of the reconstruction, of its camera's size.
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : MvsOptions
///     ``max_size_px``, ``num_neighbors`` and ``min_angle_deg`` matter here.
///
/// Returns
/// -------
/// list of MvsView
///
/// Raises
/// ------
/// DegenerateError
///     If no two photos show the same points from different places.
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

/// Finds the depth and normal of each pixel of each view by PatchMatch.
///
/// A depth is kept if enough views agree on it.
///
/// Parameters
/// ----------
/// views : list of MvsView
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : MvsOptions
///
/// Returns
/// -------
/// list of DepthMap
#[pyfunction]
#[pyo3(signature = (views, /, *, progress=None, **options))]
fn estimate_depth_maps(
    py: Python<'_>,
    views: Vec<MvsView>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<DepthMap>> {
    let options = options::read(options)?;
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let maps = progress::run(py, progress, |monitor| {
        mvs::estimate_depth_maps(&views, &options, monitor)
    })?;
    Ok(maps.into_iter().map(DepthMap).collect())
}

/// Joins depth maps to one cloud with normals, colors and confidences.
///
/// Parameters
/// ----------
/// views : list of MvsView
/// maps : list of DepthMap
///     Those of `estimate_depth_maps`.
/// progress : callable, optional
///     Called with the stage and the completed share.
/// **options : MvsOptions
///
/// Returns
/// -------
/// epipole.stereo.PointCloud
#[pyfunction]
#[pyo3(signature = (views, maps, *, progress=None, **options))]
fn fuse_depth_maps<'py>(
    py: Python<'py>,
    views: Vec<MvsView>,
    maps: Vec<DepthMap>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let options = options::read(options)?;
    let views: Vec<mvs::MvsView> = views.into_iter().map(|view| view.0).collect();
    let maps: Vec<mvs::DepthMap> = maps.into_iter().map(|map| map.0).collect();
    let cloud = progress::run(py, progress, |monitor| {
        mvs::fuse_depth_maps(&views, &maps, &options, monitor)
    })?;
    give_cloud(py, &cloud)
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &mvs::MvsOptions::default())?;
    module.add_class::<MvsView>()?;
    module.add_class::<DepthMap>()?;
    module.add_function(wrap_pyfunction!(prepare_views, module)?)?;
    module.add_function(wrap_pyfunction!(estimate_depth_maps, module)?)?;
    module.add_function(wrap_pyfunction!(fuse_depth_maps, module)?)
}
