//! Recipe for the same result elsewhere: a command line and a program.

use super::calibration_words::{camera_fields, listed};
use crate::project::{
    FeatureKind, FeatureOptions, InputPhoto, MatchOptions, Project, SfmOptions, Source,
};
use crate::tasks::{FocalOrigin, Photograph, PhotographOf, Recipe};

/// A photograph that takes part, as a recipe reads it.
struct Part<'a> {
    pixels: &'a Photograph,
    path: String,
    /// Focal length to pass on, pixels of the file.
    focal_px: Option<f64>,
    is_guessed: bool,
}

/// Contents of a recipe.
struct Parts<'a> {
    list: Vec<Part<'a>>,
    /// Folder to pass in place of the list of files, if equivalent.
    folder: Option<&'static str>,
    /// Whether the original files are read, rather than those in `images/`.
    as_given: bool,
    max_megapixels: Option<f64>,
    uses_camera: bool,
}

impl Project {
    fn parts(&self) -> Option<Parts<'_>> {
        let photos = self.taking_part();
        let pixels: Option<Vec<_>> = photos
            .iter()
            .map(|photo| self.get(PhotographOf(photo.id)))
            .collect();
        let pixels = pixels.filter(|pixels| !pixels.is_empty())?;
        let is_file = |photo: &InputPhoto| matches!(photo.source, Source::File(_));
        let both = || photos.iter().zip(&pixels);
        // Altered photographs are re-encoded with loss in `images/`, so the recipe uses the
        // originals.
        let as_given = both().any(|(photo, pixels)| is_file(photo) && !pixels.as_given);
        let list: Vec<Part<'_>> = both()
            .map(|(photo, pixels)| {
                let folder = match as_given && is_file(photo) {
                    true => "photographs",
                    false => "images",
                };
                let origin = self.focal_origin(photo);
                Part {
                    pixels,
                    path: format!("{folder}/{}", photo.name),
                    focal_px: match origin {
                        Some(FocalOrigin::Typed) => photo.focal_px,
                        // A rendered image has no file with a focal length.
                        Some(FocalOrigin::File) if !is_file(photo) => pixels.focal_px,
                        _ => None,
                    },
                    is_guessed: origin == Some(FocalOrigin::Guessed),
                }
            })
            .collect();
        let in_order = list.windows(2).all(|two| two[0].path < two[1].path);
        let all = !as_given
            || (list.len() == self.document.photos.len() && photos.iter().all(|p| is_file(p)));
        let folder = if as_given { "photographs/" } else { "images/" };
        let is_reduced =
            |part: &Part<'_>| (part.pixels.width, part.pixels.height) != part.pixels.full_size;
        Some(Parts {
            folder: (in_order && all).then_some(folder),
            as_given,
            max_megapixels: (list.iter().any(is_reduced))
                .then_some(self.document.settings.max_megapixels),
            uses_camera: list.iter().any(|part| part.pixels.k.is_some()),
            list,
        })
    }

    /// Returns the recipe, once all photographs are loaded.
    pub fn recipe(&self) -> Option<Recipe> {
        let parts = self.parts()?;
        let photographs = match parts.as_given {
            true => {
                "photographs/ stands for the folder of your original files. Save in the Project menu writes them \
                 too."
            }
            false => "images/ holds the photographs exactly as they were used.",
        };
        let is_posed = self.document.poses.is_some();
        let uses_camera = parts.uses_camera && !is_posed;
        let camera = self.document.camera.as_ref().filter(|_| uses_camera);
        Some(Recipe {
            command: self.command(&parts),
            photographs: photographs.to_owned(),
            camera_json: camera.map(|camera| format!("{{\n{}\n}}\n", camera_fields(camera))),
            program: (!is_posed).then(|| self.program(&parts)),
        })
    }

    fn command(&self, parts: &Parts<'_>) -> String {
        let paths: Vec<String> = match parts.folder {
            Some(folder) => vec![folder.to_owned()],
            None => parts.list.iter().map(|part| quoted(&part.path)).collect(),
        };
        let mut command = format!("epipole sfm {}", paths.join(" "));
        let mut say = |words: String| {
            command.push(' ');
            command.push_str(&words);
        };
        if let Some(megapixels) = parts.max_megapixels {
            say(format!("--max-megapixels {megapixels}"));
        }
        if let Some(poses) = &self.document.poses {
            say(format!("--poses {}", quoted(&poses.file)));
        } else if parts.uses_camera {
            say("--camera camera.json --undistort".to_owned());
        }
        let first = parts.list[0].focal_px;
        if parts.list.iter().any(|part| part.focal_px != first) {
            let word = |part: &Part<'_>| {
                part.focal_px
                    .map_or_else(|| "-".to_owned(), |f| f.to_string())
            };
            let words: Vec<String> = parts.list.iter().map(word).collect();
            say(format!("--focals-px={}", words.join(",")));
        } else if let Some(focal_px) = first {
            say(format!("--focal-px {focal_px}"));
        }
        let settings = &self.document.settings;
        let (features, usual) = (settings.features, FeatureOptions::default());
        say(format!("--max-features {}", features.max_features));
        if features.kind == FeatureKind::Sift {
            say("--features sift".to_owned());
        }
        if features.contrast != usual.contrast {
            say(format!("--contrast-threshold {}", features.contrast));
        }
        if settings.matching.ratio != MatchOptions::default().ratio {
            say(format!("--ratio {}", settings.matching.ratio));
        }
        if !settings.matching.mutual {
            say("--mutual=false".to_owned());
        }
        let options = self.sfm_options();
        if options.min_num_inliers != SfmOptions::default().min_num_inliers {
            say(format!("--min-inliers {}", options.min_num_inliers));
        }
        let is_guessed = parts.list.iter().any(|part| part.is_guessed);
        let all_told = parts.list.iter().all(|part| part.focal_px.is_none());
        let is_corrected = all_told && !parts.uses_camera && !options.refine_distortion;
        match (options.refine_focal, is_guessed) {
            _ if self.document.poses.is_some() => {}
            (true, false) => say("--refine-focal".to_owned()),
            (false, true) => say("--keep-focal".to_owned()),
            (false, false) if is_corrected && !options.correct_lens => {
                say("--keep-focal".to_owned());
            }
            // The default of the command is the same.
            _ => {}
        }
        if options.refine_distortion {
            say("--refine-distortion".to_owned());
        }
        say(format!("--seed {} -o sparse/0", options.seed));
        command
    }

    /// Returns a program that uses the crate `epipole`, run in the folder of the command.
    fn program(&self, parts: &Parts<'_>) -> String {
        let settings = &self.document.settings;
        let options = self.sfm_options();
        let corrects = options.correct_lens;
        let kind = match settings.features.kind {
            FeatureKind::RootSift => "RootSift",
            FeatureKind::Sift => "Sift",
        };
        let photos: String = (parts.list.iter())
            .map(|part| format!("        ({:?}, {:?}),\n", part.path, part.focal_px))
            .collect();
        let max_pixels = parts
            .max_megapixels
            .map_or_else(|| "u64::MAX".to_owned(), |_| self.max_pixels().to_string());
        let camera = self.document.camera.as_ref().filter(|_| parts.uses_camera);
        let (undistortion, imports, kinds) = match camera {
            Some(camera) => {
                let [fu, fv, cu, cv] = camera.k;
                (
                    format!(
                        "    let lens = Lens::from_coefficients(LensKind::{:?}, &{})?;\n    let camera = Camera \
                         {{\n        intrinsics: Intrinsics::new({fu:?}, {fv:?}, {cu:?}, {cv:?})?,\n        lens,\n        \
                         width: {},\n        height: {},\n    }};\n    let flat = Undistortion::new(&camera, \
                         Keep::Valid, &mut ())?;\n    let undistortion = Some(&flat);\n",
                        camera.lens,
                        listed(&camera.coefficients),
                        camera.size.0,
                        camera.size.1
                    ),
                    "use epipole::calibration::{Keep, Undistortion};\n",
                    "Camera, Intrinsics, Lens, LensKind",
                )
            }
            None => (
                "    let undistortion = None;\n".to_owned(),
                "",
                "Camera, Intrinsics",
            ),
        };
        format!(
            "//! The Lab's reconstruction, bit for bit. Needs the crates epipole, epipole-io and image 0.25.\n\n\
             {imports}use epipole::camera::{{{kinds}}};\n\
             use epipole::feature::FeatureKind;\n\
             use epipole::sfm::{{Photo, PhotoOptions, SfmOptions, reconstruct_photos}};\n\
             use epipole_io::model::Model;\nuse epipole_io::photo::{{PrepareOptions, prepare_photo}};\n\n\
             pub fn main() -> Result<(), Box<dyn std::error::Error>> {{\n    \
             // Files, and their focal lengths in pixels where they do not tell it.\n    \
             let files: [(&str, Option<f64>); {count}] = [\n{photos}    ];\n{undistortion}    \
             let prepare = PrepareOptions::default()\n        .with_max_pixels({max_pixels})\n        \
             .with_undistortion(undistortion);\n    \
             let (mut photos, mut cameras) = (Vec::new(), Vec::new());\n    \
             for (path, focal_px) in files {{\n        \
             let photo = prepare_photo(&std::fs::read(path)?, &prepare)?;\n        \
             let (width, height) = photo.image.dimensions();\n        \
             let longer = f64::from(width.max(height));\n        \
             let told_px = photo.focal_px.unwrap_or(1.2 * longer);\n        \
             let k = match (focal_px.map(|f| photo.reduced_focal_px(f)), photo.intrinsics) {{\n            \
             (Some(f), Some(k)) => Intrinsics::new(f, f, k.principal_point().x, k.principal_point().y)?,\n            \
             (Some(f), None) => Intrinsics::centered(f, width, height)?,\n            \
             (None, Some(k)) => k,\n            \
             (None, None) => Intrinsics::centered(told_px, width, height)?,\n        }};\n        \
             cameras.push(Camera::pinhole(k, width, height));\n        \
             let name = path.rsplit('/').next().unwrap_or(path).to_owned();\n        \
             photos.push(Photo {{ name, image: photo.image, ..Photo::default() }});\n    }}\n    \
             let mut how = PhotoOptions::default();\n    \
             how.features.kind = FeatureKind::{kind};\n    \
             how.features.max_features = {max_features};\n    \
             how.features.contrast_threshold = Some({contrast:?});\n    \
             how.matching.max_ratio = Some({ratio:?});\n    \
             how.matching.mutual = {mutual};\n    \
             let options = SfmOptions::default()\n        .with_min_num_inliers({enough})\n        \
             .with_refine_focal({refine_focal})\n        .with_refine_distortion({refine_distortion})\n        \
             .with_seed({seed});\n    \
             let (input, found) =\n        \
             reconstruct_photos(&photos, &cameras, &how, &options, &mut ())?;\n    \
             let {mutable}largest = found.components.{first}.ok_or(\"no two photographs show enough of the same thing\")?;\n    \
             {correction}\
             let model = Model::from_reconstruction({of}largest, &input.images);\n    \
             std::fs::create_dir_all(\"sparse/0\")?;\n    \
             for file in model.to_colmap_text()? {{\n        \
             std::fs::write(format!(\"sparse/0/{{}}\", file.name), file.bytes)?;\n    }}\n    \
             println!(\"{{}} of {{}} photographs, {{}} points\", largest.num_registered(), photos.len(), largest.points.len());\n    \
             Ok(())\n}}\n",
            mutable = if corrects { "mut " } else { "" },
            first = if corrects {
                "into_iter().next()"
            } else {
                "first()"
            },
            of = if corrects { "&" } else { "" },
            correction = match corrects {
                true => "largest.refine_lenses(&input.images, &mut ())?;\n    ",
                false => "",
            },
            count = parts.list.len(),
            max_features = settings.features.max_features,
            contrast = settings.features.contrast,
            ratio = settings.matching.ratio,
            mutual = settings.matching.mutual,
            enough = options.min_num_inliers,
            refine_focal = options.refine_focal,
            refine_distortion = options.refine_distortion,
            seed = options.seed,
        )
    }
}

/// Quotes a word for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+,@%".contains(c);
    match word.chars().all(is_plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_quoted_where_a_shell_would_take_them_apart() {
        assert_eq!(quoted("images/a-1.jpg"), "images/a-1.jpg");
        assert_eq!(quoted("my photo.jpg"), "'my photo.jpg'");
        assert_eq!(quoted("it's $(x).jpg"), "'it'\\''s $(x).jpg'");
        assert_eq!(quoted("größe.jpg"), "größe.jpg");
    }
}
