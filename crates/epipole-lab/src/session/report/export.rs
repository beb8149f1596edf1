//! Contents of the zip file of a reconstruction.

use crate::project::{InputPhoto, Outcome, Project};
use crate::tasks::{Export, ExportFormat, Packed, ReconstructionOfAll};

impl Project {
    /// Whether a reconstruction and all of its photographs are available.
    pub fn can_export(&self) -> bool {
        let mut photos = self.taking_part().into_iter();
        self.component().is_some() && photos.all(|photo| self.shown(photo).is_some())
    }

    /// Returns the task that writes the zip file of the current component; `None` without a
    /// reconstruction.
    pub fn export_request(&self, format: ExportFormat) -> Option<Export> {
        let found = self.get(ReconstructionOfAll)?;
        found.components.get(self.view.component)?;
        let pack = |photo: &&InputPhoto| {
            Some(Packed {
                name: photo.name.clone(),
                source: photo.source.clone(),
                used: Some(self.shown(photo)?.clone()),
                camera: self.lens_camera(photo).cloned(),
            })
        };
        let images = self.image_points()?;
        let (found, uncropped) = self.kept_reconstruction(found, &images);
        let mut recipe = self.recipe()?;
        if !self.edit_words().is_empty() {
            let words = format!(" {} The command finds them again.", self.edit_words());
            recipe.photographs.push_str(&words);
        }
        Some(Export {
            format,
            images,
            photographs: (self.taking_part().iter())
                .map(pack)
                .collect::<Option<_>>()?,
            found,
            uncropped,
            component: self.view.component as u32,
            unit_of: self.document.poses.as_ref().map(|poses| poses.file.clone()),
            meters_per_unit: self.scale().map(|scale| scale.meters_per_unit),
            floor: (self.floor())
                .filter(|_| self.alignment().is_none())
                .map(|floor| [floor.origin.into(), floor.up.into()]),
            measures: self.measures(),
            focal_refined: self.sfm_options().refine_focal || self.before_correction_px().is_some(),
            left_out: (self.taking_part().iter())
                .filter(|photo| !matches!(self.outcome(photo), Outcome::Registered(_)))
                .map(|photo| (photo.name.clone(), self.outcome_words(photo)))
                .collect(),
            recipe,
            max_pixels: self.max_pixels(),
            dense: (self.dense_pairs().into_iter())
                .map(|(key, first, second, dense)| {
                    (pair_name(first, second), self.kept_pair(key, dense))
                })
                .collect(),
            all_views: self.kept_views(),
        })
    }
}

/// Names a pair in files: the names of both photographs without extensions.
fn pair_name(first: &InputPhoto, second: &InputPhoto) -> String {
    let stem = |name: &str| {
        name.rsplit_once('.')
            .map_or(name, |(stem, _)| stem)
            .to_owned()
    };
    format!("{}_{}", stem(&first.name), stem(&second.name))
}
