//! Reconstruction of two views.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, Numbers, structs};
use epipole::camera::{Camera, RigidTransform};
use epipole::optim::LmReport;
use epipole::sfm::{self, TwoViewReconstructionOptions};

structs! {
    /// Two cameras and their points, in the frame of camera 1; the cameras have distance 1.
    struct TwoViewReconstruction as TwoViewReconstruction {
        /// Refined motion, with a translation of length 1.
        cam2_from_cam1: RigidTransform,
        /// Points, interleaved.
        points: Numbers,
        /// The same points as first triangulated, interleaved.
        triangulated: Numbers,
        /// Index of the match of each point, increasing.
        match_of_point: Indices,
        /// Number of matches in front of both cameras by each of the four motions of E, most
        /// first.
        num_in_front: Indices,
        /// Root mean square of the reprojection errors as first triangulated, pixels.
        rms_before_px: f64,
        /// Root mean square after the refinement, pixels.
        rms_px: f64,
        /// Report of the last refinement.
        report: LmReport,
    }
}

functions! {
    /// Points of the matches of two views without outliers, refined together with the motion. The
    /// length of the given translation is ignored.
    fn two_view_reconstruction(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        cam2_from_cam1: RigidTransform, options: Options<TwoViewReconstructionOptions>; monitor
    ) -> TwoViewReconstruction {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        let found = sfm::two_view_reconstruction(
            &pixels1, &pixels2, cameras, &cam2_from_cam1, &options.0, monitor,
        )?;
        TwoViewReconstruction {
            cam2_from_cam1: found.cam2_from_cam1,
            points: Numbers::of_points(&found.points),
            triangulated: Numbers::of_points(&found.triangulated),
            match_of_point: Indices(found.match_of_point),
            num_in_front: Indices(found.num_in_front.to_vec()),
            rms_before_px: found.rms_before_px,
            rms_px: found.rms_px,
            report: found.report,
        }
    }
}
