//! Result of structure from motion: cameras, points and tracks.

use super::bundle::{Bundle, BundleObservation, PositionPrior};
use super::tracks::TrackElement;
use crate::camera::{PosedCamera, RigidTransform};
use crate::optim::RobustLoss;
use nalgebra::{Point2, Point3, Similarity3, Translation3};

/// Loss of a reprojection error in a model of photographs, pixels: beyond a pixel and a half,
/// matches are more often wrong than imprecise.
pub(super) const LOSS: RobustLoss = RobustLoss::Cauchy { width: 1.5 };

/// A photograph, reduced to its keypoints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SfmImage {
    /// A name, such as that of its file.
    pub name: String,
    /// Positions of its keypoints, pixels.
    pub keypoints: Vec<Point2<f64>>,
    /// Their colors, red, green, blue; empty if not known.
    pub colors: Vec<[u8; 3]>,
    /// Number of its lens: photographs with the same number have equal lenses and share what is
    /// refined of them. 0.
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
    /// Observations: at least two elements, sorted by image.
    pub track: Vec<TrackElement>,
    /// Root mean square of its reprojection errors, pixels.
    pub error_px: f64,
}

/// Cameras and points that share one frame. Its scale and pose are arbitrary, unless positions of
/// photographs are known: see [`is_placed`](Self::is_placed).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reconstruction {
    /// The camera of each image, `None` if it could not be registered here.
    pub cameras: Vec<Option<PosedCamera>>,
    /// Whether it stands where the known positions of its photographs are, in their unit of length.
    pub is_placed: bool,
    /// The points.
    pub points: Vec<ScenePoint>,
}

impl Reconstruction {
    /// The number of images with a camera.
    pub fn num_registered(&self) -> usize {
        self.cameras.iter().flatten().count()
    }

    /// The same in another world: places are where `to_from_world` moves them.
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

    /// The number of observations of all points.
    pub fn num_observations(&self) -> usize {
        self.points.iter().map(|point| point.track.len()).sum()
    }

    /// The pixel where a camera shows a point through its lens; `None` if the image is not
    /// registered or the lens does not see the point: what is behind its camera, except by a
    /// fisheye.
    pub fn project(&self, image: usize, point: &Point3<f64>) -> Option<Point2<f64>> {
        let camera = self.cameras.get(image)?.as_ref()?;
        camera.project(point).ok()
    }

    /// Mean length of all reprojection errors, pixels; 0 without observations.
    pub fn mean_reprojection_px(&self, images: &[SfmImage]) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for point in &self.points {
            for element in &point.track {
                let seen = images[element.image as usize].keypoints[element.keypoint as usize];
                if let Some(pixel) = self.project(element.image as usize, &point.position) {
                    sum += (pixel - seen).norm();
                    count += 1.0;
                }
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// The same as a [`Bundle`], with the image of each of its cameras.
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

    /// Brings [`ScenePoint::color`] and [`ScenePoint::error_px`] up to date.
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

/// `cam_from_world` after the world was moved; the camera keeps its unit of length no more than the
/// world does.
pub(super) fn moved_pose(
    cam_from_world: &RigidTransform,
    to_from_world: &Similarity3<f64>,
) -> RigidTransform {
    let center = to_from_world * cam_from_world.inverse_transform_point(&Point3::origin());
    let rotation = cam_from_world.rotation * to_from_world.isometry.rotation.inverse();
    RigidTransform::from_parts(Translation3::from(-(rotation * center.coords)), rotation)
}

/// Numbers of lenses without gaps, in the order in which they come.
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
