//! Photos of `epipole stitch`.

use super::arguments::{Arguments, Model};
use crate::context::Context;
use crate::failure::Failure;
use crate::photo::Photo;
use crate::{interrupt, lens};
use epipole::calibration::{Keep, Undistortion};
use epipole::camera::Intrinsics;
use epipole::sfm;

/// Undistorted photos and their intrinsics.
pub(super) struct Input {
    pub(super) photos: Vec<sfm::Photo>,
    /// Intrinsics, given or guessed.
    pub(super) intrinsics: Vec<Intrinsics>,
    /// Whether no focal length was guessed.
    pub(super) is_known: bool,
}

impl Input {
    /// Reads all photos.
    ///
    /// # Errors
    /// For files that cannot be read, a single photo, and options that do not fit.
    pub(super) fn read(arguments: &Arguments, context: &Context) -> Result<Self, Failure> {
        if arguments.model == Model::Homography && arguments.is_bent() {
            return Err(Failure::usage(
                "photos of a plane have no cylinder or sphere: --model homography needs --projection plane",
            ));
        }
        let listed = arguments.listing.photos(&arguments.photos, context)?;
        if listed.len() < 2 {
            return Err(Failure::usage("a panorama needs two photos at least"));
        }
        let camera = arguments.camera_file.as_ref();
        let camera = camera
            .map(|file| lens::read(file, Some(&listed[0].path)))
            .transpose()?;
        let flat = camera
            .as_ref()
            .map(|camera| Undistortion::new(camera, Keep::Valid, &mut interrupt::watch));
        let flat = flat.transpose()?;
        let mut input = Self {
            photos: Vec::new(),
            intrinsics: Vec::new(),
            is_known: true,
        };
        for listed in listed {
            let photo = Photo::prepared(&listed.path, arguments.size, flat.as_ref(), context)?;
            let (k, guess) = arguments.camera.or_guess(&photo)?;
            if flat.is_some() && photo.k.is_none() {
                let message = "the camera of --camera was calibrated for another size";
                return Err(Failure::new("size-mismatch", message).about(&listed.path));
            }
            input.is_known &= guess.is_none();
            input.intrinsics.push(k);
            input.photos.push(sfm::Photo {
                name: listed.name,
                image: photo.color,
                ..sfm::Photo::default()
            });
        }
        Ok(input)
    }
}
