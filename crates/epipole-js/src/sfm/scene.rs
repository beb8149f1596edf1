//! Cameras and points that the caller passes back.

use super::alignment::Similarity;
use crate::argument::{Argument, Vectors, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::images::colors;
use crate::options::{NoOptions, Setting};
use crate::output::{Indices, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::PosedCamera;
use epipole::sfm::{Bundle, Reconstruction, ScenePoint, SfmImage, TrackElement};

/// Color of points without one.
const GRAY: [u8; 3] = [128; 3];

structs! {
    /// Reconstruction after the correction of its lenses.
    struct RefinedLenses as RefinedLenses {
        /// Cameras and points.
        reconstruction: Reconstruction,
        /// Whether they changed.
        is_refined: bool,
    }

    /// Reconstruction as a bundle.
    struct BundleOfImages as ReconstructionBundle {
        /// Cameras, points and observations.
        bundle: Bundle,
        /// Index of the photo of each camera.
        image_of_camera: Indices,
    }
}

impl Argument for Reconstruction {
    fn typescript(types: &mut Types) -> String {
        let cameras = <Vec<Option<PosedCamera>> as Argument>::typescript(types);
        let points = Vectors::<3>::typescript(types);
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "ReconstructionLike",
            "Cameras and points in one frame.",
            &[
                (
                    "cameras",
                    &cameras,
                    "Camera of each photo; null if it is not registered.",
                ),
                ("points", &points, "Points in the world."),
                (
                    "colors?",
                    "Uint8Array | Uint8ClampedArray",
                    "Color of each point, 3 bytes each. Gray if not given.",
                ),
                (
                    "errorsPx?",
                    "ArrayLike<number>",
                    "Root mean square of the reprojection errors of each point. 0 if not given.",
                ),
                (
                    "observationPoint",
                    &indices,
                    "Index of the point of each observation.",
                ),
                (
                    "observationImage",
                    &indices,
                    "Index of the photo of each observation.",
                ),
                (
                    "observationKeypoint",
                    &indices,
                    "Index of the keypoint of each observation.",
                ),
                (
                    "isPlaced?",
                    "boolean",
                    "Whether it stands where the known positions of its photos are. False if not \
                     given.",
                ),
            ],
        );
        "ReconstructionLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let keys = [
            "cameras",
            "points",
            "colors",
            "errorsPx",
            "observationPoint",
            "observationImage",
            "observationKeypoint",
            "isPlaced",
        ];
        check_keys(name, value, &keys)?;
        let cameras: Vec<Option<PosedCamera>> = entry(name, value, "cameras")?;
        let positions = entry::<Vectors<3>>(name, value, "points")?.points();
        let count = positions.len();
        let colors = colors(name, value, "point")?.unwrap_or_else(|| vec![GRAY; count]);
        let errors = match entry::<Option<Vectors<1>>>(name, value, "errorsPx")? {
            Some(errors) => errors.0.iter().map(|error| error[0]).collect(),
            None => vec![0.0; count],
        };
        for (key, got) in [("colors", colors.len()), ("errorsPx", errors.len())] {
            if got != count {
                return Err(Fault::of_range(format!(
                    "{name}.{key} must have {count} entries, as many as points, but has {got}"
                )));
            }
        }
        let parts = positions.into_iter().zip(colors).zip(errors);
        let mut points: Vec<ScenePoint> = parts
            .map(|((position, color), error_px)| ScenePoint {
                position,
                color,
                error_px,
                track: Vec::new(),
            })
            .collect();
        fill_tracks(name, value, cameras.len(), &mut points)?;
        let is_placed = entry::<Option<Setting<bool>>>(name, value, "isPlaced")?;
        Ok(Self {
            cameras,
            is_placed: is_placed.is_some_and(|flag| flag.0),
            points,
        })
    }
}

