//! Result of structure from motion: cameras, points and tracks.

use super::bundle::{Bundle, BundleObservation, PositionPrior};
use super::tracks::TrackElement;
use crate::camera::{PosedCamera, RigidTransform};
use crate::optim::RobustLoss;
use nalgebra::{Point2, Point3, Similarity3, Translation3};

/// Loss of reprojection errors, pixels: beyond a pixel and a half, matches are more often wrong
/// than imprecise.
pub(super) const LOSS: RobustLoss = RobustLoss::Cauchy { width: 1.5 };

/// An image, reduced to its keypoints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmImage {
    /// Name, such as the file name.
    pub name: String,
    /// Positions of the keypoints, pixels.
    pub keypoints: Vec<Point2<f64>>,
    /// Colors of the keypoints, red, green, blue; empty if unknown.
    pub colors: Vec<[u8; 3]>,
    /// Lens number: images with the same number have equal lenses and share refined parameters. 0.
    pub lens: usize,
    /// Position of the camera, if known.
    pub position: Option<PositionPrior>,
}

/// A point of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ScenePoint {
    /// Position in the world.
    pub position: Point3<f64>,
    /// Mean color of its keypoints; gray if none is known.
    pub color: [u8; 3],
    /// Observations: at least two, sorted by image.
    pub track: Vec<TrackElement>,
    /// RMS of its reprojection errors, pixels.
    pub error_px: f64,
}

/// Cameras and points in a common frame. Its scale and pose are arbitrary, unless positions of
/// images are known: see [`is_placed`](Self::is_placed).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reconstruction {
    /// The camera of each image, `None` if not registered in this reconstruction.
    pub cameras: Vec<Option<PosedCamera>>,
    /// Whether the frame is that of the known image positions, in their unit.
    pub is_placed: bool,
    /// The points.
    pub points: Vec<ScenePoint>,
}

impl Reconstruction {
    /// Returns the number of images with a camera.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }

    /// Transforms the world: positions move by `to_from_world`.
    ///
    /// ```
    /// use epipole::sfm::{Reconstruction, ScenePoint};
    /// use nalgebra::{Point3, Similarity3, Vector3};
    /// let mut found = Reconstruction::default();
    /// found.points.push(ScenePoint { position: Point3::new(1.0, 0.0, 0.0), color: [128; 3], track: vec![], error_px: 0.0 });
    /// let twice = Similarity3::new(Vector3::new(0.0, 0.0, 5.0), Vector3::zeros(), 2.0);
    /// assert_eq!(found.moved(&twice).points[0].position, Point3::new(2.0, 0.0, 5.0));
    /// ```
    pub fn moved(&self, to_from_world: &Similarity3<f64>) -> Self {
        let mut moved = self.clone();
        for point in &mut moved.points {
            point.position = to_from_world * point.position;
        }
        for camera in moved.cameras.iter_mut().flatten() {
            camera.cam_from_world = moved_pose(&camera.cam_from_world, to_from_world);
        }
        moved
    }

    /// Returns the number of observations of all points.
    pub fn num_observations(&self) -> usize {
        self.points.iter().map(|point| point.track.len()).sum()
    }

    /// Projects a point through the lens of an image. `None` if the image is not registered or the
    /// lens does not see the point: any point behind the camera, except for a fisheye.
    pub fn project(&self, image: usize, point: &Point3<f64>) -> Option<Point2<f64>> {
        let camera = self.cameras.get(image)?.as_ref()?;
        camera.project(point).ok()
    }

    /// Returns the mean reprojection error, pixels; 0 without observations.
    pub fn mean_reprojection_px(&self, images: &[SfmImage]) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for point in &self.points {
            for element in &point.track {
                let keypoint = images[element.image as usize].keypoints[element.keypoint as usize];
                if let Some(pixel) = self.project(element.image as usize, &point.position) {
                    sum += (pixel - keypoint).norm();
                    count += 1.0;
                }
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Converts to a [`Bundle`], with the image of each of its cameras.
    pub fn to_bundle(&self, images: &[SfmImage]) -> (Bundle, Vec<usize>) {
        let mut camera_of_image = vec![usize::MAX; self.cameras.len()];
        let mut image_of_camera = Vec::new();
        let mut bundle = Bundle::default();
        let mut lenses = Lenses::default();
        for (image, camera) in self.cameras.iter().enumerate() {
            if let Some(camera) = camera {
                camera_of_image[image] = bundle.cameras.len();
                image_of_camera.push(image);
                bundle.cameras.push(*camera);
                let lens = lenses.number_of(images[image].lens);
                bundle.lens_of_camera.push(lens);
            }
        }
        for (index, point) in self.points.iter().enumerate() {
            bundle.points.push(point.position);
            for element in &point.track {
                let image = element.image as usize;
                bundle.observations.push(BundleObservation {
                    camera: camera_of_image[image],
                    point: index,
                    pixel: images[image].keypoints[element.keypoint as usize],
                });
            }
        }
        (bundle, image_of_camera)
    }

    /// Updates [`ScenePoint::color`] and [`ScenePoint::error_px`].
    pub(super) fn finish_points(&mut self, images: &[SfmImage]) {
        let mut points = std::mem::take(&mut self.points);
        for point in &mut points {
            let (mut sum, mut color, mut colored) = (0.0, [0.0; 3], 0.0);
            for element in &point.track {
                let image = &images[element.image as usize];
                let keypoint = element.keypoint as usize;
                if let Some(pixel) = self.project(element.image as usize, &point.position) {
                    sum += (pixel - image.keypoints[keypoint]).norm_squared();
                }
                if let Some(rgb) = image.colors.get(keypoint) {
                    for (total, value) in color.iter_mut().zip(rgb) {
                        *total += f64::from(*value);
                    }
                    colored += 1.0;
                }
            }
            point.error_px = (sum / point.track.len().max(1) as f64).sqrt();
            point.color = if colored > 0.0 {
                color.map(|total| (total / colored).round() as u8)
            } else {
                [128; 3]
            };
        }
        self.points = points;
    }
}

/// Returns `cam_from_world` after the world was transformed; the camera's unit of length changes
/// with that of the world.
pub(super) fn moved_pose(
    cam_from_world: &RigidTransform,
    to_from_world: &Similarity3<f64>,
) -> RigidTransform {
    let center = to_from_world * cam_from_world.inverse_transform_point(&Point3::origin());
    let rotation = cam_from_world.rotation * to_from_world.isometry.rotation.inverse();
    RigidTransform::from_parts(Translation3::from(-(rotation * center.coords)), rotation)
}

/// Lens numbers without gaps, in order of appearance.
#[derive(Default)]
pub(super) struct Lenses(Vec<usize>);

impl Lenses {
    pub(super) fn number_of(&mut self, lens: usize) -> usize {
        let place = self.0.iter().position(|known| *known == lens);
        place.unwrap_or_else(|| {
            self.0.push(lens);
            self.0.len() - 1
        })
    }

    /// Lens of each number.
    pub(super) fn names(&self) -> &[usize] {
        &self.0
    }
}
