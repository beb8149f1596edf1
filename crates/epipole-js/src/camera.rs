//! Projection, rays, motions.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::output::Numbers;
use epipole::camera::{self, Camera, PosedCamera, RigidTransform};
use epipole::nalgebra::{Point2, Point3, SVector, Vector3};

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
}
