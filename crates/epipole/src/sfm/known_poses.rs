//! Points from matches between images with known poses.

use super::builder::Builder;
use super::options::{SfmInput, SfmOptions, check};
use super::reconstruction::Reconstruction;
use super::tracks::{PairMatches, TrackElement, build_tracks};
use crate::camera::RigidTransform;
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};

/// Name of the result in [`Error::TooFew`].
const OF_KNOWN_POSES: &str = "points from images with known poses";

/// Triangulates points from matches between images with known poses; the cameras do not change.
///
/// Matches whose rays meet are joined into tracks, and each track is triangulated from the images
/// that agree.
///
/// * `cam_from_world`: pose of each image; images without a pose are ignored
/// * `options`: [`SfmOptions::max_reprojection_error_px`], [`SfmOptions::min_angle_deg`] and
///   [`SfmOptions::min_track_length`]
/// * `monitor`: the only stage is [`Stage::PairVerification`]
///
/// Points are in the world frame of the poses. Wrong poses give few points, or none.
///
/// # Errors
/// As [`reconstruct`](super::reconstruct); [`Error::TooFew`] for fewer than two poses,
/// [`Error::SizeMismatch`] unless there is an entry for each image.
///
/// Source: Schönberger & Frahm 2016, §4.3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::feature::Match;
/// use epipole::sfm::{PairMatches, SfmImage, SfmInput, SfmOptions, triangulate_tracks};
/// use nalgebra::{Point2, Point3};
/// let image = |u| SfmImage { keypoints: vec![Point2::new(u, 240.0)], ..SfmImage::default() };
/// let input = SfmInput {
///     images: vec![image(320.0), image(250.0)],
///     cameras: vec![Camera::pinhole(Intrinsics::centered(700.0, 641, 481)?, 641, 481)],
///     pairs: vec![PairMatches { image1: 0, image2: 1, matches: vec![Match::new(0, 0)] }],
/// };
/// // Side by side, 0.2 apart: Z = f B / d = 2.
/// let poses = [0.0, -0.2].map(|x| Some(RigidTransform::translation(x, 0.0, 0.0)));
/// let found = triangulate_tracks(&input, &poses, &SfmOptions::default(), &mut ())?;
/// assert!((found.points[0].position - Point3::new(0.0, 0.0, 2.0)).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn triangulate_tracks(
    input: &SfmInput,
    cam_from_world: &[Option<RigidTransform>],
    options: &SfmOptions,
    monitor: &mut dyn Monitor,
) -> Result<Reconstruction> {
    let images = &input.images;
    let cameras = check(OF_KNOWN_POSES, images, &input.cameras, options)?;
    check_poses(images.len(), cam_from_world)?;
    let counts: Vec<usize> = images.iter().map(|image| image.keypoints.len()).collect();
    // Find invalid indices before the work begins.
    build_tracks(&counts, &input.pairs)?;
    let mut builder = Builder::new(images, cameras, options);
    for (image, pose) in cam_from_world.iter().enumerate() {
        let camera = pose.map(|pose| builder.posed(image, pose));
        builder.place(image, camera);
    }
    let mut pairs = Vec::new();
    for (n, pair) in input.pairs.iter().enumerate() {
        pairs.push(meeting(pair, &builder));
        let fraction = (n + 1) as f32 / input.pairs.len() as f32;
        report(monitor, Stage::PairVerification, fraction)?;
    }
    builder.join_tracks(&pairs)?;
    builder.triangulate();
    builder.drop_short_tracks();
    Ok(builder.so_far())
}

fn check_poses(num_images: usize, cam_from_world: &[Option<RigidTransform>]) -> Result<()> {
    if cam_from_world.len() != num_images {
        return Err(Error::SizeMismatch {
            what: "the lists of images and of their poses",
            first: num_images,
            second: cam_from_world.len(),
        });
    }
    let num_known = cam_from_world.iter().flatten().count();
    if num_known < 2 {
        return Err(Error::TooFew {
            what: OF_KNOWN_POSES,
            needed: 2,
            got: num_known,
        });
    }
    let is_finite = |pose: &RigidTransform| {
        let numbers = pose.rotation.coords.iter().chain(&pose.translation.vector);
        numbers.copied().all(f64::is_finite)
    };
    match cam_from_world.iter().flatten().all(is_finite) {
        true => Ok(()),
        false => Err(Error::NotFinite { what: "a pose" }),
    }
}

/// Returns the matches of a pair whose rays meet.
fn meeting(pair: &PairMatches, builder: &Builder) -> PairMatches {
    let element = |image: usize, keypoint: usize| TrackElement {
        image: image as u32,
        keypoint: keypoint as u32,
    };
    let mut do_meet = vec![false; pair.matches.len()];
    crate::math::parallel::for_each(&mut do_meet, |n, meet| {
        let found = &pair.matches[n];
        let first = element(pair.image1, found.index1);
        let second = element(pair.image2, found.index2);
        *meet = builder.meet(first, second);
    });
    let matches = pair.matches.iter().zip(do_meet);
    PairMatches {
        matches: matches.filter(|(_, meet)| *meet).map(|(m, _)| *m).collect(),
        ..*pair
    }
}
