//! Features of single photos, their matches, and the pose of a photo in a reconstruction.

use super::photos::photos;
use crate::argument::{Argument, check_keys, entry};
use crate::fault::Result;
use crate::feature::{Keypoints, Matches};
use crate::functions::functions;
use crate::images::Rgb;
use crate::options::Options;
use crate::output::{Indices, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, RigidTransform};
use epipole::feature::Descriptors;
use epipole::sfm::{
    self, LocalizeOptions, PairMatches, PhotoFeatures, PhotoOptions, Reconstruction, SfmImage,
};

structs! {
    /// Keypoints of a photo with their colors and descriptors.
    struct FeaturesOfPhoto as PhotoFeatures {
        /// Keypoints and their colors.
        image: SfmImage,
        /// Descriptors of the keypoints.
        descriptors: Descriptors,
        /// The keypoints with their scales and directions.
        keypoints: Keypoints,
    }

    /// Photo localized in a reconstruction.
    struct Localization as Localization {
        /// Pose of the camera.
        cam_from_world: RigidTransform,
        /// Index of the point of each inlier.
        inlier_points: Indices,
        /// Index of the keypoint of each inlier.
        inlier_keypoints: Indices,
        /// Number of matches between keypoints of the photo and points.
        num_matches: usize,
    }
}

impl Output for PhotoFeatures {
    fn typescript(types: &mut Types) -> String {
        FeaturesOfPhoto::typescript(types)
    }

    fn into_value(self) -> Value {
        let features = FeaturesOfPhoto {
            image: self.image,
            descriptors: self.descriptors,
            keypoints: Keypoints(self.keypoints),
        };
        features.into_value()
    }
}

impl Argument for PhotoFeatures {
    fn typescript(types: &mut Types) -> String {
        let image = <SfmImage as Argument>::typescript(types);
        let descriptors = <Descriptors as Argument>::typescript(types);
        let keypoints = <Keypoints as Argument>::typescript(types);
        types.interface(
            "PhotoFeaturesLike",
            "Keypoints of a photo with their descriptors.",
            &[
                ("image", &image, "Keypoints and their colors."),
                ("descriptors", &descriptors, "Descriptors of the keypoints."),
                (
                    "keypoints?",
                    &keypoints,
                    "The keypoints with their scales and directions.",
                ),
            ],
        );
        "PhotoFeaturesLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["image", "descriptors", "keypoints"])?;
        let keypoints = entry::<Option<Keypoints>>(name, value, "keypoints")?;
        Ok(Self {
            image: entry(name, value, "image")?,
            descriptors: entry(name, value, "descriptors")?,
            keypoints: keypoints.map_or(Vec::new(), |list| list.0),
        })
    }
}

functions! {
    /// Keypoints of a photo, their colors and descriptors.
    fn photo_features(photo: Rgb, options: Options<PhotoOptions>; monitor) -> PhotoFeatures {
        let photos = photos(vec![photo]);
        sfm::photo_features(&photos[0], &options.0, monitor)?
    }

    /// Matches between all pairs of photos, or between photos that are near in order.
    fn match_features(
        features: Vec<PhotoFeatures>, options: Options<PhotoOptions>; monitor
    ) -> Vec<PairMatches> {
        sfm::match_features(&features, &options.0, monitor)?
    }

    /// Matches between the photos of a rectified rig that are in the same row, within 2 pixels.
    fn match_rectified(
        left: PhotoFeatures, right: PhotoFeatures, options: Options<PhotoOptions>; monitor
    ) -> Matches {
        for (name, features) in [("left", &left), ("right", &right)] {
            check_descriptors(name, features)?;
        }
        let matches = sfm::match_rectified(&left, &right, &options.0, monitor)?;
        Matches::from(&*matches)
    }

    /// Pose of another photo in a reconstruction, from `photoFeatures` of it and of all photos of
    /// the reconstruction, in order.
    fn localize(
        reconstruction: Reconstruction, features: Vec<PhotoFeatures>, photo: PhotoFeatures,
        camera: Camera, options: Options<LocalizeOptions>; monitor
    ) -> Localization {
        let found = reconstruction.localize(&features, &photo, &camera, &options.0, monitor)?;
        let (points, keypoints) = found.inliers.into_iter().unzip();
        Localization {
            cam_from_world: found.cam_from_world,
            inlier_points: Indices(points),
            inlier_keypoints: Indices(keypoints),
            num_matches: found.num_matches,
        }
    }
}

/// Rejects keypoints without descriptors.
fn check_descriptors(name: &str, features: &PhotoFeatures) -> Result<()> {
    let (keypoints, descriptors) = (features.image.keypoints.len(), features.descriptors.len());
    match keypoints == descriptors {
        true => Ok(()),
        false => Err(crate::fault::Fault::of_range(format!(
            "{name}.descriptors must have {keypoints} entries, one for each keypoint, but has \
             {descriptors}"
        ))),
    }
}
