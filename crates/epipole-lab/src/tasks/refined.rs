//! Lens parameters that a reconstruction refines.

use super::photograph::FocalOrigin;
use crate::project::{InputPhoto, Project, RefineFocal, SfmOptions};

impl Project {
    /// Returns the options of the reconstruction, with "when guessed" resolved.
    pub fn sfm_options(&self) -> SfmOptions {
        let guessed = || {
            let mut photos = self.taking_part().into_iter();
            photos.any(|photo| self.focal_origin(photo) == Some(FocalOrigin::Guessed))
        };
        let settings = &self.document.settings;
        if self.document.poses.is_some() {
            return SfmOptions {
                refine_focal: false,
                refine_distortion: false,
                correct_lens: false,
                ..settings.sfm
            };
        }
        let refine_focal = match settings.refine_focal {
            RefineFocal::Always => true,
            RefineFocal::Never => false,
            RefineFocal::WhenGuessed => guessed(),
        };
        SfmOptions {
            refine_focal,
            correct_lens: self.corrects_lens(),
            ..settings.sfm
        }
    }

    /// Whether the lens is corrected at the end: it is guessed or from the files, and no other
    /// refinement is selected.
    fn corrects_lens(&self) -> bool {
        let settings = &self.document.settings;
        let is_open = |photo: &InputPhoto| {
            let origin = self.focal_origin(photo);
            let is_told = matches!(origin, Some(FocalOrigin::Guessed | FocalOrigin::File));
            is_told && !photo.is_rendered()
        };
        settings.refine_focal != RefineFocal::Never
            && !settings.sfm.refine_distortion
            && self.taking_part().into_iter().all(is_open)
    }
}
