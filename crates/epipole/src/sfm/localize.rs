//! Localization of a new image in a reconstruction.

use super::options::SfmOptions;
use super::photos::PhotoFeatures;
use super::reconstruction::Reconstruction;
use crate::absolute_pose::estimate_absolute_pose;
use crate::camera::{Camera, RigidTransform};
use crate::feature::{MatchOptions, match_descriptors};
use crate::progress::{Monitor, Part};
use crate::robust::RansacOptions;
use crate::{Error, Result};
use derive_setters::Setters;
use std::collections::BTreeMap;

/// Options of [`Reconstruction::localize`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct LocalizeOptions {
    /// Filters of the matches. Ratio 0.8, mutual.
    pub matching: MatchOptions,
    /// Robust estimation of the pose, with a maximum reprojection error of 6 px.
    pub ransac: RansacOptions,
    /// Minimum number of inliers. 15.
    pub min_num_inliers: usize,
}

impl Default for LocalizeOptions {
    /// Returns the thresholds of [`SfmOptions`].
    fn default() -> Self {
        let sfm = SfmOptions::default();
        Self {
            matching: MatchOptions::default(),
            ransac: RansacOptions::default().within(sfm.max_registration_error_px),
            min_num_inliers: sfm.min_num_inliers,
        }
    }
}

/// Pose of an image localized in a reconstruction.
#[derive(Debug, Clone, PartialEq)]
pub struct Localization {
    /// Pose of the camera.
    pub cam_from_world: RigidTransform,
    /// Inliers: indices of the point and of the image's keypoint.
    pub inliers: Vec<(usize, usize)>,
    /// Number of matches between keypoints of the image and points.
    pub num_matches: usize,
}

