//! Images of a model.

use crate::context::Context;
use crate::failure::Failure;
use crate::photo::Photo;
use crate::reading::SizeArguments;
use epipole::camera::Camera;
use image::RgbImage;
use std::path::{Path, PathBuf};

/// Largest difference between the shapes of an image and its camera.
const SAME_SHAPE: f64 = 0.01;

/// The folder of a model's images.
pub(crate) struct ImageFolder(pub(crate) PathBuf);

impl ImageFolder {
    /// Returns the given folder, or `images` of the project, whose model is in `.`, `sparse` or
    /// `sparse/0`.
    ///
    /// * `option`: the option that names the folder
    ///
    /// # Errors
    /// If there is none.
    pub(crate) fn find(
        folder_option: Option<&Path>,
        model: &Path,
        option: &str,
    ) -> Result<Self, Failure> {
        let beside = || {
            let folder = match model.is_dir() {
                true => model,
                false => model.parent()?,
            };
            let folder = folder.canonicalize().ok()?;
            let mut candidates = (folder.ancestors().take(3)).map(|folder| folder.join("images"));
            candidates.find(|folder| folder.is_dir())
        };
        let found = folder_option
            .map(Path::to_path_buf)
            .or_else(beside)
            .map(Self);
        found.ok_or_else(|| {
            let message = format!("there is no folder images beside the model: give {option}");
            Failure::usage(message).about(model)
        })
    }

    /// Returns the file of an image, by its name in the model or the last part of that name.
    pub(crate) fn file_of(&self, name: &str) -> Option<PathBuf> {
        let last = Path::new(name).file_name()?;
        let candidates = [self.0.join(name), self.0.join(last)];
        candidates.into_iter().find(|path| path.is_file())
    }

    /// Warns of images that are not in the folder.
    ///
    /// * `num_images`: of the model
    ///
    /// # Errors
    /// If none is.
    pub(crate) fn warn_of_missing(
        &self,
        missing: &[&str],
        num_images: usize,
        context: &Context,
    ) -> Result<(), Failure> {
        let Some(first) = missing.first() else {
            return Ok(());
        };
        if missing.len() == num_images {
            let message =
                format!("none of the model's {num_images} images is there, such as {first}");
            return Err(Failure::new("read", message).about(&self.0));
        }
        context.warn(&format!(
            "{} of {num_images} images of the model are not in {}, such as {first}",
            missing.len(),
            self.0.display()
        ));
        Ok(())
    }
}

/// Reads an image in the frame of its camera: upright, or as stored.
///
/// # Errors
/// A failure naming the file, if it cannot be read or has another shape than its camera.
pub(crate) fn in_frame_of_camera(
    camera: &Camera,
    path: &Path,
    size: SizeArguments,
    context: &Context,
) -> Result<RgbImage, Failure> {
    let fits = |width: u32, height: u32| {
        let shape = f64::from(width) / f64::from(height);
        (shape * f64::from(camera.height) / f64::from(camera.width) - 1.0).abs() < SAME_SHAPE
    };
    let photo = Photo::prepared(path, size, None, context)?;
    if fits(photo.color.width(), photo.color.height()) {
        return Ok(photo.color);
    }
    let (width, height) = photo.sensor_size;
    if fits(width, height) {
        return Photo::of_sensor(path, size.reading, context);
    }
    let message = format!(
        "the image is {width} × {height}, and its camera in the model {} × {}",
        camera.width, camera.height
    );
    Err(Failure::new("size-mismatch", message).about(path))
}

/// Returns the camera for an image of another size.
///
/// # Errors
/// For a camera or an image without pixels.
pub(crate) fn resized(camera: &Camera, to: (u32, u32)) -> Result<Camera, Failure> {
    let from = (camera.width, camera.height);
    Ok(Camera {
        intrinsics: camera.intrinsics.resized(from, to)?,
        lens: camera.lens,
        width: to.0,
        height: to.1,
    })
}
