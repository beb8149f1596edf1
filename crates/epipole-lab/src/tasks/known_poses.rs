//! Photographs whose cameras and poses a model of another program has.

use super::photograph::PhotographOf;
use crate::project::{InputPhoto, KnownImage, LensCamera, Pose, Project, Source};

impl Project {
    /// Image of the opened model that is a photograph.
    pub fn known_image(&self, photo: &InputPhoto) -> Option<&KnownImage> {
        let is_file = matches!(photo.source, Source::File(_));
        let poses = self.document.poses.as_ref().filter(|_| is_file)?;
        poses.image_of(&photo.name)
    }

    /// Camera whose distortion is removed from a photograph, if it has its size: that of the opened
    /// model, or the calibrated one. Rendered photographs have no distortion.
    pub(crate) fn lens_camera(&self, photo: &InputPhoto) -> Option<&LensCamera> {
        match photo.source {
            Source::Rendered(..) => None,
            Source::File(_) => (self.known_image(photo).map(|image| &image.camera))
                .or(self.document.camera.as_ref()),
        }
    }

    /// Pose of a photograph upright, if the model has it and a camera of its size: of the sensor,
    /// or of the photograph upright already.
    pub(crate) fn known_pose(&self, photo: &InputPhoto) -> Option<Pose> {
        let image = self.known_image(photo)?;
        let pixels = self.get(PhotographOf(photo.id)).filter(|p| p.k.is_some())?;
        if image.camera.size == pixels.sensor_size {
            return Some(image.pose.turned(pixels.quarters?));
        }
        (image.camera.size == pixels.full_size).then_some(image.pose)
    }

    /// Poses of the photographs that take part; none if no model is open.
    pub(crate) fn known_poses(&self) -> Vec<Option<Pose>> {
        match self.document.poses {
            None => Vec::new(),
            Some(_) => (self.taking_part().into_iter())
                .map(|photo| self.known_pose(photo))
                .collect(),
        }
    }
}
