//! Points from photos with known poses.

use crate::functions::functions;
use crate::options::Options;
use epipole::camera::{Camera, RigidTransform};
use epipole::sfm::{self, PairMatches, Reconstruction, SfmImage, SfmInput, SfmOptions};

functions! {
    /// Points from matches between photos with known poses, which do not change. `cameras` has one
    /// camera for each photo, or one for all; photos with the pose null are ignored.
    fn triangulate_tracks(
        images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>,
        cam_from_world: Vec<Option<RigidTransform>>, options: Options<SfmOptions>; monitor
    ) -> Reconstruction {
        let input = SfmInput { images, cameras, pairs };
        sfm::triangulate_tracks(&input, &cam_from_world, &options.0, monitor)?
    }
}
