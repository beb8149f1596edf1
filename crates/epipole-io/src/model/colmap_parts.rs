//! COLMAP's lists, joined by IDs.

use super::colmap_rigs::{FramePart, RigPart};
use super::notes::LeftOut;
use super::{Model, ModelImage, ModelPoint, Rig, RigCamera, RigFrame};
use crate::cloud::not_finite;
use crate::colmap::cameras::ListedCamera;
use crate::rotation::{pose, rotation_from_quaternion};
use crate::{Error, Result};
use epipole::camera::RigidTransform;
use nalgebra::{Point2, Point3};
use std::collections::{HashMap, HashSet};

/// Lists of cameras, images and points as in files.
pub(super) struct Parts {
    pub(super) cameras: Vec<ListedCamera>,
    pub(super) images: Vec<ImagePart>,
    pub(super) points: Vec<PointPart>,
    pub(super) rigs: Vec<RigPart>,
    pub(super) frames: Vec<FramePart>,
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
    pub(super) id: u64,
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

/// Rigs with their supported cameras, and the place of each image in them.
struct Rigs {
    rigs: Vec<Rig>,
    /// Rig and frame, by ID of the image.
    place_of_image: HashMap<u32, (usize, usize)>,
    /// IDs of the images of frames without a pose.
    lost: HashSet<u32>,
    num_other_sensors: usize,
}

impl Rigs {
    /// Joins rigs and frames. The frame of a rig becomes that of its first supported camera with a
    /// pose.
    fn join(
        rigs: Vec<RigPart>,
        frames: Vec<FramePart>,
        camera_of_id: &HashMap<u32, usize>,
    ) -> Result<Self> {
        let mut all = Self {
            rigs: Vec::new(),
            place_of_image: HashMap::new(),
            lost: HashSet::new(),
            num_other_sensors: 0,
        };
        let mut place_of_rig = HashMap::new();
        for part in rigs {
            let mut first_from_rig = None;
            let mut cameras = Vec::new();
            for sensor in &part.sensors {
                all.num_other_sensors += usize::from(sensor.camera.is_none());
                let camera = sensor.camera.and_then(|id| camera_of_id.get(&id));
                if let (Some(&camera), Some(cam_from_rig)) = (camera, sensor.pose) {
                    let first = *first_from_rig.get_or_insert(cam_from_rig);
                    let cam_from_rig = match cameras.is_empty() {
                        true => RigidTransform::identity(),
                        false if first == RigidTransform::identity() => cam_from_rig,
                        false => cam_from_rig * first.inverse(),
                    };
                    cameras.push(RigCamera {
                        camera,
                        cam_from_rig,
                    });
                }
            }
            let place = first_from_rig.map(|first| (all.rigs.len(), first));
            if place_of_rig.insert(part.id, place).is_some() {
                return Err(Error::malformed(format!("two rigs have ID {}", part.id)));
            }
            if place.is_some() {
                all.rigs.push(Rig {
                    id: part.id,
                    cameras,
                    frames: Vec::new(),
                });
            }
        }
        for part in frames {
            let place = place_of_rig.get(&part.rig).ok_or_else(|| {
                Error::malformed(format!(
                    "frame {} has rig {}, which is not listed",
                    part.id, part.rig
                ))
            })?;
            let (Some((rig, first_from_rig)), Some(rig_from_world)) = (*place, part.rig_from_world)
            else {
                all.lost.extend(part.images);
                continue;
            };
            let place = (rig, all.rigs[rig].frames.len());
            for image in part.images {
                if all.place_of_image.insert(image, place).is_some() {
                    return Err(Error::malformed(format!("image {image} is in two frames")));
                }
            }
            all.rigs[rig].frames.push(RigFrame {
                id: part.id,
                rig_from_world: match first_from_rig == RigidTransform::identity() {
                    true => rig_from_world,
                    false => first_from_rig * rig_from_world,
                },
                images: Vec::new(),
            });
        }
        Ok(all)
    }

