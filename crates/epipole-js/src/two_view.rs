//! Choice among F, E and H for two views.

pub(crate) mod degeneracy;

use crate::argument::Vectors;
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Mask, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, RigidTransform};
use epipole::nalgebra::Matrix3;
use epipole::robust::{RansacOptions, RansacReport, StopReason};
use epipole::two_view::{self, Configuration, TwoViewModel, TwoViewOptions};

structs! {
    /// Geometry of two views.
    struct TwoViewReport as TwoViewReport {
        /// Configuration of the views.
        configuration: Configuration,
        /// Kind of the model.
        kind: Kind,
        /// Chosen matrix, 9 numbers by row.
        model: Matrix3<f64>,
        /// Whether model and homography are of rays, not of pixels: lenses with distortion.
        is_of_rays: bool,
        /// F, where the views have one.
        fundamental: Option<Matrix3<f64>>,
        /// H, if one was found.
        homography: Option<Matrix3<f64>>,
        /// Motion of calibrated views, translation of length 1, or 0 for a rotation.
        cam2_from_cam1: Option<RigidTransform>,
        /// Second motion that explains a plane about as well.
        other_cam2_from_cam1: Option<RigidTransform>,
        /// 1 for each match that fits the model, otherwise 0.
        inliers: Mask,
        /// Number of inliers.
        num_inliers: usize,
        /// Matches with infinite or huge coordinates, no inliers.
        num_left_out: usize,
        /// Threshold of F and E, pixels.
        max_error_px: f64,
        /// Samples drawn, over all models tried.
        iterations: usize,
        /// Samples required for the model; Infinity if no number is enough.
        required_iterations: u64,
        /// Reason for the end of the search.
        stop: StopReason,
        /// Median angle at which rays of inliers meet, radians, of calibrated views with motion.
        median_triangulation_angle_rad: Option<f64>,
    }
}

/// Name of a model.
struct Kind(&'static str);

impl Output for Kind {
    fn typescript(_: &mut Types) -> String {
        "\"fundamental\" | \"essential\" | \"homography\"".to_owned()
    }

    fn into_value(self) -> Value {
        Value::Text(self.0.to_owned())
    }
}

impl Output for Configuration {
    fn typescript(_: &mut Types) -> String {
        "\"general\" | \"planar\" | \"panoramic\" | \"degenerate\"".to_owned()
    }

    fn into_value(self) -> Value {
        let name = match self {
            Self::General => "general",
            Self::Planar => "planar",
            Self::Panoramic => "panoramic",
            Self::Degenerate => "degenerate",
        };
        Value::Text(name.to_owned())
    }
}

impl From<two_view::TwoViewReport> for TwoViewReport {
    fn from(found: two_view::TwoViewReport) -> Self {
        let (kind, model) = match found.model {
            TwoViewModel::Fundamental(f) => ("fundamental", f),
            TwoViewModel::Essential(e) => ("essential", e),
            TwoViewModel::Homography(h) => ("homography", h),
        };
        Self {
            configuration: found.configuration,
            kind: Kind(kind),
            model,
            is_of_rays: found.is_of_rays,
            fundamental: found.fundamental,
            homography: found.homography,
            cam2_from_cam1: found.cam2_from_cam1,
            other_cam2_from_cam1: found.other_cam2_from_cam1,
            inliers: Mask(found.inliers),
            num_inliers: found.num_inliers,
            num_left_out: found.num_left_out,
            max_error_px: found.max_error_px,
            iterations: found.iterations,
            required_iterations: found.required_iterations,
            stop: found.stop,
            median_triangulation_angle_rad: found.median_triangulation_angle_rad,
        }
    }
}

functions! {
    /// Geometry of two views without calibration, by RANSAC: F or H.
    fn estimate_two_view(
        pixels1: Vectors<2>, pixels2: Vectors<2>, options: Options<TwoViewOptions>; monitor
    ) -> TwoViewReport {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        two_view::estimate_two_view(&pixels1, &pixels2, &options.0, monitor)?.into()
    }

    /// Geometry of two calibrated views, by RANSAC: E, H or a rotation, and the motion.
    fn estimate_two_view_calibrated(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        options: Options<TwoViewOptions>; monitor
    ) -> TwoViewReport {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        two_view::estimate_two_view_calibrated(&pixels1, &pixels2, cameras, &options.0, monitor)?
            .into()
    }

    /// Rotation matrix `cam2FromCam1` of two calibrated views from the same place, by RANSAC.
    fn estimate_rotation(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<Matrix3<f64>> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        two_view::estimate_rotation(&pixels1, &pixels2, cameras, &options.0, monitor)?
    }
}
