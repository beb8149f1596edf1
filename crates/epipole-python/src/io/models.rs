//! Files of models: cameras, posed images and points.

use super::clouds::give_cloud;
use super::rig::Rig;
use super::source::{Source, format_of, or_raise, os_error, path};
use crate::arrays::{from_points, from_rows, from_vector, points2, points3};
use crate::camera::{Camera, RigidTransform};
use crate::progress;
use crate::record::record;
use crate::register::{classes, functions};
use crate::sfm::wrapper::{
    colors, give_colors, give_index_rows, index_rows, require_equal, wrapper,
};
use crate::sfm::{Reconstruction, SfmImage};
use epipole_io::model::{self, ModelFormat, ModelPoint};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;
use std::path::Path;

/// Formats by their Python names.
const FORMATS: [ModelFormat; 8] = [
    ModelFormat::ColmapText,
    ModelFormat::ColmapBinary,
    ModelFormat::Bundler,
    ModelFormat::Transforms,
    ModelFormat::OpenMvg,
    ModelFormat::Ply,
    ModelFormat::Glb,
    ModelFormat::Html,
];

fn model_format(name: &str) -> PyResult<ModelFormat> {
    format_of(&FORMATS.map(|format| (format.name(), format)), name)
}

/// Image with a known pose.
///
/// Parameters
/// ----------
/// id : int
///     Number of the image in files with numbered images; unique.
/// name : str
///     Name, usually the path of its file within a folder of images.
/// camera : int
///     Index of the image's camera.
/// cam_from_world : RigidTransform
/// keypoints : array_like, shape (N, 2)
///     Pixels.
#[pyclass(frozen, from_py_object, module = "epipole.io")]
#[derive(Clone)]
struct ModelImage(model::ModelImage);

wrapper!(ModelImage: id, name, camera, cam_from_world, keypoints);

#[pymethods]
impl ModelImage {
    #[new]
    fn new(
        id: u32,
        name: String,
        camera: usize,
        cam_from_world: &RigidTransform,
        keypoints: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        Ok(Self(model::ModelImage {
            id,
            name,
            camera,
            cam_from_world: cam_from_world.0,
            keypoints: points2("keypoints", keypoints)?,
        }))
    }

    /// Number of the image.
    #[getter]
    fn id(&self) -> u32 {
        self.0.id
    }

    /// Name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Index of the image's camera.
    #[getter]
    fn camera(&self) -> usize {
        self.0.camera
    }

    /// Pose: ``x_in_cam = cam_from_world @ x_in_world``.
    #[getter]
    fn cam_from_world(&self) -> RigidTransform {
        self.0.cam_from_world.into()
    }

    /// Keypoints, pixels, shape (N, 2).
    #[getter]
    fn keypoints<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.0.keypoints)
    }

    /// Returns the center of the camera in the world, shape (3,).
    fn center_in_world<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.center_in_world().coords)
    }
}

/// Cameras, their images, and points of the scene.
///
/// Parameters
/// ----------
/// cameras : list of Camera
/// images : list of ModelImage
/// points : array_like, shape (P, 3)
/// tracks : array_like of int, shape (K, 3)
///     Observations: indices of the point, of the image, and of the image's keypoint.
/// colors : array_like of uint8, shape (P, 3), optional
///     Red, green, blue. Gray by default.
/// errors_px : list of float or None, optional
///     Mean reprojection error of each point, pixels.
/// camera_ids : list of int, optional
///     Number of each camera in files with numbered cameras. Counted from 1 by default.
/// point_ids : list of int, optional
///     Number of each point in files with numbered points. Counted from 1 by default.
/// rigs : list of Rig, optional
///     Cameras mounted rigidly on each other.
///
/// Raises
/// ------
/// ValueError
///     If a track refers to a missing point.
#[pyclass(frozen, from_py_object, module = "epipole.io")]
#[derive(Clone)]
pub(crate) struct Model(model::Model);

