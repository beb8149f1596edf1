//! Cameras and points in words.

use super::words::count;
use crate::project::{Project, pairs};
use crate::tasks::{ReconstructionOfAll, Shows, TwoViewsOf};

impl Project {
    pub(super) fn reconstruction_words(&self) -> String {
        if let Some(why) = self.failure(ReconstructionOfAll) {
            return format!("Nothing could be reconstructed: {why}.");
        }
        let photos = self.document.photos.len();
        let Some(found) = self.get(ReconstructionOfAll) else {
            return match self.taking_part().len() {
                0 | 1 => self.photographs_words(),
                _ => match self.growing() {
                    Some(so_far) => format!(
                        "Reconstructing: {} and {} so far.",
                        count(so_far.num_registered(), "camera"),
                        count(so_far.points.len(), "point")
                    ),
                    None => "Reconstructing.".to_owned(),
                },
            };
        };
        let mut words = match found.components.get(self.view.component) {
            Some(component) => format!(
                "{} of {} have a camera; {} points, mean reprojection error {:.2} pixels.",
                component.num_registered(),
                count(photos, "photograph"),
                component.points.len(),
                found.mean_error_px.get(self.view.component).unwrap_or(&0.0)
            ),
            None => {
                "No two photographs show enough of the same thing from different places.".to_owned()
            }
        };
        if self.is_flat() {
            words.push_str(
                " Every pair shows a plane and nothing else, and a plane does not tell the focal length: cameras and points are \
                 right only if the focal length is. Type it, calibrate, or add photographs of something with depth.",
            );
        }
        if found.components.len() > 1 {
            words.push_str(&format!(
                " This is part {} of {}: nothing joins the parts.",
                self.view.component + 1,
                found.components.len()
            ));
        }
        for (id, _) in self.left_out() {
            if let Some(photo) = self.document.photo(id) {
                words.push_str(&format!(" {}: {}.", photo.name, self.outcome_words(photo)));
            }
        }
        words
    }

    /// Whether everything that photographs share lies in planes, pair by pair.
    fn is_flat(&self) -> bool {
        let photos = self.taking_part();
        let enough = self.document.settings.sfm.min_num_inliers;
        let pairs = pairs(&photos).map(|(first, second)| self.get(TwoViewsOf(first.id, second.id)));
        let mut joined = pairs
            .flatten()
            .filter(|pair| pair.num_inliers >= enough)
            .peekable();
        joined.peek().is_some() && joined.all(|pair| pair.shows == Shows::Plane)
    }
}
