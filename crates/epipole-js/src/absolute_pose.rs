//! Pose of a camera from known points.

use crate::argument::{Sample, Vectors};
use crate::functions::functions;
use crate::options::{Options, Setting};
use crate::output::{Numbers, records};
use epipole::ArrayVec;
use epipole::absolute_pose::{self, AbsolutePoseWithFocal};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::nalgebra::Point2;
use epipole::optim::RobustLoss;
use epipole::robust::{RansacOptions, RansacReport};

records! {
    /// Pose and focal length.
    AbsolutePoseWithFocal as AbsolutePoseWithFocal {
        /// Pose.
        cam_from_world: RigidTransform,
        /// Focal length, pixels.
        focal_px: f64,
        /// Its standard deviation, pixels; null from a minimal solver.
        focal_std_px: Option<f64>,
    }
}

functions! {
    /// Pose of a calibrated camera from points and pixels with outliers, by RANSAC.
    fn estimate_absolute_pose(
        points_in_world: Vectors<3>, pixels: Vectors<2>, camera: Camera,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<RigidTransform> {
        let (points, pixels) = (points_in_world.points(), pixels.points());
        absolute_pose::estimate_absolute_pose(&points, &pixels, &camera, &options.0, monitor)?
    }

    /// Pose and focal length of a camera from points and pixels with outliers, by RANSAC.
    fn estimate_absolute_pose_and_focal(
        points_in_world: Vectors<3>, pixels: Vectors<2>, principal: Point2<f64>,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<AbsolutePoseWithFocal> {
        let (points, pixels, options) = (points_in_world.points(), pixels.points(), options.0);
        absolute_pose::estimate_absolute_pose_and_focal(
            &points, &pixels, &principal, &options, monitor,
        )?
    }

    /// Pose from points and pixels without outliers, by least squares.
    fn fit_absolute_pose(
        points_in_world: Vectors<3>, pixels: Vectors<2>, camera: Camera
    ) -> RigidTransform {
        absolute_pose::fit_absolute_pose(&points_in_world.points(), &pixels.points(), &camera)?
    }

    /// Pose from six or more points without outliers, by the direct linear transform.
    fn pose_dlt(
        points_in_world: Vectors<3>, pixels: Vectors<2>, intrinsics: Intrinsics
    ) -> RigidTransform {
        absolute_pose::pose_dlt(&points_in_world.points(), &pixels.points(), &intrinsics)?
    }

    /// Poses from three rays of any length and their points.
    fn pose_p3p(
        rays: Sample<3, 3>, points_in_world: Sample<3, 3>
    ) -> ArrayVec<RigidTransform, 4> {
        absolute_pose::pose_p3p(&rays.0, &points_in_world.points())
    }

    /// Poses and focal lengths from four pixels and their points.
    fn pose_p4pf(
        pixels: Sample<4, 2>, points_in_world: Sample<4, 3>, principal: Point2<f64>
    ) -> ArrayVec<AbsolutePoseWithFocal, 7> {
        absolute_pose::pose_p4pf(&pixels.points(), &points_in_world.points(), &principal)
    }

    /// Refines a pose from points and pixels without outliers by minimizing a robust loss.
    fn refine_absolute_pose(
        cam_from_world: RigidTransform, points_in_world: Vectors<3>, pixels: Vectors<2>,
        camera: Camera, loss: Option<Setting<RobustLoss>>
    ) -> RigidTransform {
        let loss = loss.map_or(RobustLoss::Trivial, |loss| loss.0);
        let (points, pixels) = (points_in_world.points(), pixels.points());
        absolute_pose::refine_absolute_pose(&cam_from_world, &points, &pixels, &camera, loss)?
    }

    /// The other pose that explains points near a plane about as well; null if there is none.
    fn find_flipped_pose(
        cam_from_world: RigidTransform, points_in_world: Vectors<3>, pixels: Vectors<2>,
        camera: Camera
    ) -> Option<RigidTransform> {
        let (points, pixels) = (points_in_world.points(), pixels.points());
        absolute_pose::find_flipped_pose(&cam_from_world, &points, &pixels, &camera)?
    }

    /// Distances between projected points and measured pixels, pixels.
    fn reprojection_error_px(
        camera: PosedCamera, points_in_world: Vectors<3>, pixels: Vectors<2>
    ) -> Numbers {
        let (points, pixels) = crate::pairs::zip(
            ("pointsInWorld", points_in_world), ("pixels", pixels),
        )?;
        let errors = points.iter().zip(&pixels).map(|(point, pixel)| {
            absolute_pose::reprojection_error_px(&camera, point, pixel)
        });
        Numbers(errors.collect())
    }
}
