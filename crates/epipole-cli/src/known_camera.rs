//! Calibrated camera of photos, from a file.

use crate::camera::PairArguments;
use crate::context::Context;
use crate::failure::Failure;
use crate::lens;
use crate::listing::file_name;
use crate::photo::Photo;
use crate::reading::SizeArguments;
use clap::Args;
use epipole::camera::Camera;
use nalgebra::Point2;
use std::path::{Path, PathBuf};

/// Fraction of a photo without rays that exceeds the corners around a fisheye's circle.
const MUCH_UNSEEN: f64 = 0.3;
/// Fraction of a photo without rays that shows a file of another camera.
const MOST_UNSEEN: f64 = 0.75;

/// Warns if a large part of the photos has no rays in the lens model.
///
/// # Errors
/// If that part is more than three quarters.
pub(crate) fn check_visible_part(camera: &Camera, context: &Context) -> Result<(), Failure> {
    let ratio = lens::unseen_ratio(camera);
    let sentence = format!(
        "the lens model of --camera has no ray for {:.0}% of the image, where it folds",
        100.0 * ratio
    );
    if ratio > MOST_UNSEEN {
        let advice = "calibrate again with boards up to the edges, or with another --model";
        return Err(Failure::new("degenerate", format!("{sentence}; {advice}")));
    }
    if ratio > MUCH_UNSEEN {
        context.warn(&format!("{sentence}; pixels there are left out"));
    }
    Ok(())
}

/// Warns of photos that the calibrated camera was not used for.
///
/// * `others`: their names, and width and height as the sensor gave them
pub(crate) fn warn_of_others(
    camera: &Camera,
    others: &[(String, (u32, u32))],
    num_photos: usize,
    context: &Context,
) {
    let Some((name, (width, height))) = others.first() else {
        return;
    };
    let why = match (*height, *width) == (camera.width, camera.height) {
        true => "is upright, and its file has no orientation",
        false => "has another size",
    };
    context.warn(&format!(
        "the camera of --camera is used for {} of {num_photos} images: it was calibrated for {} × {}, and {name}, \
         {width} × {height}, {why}",
        num_photos - others.len(),
        camera.width,
        camera.height
    ));
}

/// Calibrated camera of two photos.
#[derive(Debug, Clone, Args)]
pub(crate) struct CameraFile {
    /// Camera file (FILE#NAME: one of several) of `epipole calibrate`, OpenCV, ROS, Kalibr, KITTI,
    /// ORB-SLAM, COLMAP, nerfstudio, Metashape or MATLAB, for images of its size, also rotated by
    /// 90°. Images stay distorted, and results refer to rays.
    #[arg(long = "camera", value_name = "FILE", help_heading = "Images")]
    camera_file: Option<PathBuf>,
}

impl CameraFile {
    pub(crate) fn is_set(&self) -> bool {
        self.camera_file.is_some()
    }

    /// Reads the camera without photos.
    ///
    /// # Errors
    /// As [`lens::read`].
    pub(crate) fn read_camera(&self, context: &Context) -> Result<Option<Camera>, Failure> {
        let Some(file) = &self.camera_file else {
            return Ok(None);
        };
        let camera = lens::read(file, None)?;
        check_visible_part(&camera, context)?;
        Ok(Some(camera))
    }

    /// Reads two photos and keeps their distortion.
    ///
    /// # Errors
    /// For files that cannot be read, and if neither photo is by the camera.
    pub(crate) fn read(
        &self,
        paths: [&Path; 2],
        size: SizeArguments,
        context: &Context,
    ) -> Result<[Photo; 2], Failure> {
        let Some(file) = &self.camera_file else {
            let [first, second] = paths.map(|path| Photo::prepared(path, size, None, context));
            return Ok([first?, second?]);
        };
        let camera = lens::read(file, Some(paths[0]))?;
        if lens::read_rig(file, Some(paths[0])).is_ok() {
            context.warn(&format!(
                "{} holds a rig: both images are taken to be by its first camera; epipole rectify --rig uses both \
                 cameras and their pose",
                file.display()
            ));
        }
        check_visible_part(&camera, context)?;
        let [first, second] = paths.map(|path| Photo::by_camera(path, size, &camera, context));
        let photos = [first?, second?];
        let others: Vec<(String, (u32, u32))> = (photos.iter().zip(paths))
            .filter(|(photo, _)| photo.lens.is_none())
            .map(|(photo, path)| (file_name(path), photo.sensor_size))
            .collect();
        if others.len() == 2 {
            return Err(Failure::new(
                "size-mismatch",
                format!(
                    "the camera of --camera was calibrated for {} × {}, and neither image has this size",
                    camera.width, camera.height
                ),
            ));
        }
        warn_of_others(&camera, &others, 2, context);
        Ok(photos)
    }
}

/// Returns the cameras of two photos with their lenses. Warns of a guessed focal length.
///
/// # Errors
/// As [`PairArguments::or_guess`].
pub(crate) fn known_cameras(
    arguments: &PairArguments,
    context: &Context,
    photos: &[Photo; 2],
) -> Result<[Camera; 2], Failure> {
    let ([k1, k2], guess) = arguments.or_guess(photos)?;
    if let Some(sentence) = guess {
        context.warn(&sentence);
    }
    Ok([photos[0].camera(k1), photos[1].camera(k2)])
}

/// Warns of matches with a pixel that has no ray in its lens model.
pub(crate) fn warn_of_unseen(
    cameras: [&Camera; 2],
    pixels: [&[Point2<f64>]; 2],
    context: &Context,
) {
    let is_visible = |n: usize, i: usize| cameras[n].observe(&pixels[n][i]).is_ok();
    let num_matches = pixels[0].len();
    let visible = (0..num_matches).filter(|&i| is_visible(0, i) && is_visible(1, i));
    let num_unseen = num_matches - visible.count();
    if num_unseen > 0 {
        context.warn(&format!(
            "{num_unseen} of {num_matches} matches are left out: the lens model of --camera has no rays there"
        ));
    }
}