impl Reconstruction {
    /// Localizes an image that is not part of the reconstruction.
    ///
    /// Keypoints of the image are matched with those of each registered image, and thereby with the
    /// points that these observe.
    ///
    /// * `features`: features of all images of the reconstruction, in order
    /// * `photo`: features of the new image, of the same kind
    /// * `camera`: camera of the new image, with any lens
    /// * `monitor`: the stages are
    ///   [`Stage::FeatureMatching`](crate::progress::Stage::FeatureMatching) and
    ///   [`Stage::RobustEstimation`](crate::progress::Stage::RobustEstimation)
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] if `features` has another number of images, or keypoints lack
    /// descriptors, [`Error::OutOfRange`] for a track with an invalid keypoint, [`Error::TooFew`]
    /// if fewer than [`LocalizeOptions::min_num_inliers`] points are matched or agree with a pose,
    /// and as [`match_descriptors`] and [`estimate_absolute_pose`].
    ///
    /// Source: Sattler, Leibe & Kobbelt 2011, "Fast image-based localization using direct 2D-to-3D
    /// matching" (the problem); Schönberger & Frahm 2016, §4.2.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
    /// use epipole::feature::Descriptors;
    /// use epipole::sfm::{LocalizeOptions, PhotoFeatures, Reconstruction, ScenePoint, SfmImage, TrackElement};
    /// use nalgebra::{Point2, Point3, Vector3};
    /// let camera = Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480);
    /// // Thirty points, each with a descriptor of its own.
    /// let points: Vec<Point3<f64>> =
    ///     (0..30).map(|i| Point3::new(f64::from(i % 6) - 2.5, f64::from(i / 6) - 2.0, 6.0 + f64::from(i * i % 5))).collect();
    /// let seen_from = |pose: &RigidTransform| -> Result<PhotoFeatures, epipole::Error> {
    ///     let keypoints: Result<Vec<Point2<f64>>, _> = points.iter().map(|x| camera.project(&(pose * x))).collect();
    ///     let values = (0..30u8).flat_map(|i| [i * 8, 255 - i * 8]).collect();
    ///     Ok(PhotoFeatures {
    ///         image: SfmImage { keypoints: keypoints?, ..SfmImage::default() },
    ///         descriptors: Descriptors::from_bytes(2, values)?,
    ///         keypoints: Vec::new(),
    ///     })
    /// };
    /// let first = RigidTransform::identity();
    /// let track = |i: u32| vec![TrackElement { image: 0, keypoint: i }];
    /// let found = Reconstruction {
    ///     cameras: vec![Some(PosedCamera { camera: Camera::pinhole(camera.intrinsics, 640, 480), cam_from_world: first })],
    ///     points: (0..30).zip(&points)
    ///         .map(|(i, x)| ScenePoint { position: *x, color: [128; 3], track: track(i), error_px: 0.0 })
    ///         .collect(),
    ///     ..Reconstruction::default()
    /// };
    /// let pose = RigidTransform::new(Vector3::new(-0.5, 0.1, 0.4), Vector3::new(0.05, 0.1, -0.02));
    /// let (known, photo) = (seen_from(&first)?, seen_from(&pose)?);
    /// let localized = found.localize(&[known], &photo, &camera, &LocalizeOptions::default(), &mut ())?;
    /// assert_eq!(localized.inliers.len(), 30);
    /// assert!((localized.cam_from_world.to_matrix() - pose.to_matrix()).norm() < 1e-6);
    /// # Ok(()) }
    /// ```
    pub fn localize(
        &self,
        features: &[PhotoFeatures],
        photo: &PhotoFeatures,
        camera: &Camera,
        options: &LocalizeOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Localization> {
        if features.len() != self.cameras.len() {
            return Err(Error::SizeMismatch {
                what: "the images of a reconstruction and the list of their features",
                first: self.cameras.len(),
                second: features.len(),
            });
        }
        for known in features.iter().chain([photo]) {
            let (first, second) = (known.image.keypoints.len(), known.descriptors.len());
            if first != second {
                return Err(Error::SizeMismatch {
                    what: "the lists of keypoints and of their descriptors",
                    first,
                    second,
                });
            }
        }
        let matches = self.match_points(features, photo, options, monitor)?;
        let enough = |got: usize| match got < options.min_num_inliers {
            true => Err(Error::TooFew {
                what: "the pose of a photo from points of a reconstruction",
                needed: options.min_num_inliers,
                got,
            }),
            false => Ok(()),
        };
        enough(matches.len())?;
        let points: Vec<_> = (matches.iter())
            .map(|(i, _)| self.points[*i].position)
            .collect();
        let pixels: Vec<_> = (matches.iter())
            .map(|(_, j)| photo.image.keypoints[*j])
            .collect();
        let mut part = Part::new(monitor, MATCHED, 1.0);
        let report = estimate_absolute_pose(&points, &pixels, camera, &options.ransac, &mut part)?;
        enough(report.num_unique_inliers)?;
        let inliers = matches.iter().zip(&report.inliers).filter(|(_, is)| **is);
        Ok(Localization {
            cam_from_world: report.model,
            inliers: inliers.map(|(pair, _)| *pair).collect(),
            num_matches: matches.len(),
        })
    }

    /// Matches points with keypoints of an image, the least ambiguous first.
    fn match_points(
        &self,
        features: &[PhotoFeatures],
        photo: &PhotoFeatures,
        options: &LocalizeOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<(usize, usize)>> {
        let mut point_of: Vec<Vec<Option<usize>>> = (features.iter())
            .map(|known| vec![None; known.image.keypoints.len()])
            .collect();
        for (index, point) in self.points.iter().enumerate() {
            for element in &point.track {
                let image = point_of.get_mut(element.image as usize);
                let keypoint = image.and_then(|image| image.get_mut(element.keypoint as usize));
                *keypoint.ok_or(Error::OutOfRange {
                    what: "a keypoint in the track of a point",
                    requirement: "the index of one that its image has",
                    value: f64::from(element.keypoint),
                })? = Some(index);
            }
        }
        let registered = (0..features.len()).filter(|&image| self.cameras[image].is_some());
        let fraction = |done: usize| MATCHED * done as f32 / self.num_registered() as f32;
        // If several images match the same point and keypoint, keep the least ambiguous match.
        let mut ratios: BTreeMap<(usize, usize), f32> = BTreeMap::new();
        for (done, image) in registered.enumerate() {
            let mut part = Part::new(monitor, fraction(done), fraction(done + 1));
            let known = &features[image].descriptors;
            let matches =
                match_descriptors(known, &photo.descriptors, &options.matching, &mut part)?;
            for found in matches {
                if let Some(point) = point_of[image][found.index1] {
                    let ratio = ratios.entry((point, found.index2)).or_insert(found.ratio);
                    *ratio = ratio.min(found.ratio);
                }
            }
        }
        let mut matches: Vec<_> = ratios.into_iter().collect();
        matches.sort_by(|a, b| a.1.total_cmp(&b.1));
        Ok(matches.into_iter().map(|(pair, _)| pair).collect())
    }
}

/// Progress when all is matched.
const MATCHED: f32 = 0.8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Intrinsics;
    use crate::feature::Descriptors;
    use crate::sfm::{ScenePoint, SfmImage, TrackElement};
    use nalgebra::{Point2, Point3};

    fn features(num_keypoints: usize, num_descriptors: u8) -> PhotoFeatures {
        let values = (0..num_descriptors).flat_map(|i| [i, 255 - i]).collect();
        PhotoFeatures {
            image: SfmImage {
                keypoints: vec![Point2::new(1.0, 2.0); num_keypoints],
                ..SfmImage::default()
            },
            descriptors: Descriptors::from_bytes(2, values).unwrap(),
            keypoints: Vec::new(),
        }
    }

    #[test]
    fn features_that_do_not_fit_are_refused() {
        let camera = Camera::pinhole(Intrinsics::centered(500.0, 640, 480).unwrap(), 640, 480);
        let track = vec![TrackElement {
            image: 0,
            keypoint: 7,
        }];
        let point = ScenePoint {
            position: Point3::origin(),
            color: [128; 3],
            track,
            error_px: 0.0,
        };
        let found = Reconstruction {
            cameras: vec![None],
            points: vec![point],
            ..Reconstruction::default()
        };
        let run = |known: &[PhotoFeatures], photo: &PhotoFeatures| {
            let options = LocalizeOptions::default();
            found.localize(known, photo, &camera, &options, &mut ())
        };
        let size = |result| matches!(result, Err(Error::SizeMismatch { .. }));
        assert!(size(run(&[], &features(3, 3))));
        assert!(size(run(&[features(8, 8)], &features(3, 4))));
        assert!(size(run(&[features(8, 7)], &features(3, 3))));
        let missing = run(&[features(5, 5)], &features(3, 3));
        assert!(matches!(missing, Err(Error::OutOfRange { .. })));
        // No image is registered, so no point is matched.
        let few = run(&[features(8, 8)], &features(3, 3));
        assert!(matches!(few, Err(Error::TooFew { got: 0, .. })));
    }
}
