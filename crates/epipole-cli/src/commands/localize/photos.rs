//! New photos of `epipole localize`.

use super::arguments::Arguments;
use super::known::Known;
use crate::camera::sentence;
use crate::context::Context;
use crate::failure::Failure;
use crate::known_camera::check_visible_part;
use crate::lens;
use crate::listing::Listed;
use crate::photo::Photo;
use crate::progress::Progress;
use epipole::Error;
use epipole::camera::{Camera, RigidTransform};
use epipole::sfm::{LocalizeOptions, PhotoFeatures, SfmImage};
use nalgebra::Point3;

/// A photo with its camera and features.
pub(super) struct NewPhoto {
    pub(super) name: String,
    pub(super) camera: Camera,
    features: PhotoFeatures,
}

/// A pose in the model.
pub(super) struct Localized {
    pub(super) cam_from_world: RigidTransform,
    pub(super) num_inliers: usize,
    pub(super) num_matches: usize,
}

impl Localized {
    pub(super) fn center(&self) -> [f64; 3] {
        let center = self
            .cam_from_world
            .inverse_transform_point(&Point3::origin());
        [center.x, center.y, center.z]
    }
}

/// Returns the camera of a model with the size of a photo, or else the only one with its shape,
/// because the model may have downscaled images.
fn of_model(
    cameras: &[Camera],
    size: (u32, u32),
    name: &str,
    context: &Context,
) -> Result<Option<Camera>, Failure> {
    let size_of = |camera: &Camera| (camera.width, camera.height);
    if let Some(camera) = cameras.iter().find(|camera| size_of(camera) == size) {
        return Ok(Some(*camera));
    }
    let (width, height) = (f64::from(size.0), f64::from(size.1));
    // Sides of downscaled images are rounded.
    let has_shape = |camera: &&Camera| {
        let scale = f64::from(camera.width) / width;
        (height * scale - f64::from(camera.height)).abs() <= 0.5 + scale / 2.0
    };
    let mut shaped = cameras.iter().filter(has_shape);
    let (Some(camera), None) = (shaped.next(), shaped.next()) else {
        return Ok(None);
    };
    context.warn(&format!(
        "{name}: taking the camera of the model, which is of {} × {}, for {} × {}",
        camera.width, camera.height, size.0, size.1
    ));
    Ok(Some(Camera {
        width: size.0,
        height: size.1,
        intrinsics: camera.intrinsics.resized(size_of(camera), size)?,
        lens: camera.lens,
    }))
}

impl NewPhoto {
    /// Reads a photo and finds its features.
    ///
    /// * `cameras`: cameras of the model, among them perhaps that of the photo
    ///
    /// # Errors
    /// A failure that names the file.
    pub(super) fn read(
        arguments: &Arguments,
        listed: &Listed,
        cameras: &[Camera],
        context: &Context,
    ) -> Result<Self, Failure> {
        let path = &listed.path;
        let own = match &arguments.camera_file {
            Some(file) => {
                let camera = lens::read(file, Some(path))?;
                check_visible_part(&camera, context)?;
                Some(camera)
            }
            None if arguments.camera.is_set() => None,
            None => match lens::size_of(path) {
                Some(size) => of_model(cameras, size, &listed.name, context)?,
                None => None,
            },
        };
        let photo = match &own {
            Some(camera) => Photo::by_camera(path, arguments.size, camera, context)?,
            None => Photo::prepared(path, arguments.size, None, context)?,
        };
        if arguments.camera_file.is_some() && photo.lens.is_none() {
            let message = "the camera of --camera was calibrated for another size";
            return Err(Failure::new("size-mismatch", message).about(path));
        }
        let (k, guess) = arguments.camera.or_guess(&photo)?;
        if let Some(sentence) = sentence(guess.as_slice()) {
            context.warn(&format!("{}: {sentence}", listed.name));
        }
        let found = arguments.features.detect(&photo, context)?;
        Ok(Self {
            name: listed.name.clone(),
            camera: photo.camera(k),
            features: PhotoFeatures {
                image: SfmImage {
                    keypoints: found.keypoints.iter().map(|k| k.point()).collect(),
                    ..SfmImage::default()
                },
                descriptors: found.descriptors,
                keypoints: Vec::new(),
            },
        })
    }

    /// Returns the pose in a model, or the reason why there is none.
    ///
    /// # Errors
    /// After Ctrl-C.
    pub(super) fn localize(
        &self,
        arguments: &Arguments,
        known: &Known,
        context: &Context,
    ) -> Result<Result<Localized, String>, Failure> {
        let options = LocalizeOptions::default()
            .with_matching(arguments.matching.options())
            .with_ransac(arguments.robust.options(context))
            .with_min_num_inliers(arguments.min_inliers);
        let progress = Progress::new(context, "localization");
        let found = known.reconstruction.localize(
            &known.features,
            &self.features,
            &self.camera,
            &options,
            &mut |status| progress.show(status),
        );
        match found {
            Ok(found) => Ok(Ok(Localized {
                cam_from_world: found.cam_from_world,
                num_inliers: found.inliers.len(),
                num_matches: found.num_matches,
            })),
            Err(Error::Canceled) => Err(Error::Canceled.into()),
            Err(error) => Ok(Err(error.to_string())),
        }
    }
}
