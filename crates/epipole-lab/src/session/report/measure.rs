//! Lengths between points, and their uncertainty.

use crate::project::{Anchor, CloudPoint, DensePixel, Key, Measure, PhotoId, Project};
use crate::tasks::{CameraFound, CloudVertex, Component, Dense, DenseCloud, DepthOf};
use nalgebra::{Matrix2x3, Matrix3, Point3, Vector3};

/// A length with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    /// The length.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

impl Project {
    /// Returns the position of an anchor in the current component; `None` if it no longer exists.
    pub fn anchored(&self, anchor: &Anchor) -> Option<Point3<f64>> {
        match (anchor.cloud, anchor.pixel) {
            (Some(point), _) => Some(self.cloud_of(point)?.point(point.index)?.position.into()),
            (None, Some(pixel)) => dense_place(self.dense_of(anchor.photo, pixel)?, pixel.at),
            (None, None) => {
                let point = self.anchored_point(anchor)?;
                Some(self.component()?.points[point].position.into())
            }
        }
    }

    /// Returns the sparse point of an anchor at a keypoint.
    fn anchored_point(&self, anchor: &Anchor) -> Option<usize> {
        let image = self.place(anchor.photo)? as u32;
        let points = &self.component()?.points;
        let sees = |track: &[(u32, u32)]| track.contains(&(image, anchor.keypoint));
        points.iter().position(|point| sees(&point.track))
    }

    /// Returns the dense depth that an anchor needs, if it is part of the cloud.
    fn dense_of(&self, first: PhotoId, pixel: DensePixel) -> Option<&Dense> {
        let pair = (first, pixel.second);
        let query = DepthOf(pair.0, pair.1);
        self.get(query).filter(|_| self.document.is_dense(pair))
    }

    /// Returns the cloud of a point, if it is shown.
    fn cloud_of(&self, point: CloudPoint) -> Option<&DenseCloud> {
        let (key, cloud) = self.all_views()?;
        (key.0 == point.cloud).then_some(cloud)
    }

    /// Returns the covariance of an anchor's position for fixed cameras.
    pub(super) fn covariance(&self, anchor: &Anchor) -> Option<Matrix3<f64>> {
        match (anchor.cloud, anchor.pixel) {
            (Some(point), _) => {
                let cloud = self.cloud_of(point)?;
                cloud_covariance(self.component()?, cloud, &cloud.point(point.index)?)
            }
            (None, Some(pixel)) => dense_covariance(self.dense_of(anchor.photo, pixel)?, pixel.at),
            (None, None) => {
                let component = self.component()?;
                covariance(component, self.anchored_point(anchor)?, noise_px(component))
            }
        }
    }

    /// Returns the images that see an anchor, by index.
    pub(super) fn observers(&self, anchor: &Anchor) -> Option<Vec<u32>> {
        let component = self.component()?;
        Some(match (anchor.cloud, anchor.pixel) {
            (Some(point), _) => {
                let vertex = self.cloud_of(point)?.point(point.index)?;
                let cameras = facing_cameras(component, &vertex).into_iter();
                cameras.map(|(image, _)| image).collect()
            }
            (None, Some(_)) => {
                let images = anchor.photos().map(|photo| self.place(photo));
                images
                    .map(|image| Some(image? as u32))
                    .collect::<Option<_>>()?
            }
            (None, None) => {
                let track = &component.points[self.anchored_point(anchor)?].track;
                track.iter().map(|(image, _)| *image).collect()
            }
        })
    }

    /// Returns an anchor for a point of the current component.
    pub fn anchor_of(&self, point: usize) -> Option<Anchor> {
        let (image, keypoint) = *self.component()?.points.get(point)?.track.first()?;
        let photo = self.taking_part().get(image as usize)?.id;
        Some(Anchor {
            photo,
            keypoint,
            pixel: None,
            cloud: None,
        })
    }

    /// Returns an anchor for a point of the cloud of all views.
    ///
    /// * `cloud`: key of the cloud
    pub fn anchor_of_cloud(&self, cloud: Key, index: u32) -> Option<Anchor> {
        let photos = self.taking_part().into_iter();
        let mut registered = photos.zip(&self.component()?.cameras);
        let (photo, _) = registered.find(|(_, camera)| camera.is_some())?;
        Some(Anchor {
            photo: photo.id,
            keypoint: 0,
            pixel: None,
            cloud: Some(CloudPoint {
                cloud: cloud.0,
                index,
            }),
        })
    }

    /// Returns the length of a measure in units of the reconstruction; `None` if a point no longer
    /// exists.
    pub fn length_in_units(&self, measure: &Measure) -> Option<Length> {
        let [first, second] = &measure.ends;
        let between = self.anchored(second)? - self.anchored(first)?;
        let value = between.norm();
        if !(value > 0.0 && value.is_finite()) {
            return None;
        }
        let along = between / value;
        let mut variance = 0.0;
        for end in &measure.ends {
            variance += along.dot(&(self.covariance(end)? * along));
        }
        Some(Length {
            value,
            sigma: libm::sqrt(variance.max(0.0)),
        })
    }
}

