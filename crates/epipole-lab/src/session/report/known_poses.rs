//! Text about known poses.

use super::words::count;
use crate::project::{InputPhoto, Project};
use crate::tasks::ReconstructionOfAll;

/// Maximum mean error of points for correct poses, pixels. Wrong matches give about half of the 4
/// pixels that the reconstruction accepts.
const MAX_MEAN_ERROR_PX: f64 = 1.2;

impl Project {
    /// Describes the source of the cameras; empty if they are estimated.
    pub fn poses_words(&self) -> String {
        let Some(poses) = &self.document.poses else {
            return String::new();
        };
        let photos = &self.document.photos;
        let known = photos.iter().filter(|p| self.known_image(p).is_some());
        let mut words = format!(
            "Cameras of {} of {} come from {} and stay as they are. Only points are found.",
            known.count(),
            count(photos.len(), "photograph"),
            poses.file
        );
        let found = self.get(ReconstructionOfAll);
        let mean_px = found.and_then(|found| found.mean_error_px.first());
        if let Some(mean_px) = mean_px.filter(|mean_px| **mean_px > MAX_MEAN_ERROR_PX) {
            words.push_str(&format!(
                " Points are {mean_px:.2} pixels off on average: the poses may be imprecise, those of other photographs, or \
                 world from camera."
            ));
        }
        words
    }

    /// Explains why a photograph has no known pose.
    pub(super) fn no_pose_words(&self, photo: &InputPhoto) -> String {
        let file = (self.document.poses.as_ref()).map_or("", |poses| &poses.file);
        let (Some(image), Some(pixels)) = (self.known_image(photo), self.shown(photo)) else {
            return format!("has no pose in {file}, by its name");
        };
        let (width, height) = image.camera.size;
        let (own_width, own_height) = pixels.full_size;
        format!(
            "its camera in {file} is for {width} × {height} pixels, and the photograph has {own_width} × {own_height}: open \
             the photographs of the model, neither resized nor turned"
        )
    }
}
