//! Features of a model's images, with the points they observe.

use super::arguments::Arguments;
use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::model_images::{ImageFolder, in_frame_of_camera};
use crate::progress::Progress;
use crate::reading::SizeArguments;
use epipole::camera::PosedCamera;
use epipole::feature::{detect_features, photo_to_gray};
use epipole::sfm::{PhotoFeatures, Reconstruction, ScenePoint, SfmImage, TrackElement};
use epipole_io::model::{Model, ModelImage};
use nalgebra::Point2;
use std::collections::HashMap;
use std::path::Path;

/// Maximum distance of a feature from an observation of a point, pixels.
const SAME_PX: f64 = 1.5;

/// Fraction of observations with a feature, below which the images are not those of the model.
const FEW: f64 = 0.1;

/// A model whose observations are features with descriptors.
pub(super) struct Known {
    pub(super) reconstruction: Reconstruction,
    pub(super) features: Vec<PhotoFeatures>,
    pub(super) num_observations: usize,
    pub(super) num_found_again: usize,
}

impl Known {
    /// Finds features in the images of a model and assigns them to points.
    ///
    /// # Errors
    /// For a model without observations, and for images that are missing or have another shape than
    /// their cameras.
    pub(super) fn read(
        arguments: &Arguments,
        model: &Model,
        context: &Context,
    ) -> Result<Self, Failure> {
        let about = |failure: Failure| failure.about(&arguments.model);
        if model.num_observations() == 0 {
            let message = "the model has no observations of points in images, as those of COLMAP, Bundler and openMVG \
                           have: nothing can be matched";
            return Err(about(Failure::new("too-few", message)));
        }
        let folder = ImageFolder::find(
            arguments.images.as_deref(),
            &arguments.model,
            "--images DIR",
        )?;
        let mut known = Self {
            reconstruction: Reconstruction {
                points: points_of(model),
                ..Reconstruction::default()
            },
            features: Vec::new(),
            num_observations: 0,
            num_found_again: 0,
        };
        let observed = observations_by_image(model);
        let mut missing = Vec::new();
        let progress = Progress::new(context, "features of the model");
        for (n, (image, observed)) in model.images.iter().zip(&observed).enumerate() {
            progress.set(n as f64 / model.images.len() as f64);
            if interrupt::requested() {
                return Err(epipole::Error::Canceled.into());
            }
            match folder.file_of(&image.name) {
                Some(path) => known.add(arguments, context, (model, image), observed, &path)?,
                None => missing.push(&*image.name),
            }
        }
        drop(progress);
        folder.warn_of_missing(&missing, model.images.len(), context)?;
        if (known.num_found_again as f64) < FEW * known.num_observations as f64 {
            context.warn(&format!(
                "only {} of {} observations of the model have a feature near them: are the images in {} those of the \
                 model?",
                known.num_found_again,
                known.num_observations,
                folder.0.display()
            ));
        }
        Ok(known)
    }

    /// Adds an image of the model.
    fn add(
        &mut self,
        arguments: &Arguments,
        context: &Context,
        (model, image): (&Model, &ModelImage),
        observed: &[(Point2<f64>, usize)],
        path: &Path,
    ) -> Result<(), Failure> {
        let camera = &model.cameras[image.camera];
        let num_pixels = f64::from(camera.width) * f64::from(camera.height);
        let size = SizeArguments {
            max_megapixels: Some(1e-6 * num_pixels),
            ..arguments.size
        };
        let gray = photo_to_gray(&in_frame_of_camera(camera, path, size, context)?);
        let found = detect_features(&gray, &arguments.features.options(), &mut ())?;
        let scale = [
            f64::from(camera.width) / f64::from(gray.width()),
            f64::from(camera.height) / f64::from(gray.height()),
        ];
        let keypoints: Vec<Point2<f64>> = (found.keypoints.iter())
            .map(|k| Point2::new((k.u + 0.5) * scale[0] - 0.5, (k.v + 0.5) * scale[1] - 0.5))
            .collect();
        let place = self.features.len() as u32;
        let grid = Grid::new(observed);
        let mut is_found = vec![false; observed.len()];
        for (keypoint, pixel) in keypoints.iter().enumerate() {
            if let Some(nearest) = grid.nearest(pixel) {
                is_found[nearest] = true;
                let (_, point) = observed[nearest];
                self.reconstruction.points[point].track.push(TrackElement {
                    image: place,
                    keypoint: keypoint as u32,
                });
            }
        }
        self.num_observations += observed.len();
        self.num_found_again += is_found.iter().filter(|is| **is).count();
        self.reconstruction.cameras.push(Some(PosedCamera {
            camera: *camera,
            cam_from_world: image.cam_from_world,
        }));
        self.features.push(PhotoFeatures {
            image: SfmImage {
                keypoints,
                ..SfmImage::default()
            },
            descriptors: found.descriptors,
            keypoints: Vec::new(),
        });
        Ok(())
    }
}

/// Returns the points of a model, still without observations.
fn points_of(model: &Model) -> Vec<ScenePoint> {
    let point = |point: &epipole_io::model::ModelPoint| ScenePoint {
        position: point.position,
        color: point.color,
        track: Vec::new(),
        error_px: point.error_px.unwrap_or(0.0),
    };
    model.points.iter().map(point).collect()
}

/// Returns pixel and point of each observation, by image.
fn observations_by_image(model: &Model) -> Vec<Vec<(Point2<f64>, usize)>> {
    let mut observed = vec![Vec::new(); model.images.len()];
    for (index, point) in model.points.iter().enumerate() {
        for &(image, keypoint) in &point.track {
            observed[image].push((model.images[image].keypoints[keypoint], index));
        }
    }
    observed
}

/// Observations in squares of side [`SAME_PX`].
struct Grid<'a> {
    observed: &'a [(Point2<f64>, usize)],
    cells: HashMap<(i64, i64), Vec<usize>>,
}

impl<'a> Grid<'a> {
    fn new(observed: &'a [(Point2<f64>, usize)]) -> Self {
        let mut cells: HashMap<_, Vec<usize>> = HashMap::new();
        for (index, (pixel, _)) in observed.iter().enumerate() {
            cells.entry(Self::cell(pixel)).or_default().push(index);
        }
        Self { observed, cells }
    }

    fn cell(pixel: &Point2<f64>) -> (i64, i64) {
        let index = |x: f64| (x / SAME_PX).floor() as i64;
        (index(pixel.x), index(pixel.y))
    }

    /// Returns the index of the nearest observation within [`SAME_PX`].
    fn nearest(&self, pixel: &Point2<f64>) -> Option<usize> {
        let (u, v) = Self::cell(pixel);
        let around = (-1..=1).flat_map(|dv| (-1..=1).map(move |du| (u + du, v + dv)));
        let neighbors = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        neighbors
            .map(|&index| ((self.observed[index].0 - pixel).norm(), index))
            .filter(|(distance, _)| *distance <= SAME_PX)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, index)| index)
    }
}
