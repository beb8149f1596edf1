//! The depth of all views in words.

use super::words::count;
use crate::project::Project;
use crate::tasks::{AllViews, ReconstructionOfAll};

impl Project {
    /// Describes the state of the depth of all views, in sentences.
    pub fn all_views_words(&self) -> String {
        if self.component().is_none() {
            return match self.failure(ReconstructionOfAll) {
                Some(why) => format!("Nothing could be reconstructed: {why}."),
                None => {
                    "The depth of all views needs at least 2 photographs with a camera.".to_owned()
                }
            };
        }
        if !self.document.all_views {
            return "Finds a depth for each pixel of each photograph, and joins those on which photographs agree to one \
                    cloud and a surface."
                .to_owned();
        }
        if let Some(why) = self.failure(AllViews) {
            return format!("No depth of all views: {why}.");
        }
        let Some(cloud) = self.get(AllViews) else {
            return match self.is_paused() {
                true => "Computing was stopped.".to_owned(),
                false => "Computing the depth of all views.".to_owned(),
            };
        };
        let mut words = format!("{} from all views.", count(cloud.len(), "point"));
        let left_out = cloud.num_registered.saturating_sub(cloud.num_maps);
        if left_out > 0 {
            words.push_str(&format!(
                " {} without depth: no other shows the same points from another place.",
                count(left_out as usize, "photograph")
            ));
        }
        words
    }

    /// Returns the maximum size of a photograph for the depth of all views, megapixels, if memory
    /// allows less than the setting.
    pub fn all_views_limit(&self) -> Option<f64> {
        let max_megapixels = f64::from(self.max_view_pixels()?) / 1e6;
        let wanted = self.document.settings.all_views.max_megapixels;
        (max_megapixels < wanted - 1e-6).then_some(max_megapixels)
    }
}
