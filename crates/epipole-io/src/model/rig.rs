//! Cameras that are fixed to each other.

use super::Model;
use crate::{Error, Result};
use epipole::camera::RigidTransform;
use std::collections::BTreeSet;

/// Maximum angle between an image and its pose by the rig, radians, that counts as rounding.
const MAX_ANGLE_RAD: f64 = 1e-6;
/// Maximum distance between both, relative to the translations involved.
const MAX_RATIO: f64 = 1e-6;

/// Cameras that are fixed to each other, and the moments at which they took images.
#[derive(Debug, Clone, PartialEq)]
pub struct Rig {
    /// Unique ID of the rig, in formats with IDs.
    pub id: u32,
    /// Its cameras. The frame of the rig is that of the first one.
    pub cameras: Vec<RigCamera>,
    /// Moments at which images were taken.
    pub frames: Vec<RigFrame>,
}

/// A camera of a rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigCamera {
    /// Index of the camera.
    pub camera: usize,
    /// `x_in_cam = cam_from_rig * x_in_rig`; the identity for the first camera.
    pub cam_from_rig: RigidTransform,
}

/// A moment at which a rig took images.
#[derive(Debug, Clone, PartialEq)]
pub struct RigFrame {
    /// Unique ID of the frame, in formats with IDs.
    pub id: u32,
    /// `x_in_rig = rig_from_world * x_in_world`.
    pub rig_from_world: RigidTransform,
    /// Indices of the images, at most one of each camera.
    pub images: Vec<usize>,
}

impl Model {
    /// # Errors
    /// [`Error::Malformed`] if an index is wrong, an entry is duplicate, or the pose of an image
    /// differs from that of its rig.
    pub(super) fn check_rigs(&self) -> Result<()> {
        let (mut rigs, mut cameras) = (BTreeSet::new(), BTreeSet::new());
        let (mut frames, mut images) = (BTreeSet::new(), BTreeSet::new());
        for rig in &self.rigs {
            let wrong = |why: String| Err(Error::malformed(format!("rig {}: {why}", rig.id)));
            if !rigs.insert(rig.id) {
                return wrong("its ID is there twice".to_owned());
            }
            if rig.cameras.is_empty() {
                return wrong("it has no cameras".to_owned());
            }
            for RigCamera { camera, .. } in &rig.cameras {
                if *camera >= self.cameras.len() || !cameras.insert(*camera) {
                    return wrong(format!("camera {camera} is missing, or in two places"));
                }
            }
            for frame in &rig.frames {
                if !frames.insert(frame.id) {
                    return wrong(format!("two frames have ID {}", frame.id));
                }
                for &image in &frame.images {
                    if image >= self.images.len() || !images.insert(image) {
                        return wrong(format!("image {image} is missing, or in two frames"));
                    }
                    if !self.is_in_place(image, rig, frame) {
                        let name = &self.images[image].name;
                        return wrong(format!(
                            "image {name} is not where frame {} and the rig have it: move the \
                             frames with the images, or leave out the rigs",
                            frame.id
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the rigs, then a separate one for each other camera, with a frame for each image
    /// that is in none. Empty if each camera moves alone.
    pub(super) fn rigs_of_all(&self) -> Vec<Rig> {
        let mut rigs = self.rigs.clone();
        if rigs.iter().all(|rig| rig.cameras.len() < 2) {
            return Vec::new();
        }
        let next = |most: Option<u32>| most.map_or(1, |id| id.wrapping_add(1));
        let mut next_rig = next(rigs.iter().map(|rig| rig.id).max());
        let all_frames = rigs.iter().flat_map(|rig| &rig.frames);
        let mut next_frame = next(all_frames.clone().map(|frame| frame.id).max());
        let in_frame: BTreeSet<usize> = all_frames.flat_map(|f| f.images.clone()).collect();
        let mut place_of_camera = vec![None; self.cameras.len()];
        for (place, rig) in rigs.iter().enumerate() {
            for camera in &rig.cameras {
                place_of_camera[camera.camera] = Some((place, camera.cam_from_rig));
            }
        }
        for (camera, place) in place_of_camera.iter_mut().enumerate() {
            if place.is_some() {
                continue;
            }
            let cam_from_rig = RigidTransform::identity();
            *place = Some((rigs.len(), cam_from_rig));
            rigs.push(Rig {
                id: next_rig,
                cameras: vec![RigCamera {
                    camera,
                    cam_from_rig,
                }],
                frames: Vec::new(),
            });
            next_rig = next_rig.wrapping_add(1);
        }
        for (index, image) in self.images.iter().enumerate() {
            let place = place_of_camera[image.camera];
            if let Some((rig, cam_from_rig)) = place.filter(|_| !in_frame.contains(&index)) {
                rigs[rig].frames.push(RigFrame {
                    id: next_frame,
                    rig_from_world: cam_from_rig.inverse() * image.cam_from_world,
                    images: vec![index],
                });
                next_frame = next_frame.wrapping_add(1);
            }
        }
        rigs
    }

    fn is_in_place(&self, image: usize, rig: &Rig, frame: &RigFrame) -> bool {
        let image = &self.images[image];
        let mut cameras = rig.cameras.iter();
        let Some(camera) = cameras.find(|camera| camera.camera == image.camera) else {
            return false;
        };
        let expected = camera.cam_from_rig * frame.rig_from_world;
        let length = |pose: &RigidTransform| pose.translation.vector.norm();
        let scale = length(&camera.cam_from_rig) + length(&frame.rig_from_world);
        let off = (image.cam_from_world.translation.vector - expected.translation.vector).norm();
        let angle_rad = image.cam_from_world.rotation.angle_to(&expected.rotation);
        off <= MAX_RATIO * scale && angle_rad <= MAX_ANGLE_RAD
    }
}

#[cfg(test)]
mod tests {
    use super::super::example::{example, in_rigs, lenses};
    use super::*;

    #[test]
    fn rigs_must_fit_the_images() {
        let good = in_rigs(example(&lenses()[..3], false));
        assert!(good.check().is_ok());
        let of = |change: &dyn Fn(&mut Model)| {
            let mut model = good.clone();
            change(&mut model);
            model.check().unwrap_err().to_string()
        };
        assert!(of(&|m| m.rigs[0].id = m.rigs[1].id).contains("there twice"));
        assert!(of(&|m| m.rigs[0].cameras.clear()).contains("no cameras"));
        assert!(of(&|m| m.rigs[0].cameras[1].camera = 7).contains("camera 7 is missing"));
        assert!(of(&|m| m.rigs[0].cameras[1].camera = 0).contains("in two places"));
        assert!(of(&|m| m.rigs[0].frames[1].id = m.rigs[0].frames[0].id).contains("two frames"));
        assert!(of(&|m| m.rigs[0].frames[0].images[0] = 9).contains("image 9 is missing"));
        let moved = of(&|m| m.images[1].cam_from_world.translation.x += 1e-3);
        assert!(moved.contains("is not where frame"), "{moved}");
        let rotated = of(&|m| {
            m.rigs[0].cameras[1].cam_from_rig.rotation = m.images[0].cam_from_world.rotation
        });
        assert!(rotated.contains("is not where frame"), "{rotated}");
    }
}
