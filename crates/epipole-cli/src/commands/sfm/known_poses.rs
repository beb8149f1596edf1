//! `epipole sfm --poses`: points from photos with the cameras of a model.

use super::arguments::Arguments;
use super::output::{LeftOut, images_json, write_model};
use crate::context::Context;
use crate::failure::Failure;
use crate::listing::Listed;
use crate::model;
use crate::model_images::{in_frame_of_camera, resized};
use crate::output_folder::OutputFolder;
use crate::progress::Progress;
use crate::report::Report;
use epipole::camera::{Camera, RigidTransform};
use epipole::progress::Part;
use epipole::sfm::{Photo, Reconstruction, SfmInput, match_photos, triangulate_tracks};
use epipole_io::model::{Model, ModelImage};
use serde_json::json;
use std::path::Path;

/// Fraction of the work after which all photos are matched.
const MATCHED: f32 = 0.95;

/// Maximum mean error of points with correct poses, relative to the maximum error kept; with wrong
/// matches it is about 0.5.
const MAX_MEAN_ERROR: f64 = 0.3;

/// Photos whose poses a model has.
struct Known {
    photos: Vec<Photo>,
    cameras: Vec<Camera>,
    cam_from_world: Vec<Option<RigidTransform>>,
    left_out: Vec<LeftOut>,
}

pub(super) fn run(
    arguments: &Arguments,
    path: &Path,
    mut output: OutputFolder,
    context: &Context,
) -> Result<Report, Failure> {
    let model = model::read(path)?.model;
    let known = read(arguments, &model, path, context)?;
    let options = (arguments.growth).options(&arguments.robust, context, false);
    let photo_options = arguments.photo_options(&options);
    let progress = Progress::new(context, "points");
    let watch = &mut |status| progress.show(status);
    let part = &mut Part::new(watch, 0.0, MATCHED);
    let (images, pairs) = match_photos(&known.photos, &photo_options, part)?;
    let input = SfmInput {
        images,
        cameras: known.cameras,
        pairs,
    };
    let part = &mut Part::new(watch, MATCHED, 1.0);
    let found = triangulate_tracks(&input, &known.cam_from_world, &options, part)?;
    drop(progress);
    if found.points.is_empty() {
        let message =
            "no match fits the poses: are they those of these images, and cam_from_world?";
        return Err(Failure::new("no-consensus", message).about(path));
    }
    warn_of_few(&found, &input, options.min_num_inliers, context);
    let mean_px = found.mean_reprojection_px(&input.images);
    if mean_px > MAX_MEAN_ERROR * options.max_reprojection_error_px {
        context.warn(&format!(
            "the points are {mean_px:.2} px off on average, nearly as points of wrong matches are: the poses may be \
             imprecise, those of other images, or world from camera"
        ));
    }
    let written = write_model(&mut output, "", &found, &input.images)?;
    output.finish_anew()?;
    let num_images = known.photos.len() + known.left_out.len();
    let (num_registered, num_points) = (found.num_registered(), found.points.len());
    let component = json!({ "num_registered": num_registered, "num_points": num_points });
    let mut report = Report::default()
        .row("with poses", format!("{num_registered} of {num_images}"))
        .row("points", num_points)
        .row("mean reprojection error", format!("{mean_px:.3} px"));
    for left_out in &known.left_out {
        report = report.row(&format!("without {}", left_out.name), &left_out.reason);
    }
    Ok(report
        .row("written", written.join(", "))
        .field("focal_refined", false)
        .field("focal_determined", None::<bool>)
        .field("lens_refined", false)
        .field("num_registered", num_registered)
        .field("num_images", num_images)
        .field("num_points", num_points)
        .field("mean_reprojection_px", mean_px)
        .field("images", images_json(&input.images, &found))
        .field("unregistered", &known.left_out)
        .field("components", [component])
        .field("complete", true))
}

fn read(
    arguments: &Arguments,
    model: &Model,
    path: &Path,
    context: &Context,
) -> Result<Known, Failure> {
    let listed = (arguments.input.listing).photos(&arguments.input.photos, context)?;
    let mut known = Known {
        photos: Vec::new(),
        cameras: Vec::new(),
        cam_from_world: Vec::new(),
        left_out: Vec::new(),
    };
    for photo in listed {
        let Some(image) = image_of(model, &photo) else {
            let reason = format!("it has no pose in {}", path.display());
            let name = photo.name;
            known.left_out.push(LeftOut { name, reason });
            continue;
        };
        let camera = &model.cameras[image.camera];
        let pixels = in_frame_of_camera(camera, &photo.path, arguments.input.size, context)?;
        known.cameras.push(resized(camera, pixels.dimensions())?);
        known.cam_from_world.push(Some(image.cam_from_world));
        known.photos.push(Photo {
            name: photo.name,
            image: pixels,
            lens: image.camera,
            ..Photo::default()
        });
    }
    let num_known = known.photos.len();
    if num_known < 2 {
        let num_poses = num_known + known.left_out.len();
        let message = match model.images.first() {
            None => "it has no images with poses, only points".to_owned(),
            Some(_) if known.left_out.is_empty() => {
                format!("points need at least two images, but the input has {num_poses}")
            }
            Some(first) => format!(
                "it has poses of {num_known} of the {num_poses} images, and two are needed: its images have other \
                 names, such as {}",
                first.name
            ),
        };
        return Err(Failure::new("too-few", message).about(path));
    }
    if num_known < model.images.len() {
        context.warn(&format!(
            "{} of {} images of the model are not among the input images",
            model.images.len() - num_known,
            model.images.len()
        ));
    }
    Ok(known)
}

/// Returns the image of a photo, by its name or by a file name that is unique.
fn image_of<'a>(model: &'a Model, photo: &Listed) -> Option<&'a ModelImage> {
    let images = &model.images;
    let file = photo.path.file_name();
    let mut of_file = (images.iter()).filter(|image| Path::new(&image.name).file_name() == file);
    let exact = images.iter().find(|image| image.name == photo.name);
    exact.or_else(|| of_file.next().filter(|_| of_file.next().is_none()))
}

/// Warns of photos that see few points, whose poses may belong to others.
fn warn_of_few(found: &Reconstruction, input: &SfmInput, few: usize, context: &Context) {
    let mut counts = vec![0; input.images.len()];
    for element in found.points.iter().flat_map(|point| &point.track) {
        counts[element.image as usize] += 1;
    }
    let poor: Vec<_> = (input.images.iter().zip(&counts))
        .filter(|(_, count)| **count < few)
        .collect();
    if let Some((first, count)) = poor.first() {
        context.warn(&format!(
            "{} of {} images see fewer than {few} points, such as {} ({count}): they overlap too little, or their \
             poses are those of other images",
            poor.len(),
            input.images.len(),
            first.name
        ));
    }
}
