//! Homographies, and similarity transforms of the plane.

#[cfg(feature = "geometry")]
pub(crate) mod calibrated;

use crate::argument::{Sample, Vectors};
use crate::functions::functions;
use crate::options::{Options, Setting};
use crate::output::{Numbers, records};
use epipole::ArrayVec;
use epipole::camera::{Intrinsics, RigidTransform};
use epipole::homography::{self, PlaneMotion};
use epipole::nalgebra::{Matrix3, Point2, Vector3};
use epipole::optim::RobustLoss;
use epipole::robust::{self, PlaneSimilarity, RansacOptions, RansacReport};

records! {
    /// A motion and the plane that explain a homography.
    PlaneMotion as PlaneMotion {
        /// Motion; the translation is in units of the distance of the plane from camera 1.
        cam2_from_cam1: RigidTransform,
        /// Unit normal of the plane in the frame of camera 1.
        normal_in_cam1: Vector3<f64>,
    }

    /// Similarity of the plane: (u, v) to (a u - b v + tu, b u + a v + tv).
    PlaneSimilarity as PlaneSimilarity {
        /// Scale times cosine.
        a: f64,
        /// Scale times sine.
        b: f64,
        /// Translation along u, pixels.
        tu: f64,
        /// Translation along v, pixels.
        tv: f64,
    }
}

functions! {
    /// Homography of matches with outliers, by RANSAC: `x2 ~ H x1`.
    fn estimate_homography(
        pixels1: Vectors<2>, pixels2: Vectors<2>, options: Options<RansacOptions>; monitor
    ) -> RansacReport<Matrix3<f64>> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        homography::estimate_homography(&pixels1, &pixels2, &options.0, monitor)?
    }

    /// Homography of matches without outliers, by linear least squares.
    fn fit_homography(pixels1: Vectors<2>, pixels2: Vectors<2>) -> Matrix3<f64> {
        homography::fit_homography(&pixels1.points(), &pixels2.points())?
    }

    /// Homography of four matches; none if three points lie on a line.
    fn homography_4point(
        pixels1: Sample<4, 2>, pixels2: Sample<4, 2>
    ) -> ArrayVec<Matrix3<f64>, 1> {
        homography::homography_4point(&pixels1.points(), &pixels2.points())
    }

    /// Refines a homography from matches without outliers by minimizing a robust loss.
    fn refine_homography(
        homography: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>,
        loss: Option<Setting<RobustLoss>>
    ) -> Matrix3<f64> {
        let loss = loss.map_or(RobustLoss::Trivial, |loss| loss.0);
        homography::refine_homography(&homography, &pixels1.points(), &pixels2.points(), loss)?
    }

    /// Maps pixels of image 1 to image 2; NaN for those that go to infinity.
    fn transfer(homography: Matrix3<f64>, pixels1: Vectors<2>) -> Numbers {
        let map = |pixel: Point2<f64>| {
            let mapped = homography::transfer(&homography, &pixel);
            mapped.map_or([f64::NAN; 2], |pixel| [pixel.x, pixel.y])
        };
        Numbers(pixels1.points().into_iter().flat_map(map).collect())
    }

    /// Distances in image 2 between mapped and matched pixels, pixels.
    fn transfer_error_px(
        homography: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        crate::pairs::numbers(pixels1, pixels2, |pixel1, pixel2| {
            homography::transfer_error_px(&homography, pixel1, pixel2)
        })?
    }

    /// Sampson distances of matches from a homography, pixels.
    fn homography_sampson_px(
        homography: Matrix3<f64>, pixels1: Vectors<2>, pixels2: Vectors<2>
    ) -> Numbers {
        crate::pairs::numbers(pixels1, pixels2, |pixel1, pixel2| {
            homography::homography_sampson_px(&homography, pixel1, pixel2)
        })?
    }

    /// Motions and planes that explain a homography between two calibrated cameras.
    fn decompose_homography(
        homography: Matrix3<f64>, k1: Intrinsics, k2: Intrinsics
    ) -> Vec<PlaneMotion> {
        homography::decompose_homography(&homography, &k1, &k2)?
    }

    /// Homography of a plane with a unit normal at a distance from camera 1.
    fn homography_from_motion(
        cam2_from_cam1: RigidTransform, normal_in_cam1: Vector3<f64>, distance: f64,
        k1: Intrinsics, k2: Intrinsics
    ) -> Matrix3<f64> {
        homography::homography_from_motion(&cam2_from_cam1, &normal_in_cam1, distance, &k1, &k2)
    }

    /// Similarity of matches with outliers, by RANSAC.
    fn estimate_similarity(
        pixels1: Vectors<2>, pixels2: Vectors<2>, options: Options<RansacOptions>; monitor
    ) -> RansacReport<PlaneSimilarity> {
        let (pixels1, pixels2) = (pixels1.points(), pixels2.points());
        robust::estimate_similarity(&pixels1, &pixels2, &options.0, monitor)?
    }

    /// Similarity of matches without outliers, by least squares.
    fn fit_similarity(pixels1: Vectors<2>, pixels2: Vectors<2>) -> PlaneSimilarity {
        robust::fit_similarity(&pixels1.points(), &pixels2.points())?
    }
}