fn fill_tracks(
    name: &str,
    value: &Value,
    num_images: usize,
    points: &mut [ScenePoint],
) -> Result<()> {
    let column = |key| -> Result<Vec<usize>> { Ok(entry::<Indices>(name, value, key)?.0) };
    let of_point = column("observationPoint")?;
    let (images, keypoints) = (column("observationImage")?, column("observationKeypoint")?);
    for (key, got) in [
        ("observationImage", images.len()),
        ("observationKeypoint", keypoints.len()),
    ] {
        if got != of_point.len() {
            return Err(Fault::of_range(format!(
                "{name}.{key} must have {} numbers, as many as observationPoint, but has {got}",
                of_point.len()
            )));
        }
    }
    let num_points = points.len();
    for ((point, image), keypoint) in of_point.into_iter().zip(images).zip(keypoints) {
        let Some(found) = points.get_mut(point).filter(|_| image < num_images) else {
            return Err(Fault::of_range(format!(
                "{name} has an observation of point {point} in photo {image}, but has \
                 {num_points} points and {num_images} cameras"
            )));
        };
        found.track.push(TrackElement {
            image: image as u32,
            keypoint: keypoint as u32,
        });
    }
    for point in points {
        point.track.sort_unstable();
    }
    Ok(())
}

/// Rejects observations without a camera or a keypoint.
pub(super) fn check_observations(found: &Reconstruction, images: &[SfmImage]) -> Result<()> {
    if found.cameras.len() != images.len() {
        return Err(Fault::of_range(format!(
            "images must have {} entries, one for each camera, but has {}",
            found.cameras.len(),
            images.len()
        )));
    }
    let mut elements = found.points.iter().flat_map(|point| &point.track);
    let is_wrong = |seen: &&TrackElement| {
        let image = seen.image as usize;
        found.cameras[image].is_none() || seen.keypoint as usize >= images[image].keypoints.len()
    };
    match elements.find(is_wrong) {
        None => Ok(()),
        Some(seen) => Err(Fault::of_range(format!(
            "a point is observed by keypoint {} of photo {}, which has no camera or no such \
             keypoint",
            seen.keypoint, seen.image
        ))),
    }
}

functions! {
    /// Reconstruction in another world, moved by a similarity.
    fn move_reconstruction(
        reconstruction: Reconstruction, to_from_world: Similarity
    ) -> Reconstruction {
        reconstruction.moved(&to_from_world.0)
    }

    /// Mean length of the reprojection errors of all observations, pixels.
    fn mean_reprojection_px(reconstruction: Reconstruction, images: Vec<SfmImage>) -> f64 {
        check_observations(&reconstruction, &images)?;
        reconstruction.mean_reprojection_px(&images)
    }

    /// Bundle of a reconstruction, for `adjustBundle`.
    fn reconstruction_bundle(
        reconstruction: Reconstruction, images: Vec<SfmImage>
    ) -> BundleOfImages {
        check_observations(&reconstruction, &images)?;
        let (bundle, image_of_camera) = reconstruction.to_bundle(&images);
        BundleOfImages { bundle, image_of_camera: Indices(image_of_camera) }
    }

    /// Whether the photos determine the focal lengths of their lenses.
    fn determines_focal(reconstruction: Reconstruction, images: Vec<SfmImage>) -> bool {
        check_observations(&reconstruction, &images)?;
        reconstruction.determines_focal(&images)?
    }

    /// Corrects focal lengths and radial distortion of all lenses, if the photos determine them
    /// and the errors become clearly smaller.
    fn refine_lenses(
        reconstruction: Reconstruction, images: Vec<SfmImage>, options: NoOptions; monitor
    ) -> RefinedLenses {
        let NoOptions = options;
        check_observations(&reconstruction, &images)?;
        let mut reconstruction = reconstruction;
        let is_refined = reconstruction.refine_lenses(&images, monitor)?;
        RefinedLenses { reconstruction, is_refined }
    }
}