    /// Adds an image to its frame and returns its pose, if it has one.
    fn place(&mut self, part: &ImagePart, camera: usize, index: usize) -> Option<RigidTransform> {
        let Some(&(rig, frame)) = self.place_of_image.get(&part.id) else {
            return part.pose().filter(|_| !self.lost.contains(&part.id));
        };
        let Rig {
            cameras, frames, ..
        } = &mut self.rigs[rig];
        let of_rig = cameras.iter().find(|other| other.camera == camera)?;
        let found = of_rig.cam_from_rig * frames[frame].rig_from_world;
        let found = pose(found.rotation, found.translation.vector)?;
        frames[frame].images.push(index);
        Some(found)
    }

    /// Returns the rigs, if one of them has several cameras.
    fn finish(mut self) -> Vec<Rig> {
        if self.rigs.iter().all(|rig| rig.cameras.len() < 2) {
            return Vec::new();
        }
        for rig in &mut self.rigs {
            rig.frames.retain(|frame| !frame.images.is_empty());
        }
        self.rigs
    }
}

impl Parts {
    /// Returns the model, with sentences on omitted parts.
    pub(super) fn join(self) -> Result<(Model, Vec<String>)> {
        let mut left_out = LeftOut::default();
        let (mut camera_of_id, mut why_of_id) = (HashMap::new(), HashMap::new());
        let (mut cameras, mut camera_ids) = (Vec::new(), Vec::new());
        for (id, camera) in self.cameras {
            if camera_of_id.contains_key(&id) || why_of_id.contains_key(&id) {
                return Err(Error::malformed(format!("two cameras have ID {id}")));
            }
            match camera {
                Ok(camera) => {
                    camera_of_id.insert(id, cameras.len());
                    cameras.push(camera);
                    camera_ids.push(id);
                }
                Err(why) => {
                    let why = format!("camera {id}: {why}");
                    left_out.add(&why, None);
                    why_of_id.insert(id, why);
                }
            }
        }
        let mut rigs = Rigs::join(self.rigs, self.frames, &camera_of_id)?;
        let (mut image_of_id, mut num_without) = (HashMap::new(), 0_usize);
        let mut images = Vec::new();
        for part in self.images {
            if image_of_id.insert(part.id, None).is_some() {
                return Err(Error::malformed(format!("two images have ID {}", part.id)));
            }
            if let Some(why) = why_of_id.get(&part.camera) {
                left_out.add(why, Some(&part.name));
                continue;
            }
            let camera = *camera_of_id.get(&part.camera).ok_or_else(|| {
                Error::malformed(format!(
                    "image {} ({}) has camera {}, which is not listed",
                    part.id, part.name, part.camera
                ))
            })?;
            let Some(cam_from_world) = rigs.place(&part, camera, images.len()) else {
                let is_of_rig = rigs.lost.contains(&part.id);
                if is_of_rig || rigs.place_of_image.contains_key(&part.id) {
                    num_without += 1;
                    continue;
                }
                return Err(Error::malformed(format!(
                    "the pose of image {} ({}) is not finite, or its quaternion is 0",
                    part.id, part.name
                )));
            };
            image_of_id.insert(part.id, Some(images.len()));
            images.push(ModelImage {
                id: part.id,
                camera,
                cam_from_world,
                name: part.name,
                keypoints: part.keypoints,
            });
        }
        let mut notes = left_out.notes(images.len())?;
        if num_without > 0 {
            notes.push(format!(
                "{num_without} images have no pose in their rig: left out"
            ));
        }
        if rigs.num_other_sensors > 0 {
            notes.push(format!(
                "{} sensors of rigs are no cameras: left out",
                rigs.num_other_sensors
            ));
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
                match image_of_id.get(&image) {
                    // Its image is left out.
                    Some(None) => {}
                    Some(Some(image)) if (keypoint as usize) < images[*image].keypoints.len() => {
                        track.push((*image, keypoint as usize));
                    }
                    _ => num_lost += 1,
                }
            }
            points.push(ModelPoint {
                id: part.id,
                position: part.position,
                color: part.color,
                // COLMAP writes −1 for an error that it did not compute.
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
            rigs: rigs.finish(),
        };
        model.check()?;
        Ok((model, notes))
    }
}
