//! Projection, rays, motions.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::output::Numbers;
use epipole::camera::{self, Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::nalgebra::{Matrix3, Matrix3x4, Point2, Point3, SVector, Vector3};

functions! {
    /// Pixels of points in the camera frame; NaN for points that the lens does not see.
    fn project(camera: Camera, points_in_cam: Vectors<3>) -> Numbers {
        let pixel = |point: Point3<f64>| -> epipole::Result<SVector<f64, 2>> {
            Ok(camera.project(&point)?.coords)
        };
        Numbers::or_nan(points_in_cam.points().into_iter().map(pixel))
    }

    /// Pixels of points in the world; NaN for points that the camera does not see.
    fn project_from_world(camera: PosedCamera, points_in_world: Vectors<3>) -> Numbers {
        let pixel = |point: Point3<f64>| -> epipole::Result<SVector<f64, 2>> {
            Ok(camera.project(&point)?.coords)
        };
        Numbers::or_nan(points_in_world.points().into_iter().map(pixel))
    }

    /// Unit rays through pixels, in the camera frame; NaN for pixels without one.
    fn unproject(camera: Camera, pixels: Vectors<2>) -> Numbers {
        let ray = |pixel: Point2<f64>| camera.unproject(&pixel);
        Numbers::or_nan(pixels.points().into_iter().map(ray))
    }

    /// Undistorted pixels, those of a camera with the same K and no lens; NaN for pixels without
    /// one.
    fn pinhole_pixel(camera: Camera, pixels: Vectors<2>) -> Numbers {
        let pixel = |pixel: Point2<f64>| -> epipole::Result<SVector<f64, 2>> {
            Ok(camera.pinhole_pixel(&pixel)?.coords)
        };
        Numbers::or_nan(pixels.points().into_iter().map(pixel))
    }

    /// Pose of a camera at a center that looks at a target.
    fn look_at(
        center_in_world: Point3<f64>, target_in_world: Point3<f64>, up_in_world: Vector3<f64>
    ) -> RigidTransform {
        camera::look_at(&center_in_world, &target_in_world, &up_in_world)?
    }

    /// Motion between two poses, `cam2FromCam1`.
    fn relative_motion(
        cam1_from_world: RigidTransform, cam2_from_world: RigidTransform
    ) -> RigidTransform {
        camera::relative_motion(&cam1_from_world, &cam2_from_world)
    }

    /// Transform after another: `aFromB` after `bFromC` is `aFromC`.
    fn compose_transforms(a_from_b: RigidTransform, b_from_c: RigidTransform) -> RigidTransform {
        a_from_b * b_from_c
    }

    /// Inverse transform: of `aFromB`, `bFromA`.
    fn invert_transform(a_from_b: RigidTransform) -> RigidTransform {
        a_from_b.inverse()
    }

    /// Points moved from frame b to frame a.
    fn transform_points(a_from_b: RigidTransform, points_in_b: Vectors<3>) -> Numbers {
        let points: Vec<_> = points_in_b.points().iter().map(|point| a_from_b * point).collect();
        Numbers::of_points(&points)
    }

    /// Angle of the rotation of a transform, radians in [0, pi].
    fn rotation_angle_rad(a_from_b: RigidTransform) -> f64 {
        a_from_b.rotation.angle()
    }

    /// Matrix K of intrinsics, 9 numbers by row.
    fn intrinsics_matrix(intrinsics: Intrinsics) -> Matrix3<f64> {
        intrinsics.matrix()
    }

    /// Projection matrix K [R | t] of a camera, 12 numbers by row, for undistorted pixels.
    fn projection_matrix(camera: PosedCamera) -> Matrix3x4<f64> {
        camera.projection_matrix()
    }
}