wrapper!(
    Model: cameras, images, points, tracks, colors, errors_px, camera_ids, point_ids, rigs
);

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (
        cameras, images, points, tracks, colors=None, errors_px=None, camera_ids=None,
        point_ids=None, rigs=None
    ))]
    #[allow(clippy::too_many_arguments, reason = "the parts of a model")]
    fn new(
        cameras: Vec<Camera>,
        images: Vec<ModelImage>,
        points: &Bound<'_, PyAny>,
        tracks: &Bound<'_, PyAny>,
        colors: Option<&Bound<'_, PyAny>>,
        errors_px: Option<Vec<Option<f64>>>,
        camera_ids: Option<Vec<u32>>,
        point_ids: Option<Vec<u64>>,
        rigs: Option<Vec<Rig>>,
    ) -> PyResult<Self> {
        let positions = points3("points", points)?;
        let (count, num_cameras) = (positions.len(), cameras.len());
        let colors = match colors {
            Some(_) => self::colors("colors", colors)?,
            None => vec![[128; 3]; count],
        };
        let errors = errors_px.unwrap_or_else(|| vec![None; count]);
        require_equal(("points", count), ("colors", colors.len()))?;
        require_equal(("points", count), ("errors_px", errors.len()))?;
        let ids = point_ids.unwrap_or_else(|| (1..=count as u64).collect());
        require_equal(("points", count), ("point_ids", ids.len()))?;
        let parts = positions.into_iter().zip(colors).zip(errors).zip(ids);
        let mut points: Vec<_> = parts
            .map(|(((position, color), error_px), id)| ModelPoint {
                id,
                position,
                color,
                error_px,
                track: Vec::new(),
            })
            .collect();
        for [point, image, keypoint] in index_rows::<3>("tracks", tracks)? {
            let Some(point) = points.get_mut(point) else {
                return Err(PyValueError::new_err(format!(
                    "tracks has point {point}, but there are {count}"
                )));
            };
            point.track.push((image, keypoint));
        }
        Ok(Self(model::Model {
            cameras: cameras.into_iter().map(|camera| camera.0).collect(),
            images: images.into_iter().map(|image| image.0).collect(),
            points,
            // Numbers counted from 1 are the default.
            camera_ids: camera_ids
                .filter(|ids| !ids.iter().copied().eq(1..=num_cameras as u32))
                .unwrap_or_default(),
            rigs: rigs
                .unwrap_or_default()
                .into_iter()
                .map(|rig| rig.0)
                .collect(),
        }))
    }

    /// Creates the model of a reconstruction and its `images`.
    ///
    /// Parameters
    /// ----------
    /// reconstruction : epipole.sfm.Reconstruction
    /// images : list of epipole.sfm.SfmImage
    ///     Images of the input.
    #[staticmethod]
    fn from_reconstruction(
        reconstruction: &Reconstruction,
        images: Vec<SfmImage>,
    ) -> PyResult<Self> {
        let cameras = reconstruction.0.cameras.len();
        require_equal(("images", images.len()), ("cameras", cameras))?;
        let images: Vec<_> = images.into_iter().map(|image| image.0).collect();
        Ok(Self(model::Model::from_reconstruction(
            &reconstruction.0,
            &images,
        )))
    }

    /// Returns the reconstruction and its images.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If an index refers to a missing item of the model.
    fn to_reconstruction(&self) -> PyResult<(Reconstruction, Vec<SfmImage>)> {
        let (reconstruction, images) = or_raise(self.0.to_reconstruction())?;
        let images = images.into_iter().map(SfmImage).collect();
        Ok((Reconstruction(reconstruction), images))
    }

    /// Cameras, a list of `Camera`.
    #[getter]
    fn cameras(&self) -> Vec<Camera> {
        self.0.cameras.iter().map(|&camera| camera.into()).collect()
    }

    /// Images with a known pose, a list of `ModelImage`.
    #[getter]
    fn images(&self) -> Vec<ModelImage> {
        self.0.images.iter().cloned().map(ModelImage).collect()
    }

    /// Points, shape (P, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_rows(py, self.0.points.iter().map(|point| point.position.coords))
    }

    /// Observations, int64 of shape (K, 3): indices of the point, the image and its keypoint.
    #[getter]
    fn tracks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let rows = self.0.points.iter().enumerate().flat_map(|(index, point)| {
            let track = point.track.iter();
            track.map(move |&(image, keypoint)| [index, image, keypoint])
        });
        give_index_rows(py, rows)
    }

    /// Colors of the points, uint8 of shape (P, 3).
    #[getter]
    fn colors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        give_colors(py, self.0.points.iter().map(|point| point.color))
    }

    /// Mean reprojection error of each point, pixels; None if the file lacks it.
    #[getter]
    fn errors_px(&self) -> Vec<Option<f64>> {
        self.0.points.iter().map(|point| point.error_px).collect()
    }

    /// Number of each camera in files with numbered cameras.
    #[getter]
    fn camera_ids(&self) -> Vec<u32> {
        (0..self.0.cameras.len())
            .map(|n| self.0.camera_id(n))
            .collect()
    }

    /// Number of each point in files with numbered points.
    #[getter]
    fn point_ids(&self) -> Vec<u64> {
        self.0.points.iter().map(|point| point.id).collect()
    }

    /// Cameras mounted rigidly on each other, a list of `Rig`.
    #[getter]
    fn rigs(&self) -> Vec<Rig> {
        self.0.rigs.iter().cloned().map(Rig).collect()
    }

    /// Returns the points without their observations.
    ///
    /// Returns
    /// -------
    /// epipole.stereo.PointCloud
    fn cloud<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        give_cloud(py, &self.0.cloud())
    }

    /// Returns the number of observations of all points.
    fn num_observations(&self) -> usize {
        self.0.num_observations()
    }

    /// Computes the mean length of all reprojection errors, pixels; None without observations.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If an index refers to a missing item of the model.
    fn mean_reprojection_px(&self) -> PyResult<Option<f64>> {
        or_raise(self.0.mean_reprojection_px())
    }

    /// Returns oddities of the model, such as points behind cameras, as sentences.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If an index refers to a missing item of the model.
    fn oddities(&self) -> PyResult<Vec<String>> {
        or_raise(self.0.oddities())
    }

    /// Returns the information that a format loses, as sentences.
    ///
    /// Parameters
    /// ----------
    /// format : str
    ///     File format.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the format is unknown.
    fn losses(&self, format: &str) -> PyResult<Vec<String>> {
        Ok(model_format(format)?.losses(&self.0))
    }

    /// Returns the files of the model.
    ///
    /// Parameters
    /// ----------
    /// format : str
    ///     "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg", "ply", "glb" or
    ///     "html".
    ///
    /// Returns
    /// -------
    /// dict
    ///     Content of each file by its usual name, as bytes.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the format is unknown or cannot hold a camera, or an index refers to a missing item
    ///     of the model.
    fn to_files(&self, format: &str) -> PyResult<std::collections::BTreeMap<String, Vec<u8>>> {
        let files = or_raise(self.0.to_files(model_format(format)?))?;
        Ok(files
            .into_iter()
            .map(|file| (file.name, file.bytes))
            .collect())
    }

    /// Writes the files of the model to a folder, which is created if needed.
    ///
    /// Parameters
    /// ----------
    /// folder : str or os.PathLike
    /// format : str
    ///     Same as for `to_files`.
    ///
    /// Returns
    /// -------
    /// list of Any
    ///     Paths of the files, `pathlib.Path`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the format is unknown or cannot hold a camera, or an index refers to a missing item
    ///     of the model.
    /// OSError
    ///     If a folder or file cannot be written.
    fn write<'py>(
        &self,
        folder: &Bound<'py, PyAny>,
        format: &str,
    ) -> PyResult<Vec<std::path::PathBuf>> {
        let folder = path(folder)?;
        let files = or_raise(self.0.to_files(model_format(format)?))?;
        let put = |path: &Path, result: std::io::Result<()>| {
            result.map_err(|error| os_error(&error, path))
        };
        put(&folder, std::fs::create_dir_all(&folder))?;
        let mut paths = Vec::new();
        for file in files {
            let path = folder.join(&file.name);
            put(&path, std::fs::write(&path, &file.bytes))?;
            paths.push(path);
        }
        Ok(paths)
    }
}

