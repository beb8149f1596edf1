//! COLMAP's three lists, with the IDs that join them.

use super::notes::not_finite;
use super::{Model, ModelImage, ModelPoint};
use crate::rotation::{pose, rotation_from_quaternion};
use crate::{Error, Result};
use epipole::camera::{Camera, RigidTransform};
use nalgebra::{Point2, Point3};
use std::collections::HashMap;

/// Lists of cameras, images and points as files have them.
pub(super) struct Parts {
    pub(super) cameras: Vec<(u32, Camera)>,
    pub(super) images: Vec<ImagePart>,
    pub(super) points: Vec<PointPart>,
}

/// An image of the list.
pub(super) struct ImagePart {
    pub(super) id: u32,
    pub(super) name: String,
    pub(super) camera: u32,
    /// w, x, y, z of `cam_from_world`.
    pub(super) quaternion: [f64; 4],
    pub(super) translation: [f64; 3],
    pub(super) keypoints: Vec<Point2<f64>>,
}

/// A point of the list.
pub(super) struct PointPart {
    pub(super) position: Point3<f64>,
    pub(super) color: [u8; 3],
    pub(super) error_px: f64,
    /// Image ID and index of its keypoint.
    pub(super) track: Vec<(u32, u32)>,
}

impl ImagePart {
    fn pose(&self) -> Option<RigidTransform> {
        let rotation = rotation_from_quaternion(&self.quaternion)?;
        pose(rotation, self.translation.into())
    }
}

impl Parts {
    /// The model, with sentences on what was left out.
    pub(super) fn join(self) -> Result<(Model, Vec<String>)> {
        let mut notes = Vec::new();
        let mut camera_of_id = HashMap::new();
        let (mut cameras, mut camera_ids) = (Vec::new(), Vec::new());
        for (id, camera) in self.cameras {
            if camera_of_id.insert(id, cameras.len()).is_some() {
                return Err(Error::malformed(format!("two cameras have ID {id}")));
            }
            cameras.push(camera);
            camera_ids.push(id);
        }
        let mut image_of_id = HashMap::new();
        let mut images = Vec::new();
        for part in self.images {
            if image_of_id.insert(part.id, images.len()).is_some() {
                return Err(Error::malformed(format!("two images have ID {}", part.id)));
            }
            let camera = *camera_of_id.get(&part.camera).ok_or_else(|| {
                Error::malformed(format!(
                    "image {} ({}) has camera {}, which is not listed",
                    part.id, part.name, part.camera
                ))
            })?;
            images.push(ModelImage {
                id: part.id,
                camera,
                cam_from_world: part.pose().ok_or_else(|| {
                    Error::malformed(format!(
                        "the pose of image {} ({}) is not finite, or its quaternion is 0",
                        part.id, part.name
                    ))
                })?,
                name: part.name,
                keypoints: part.keypoints,
            });
        }
        let (mut num_lost, mut num_not_finite) = (0_usize, 0);
        let mut points = Vec::new();
        for part in self.points {
            if !part.position.iter().all(|value| value.is_finite()) {
                num_not_finite += 1;
                continue;
            }
            let mut track = Vec::new();
            for (image, keypoint) in part.track {
                let image = image_of_id.get(&image).copied();
                match image.filter(|i| (keypoint as usize) < images[*i].keypoints.len()) {
                    Some(image) => track.push((image, keypoint as usize)),
                    None => num_lost += 1,
                }
            }
            points.push(ModelPoint {
                position: part.position,
                color: part.color,
                // COLMAP has −1 where it did not compute one.
                error_px: Some(part.error_px).filter(|error| *error >= 0.0 && error.is_finite()),
                track,
            });
        }
        notes.extend(not_finite(num_not_finite));
        if num_lost > 0 {
            notes.push(format!(
                "{num_lost} observations name an image or keypoint that is not listed: left out"
            ));
        }
        let model = Model {
            cameras,
            camera_ids,
            images,
            points,
        };
        Ok((model, notes))
    }
}
