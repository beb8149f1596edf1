//! Fundamental and essential matrices, relative pose.

use crate::argument::{Sample, Vectors};
use crate::functions::functions;
use crate::options::{Options, Setting};
use crate::output::{Numbers, records, structs};
use epipole::ArrayVec;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{
    self, EightPoint, Epipole, EssentialWithFocal, PoseWithFocal, RelativePose, SelectedPose,
};
use epipole::nalgebra::{Matrix3, Point2, SVector, Vector3};
use epipole::optim::RobustLoss;
use epipole::robust::{RansacOptions, RansacReport};

records! {
    /// Rotation and direction of translation.
    RelativePose as RelativePose {
        /// Rotation matrix R, 9 numbers by row: `x_in_cam2 = R x_in_cam1 + t`.
        rotation: Matrix3<f64>,
        /// Unit vector t.
        direction: Vector3<f64>,
    }

    /// Relative pose and common focal length.
    PoseWithFocal as PoseWithFocal {
        /// Pose.
        pose: RelativePose,
        /// Fundamental matrix.
        fundamental: Matrix3<f64>,
        /// Focal length, pixels.
        focal_px: f64,
        /// Its standard deviation, pixels; null if unknown.
        focal_std_px: Option<f64>,
    }

    /// Motion with most points in front of both cameras.
    SelectedPose as SelectedPose {
        /// Motion.
        cam2_from_cam1: RigidTransform,
        /// Number of points in front of both cameras.
        num_in_front: usize,
        /// The same for the second-best motion.
        second_num_in_front: usize,
    }

    /// Fundamental matrix by the eight-point method, with its intermediate results.
    EightPoint as EightPoint {
        /// F of rank 2 and unit norm.
        fundamental: Matrix3<f64>,
        /// Least-squares solution before its rank was lowered to 2, of unit norm.
        full_rank: Matrix3<f64>,
        /// The 9 singular values of the linear system, largest first.
        singular_values: [f64; 9],
        /// Largest singular value over the eighth: amplification of errors of the data.
        condition_number: f64,
    }

    /// Essential matrix and focal length.
    EssentialWithFocal as EssentialWithFocal {
        /// Essential matrix.
        essential: Matrix3<f64>,
        /// Focal length, pixels.
        focal_px: f64,
    }
}

structs! {
    /// Epipoles: (u, v, 1), or (u, v, 0) with a unit direction for those at infinity.
    struct Epipoles as Epipoles {
        /// Epipole of image 1.
        epipole1: Vector3<f64>,
        /// Epipole of image 2.
        epipole2: Vector3<f64>,
    }
}

fn homogeneous(epipole: Epipole) -> Vector3<f64> {
    match epipole {
        Epipole::Finite(pixel) => pixel.coords.push(1.0),
        Epipole::AtInfinity(direction) => direction.push(0.0),
    }
}

fn loss(loss: Option<Setting<RobustLoss>>) -> RobustLoss {
    loss.map_or(RobustLoss::Trivial, |loss| loss.0)
}

