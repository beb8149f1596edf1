//! Photographs with cameras and poses from an opened model.

use super::photograph::PhotographOf;
use crate::project::{InputPhoto, KnownImage, LensCamera, Pose, Project, Source};

impl Project {
    /// Returns the image of the opened model that is this photograph.
    pub fn known_image(&self, photo: &InputPhoto) -> Option<&KnownImage> {
        let is_file = matches!(photo.source, Source::File(_));
        let poses = self.document.poses.as_ref().filter(|_| is_file)?;
        poses.image_of(&photo.name)
    }

    /// Returns the camera whose distortion is removed from a photograph, if it has its size: that
    /// of the opened model, or the calibrated one. Rendered photographs have no distortion.
    pub(crate) fn lens_camera(&self, photo: &InputPhoto) -> Option<&LensCamera> {
        match photo.source {
            Source::Rendered(..) => None,
            Source::File(_) => (self.known_image(photo).map(|image| &image.camera))
                .or(self.document.camera.as_ref()),
        }
    }

    /// Returns the pose of a photograph in upright orientation, if the model contains it with a
    /// camera of the sensor's size or of the upright photograph's size.
    pub(crate) fn known_pose(&self, photo: &InputPhoto) -> Option<Pose> {
        let image = self.known_image(photo)?;
        let pixels = self.get(PhotographOf(photo.id)).filter(|p| p.k.is_some())?;
        if image.camera.size == pixels.sensor_size {
            return Some(image.pose.turned(pixels.quarters?));
        }
        (image.camera.size == pixels.full_size).then_some(image.pose)
    }

    /// Returns the poses of the photographs that take part; empty if no model is open.
    pub(crate) fn known_poses(&self) -> Vec<Option<Pose>> {
        match self.document.poses {
            None => Vec::new(),
            Some(_) => (self.taking_part().into_iter())
                .map(|photo| self.known_pose(photo))
                .collect(),
        }
    }
}
