//! Homographies between the rays of cameras.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::options::Options;
use epipole::camera::Camera;
use epipole::homography;
use epipole::nalgebra::Matrix3;
use epipole::robust::{RansacOptions, RansacReport};

functions! {
    /// Homography between the rays of two cameras of any lens, from matches with outliers, by
    /// RANSAC.
    fn estimate_homography_calibrated(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<Matrix3<f64>> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        homography::estimate_homography_calibrated(
            &pixels1, &pixels2, cameras, &options.0, monitor,
        )?
    }
}