functions! {
    /// Fundamental matrix of matches with outliers, by RANSAC: `x2' F x1 = 0`, unit norm.
    fn estimate_fundamental(
        pixels1: Vectors<2>, pixels2: Vectors<2>, options: Options<RansacOptions>; monitor
    ) -> RansacReport<Matrix3<f64>> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        epipolar::estimate_fundamental(&pixels1, &pixels2, &options.0, monitor)?
    }

    /// Essential matrix of matches with outliers, by RANSAC: unit norm.
    fn estimate_essential(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<Matrix3<f64>> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        epipolar::estimate_essential(&pixels1, &pixels2, cameras, &options.0, monitor)?
    }

    /// Relative pose of two calibrated cameras from matches with outliers, by RANSAC.
    fn estimate_relative_pose(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<RelativePose> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let cameras = [&camera1, &camera2];
        epipolar::estimate_relative_pose(&pixels1, &pixels2, cameras, &options.0, monitor)?
    }

    /// Relative pose of two cameras that know the direction of gravity, by RANSAC.
    fn estimate_relative_pose_with_gravity(
        pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera, camera2: Camera,
        gravity1: Vector3<f64>, gravity2: Vector3<f64>,
        options: Options<RansacOptions>; monitor
    ) -> RansacReport<RelativePose> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let (cameras, gravity) = ([&camera1, &camera2], [&gravity1, &gravity2]);
        epipolar::estimate_relative_pose_with_gravity(
            &pixels1, &pixels2, cameras, gravity, &options.0, monitor,
        )?
    }

    /// Relative pose and common focal length of two cameras, by RANSAC.
    fn estimate_relative_pose_and_focal(
        pixels1: Vectors<2>, pixels2: Vectors<2>, principal1: Point2<f64>,
        principal2: Point2<f64>, options: Options<RansacOptions>; monitor
    ) -> RansacReport<PoseWithFocal> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        epipolar::estimate_relative_pose_and_focal(
            &pixels1, &pixels2, &principal1, &principal2, &options.0, monitor,
        )?
    }

    /// Fundamental matrix of eight or more matches without outliers, normalized.
    fn fundamental_8point(pixels1: Vectors<2>, pixels2: Vectors<2>) -> Matrix3<f64> {
        epipolar::fundamental_8point(&pixels1.points(), &pixels2.points())?
    }

    /// Result of `fundamental8point` with its intermediate results.
    fn fundamental_8point_explained(pixels1: Vectors<2>, pixels2: Vectors<2>) -> EightPoint {
        epipolar::fundamental_8point_explained(&pixels1.points(), &pixels2.points())?
    }

    /// Eight-point method without normalization of the pixels, for comparison.
    fn fundamental_8point_unnormalized(pixels1: Vectors<2>, pixels2: Vectors<2>) -> EightPoint {
        epipolar::fundamental_8point_unnormalized(&pixels1.points(), &pixels2.points())?
    }

    /// Rows of the linear system of the eight-point method, 9 numbers for each match: their product
    /// with F by row is `x2' F x1`.
    fn epipolar_row(pixels1: Vectors<2>, pixels2: Vectors<2>) -> Numbers {
        let (pixels1, pixels2) = crate::pairs::zip(("pixels1", pixels1), ("pixels2", pixels2))?;
        let rows = pixels1.iter().zip(&pixels2);
        Numbers(rows.flat_map(|(pixel1, pixel2)| epipolar::epipolar_row(pixel1, pixel2)).collect())
    }

    /// Fundamental matrices of seven matches.
    fn fundamental_7point(
        pixels1: Sample<7, 2>, pixels2: Sample<7, 2>
    ) -> ArrayVec<Matrix3<f64>, 3> {
        epipolar::fundamental_7point(&pixels1.points(), &pixels2.points())
    }

    /// Essential matrix of eight or more pairs of rays without outliers.
    fn essential_8point(rays1: Vectors<3>, rays2: Vectors<3>) -> Matrix3<f64> {
        epipolar::essential_8point(&rays1.0, &rays2.0)?
    }

    /// Essential matrices of five pairs of rays.
    fn essential_5point(
        rays1: Sample<5, 3>, rays2: Sample<5, 3>
    ) -> ArrayVec<Matrix3<f64>, 10> {
        epipolar::essential_5point(&rays1.0, &rays2.0)
    }

    /// Essential matrices and focal lengths of six matches.
    fn essential_6point(
        pixels1: Sample<6, 2>, pixels2: Sample<6, 2>, principal1: Point2<f64>,
        principal2: Point2<f64>
    ) -> ArrayVec<EssentialWithFocal, 15> {
        epipolar::essential_6point(
            &pixels1.points(), &pixels2.points(), &principal1, &principal2,
        )
    }

    /// Motions of three pairs of rays and the direction of gravity in both cameras.
    fn relative_pose_3point(
        rays1: Sample<3, 3>, rays2: Sample<3, 3>, gravity1: Vector3<f64>,
        gravity2: Vector3<f64>
    ) -> ArrayVec<RigidTransform, 4> {
        epipolar::relative_pose_3point(&rays1.0, &rays2.0, &gravity1, &gravity2)
    }

    /// Refines a fundamental matrix from matches without outliers.
    fn refine_fundamental(
        fundamental: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>,
        loss: Option<Setting<RobustLoss>>
    ) -> Matrix3<f64> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        epipolar::refine_fundamental(&fundamental, &pixels1, &pixels2, self::loss(loss))?
    }

    /// Refines a motion, whose length is ignored, from matches without outliers.
    fn refine_relative_pose(
        cam2_from_cam1: RigidTransform, pixels1: Vectors<2>, pixels2: Vectors<2>,
        camera1: Camera, camera2: Camera, loss: Option<Setting<RobustLoss>>
    ) -> RelativePose {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        let pose = RelativePose::from_motion(&cam2_from_cam1)?;
        let cameras = [&camera1, &camera2];
        epipolar::refine_relative_pose(&pose, &pixels1, &pixels2, cameras, self::loss(loss))?
    }

    /// Sampson distances of matches from a fundamental matrix, pixels.
    fn sampson_px(
        fundamental: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        crate::pairs::numbers(pixels1, pixels2, |pixel1, pixel2| {
            epipolar::sampson_px(&fundamental, pixel1, pixel2)
        })?
    }

    /// Sampson distances of matches through lenses from a motion, pixels; Infinity behind a camera,
    /// NaN for pixels without a ray.
    fn tangent_sampson_px(
        cam2_from_cam1: RigidTransform, pixels1: Vectors<2>, pixels2: Vectors<2>, camera1: Camera,
        camera2: Camera
    ) -> Numbers {
        crate::pairs::numbers(pixels1, pixels2, |pixel1, pixel2| {
            match (camera1.observe(pixel1), camera2.observe(pixel2)) {
                (Ok(seen1), Ok(seen2)) => {
                    epipolar::tangent_sampson_px(&cam2_from_cam1, &seen1, &seen2)
                }
                _ => f64::NAN,
            }
        })?
    }

    /// Symmetric epipolar distances of matches from a fundamental matrix, pixels.
    fn symmetric_epipolar_px(
        fundamental: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        crate::pairs::numbers(pixels1, pixels2, |pixel1, pixel2| {
            epipolar::symmetric_epipolar_px(&fundamental, pixel1, pixel2)
        })?
    }

    /// Epipolar lines in image 1 of pixels of image 2: (a, b, c) with `a u + b v + c = 0`,
    /// a² + b² = 1. NaN for epipoles.
    fn epipolar_line1(fundamental: Matrix3<f64>, pixels2: Vectors<2>) -> Numbers {
        let line = |pixel: Point2<f64>| -> epipole::Result<SVector<f64, 3>> {
            Ok(epipolar::epipolar_line1(&fundamental, &pixel)?.homogeneous())
        };
        Numbers::or_nan(pixels2.points().into_iter().map(line))
    }

    /// Epipolar lines in image 2 of pixels of image 1, as for image 1.
    fn epipolar_line2(fundamental: Matrix3<f64>, pixels1: Vectors<2>) -> Numbers {
        let line = |pixel: Point2<f64>| -> epipole::Result<SVector<f64, 3>> {
            Ok(epipolar::epipolar_line2(&fundamental, &pixel)?.homogeneous())
        };
        Numbers::or_nan(pixels1.points().into_iter().map(line))
    }

    /// Epipoles of both images.
    fn epipoles(fundamental: Matrix3<f64>) -> Epipoles {
        let (epipole1, epipole2) = epipolar::epipoles(&fundamental)?;
        Epipoles { epipole1: homogeneous(epipole1), epipole2: homogeneous(epipole2) }
    }

    /// Nearest matrix of rank 2, of unit norm.
    fn enforce_rank2(matrix: Matrix3<f64>) -> Matrix3<f64> {
        epipolar::enforce_rank2(&matrix)?
    }

    /// Nearest essential matrix, of unit norm.
    fn project_to_essential(matrix: Matrix3<f64>) -> Matrix3<f64> {
        epipolar::project_to_essential(&matrix)?
    }

    /// The four motions of an essential matrix, with translations of length 1.
    fn decompose_essential(essential: Matrix3<f64>) -> Vec<RigidTransform> {
        epipolar::decompose_essential(&essential)?.to_vec()
    }

    /// Motion with most points in front of both cameras, from matches without outliers.
    fn select_pose(
        motions: Vec<RigidTransform>, pixels1: Vectors<2>, pixels2: Vectors<2>,
        k1: Intrinsics, k2: Intrinsics
    ) -> SelectedPose {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        epipolar::select_pose(&motions, &pixels1, &pixels2, &k1, &k2)?
    }

    /// Essential matrix of a motion, of unit norm.
    fn essential_from_motion(cam2_from_cam1: RigidTransform) -> Matrix3<f64> {
        epipolar::essential_from_motion(&cam2_from_cam1)?
    }

    /// Fundamental matrix of two cameras, of unit norm, for undistorted pixels.
    fn fundamental_from_cameras(camera1: PosedCamera, camera2: PosedCamera) -> Matrix3<f64> {
        epipolar::fundamental_from_cameras(&camera1, &camera2)?
    }

    /// Fundamental matrix of an essential matrix, of unit norm.
    fn fundamental_from_essential(
        essential: Matrix3<f64>, k1: Intrinsics, k2: Intrinsics
    ) -> Matrix3<f64> {
        epipolar::fundamental_from_essential(&essential, &k1, &k2)?
    }

    /// Essential matrix of a fundamental matrix, of unit norm.
    fn essential_from_fundamental(
        fundamental: Matrix3<f64>, k1: Intrinsics, k2: Intrinsics
    ) -> Matrix3<f64> {
        epipolar::essential_from_fundamental(&fundamental, &k1, &k2)?
    }

    /// Focal lengths of both cameras from a fundamental matrix, pixels.
    fn focal_lengths_from_fundamental(
        fundamental: Matrix3<f64>, principal1: Point2<f64>, principal2: Point2<f64>
    ) -> Numbers {
        let focals = epipolar::focal_lengths_from_fundamental(
            &fundamental, &principal1, &principal2,
        )?;
        Numbers(focals.to_vec())
    }
}
