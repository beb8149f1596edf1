//! Input of `epipole mvs`: the model and its images.

use super::arguments::Arguments;
use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::model_images::{ImageFolder, in_frame_of_camera, resized};
use crate::progress::Progress;
use crate::reading::SizeArguments;
use epipole::camera::Camera;
use epipole::sfm::Reconstruction;
use epipole_io::model::Model;
use image::RgbImage;

/// A model with its images.
pub(super) struct Input {
    /// Cameras have the sizes of the photos, and are `None` without a photo.
    pub(super) reconstruction: Reconstruction,
    pub(super) names: Vec<String>,
    pub(super) photos: Vec<RgbImage>,
}

impl Input {
    /// # Errors
    /// For a model without enough points or images, and for images that are missing or have another
    /// shape than their cameras.
    pub(super) fn read(
        arguments: &Arguments,
        model: &Model,
        context: &Context,
    ) -> Result<Self, Failure> {
        let about = |kind, message: &str| Err(Failure::new(kind, message).about(&arguments.model));
        if model.images.len() < 2 {
            let count = model.images.len();
            return about(
                "too-few",
                &format!("the model needs at least 2 images, but it has {count}"),
            );
        }
        let (reconstruction, _) = model.to_reconstruction()?;
        if reconstruction.points.is_empty() {
            let message = "the model has no points that two images observe, as those of `epipole sfm` and COLMAP have: \
                           they tell which photos to compare, and where";
            return about("too-few", message);
        }
        let folder = ImageFolder::find(arguments.images.as_deref(), &arguments.model, "IMAGES")?;
        let mut input = Self {
            reconstruction,
            names: model
                .images
                .iter()
                .map(|image| image.name.clone())
                .collect(),
            photos: Vec::new(),
        };
        let mut missing = Vec::new();
        let progress = Progress::new(context, "images");
        for (n, image) in model.images.iter().enumerate() {
            progress.set(n as f64 / model.images.len() as f64);
            if interrupt::requested() {
                return Err(epipole::Error::Canceled.into());
            }
            let Some(path) = folder.file_of(&image.name) else {
                missing.push(&*image.name);
                input.reconstruction.cameras[n] = None;
                input.photos.push(RgbImage::new(0, 0));
                continue;
            };
            let camera = &model.cameras[image.camera];
            let photo = in_frame_of_camera(camera, &path, size(arguments, camera), context)?;
            if let Some(posed) = &mut input.reconstruction.cameras[n] {
                posed.camera = resized(camera, photo.dimensions())?;
            }
            input.photos.push(photo);
        }
        drop(progress);
        folder.warn_of_missing(&missing, model.images.len(), context)?;
        Ok(input)
    }
}

/// Returns the size with a longer side of at most `--max-size`.
fn size(arguments: &Arguments, camera: &Camera) -> SizeArguments {
    let (width, height) = (f64::from(camera.width), f64::from(camera.height));
    let side = f64::from(arguments.max_size);
    let num_pixels = side * side * width.min(height) / width.max(height);
    SizeArguments {
        max_megapixels: Some(1e-6 * num_pixels),
        ..arguments.reading.into()
    }
}
