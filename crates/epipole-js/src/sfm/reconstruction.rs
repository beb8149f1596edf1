//! Cameras and points from matches between photos.

use super::photos::photos;
use crate::functions::functions;
use crate::images::Rgb;
use crate::options::Options;
use crate::output::{Bytes, Indices, Numbers, Output, Text, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, PosedCamera};
use epipole::sfm::{
    self, PairMatches, PhotoOptions, Reconstruction, SfmImage, SfmInput, SfmOptions, SfmResult,
    SfmStep,
};

structs! {
    /// Reconstruction of photos.
    struct PhotoReconstruction as PhotoReconstruction {
        /// Keypoints of each photo.
        images: Vec<SfmImage>,
        /// Matches between photos.
        pairs: Vec<PairMatches>,
        /// Cameras and points.
        result: SfmResult,
    }

    /// Result of structure from motion.
    struct Outcome as SfmResult {
        /// Reconstructions that could not be connected, largest first; each has its own frame.
        components: Vec<Reconstruction>,
        /// Indices of photos that are in none.
        unregistered: Indices,
        /// Steps taken, in order.
        steps: Vec<SfmStep>,
    }

    /// Cameras and points in one frame.
    struct Scene as Reconstruction {
        /// Camera of each photo; null if it is not registered.
        cameras: Vec<Option<PosedCamera>>,
        /// Points in the world, interleaved.
        points: Numbers,
        /// Mean color of the keypoints of each point, 3 bytes each.
        colors: Bytes,
        /// Root mean square of the reprojection errors of each point, pixels.
        errors_px: Numbers,
        /// Index of the point of each observation.
        observation_point: Indices,
        /// Index of the photo of each observation.
        observation_image: Indices,
        /// Index of the keypoint of each observation.
        observation_keypoint: Indices,
        /// Whether it stands where the known positions of its photos are.
        is_placed: bool,
    }

    /// Step of structure from motion.
    struct Step as SfmStep {
        /// Kind: started, registered or adjusted.
        kind: Text,
        /// The two photos that started a component, the registered one, or none.
        images: Indices,
        /// Number of registered photos of the component; null unless one was registered.
        num_registered: Option<usize>,
        /// Number of points of the component; null after an adjustment.
        num_points: Option<usize>,
        /// Half the sum of the losses after the refinement, square pixels; null without one.
        cost: Option<f64>,
    }
}

impl Output for SfmResult {
    fn typescript(types: &mut Types) -> String {
        Outcome::typescript(types)
    }

    fn into_value(self) -> Value {
        let outcome = Outcome {
            components: self.components,
            unregistered: Indices(self.unregistered),
            steps: self.steps,
        };
        outcome.into_value()
    }
}

impl Output for Reconstruction {
    fn typescript(types: &mut Types) -> String {
        Scene::typescript(types)
    }

    fn into_value(self) -> Value {
        let positions: Vec<_> = self.points.iter().map(|point| point.position).collect();
        let observations = || {
            let points = self.points.iter().enumerate();
            points.flat_map(|(index, point)| {
                point
                    .track
                    .iter()
                    .map(move |observations| (index, observations))
            })
        };
        let scene = Scene {
            points: Numbers::of_points(&positions),
            colors: Bytes(self.points.iter().flat_map(|point| point.color).collect()),
            errors_px: Numbers(self.points.iter().map(|point| point.error_px).collect()),
            observation_point: Indices(observations().map(|(point, _)| point).collect()),
            observation_image: Indices(
                observations()
                    .map(|(_, observations)| observations.image as usize)
                    .collect(),
            ),
            observation_keypoint: Indices(
                observations()
                    .map(|(_, observations)| observations.keypoint as usize)
                    .collect(),
            ),
            is_placed: self.is_placed,
            cameras: self.cameras,
        };
        scene.into_value()
    }
}

impl Output for SfmStep {
    fn typescript(types: &mut Types) -> String {
        Step::typescript(types)
    }

    fn into_value(self) -> Value {
        let (kind, images, num_registered, num_points) = match self {
            Self::Started { images, num_points } => {
                ("started", images.to_vec(), None, Some(num_points))
            }
            Self::Registered {
                image,
                num_registered,
                num_points,
                ..
            } => {
                let (registered, points) = (Some(num_registered), Some(num_points));
                ("registered", vec![image], registered, points)
            }
            _ => ("adjusted", Vec::new(), None, None),
        };
        let step = Step {
            kind: Text(kind.to_owned()),
            images: Indices(images),
            num_registered,
            num_points,
            cost: self.cost(),
        };
        step.into_value()
    }
}

functions! {
    /// Cameras and points from keypoints and matches: incremental structure from motion. `cameras`
    /// has one camera for each photo, or one for all.
    fn reconstruct(
        images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>,
        options: Options<SfmOptions>; monitor
    ) -> SfmResult {
        sfm::reconstruct(&SfmInput { images, cameras, pairs }, &options.0, monitor)?
    }

    /// Cameras and points from photos: `matchPhotos` with `photoOptions`, then `reconstruct`.
    fn reconstruct_photos(
        photos: Vec<Rgb>, cameras: Vec<Camera>, photo_options: Options<PhotoOptions>,
        options: Options<SfmOptions>; monitor
    ) -> PhotoReconstruction {
        let photos = self::photos(photos);
        let (input, result) = sfm::reconstruct_photos(
            &photos, &cameras, &photo_options.0, &options.0, monitor,
        )?;
        PhotoReconstruction { images: input.images, pairs: input.pairs, result }
    }
}
