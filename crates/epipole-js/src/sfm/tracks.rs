//! Tracks, and matches verified by epipolar geometry.

use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, records, structs};
use epipole::camera::{Camera, RigidTransform};
use epipole::sfm::{self, PairMatches, SfmImage, SfmOptions, VerifiedPair};

/// Maximum number of keypoints of all photos: more would exhaust the memory of a page.
const MAX_KEYPOINTS: usize = 1 << 26;

structs! {
    /// Keypoints of several photos that show the same point: entry k of each array belongs to
    /// keypoint k.
    struct KeypointTracks as KeypointTracks {
        /// Number of its track, increasing.
        track: Indices,
        /// Index of its photo.
        image: Indices,
        /// Index of the keypoint in the photo.
        keypoint: Indices,
    }
}

records! {
    /// Pair of photos with matches that agree with one motion.
    VerifiedPair as VerifiedPair {
        /// Verified matches.
        pair: PairMatches,
        /// Motion of the camera, with a translation of length 1.
        cam2_from_cam1: RigidTransform,
        /// Median angle at which rays of the matches meet, radians; 0 if a plane and a pure
        /// rotation explain them.
        median_angle_rad: f64,
        /// Whether a homography explains most matches.
        is_flat: bool,
    }
}

fn check_total(num_keypoints: &[usize]) -> Result<()> {
    let total = num_keypoints
        .iter()
        .fold(0, |sum: usize, count| sum.saturating_add(*count));
    match total <= MAX_KEYPOINTS {
        true => Ok(()),
        false => Err(Fault::of_range(format!(
            "numKeypoints must sum up to at most {MAX_KEYPOINTS}, but sums up to {total}"
        ))),
    }
}

functions! {
    /// Tracks from verified matches: at most one keypoint per photo each. `numKeypoints` has the
    /// number of keypoints of each photo.
    fn build_tracks(num_keypoints: Indices, pairs: Vec<PairMatches>) -> KeypointTracks {
        check_total(&num_keypoints.0)?;
        let tracks = sfm::build_tracks(&num_keypoints.0, &pairs)?;
        let elements = || {
            let tracks = tracks.iter().enumerate();
            tracks.flat_map(|(number, track)| track.iter().map(move |element| (number, element)))
        };
        KeypointTracks {
            track: Indices(elements().map(|(number, _)| number).collect()),
            image: Indices(elements().map(|(_, element)| element.image as usize).collect()),
            keypoint: Indices(elements().map(|(_, element)| element.keypoint as usize).collect()),
        }
    }

    /// Matches of two photos that agree with one motion of the camera; null if too few do.
    fn verify_matches(
        pair: PairMatches, image1: SfmImage, image2: SfmImage, camera1: Camera, camera2: Camera,
        options: Options<SfmOptions>; monitor
    ) -> Option<VerifiedPair> {
        let (images, cameras) = ([&image1, &image2], [&camera1, &camera2]);
        sfm::verify_matches(&pair, images, cameras, &options.0, monitor)?
    }
}
