//! Text about cameras and points.

use super::verdict::Verdict;
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
        let verdict = self.verdict();
        if let Some(verdict @ (Verdict::Flat | Verdict::FocalUnsure)) = verdict {
            words.push_str(&format!(" {}", verdict.explanation()));
        }
        if let Some(before_px) = self.before_correction_px() {
            words.push_str(&format!(
                " Focal length and radial distortion were corrected: before, the error was {before_px:.2} pixels."
            ));
        }
        if found.components.len() > 1 {
            words.push_str(&format!(
                " This is part {} of {}: nothing joins the parts.",
                self.view.component + 1,
                found.components.len()
            ));
        }
        let poses = self.poses_words();
        if !poses.is_empty() {
            words.push_str(&format!(" {poses}"));
        }
        for (id, _) in self.left_out() {
            if let Some(photo) = self.document.photo(id) {
                words.push_str(&format!(" {}: {}.", photo.name, self.outcome_words(photo)));
            }
        }
        match verdict {
            Some(verdict) => format!("{}: {words}", verdict.title()),
            None => words,
        }
    }

    /// Returns the mean error of the current component before its lens was corrected, pixels;
    /// `None` if it was not.
    pub fn before_correction_px(&self) -> Option<f64> {
        let found = self.get(ReconstructionOfAll)?;
        *found.before_correction_px.get(self.view.component)?
    }

    /// Whether the focal length of the current component is given or determined by its photographs.
    /// True while there is no component.
    pub fn knows_focal(&self) -> bool {
        let found = self.get(ReconstructionOfAll);
        let known = found.and_then(|found| found.determines_focal.get(self.view.component));
        known.copied().unwrap_or(true)
    }

    /// Whether all verified pairs show planes.
    pub(super) fn is_flat(&self) -> bool {
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
