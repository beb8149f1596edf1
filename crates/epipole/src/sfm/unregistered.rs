//! Reasons why images are missing from a reconstruction.

use super::incremental::SfmResult;
use super::options::{OF_IMAGES, SfmInput, SfmOptions, check, pair_ransac};
use super::two_view_start::verify_pair;
use super::views::Views;
use crate::Result;
use crate::progress::{Monitor, Stage, report};

/// Reason why an image is in no reconstruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WhyUnregistered {
    /// The image is blurred, uniform or very small.
    #[error("it has only {num_keypoints} features, and {needed} are needed")]
    FewFeatures {
        /// Number of features.
        num_keypoints: usize,
        /// Minimum number needed.
        needed: usize,
    },
    /// No other image resembles it.
    #[error("no other image has more than {most} matches with it, and {needed} are needed")]
    FewMatches {
        /// Number of matches with the image that has most.
        most: usize,
        /// Minimum number needed.
        needed: usize,
    },
    /// Its matches are between similar but different objects, or too few.
    #[error(
        "its matches with other images fit no camera motion: the images may show different objects that look alike"
    )]
    NoMotion,
    /// It could have started a reconstruction, but the cameras had no baseline.
    #[error(
        "it was taken from nearly the same position as the images that match it, so depth is undetermined"
    )]
    NoBaseline,
    /// It could have started a reconstruction with an image that matches it, but no points
    /// remained.
    #[error(
        "too few of its matches become points within the largest error and under the smallest angle of the options, or its focal length is wrong"
    )]
    NoStart,
    /// It matches registered images, but mostly where these have no points.
    #[error("it sees {visible} of the reconstructed points, and {needed} are needed")]
    FewPoints {
        /// Number of points that it sees.
        visible: usize,
        /// Minimum number needed.
        needed: usize,
    },
    /// It sees enough points, but no pose explains them.
    #[error(
        "no place of the camera explains what it sees of the {visible} points: its focal length or the matches may be wrong"
    )]
    NoPose {
        /// Number of points that it sees.
        visible: usize,
    },
    /// The reconstruction was stopped before this image was tried.
    #[error("the work was ended before it was tried")]
    NotTried,
}

/// Minimum median angle between the rays of an initial pair, radians.
const LEAST_START_ANGLE_RAD: f64 = 0.25 * core::f64::consts::PI / 180.0;

/// Returns the reason for each of [`SfmResult::unregistered`], in its order.
///
/// * `input`, `options`: input of [`reconstruct`](super::reconstruct)
/// * `result`: its result
///
/// Verifies the pairs of these images again, so each takes a moment, in the only stage,
/// [`Stage::PairVerification`].
///
/// # Errors
/// As [`reconstruct`](super::reconstruct).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::sfm::{SfmImage, SfmInput, SfmOptions, reconstruct, why_unregistered};
/// // Two images without a feature.
/// let input = SfmInput {
///     images: vec![SfmImage::default(); 2],
///     cameras: vec![Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480)],
///     pairs: vec![],
/// };
/// let options = SfmOptions::default();
/// let result = reconstruct(&input, &options, &mut ())?;
/// let why = why_unregistered(&input, &options, &result, &mut ())?;
/// assert_eq!(why[1].to_string(), "it has only 0 features, and 15 are needed");
/// # Ok(()) }
/// ```
pub fn why_unregistered(
    input: &SfmInput,
    options: &SfmOptions,
    result: &SfmResult,
    monitor: &mut dyn Monitor,
) -> Result<Vec<WhyUnregistered>> {
    let cameras = check(OF_IMAGES, &input.images, &input.cameras, options)?;
    let views = Views::new(&input.images, &cameras);
    let ransac = pair_ransac(options);
    let needed = options.min_num_inliers;
    // Keypoints of registered images that belong to points.
    let mut has_point: Vec<Vec<bool>> = input
        .images
        .iter()
        .map(|image| vec![false; image.keypoints.len()])
        .collect();
    for element in result
        .components
        .iter()
        .flat_map(|component| &component.points)
        .flat_map(|point| &point.track)
    {
        has_point[element.image as usize][element.keypoint as usize] = true;
    }
    let why = |&image: &usize| {
        let num_keypoints = input.images[image].keypoints.len();
        if num_keypoints < needed {
            return WhyUnregistered::FewFeatures {
                num_keypoints,
                needed,
            };
        }
        let with: Vec<_> = input
            .pairs
            .iter()
            .filter(|pair| pair.image1 == image || pair.image2 == image)
            .collect();
        if with.is_empty() && !result.is_complete {
            return WhyUnregistered::NotTried;
        }
        let most = with
            .iter()
            .map(|pair| pair.matches.len())
            .max()
            .unwrap_or(0);
        if most < needed {
            return WhyUnregistered::FewMatches { most, needed };
        }
        let verified: Vec<_> = with
            .iter()
            .filter_map(|pair| verify_pair(pair, &views, &ransac, needed, &mut ()).ok()?)
            .collect();
        if verified.is_empty() {
            return WhyUnregistered::NoMotion;
        }
        let mut has_visible_point = vec![false; num_keypoints];
        let mut has_placed_neighbor = false;
        for pair in verified.iter().map(|verified| &verified.pair) {
            for found in &pair.matches {
                let (mine, other, there) = if pair.image1 == image {
                    (found.index1, pair.image2, found.index2)
                } else {
                    (found.index2, pair.image1, found.index1)
                };
                let is_point = has_point[other][there];
                has_visible_point[mine] |= is_point;
                has_placed_neighbor |= is_point;
            }
        }
        let visible = has_visible_point
            .iter()
            .filter(|has_visible_point| **has_visible_point)
            .count();
        let has_baseline = verified
            .iter()
            .any(|verified| verified.median_angle_rad > LEAST_START_ANGLE_RAD);
        if !result.is_complete {
            WhyUnregistered::NotTried
        } else if !has_placed_neighbor && !has_baseline {
            WhyUnregistered::NoBaseline
        } else if result.components.is_empty() {
            WhyUnregistered::NoStart
        } else if visible < needed {
            WhyUnregistered::FewPoints { visible, needed }
        } else {
            WhyUnregistered::NoPose { visible }
        }
    };
    let mut reasons = Vec::new();
    for (done, image) in result.unregistered.iter().enumerate() {
        let fraction = done as f32 / result.unregistered.len() as f32;
        report(monitor, Stage::PairVerification, fraction)?;
        reasons.push(why(image));
    }
    Ok(reasons)
}

