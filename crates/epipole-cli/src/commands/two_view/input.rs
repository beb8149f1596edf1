//! Photos and matches of `epipole two-view`.

use super::arguments::{Arguments, Model};
use crate::context::Context;
use crate::failure::Failure;
use crate::features::matched_pixels;
use crate::match_file;
use crate::photo::Photo;
use crate::units::{warn_of_fractions, warn_of_units};
use nalgebra::Point2;

/// Two photos and their matches.
pub(super) struct Input {
    /// The photos, without pixels if only matches are given.
    pub(super) photos: [Photo; 2],
    pub(super) pixels: [Vec<Point2<f64>>; 2],
    /// `None` for matches of a file.
    pub(super) nums_keypoints: Option<[usize; 2]>,
}

impl Input {
    /// Reads the photos and the matches, or matches features.
    ///
    /// # Errors
    /// A failure that names the file, or intrinsics that only a photo provides.
    pub(super) fn read(arguments: &Arguments, context: &Context) -> Result<Self, Failure> {
        let photos = match (&arguments.first, &arguments.second) {
            (Some(first), Some(second)) => {
                (arguments.known).read([first, second], arguments.size, context)?
            }
            _ => without_photos(arguments, context)?,
        };
        if let Some(path) = &arguments.matches {
            let pixels = match_file::matches(path)?;
            let known = match arguments.camera.explicit(&photos)? {
                Some(known) => known.map(Some),
                None => photos.each_ref().map(|photo| photo.k),
            };
            for (pixels, known) in pixels.iter().zip(known) {
                match known {
                    Some(k) => warn_of_units(pixels, &k, context),
                    None => {
                        let max_error_px = arguments.robust.options(context).max_error_px;
                        warn_of_fractions(&[pixels], max_error_px, context);
                    }
                }
            }
            return Ok(Self {
                photos,
                pixels,
                nums_keypoints: None,
            });
        }
        let found1 = arguments.features.detect(&photos[0], context)?;
        let found2 = arguments.features.detect(&photos[1], context)?;
        let matches = arguments.matching.run_best_first(&found1, &found2)?;
        Ok(Self {
            photos,
            pixels: matched_pixels(&matches, &found1, &found2),
            nums_keypoints: Some([found1.keypoints.len(), found2.keypoints.len()]),
        })
    }
}

fn without_photos(arguments: &Arguments, context: &Context) -> Result<[Photo; 2], Failure> {
    if arguments.camera.has_focal_only() {
        return Err(Failure::usage(
            "--focal-px has the principal point in the middle of a photo: give both photos, or --k fx,fy,cx,cy",
        ));
    }
    let is_known = arguments.known.is_set() || arguments.camera.is_set();
    if arguments.model == Model::Essential && !is_known {
        return Err(Failure::usage(
            "an essential matrix needs --k fx,fy,cx,cy or --camera where there are no photos",
        ));
    }
    let camera = arguments.known.read_camera(context)?;
    Ok([
        Photo::without_pixels(camera.as_ref()),
        Photo::without_pixels(camera.as_ref()),
    ])
}
