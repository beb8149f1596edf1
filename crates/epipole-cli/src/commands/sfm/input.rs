//! Photos of `epipole sfm`, with the known parts of their cameras.

use crate::camera::{CameraArguments, Guess, of_focal};
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::{check_visible_part, warn_of_others};
use crate::listing::{Listed, ListingArguments};
use crate::photo::{Photo, RetainedLens};
use crate::reading::SizeArguments;
use crate::{interrupt, lens};
use clap::Args;
use epipole::calibration::{Keep, Undistortion};
use epipole::camera::Camera;
use epipole::math::Geodetic;
use epipole::sfm::Photo as SfmPhoto;
use std::path::PathBuf;

/// Photos and cameras.
#[derive(Debug, Args)]
pub(super) struct InputArguments {
    /// Images, or a folder of them.
    #[arg(required = true, value_name = "FILES|FOLDER")]
    pub(super) photos: Vec<PathBuf>,
    #[command(flatten)]
    camera: CameraArguments,
    /// Focal length of each image, pixels of its file, in order and separated by commas; "-" for
    /// one from --camera or EXIF data, or for a guess.
    #[arg(long, value_name = "F,F,…", value_delimiter = ',', value_parser = focal, allow_hyphen_values = true, conflicts_with_all = ["k", "focal_px"])]
    focals_px: Vec<Focal>,
    /// Camera file (FILE#NAME: one of several) of `epipole calibrate`, OpenCV, ROS, Kalibr, KITTI,
    /// ORB-SLAM, COLMAP, nerfstudio, Metashape or MATLAB, for images of its size, also rotated by
    /// 90°. Images stay distorted, and cameras.txt has the lens.
    #[arg(long = "camera", value_name = "FILE", conflicts_with = "k")]
    camera_file: Option<PathBuf>,
    /// Undistort the images of --camera first. cameras.txt then has pinhole cameras, for programs
    /// that support no others. The border of a fisheye image is lost.
    #[arg(long, requires = "camera_file")]
    undistort: bool,
    /// Take cameras and poses from a model, matched by image names, and only find points.
    #[arg(long, value_name = "MODEL", conflicts_with_all = ["k", "focal_px", "focals_px", "camera_file", "images",
        "positions", "lenses", "refine_focal", "keep_focal", "refine_principal_point", "refine_distortion",
        "refine_tangential"])]
    pub(super) poses: Option<PathBuf>,
    #[command(flatten)]
    pub(super) listing: ListingArguments,
    #[command(flatten)]
    pub(super) size: SizeArguments,
}

/// A focal length in pixels, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Focal(Option<f64>);

fn focal(text: &str) -> Result<Focal, String> {
    match text {
        "-" => Ok(Focal(None)),
        _ => crate::matrices::positive(text).map(|focal_px| Focal(Some(focal_px))),
    }
}

/// Input that was read.
pub(super) struct Input {
    pub(super) photos: Vec<SfmPhoto>,
    pub(super) cameras: Vec<Camera>,
    /// Lenses of the photos that keep their distortion.
    pub(super) lenses: Vec<Option<RetainedLens>>,
    /// Positions from the files of the photos.
    pub(super) places: Vec<Option<Geodetic>>,
    /// Guessed focal lengths.
    pub(super) guesses: Vec<Guess>,
    pub(super) used: Vec<Used>,
}

/// File of a photo.
pub(super) struct Used {
    pub(super) listed: Listed,
    /// Whether the file has exactly the pixels used: not rotated, resampled or downscaled.
    pub(super) is_as_stored: bool,
}

impl InputArguments {
    /// Reads all photos.
    ///
    /// # Errors
    /// For files that cannot be read and numbers that do not fit.
    pub(super) fn read(&self, context: &Context) -> Result<Input, Failure> {
        let listed = self.listing.photos(&self.photos, context)?;
        if !self.focals_px.is_empty() && self.focals_px.len() != listed.len() {
            return Err(Failure::usage(format!(
                "--focals-px needs one for each image, but there are {} for {}",
                self.focals_px.len(),
                listed.len()
            )));
        }
        let camera = self.camera_file.as_ref();
        let first = listed.first().map(|one| one.path.as_path());
        let camera = camera.map(|file| lens::read(file, first)).transpose()?;
        let flat = (camera.as_ref())
            .filter(|_| self.undistort)
            .map(|camera| Undistortion::new(camera, Keep::Valid, &mut interrupt::watch));
        let flat = flat.transpose()?;
        if let (Some(camera), None) = (&camera, &flat) {
            check_visible_part(camera, context)?;
        }
        let mut input = Input {
            photos: Vec::new(),
            cameras: Vec::new(),
            lenses: Vec::new(),
            places: Vec::new(),
            guesses: Vec::new(),
            used: Vec::new(),
        };
        let (mut sizes, mut others) = (Vec::new(), Vec::new());
        let num_photos = listed.len();
        for (index, listed) in listed.into_iter().enumerate() {
            let path = &listed.path;
            let photo = match &camera {
                Some(camera) if flat.is_none() => {
                    Photo::by_camera(path, self.size, camera, context)?
                }
                _ => Photo::prepared(path, self.size, flat.as_ref(), context)?,
            };
            let (k, guess) = match self.focals_px.get(index) {
                Some(Focal(Some(focal_px))) => (of_focal(*focal_px, &photo)?, None),
                _ => self.camera.or_guess(&photo)?,
            };
            if photo.k.is_none() {
                others.push((listed.name.clone(), photo.sensor_size));
            }
            sizes.push(photo.full_size);
            input.guesses.extend(guess);
            input.cameras.push(photo.camera(k));
            input.lenses.push(photo.lens);
            input.places.push(photo.place);
            input.photos.push(SfmPhoto {
                name: listed.name.clone(),
                image: photo.color,
                ..SfmPhoto::default()
            });
            input.used.push(Used {
                listed,
                is_as_stored: photo.is_as_stored,
            });
        }
        if let Some(camera) = &camera {
            warn_of_others(camera, &others, num_photos, context);
        }
        if self.camera.k.is_some()
            && let Some(place) = sizes.iter().position(|size| *size != sizes[0])
        {
            let ((w, h), (w0, h0)) = (sizes[place], sizes[0]);
            context.warn(&format!(
                "--k is used for images of different sizes: {} is {w} × {h}, the first one {w0} × {h0}",
                input.photos[place].name
            ));
        }
        Ok(input)
    }
}