/// Estimates the standard deviation of a keypoint in each direction from all reprojection errors:
/// two degrees of freedom per observation, less three per point and six per camera.
fn noise_px(component: &Component) -> f64 {
    let (mut sum_sq, mut count) = (0.0, 0.0);
    for point in &component.points {
        let seen = point.track.len() as f64;
        sum_sq += point.error_px * point.error_px * seen;
        count += 2.0 * seen - 3.0;
    }
    let freedom = count - 6.0 * component.num_registered() as f64;
    libm::sqrt(sum_sq / freedom.max(1.0))
}

/// Standard deviation of a disparity, pixels.
const DISPARITY_SIGMA_PX: f64 = 0.5;

/// Returns the position of a pixel with dense depth.
fn dense_place(pair: &Dense, [u, v]: [u32; 2]) -> Option<Point3<f64>> {
    let ray = pair.camera.ray([f64::from(u), f64::from(v)]);
    Some(pair.camera.center() + ray * pair.depth(u, v)?)
}

/// Returns the covariance of the position of a pixel with dense depth, for fixed cameras:
/// `σ_Z = Z² σ_d / (f B)` along the ray, and the width of the pixel across it.
fn dense_covariance(pair: &Dense, [u, v]: [u32; 2]) -> Option<Matrix3<f64>> {
    let ray = pair.camera.ray([f64::from(u), f64::from(v)]);
    let depth = pair.depth(u, v)?;
    let along = depth * depth * DISPARITY_SIGMA_PX / (pair.focal_px() * pair.baseline);
    // A pixel is uniform within its width, whose variance is 1/12.
    let across = depth / pair.focal_px();
    let covariance =
        ray * ray.transpose() * (along * along) + Matrix3::identity() * (across * across / 12.0);
    Some(covariance)
}

/// Returns the covariance of a point of the cloud of all views for fixed cameras. It counts as many
/// cameras as agree on the point, those that its surface faces most.
fn cloud_covariance(
    component: &Component,
    cloud: &DenseCloud,
    point: &CloudVertex,
) -> Option<Matrix3<f64>> {
    let cameras: Vec<_> = (facing_cameras(component, point).into_iter())
        .map(|(_, camera)| camera)
        .collect();
    let noise_px = DISPARITY_SIGMA_PX * cloud.pixel_px;
    covariance_from(&cameras, &point.position.into(), noise_px)
}

/// Returns as many cameras as agree on a point, those that its surface faces most, with the indices
/// of their images.
fn facing_cameras<'a>(
    component: &'a Component,
    point: &CloudVertex,
) -> Vec<(u32, &'a CameraFound)> {
    let (position, normal) = (Point3::from(point.position), Vector3::from(point.normal));
    let away = |camera: &CameraFound| -(camera.center() - position).normalize().dot(&normal);
    let cameras = component.cameras.iter().zip(0_u32..);
    let registered =
        |(camera, image): (&'a Option<CameraFound>, u32)| Some((image, camera.as_ref()?));
    let mut cameras: Vec<_> = cameras.filter_map(registered).collect();
    cameras.sort_by(|(_, a), (_, b)| away(a).total_cmp(&away(b)));
    cameras.truncate(usize::from(point.num_views).max(2));
    cameras
}

/// Returns the covariance of a sparse point for fixed cameras.
fn covariance(component: &Component, point: usize, noise_px: f64) -> Option<Matrix3<f64>> {
    let point = component.points.get(point)?;
    let camera = |&(image, _): &(u32, u32)| component.cameras.get(image as usize)?.as_ref();
    let cameras: Option<Vec<&CameraFound>> = point.track.iter().map(camera).collect();
    covariance_from(&cameras?, &point.position.into(), noise_px)
}

/// Returns the covariance of a point for fixed cameras: `σ² (Σ JᵀJ)⁻¹`.
fn covariance_from(
    cameras: &[&CameraFound],
    position: &Point3<f64>,
    noise_px: f64,
) -> Option<Matrix3<f64>> {
    let mut information = Matrix3::zeros();
    for camera in cameras {
        let jacobian = jacobian(camera, position)?;
        information += jacobian.transpose() * jacobian;
    }
    let covariance = information.try_inverse()? * (noise_px * noise_px);
    covariance
        .iter()
        .all(|v| v.is_finite())
        .then_some(covariance)
}

/// Returns the derivative of the pixel by the point, without lens distortion.
fn jacobian(camera: &CameraFound, position: &Point3<f64>) -> Option<Matrix2x3<f64>> {
    let (rotation, in_cam) = camera.transform(position);
    if in_cam.z <= 0.0 {
        return None;
    }
    let [fu, fv, ..] = camera.intrinsics;
    let inverse = 1.0 / in_cam.z;
    let by_place = Matrix2x3::new(
        fu * inverse,
        0.0,
        -fu * in_cam.x * inverse * inverse,
        0.0,
        fv * inverse,
        -fv * in_cam.y * inverse * inverse,
    );
    Some(by_place * rotation)
}