#[cfg(test)]
mod tests {
    use super::super::incremental::reconstruct;
    use super::super::reconstruction::SfmImage;
    use super::super::tracks::PairMatches;
    use super::*;
    use crate::camera::{Camera, Intrinsics, RigidTransform};
    use crate::feature::Match;
    use crate::math::random::Random;
    use nalgebra::{Point2, Point3, Vector3};

    /// Three cameras in a row that see everything, and others that do not.
    #[test]
    fn each_unregistered_image_has_its_reason() {
        let mut random = Random::new(1);
        let k = Intrinsics::centered(600.0, 640, 480).unwrap();
        let points: Vec<Point3<f64>> = (0..80)
            .map(|_| {
                Point3::new(
                    random.uniform(-1.0, 1.0),
                    random.uniform(-0.8, 0.8),
                    random.uniform(3.0, 6.0),
                )
            })
            .collect();
        let observe = |pose: &RigidTransform| -> Vec<Point2<f64>> {
            points
                .iter()
                .map(|x| k.project(&(pose * x)).unwrap())
                .collect()
        };
        let at = |x: f64| RigidTransform::new(Vector3::new(x, 0.0, 0.1 * x), Vector3::zeros());
        let mut keypoints: Vec<Vec<Point2<f64>>> =
            [0.0, -0.6, -1.2].iter().map(|x| observe(&at(*x))).collect();
        // 3: no keypoints. 4: matches nothing. 5: matches at random. 6: sees 10 of the points.
        keypoints.push(Vec::new());
        let mut anywhere = |count: usize| -> Vec<Point2<f64>> {
            (0..count)
                .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
                .collect()
        };
        keypoints.push(anywhere(80));
        keypoints.push(anywhere(80));
        keypoints.push(observe(&at(-0.3)));
        let all: Vec<Match> = (0..80).map(|i| Match::new(i, i)).collect();
        let pair = |image1, image2, matches: &[Match]| PairMatches {
            image1,
            image2,
            matches: matches.to_vec(),
        };
        let input = SfmInput {
            images: keypoints
                .into_iter()
                .map(|keypoints| SfmImage {
                    keypoints,
                    ..SfmImage::default()
                })
                .collect(),
            cameras: vec![Camera::pinhole(k, 640, 480)],
            pairs: vec![
                pair(0, 1, &all),
                pair(0, 2, &all),
                pair(1, 2, &all),
                pair(0, 4, &all[..7]),
                pair(0, 5, &all[..40]),
                pair(0, 6, &all[..10]),
                pair(1, 6, &all[..10]),
            ],
        };
        let options = SfmOptions::default();
        let result = reconstruct(&input, &options, &mut ()).unwrap();
        assert_eq!(result.unregistered, [3, 4, 5, 6]);
        let why = why_unregistered(&input, &options, &result, &mut ()).unwrap();
        let needed = 15;
        assert_eq!(
            why,
            [
                WhyUnregistered::FewFeatures {
                    num_keypoints: 0,
                    needed
                },
                WhyUnregistered::FewMatches { most: 7, needed },
                WhyUnregistered::NoMotion,
                WhyUnregistered::FewMatches { most: 10, needed },
            ]
        );
    }
}
