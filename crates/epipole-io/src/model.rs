//! Models: cameras, posed images and points.

mod bundler;
mod cloud;
mod colmap_binary;
mod colmap_parts;
mod colmap_rigs;
mod colmap_text;
#[cfg(test)]
mod example;
mod folder;
mod format;
mod frustum;
#[cfg(test)]
mod fuzz;
mod gltf;
mod html;
mod nerfstudio;
mod notes;
mod openmvg;
mod reconstruction;
mod rig;

pub use folder::ModelFolder;
pub use format::{ModelFormat, ReadModel, format_of_file, read_model_file, read_model_folder};
pub use rig::{Rig, RigCamera, RigFrame};

use crate::trajectory::{Trajectory, frame_stamps_ns};
use crate::{Error, Result};
use epipole::camera::{Camera, RigidTransform};
use epipole::stereo::PointCloud;
use nalgebra::{Point2, Point3};
use std::collections::HashMap;
use std::fmt::Display;
use std::iter;

/// Cameras, the images that they took, and points of the scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// The cameras.
    pub cameras: Vec<Camera>,
    /// Distinct IDs of the cameras, in formats with IDs; if empty, IDs count from 1.
    pub camera_ids: Vec<u32>,
    /// The images with a known pose.
    pub images: Vec<ModelImage>,
    /// The points.
    pub points: Vec<ModelPoint>,
    /// Rigs of cameras fixed to each other; if empty, each camera moves alone.
    pub rigs: Vec<Rig>,
}

/// An image with a known pose.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelImage {
    /// Unique ID of the image, in formats with IDs.
    pub id: u32,
    /// Name, usually the path of its file in a folder of images.
    pub name: String,
    /// Index of its camera.
    pub camera: usize,
    /// `x_in_cam = cam_from_world * x_in_world`.
    pub cam_from_world: RigidTransform,
    /// Keypoints, pixels.
    pub keypoints: Vec<Point2<f64>>,
}

impl ModelImage {
    /// Returns the center of the camera in the world.
    pub fn center_in_world(&self) -> Point3<f64> {
        self.cam_from_world
            .inverse_transform_point(&Point3::origin())
    }
}

/// A point of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelPoint {
    /// Unique ID of the point, in formats with IDs.
    pub id: u64,
    /// Position in the world.
    pub position: Point3<f64>,
    /// Red, green, blue.
    pub color: [u8; 3],
    /// Mean reprojection error, pixels, if the file has one.
    pub error_px: Option<f64>,
    /// Observations: index of the image, index of its keypoint.
    pub track: Vec<(usize, usize)>,
}

/// Returns points without observations, with IDs from 1; gray if they have no color.
fn points_of(cloud: PointCloud) -> Vec<ModelPoint> {
    let colors = cloud.colors.into_iter().chain(iter::repeat([128; 3]));
    let points = (1..).zip(cloud.points).zip(colors);
    points
        .map(|((id, position), color)| ModelPoint {
            id,
            position,
            color,
            error_px: None,
            track: Vec::new(),
        })
        .collect()
}

/// Distinct cameras, in order of first occurrence.
#[derive(Default)]
struct CameraList {
    cameras: Vec<Camera>,
    place_of_key: HashMap<(u32, u32, &'static str, Vec<u64>), usize>,
}

impl CameraList {
    fn number_of(&mut self, camera: Camera) -> usize {
        let (k, center) = (&camera.intrinsics, camera.intrinsics.principal_point());
        let mut numbers = vec![k.fu_px(), k.fv_px(), center.x, center.y];
        numbers.extend(camera.lens.coefficients());
        // −0 equals 0.
        let bits = numbers.into_iter().map(|number| (number + 0.0).to_bits());
        let (width, height, kind) = (camera.width, camera.height, camera.lens.kind().name());
        let key = (width, height, kind, bits.collect());
        let place = self.place_of_key.entry(key).or_insert(self.cameras.len());
        if *place == self.cameras.len() {
            self.cameras.push(camera);
        }
        *place
    }

    fn into_list(self) -> Vec<Camera> {
        self.cameras
    }
}

/// # Errors
/// [`Error::Malformed`] for a duplicate ID.
fn check_ids<T: Ord + Display>(what: &str, mut ids: Vec<T>) -> Result<()> {
    ids.sort_unstable();
    match ids.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Error::malformed(format!("two {what} have ID {}", pair[0]))),
        None => Ok(()),
    }
}

/// A file of a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModelFile {
    /// Usual name.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

impl ModelFile {
    pub(crate) fn new(name: &str, content: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.to_owned(),
            bytes: content.into(),
        }
    }
}

impl Model {
    /// Poses of the images in their order, with times if the images are
    /// [named by them](frame_stamps_ns).
    pub fn trajectory(&self) -> Trajectory {
        let poses = self.images.iter();
        let names: Vec<&str> = self.images.iter().map(|image| &*image.name).collect();
        Trajectory {
            stamps_ns: frame_stamps_ns(&names),
            world_from_cam: poses.map(|image| image.cam_from_world.inverse()).collect(),
            ..Trajectory::default()
        }
    }

    /// # Errors
    /// [`Error::Malformed`] if an index is wrong, two images, cameras or points have the same ID,
    /// or the pose of an image differs from that of its rig.
    fn check(&self) -> Result<()> {
        if ![0, self.cameras.len()].contains(&self.camera_ids.len()) {
            return Err(Error::malformed(format!(
                "{} cameras have {} IDs",
                self.cameras.len(),
                self.camera_ids.len()
            )));
        }
        check_ids("cameras", self.camera_ids.clone())?;
        check_ids("images", self.images.iter().map(|image| image.id).collect())?;
        check_ids("points", self.points.iter().map(|point| point.id).collect())?;
        for image in &self.images {
            if image.camera >= self.cameras.len() {
                return Err(Error::malformed(format!(
                    "image {} has camera {} of {}",
                    image.name,
                    image.camera,
                    self.cameras.len()
                )));
            }
        }
        for (index, point) in self.points.iter().enumerate() {
            let is_there = |&(image, keypoint): &(usize, usize)| {
                (self.images.get(image)).is_some_and(|image| keypoint < image.keypoints.len())
            };
            if !point.track.iter().all(is_there) {
                return Err(Error::malformed(format!(
                    "point {index} is observed at a keypoint that is not there"
                )));
            }
        }
        self.check_rigs()
    }

    /// Returns the ID of a camera, for formats with IDs.
    ///
    /// * `camera`: index of the camera
    pub fn camera_id(&self, camera: usize) -> u32 {
        let id = self.camera_ids.get(camera).copied();
        id.unwrap_or(camera as u32 + 1)
    }

    /// Returns the cameras with their IDs.
    fn numbered_cameras(&self) -> Vec<(u32, Camera)> {
        let cameras = self.cameras.iter().enumerate();
        cameras
            .map(|(n, camera)| (self.camera_id(n), *camera))
            .collect()
    }

    /// Returns the index of the point of each keypoint of each image.
    fn point_of_keypoint(&self) -> Vec<Vec<Option<usize>>> {
        let none = |image: &ModelImage| vec![None; image.keypoints.len()];
        let mut all: Vec<Vec<_>> = self.images.iter().map(none).collect();
        for (index, point) in self.points.iter().enumerate() {
            for &(image, keypoint) in &point.track {
                all[image][keypoint] = Some(index);
            }
        }
        all
    }
}
