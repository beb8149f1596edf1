//! Points from known cameras.

use crate::argument::Vectors;
use crate::functions::functions;
use crate::options::Setting;
use crate::output::{Numbers, records, structs};
use crate::pairs::zip;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::nalgebra::{Matrix3, Matrix3x4, Point3, SVector, Vector3};
use epipole::optim::RobustLoss;
use epipole::triangulation::{self, NviewPoint};

records! {
    /// Point seen by several cameras.
    NviewPoint as NviewPoint {
        /// Point, world frame.
        point_in_world: Point3<f64>,
        /// Root mean square of its reprojection errors, pixels.
        rms_error_px: f64,
    }
}

structs! {
    /// Matches that satisfy the epipolar constraint; NaN for those without a correction.
    struct CorrectedMatches as CorrectedMatches {
        /// Pixels of image 1, interleaved.
        pixels1: Numbers,
        /// Pixels of image 2, interleaved.
        pixels2: Numbers,
    }
}

type Rays = fn(&RigidTransform, &Vector3<f64>, &Vector3<f64>) -> epipole::Result<Point3<f64>>;

fn of_rays(
    method: Rays,
    cam2_from_cam1: &RigidTransform,
    rays1: Vectors<3>,
    rays2: Vectors<3>,
) -> crate::fault::Result<Numbers> {
    let (rays1, rays2) = zip(("rays1", rays1), ("rays2", rays2))?;
    let rays = rays1.iter().zip(&rays2);
    Ok(Numbers::or_nan(rays.map(|(ray1, ray2)| {
        Ok(method(cam2_from_cam1, &ray1.coords, &ray2.coords)?.coords)
    })))
}

functions! {
    /// Points of matches by the direct linear transform, in the frame of the projection
    /// matrices (3 x 4). NaN for points at infinity and for those behind a camera.
    fn triangulate_dlt(
        p1: Matrix3x4<f64>, p2: Matrix3x4<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let points = triangulation::triangulate_dlt_all(&p1, &p2, &pixels1, &pixels2)?;
        Numbers::or_nan(points.into_iter().map(|point| Ok(point?.coords)))
    }

    /// Points halfway between rays, in the frame of camera 1. NaN for parallel rays.
    fn triangulate_midpoint(
        cam2_from_cam1: RigidTransform, rays1: Vectors<3>, rays2: Vectors<3>
    ) -> Numbers {
        of_rays(triangulation::triangulate_midpoint, &cam2_from_cam1, rays1, rays2)?
    }

    /// Points between rays, weighted by inverse depth, in the frame of camera 1. NaN for
    /// parallel rays.
    fn triangulate_weighted_midpoint(
        cam2_from_cam1: RigidTransform, rays1: Vectors<3>, rays2: Vectors<3>
    ) -> Numbers {
        of_rays(triangulation::triangulate_weighted_midpoint, &cam2_from_cam1, rays1, rays2)?
    }

    /// Points of rays turned by the least angles, in the frame of camera 1. NaN for parallel
    /// rays.
    fn triangulate_angular(
        cam2_from_cam1: RigidTransform, rays1: Vectors<3>, rays2: Vectors<3>
    ) -> Numbers {
        of_rays(triangulation::triangulate_angular, &cam2_from_cam1, rays1, rays2)?
    }

    /// Points of least reprojection error of two cameras, world frame. NaN for points at
    /// infinity.
    fn triangulate_optimal(
        camera1: PosedCamera, camera2: PosedCamera, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        let (pixels1, pixels2) = zip(("pixels1", pixels1), ("pixels2", pixels2))?;
        let pairs = pixels1.iter().zip(&pixels2);
        Numbers::or_nan(pairs.map(|(pixel1, pixel2)| -> epipole::Result<SVector<f64, 3>> {
            Ok(triangulation::triangulate_optimal(&camera1, &camera2, pixel1, pixel2)?.coords)
        }))
    }

    /// Nearest matches that satisfy the epipolar constraint.
    fn correct_matches(
        fundamental: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> CorrectedMatches {
        let (pixels1, pixels2) = zip(("pixels1", pixels1), ("pixels2", pixels2))?;
        let pairs = pixels1.iter().zip(&pixels2);
        let corrected: Vec<_> = pairs
            .map(|(pixel1, pixel2)| triangulation::correct_matches(&fundamental, pixel1, pixel2))
            .collect();
        let of = |pick: fn(&_) -> SVector<f64, 2>| {
            Numbers::or_nan(corrected.iter().map(|pair| pair.as_ref().map(pick).map_err(Clone::clone)))
        };
        CorrectedMatches {
            pixels1: of(|(pixel1, _): &(epipole::nalgebra::Point2<f64>, _)| pixel1.coords),
            pixels2: of(|(_, pixel2): &(_, epipole::nalgebra::Point2<f64>)| pixel2.coords),
        }
    }

    /// Point of one pixel in each of several cameras, by the direct linear transform, world
    /// frame.
    fn triangulate_nview_dlt(cameras: Vec<PosedCamera>, pixels: Vectors<2>) -> Point3<f64> {
        triangulation::triangulate_nview_dlt(&cameras, &pixels.points())?
    }

    /// Point of one pixel in each of several cameras that minimizes a robust loss.
    fn triangulate_nview(
        cameras: Vec<PosedCamera>, pixels: Vectors<2>, loss: Option<Setting<RobustLoss>>
    ) -> NviewPoint {
        let loss = loss.map_or(RobustLoss::Trivial, |loss| loss.0);
        triangulation::triangulate_nview(&cameras, &pixels.points(), loss)?
    }

    /// Angles at points between the directions to two camera centers, radians.
    fn triangulation_angle_rad(
        center1_in_world: Point3<f64>, center2_in_world: Point3<f64>,
        points_in_world: Vectors<3>
    ) -> Numbers {
        let angle = |point: Point3<f64>| {
            triangulation::triangulation_angle_rad(&center1_in_world, &center2_in_world, &point)
        };
        Numbers(points_in_world.points().into_iter().map(angle).collect())
    }

    /// Covariance of a point seen by several cameras with pixel noise `sigmaPx`, 3 x 3.
    fn point_covariance(
        cameras: Vec<PosedCamera>, point_in_world: Point3<f64>, sigma_px: f64
    ) -> Matrix3<f64> {
        triangulation::point_covariance(&cameras, &point_in_world, sigma_px)?
    }
}