record! {
    /// Model as read from files.
    "epipole.io" ReadModel {
        /// Format: "colmap-text", "colmap-binary", "bundler", "transforms", "openmvg" or "ply".
        format: String,
        /// Model.
        model: Model,
        /// Notes on skipped content and assumptions, as sentences.
        notes: Vec<String>,
    }
}

impl From<model::ReadModel> for ReadModel {
    fn from(read: model::ReadModel) -> Self {
        Self {
            format: read.format.name().to_owned(),
            model: Model(read.model),
            notes: read.notes,
        }
    }
}

/// Reads the model in a folder.
///
/// Parameters
/// ----------
/// folder : str or os.PathLike
///     Folder with COLMAP's files, or with one of transforms.json, sfm_data.json, bundle.out,
///     points.ply.
///
/// Returns
/// -------
/// ReadModel
///
/// Raises
/// ------
/// ValueError
///     If the model is damaged or incomplete, or a camera model is not supported.
/// FileNotFoundError
///     If the folder does not exist or holds no model.
/// OSError
///     If the folder cannot be read.
#[pyfunction]
fn read_model_folder(folder: &Bound<'_, PyAny>) -> PyResult<ReadModel> {
    let path = path(folder)?;
    std::fs::read_dir(&path).map_err(|error| os_error(&error, &path))?;
    let file = |name: &str| std::fs::read(path.join(name)).ok();
    let read = progress::detach(folder.py(), || model::read_model_folder(&file));
    let located = |error| PyValueError::new_err(format!("{}: {error}", path.display()));
    match read.map_err(located)? {
        Some(read) => Ok(read.into()),
        None => Err(PyFileNotFoundError::new_err(format!(
            "{}: the folder has no model",
            path.display()
        ))),
    }
}

/// Reads a model from one file; related files are read if the format needs them.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///
/// Returns
/// -------
/// ReadModel
///
/// Raises
/// ------
/// ValueError
///     If the format is unknown, the model is damaged, or a camera model is not supported.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_model_file(path: &Bound<'_, PyAny>) -> PyResult<ReadModel> {
    let place = super::source::path(path)?;
    let source = Source::read(path)?;
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    let beside = |name: &str| std::fs::read(place.with_file_name(name)).ok();
    let read = model::read_model_file(&name, &source.bytes, &beside);
    Ok(source.done(read)?.into())
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: ModelImage, Rig, Model, ReadModel);
    functions!(module: read_model_folder, read_model_file);
    Ok(())
}
