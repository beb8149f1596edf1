//! Detection of rotation-only motion: E and F are meaningless then, though they fit.

use super::TwoViewOptions;
use super::explaining_rotation::ExplainingRotation;
use super::pairs::inliers_of;
use super::rotation::estimate_rotation;
use super::rotation_through_lenses::find_rotation_through_lenses;
use crate::camera::Camera;
use crate::epipolar::ObservedMatches;
use crate::robust::RansacOptions;
use crate::{Error, Result};
use nalgebra::Point2;

/// Maximum number of two-match samples. Where a rotation explains enough, a tenth is plenty.
const MAX_SAMPLES: usize = 300;

/// Finds the rotation that explains the inliers of E, F or H equally well, if any: then the matches
/// show neither whether nor in which direction the camera moved, whatever the model.
///
/// * `pixels1`, `pixels2`: the matches from which the model was estimated
/// * `cameras`: the two cameras, with any lens
/// * `inliers`: for each match, whether it is an inlier of the model
/// * `options`: [`TwoViewOptions::max_homography_ratio`] defines "nearly all", and
///   [`RansacOptions::max_error_px`] should be that of the model
///
/// # Errors
/// [`Error::SizeMismatch`] if the lists differ in length, and as [`TwoViewOptions::check`] and
/// [`MatchSet::new`](crate::robust::MatchSet::new).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics};
/// use epipole::estimate_relative_pose;
/// use epipole::two_view::{TwoViewOptions, find_explaining_rotation};
/// use nalgebra::{Matrix3, Point2, Rotation3, Vector3};
/// let k = Intrinsics::centered(600.0, 640, 480)?;
/// let rotation = Rotation3::from_scaled_axis(Vector3::new(0.0, 0.1, 0.0));
/// let p1: Vec<_> = (0..60).map(|i| Point2::new(f64::from(i * 37 % 640), f64::from(i * 71 % 480))).collect();
/// let p2: Vec<_> = p1.iter().map(|p| {
///     let x = k.matrix() * (rotation * k.ray(p));
///     Point2::new(x.x / x.z, x.y / x.z)
/// }).collect();
/// let options = TwoViewOptions::default();
/// // The pose fits every match, but its direction is meaningless.
/// let camera = Camera::pinhole(k, 640, 480);
/// let pose = estimate_relative_pose(&p1, &p2, [&camera; 2], &options.ransac, &mut ())?;
/// assert_eq!(pose.num_inliers, 60);
/// let explaining = find_explaining_rotation(&p1, &p2, [&camera; 2], &pose.inliers, &options)?;
/// assert_eq!(explaining.map(|explaining| explaining.num_explained), Some(60));
/// # Ok(()) }
/// ```
pub fn find_explaining_rotation(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    cameras: [&Camera; 2],
    inliers: &[bool],
    options: &TwoViewOptions,
) -> Result<Option<ExplainingRotation>> {
    options.check()?;
    let [in1, in2] = inliers_of(pixels1, pixels2, inliers)?;
    if !Camera::are_pinholes(cameras) {
        let [observations1, observations2] =
            ObservedMatches::new(&in1, &in2, cameras)?.observations;
        let pairs: Vec<_> = observations1
            .into_iter()
            .zip(observations2)
            .map(|(a, b)| [a, b])
            .collect();
        return Ok(find_rotation_through_lenses(&pairs, options));
    }
    let [k1, k2] = cameras.map(|camera| &camera.intrinsics);
    let ransac = RansacOptions {
        max_iterations: options.ransac.max_iterations.min(MAX_SAMPLES),
        ..options.in_two_dimensions()
    };
    let report = match estimate_rotation(&in1, &in2, cameras, &ransac, &mut ()) {
        Ok(report) => report,
        Err(Error::TooFew { .. } | Error::TooFewDistinct { .. } | Error::NoConsensus { .. }) => {
            return Ok(None);
        }
        Err(error) => return Err(error),
    };
    let pairs = in1.iter().zip(&in2);
    Ok(ExplainingRotation::new(&report, [k1, k2], pairs, options))
}
