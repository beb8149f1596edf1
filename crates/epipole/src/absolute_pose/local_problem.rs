//! A pose that turns about a point amid its data.

use super::refine::{Pose, PoseProblem};
use crate::camera::Intrinsics;
use crate::math::nearest_orthogonal;
use nalgebra::{Matrix3, Point3, Rotation3, SMatrix, SVector, Vector2, Vector3};

/// A pose problem in a frame of its own: the pose turns about a point amid the data, and moves in
/// units of that point's distance from the camera.
///
/// About the world's origin, a turn would carry the points along a circle as large as their distance
/// from there. Far out, as in geodetic coordinates, it could not be told from a shift, and the search
/// would end where it began.
pub(super) struct LocalProblem<'a> {
    pub(super) problem: &'a PoseProblem<'a>,
    /// The point about which the pose turns, in the world.
    pub(super) pivot: Vector3<f64>,
    /// The unit of length of the steps.
    unit: f64,
}

/// R, and where the camera sees the pivot.
pub(super) type LocalPose = (Matrix3<f64>, Vector3<f64>);

impl<'a> LocalProblem<'a> {
    /// The mean of the points, weighted by the square of their nearness, is a pivot for which
    /// the effects of turns and shifts on the pixels are nearly independent. One point at the end of
    /// the world does not move it.
    pub(super) fn new(problem: &'a PoseProblem<'a>, (rotation, t): &Pose) -> Self {
        let places = problem
            .used
            .indices
            .iter()
            .map(|&i| problem.points[i].coords);
        let depth = |x: &Vector3<f64>| (rotation.row(2) * x)[0] + t.z;
        let in_front = |z: &f64| *z > 0.0;
        let depths = places.clone().map(|x| depth(&x)).filter(in_front);
        let nearest = depths.fold(f64::INFINITY, f64::min);
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for x in places {
            let nearness = nearest / depth(&x);
            // What is behind the camera ends the search before it begins.
            if nearness > 0.0 {
                sum += x * (nearness * nearness);
                total += nearness * nearness;
            }
        }
        let pivot = if total > 0.0 {
            sum / total
        } else {
            Vector3::zeros()
        };
        let distance = (rotation * pivot + t).norm();
        Self {
            problem,
            pivot,
            unit: if distance > 0.0 { distance } else { 1.0 },
        }
    }

    pub(super) fn about_pivot(&self, (rotation, t): &Pose) -> LocalPose {
        (*rotation, rotation * self.pivot + t)
    }

    /// `None` if the pose is not finite.
    pub(super) fn in_world(&self, (rotation, pivot_in_cam): &LocalPose) -> Option<Pose> {
        let rotation = nearest_orthogonal(rotation);
        let t = pivot_in_cam - rotation * self.pivot;
        let finite = rotation.iter().chain(t.iter()).all(|x| x.is_finite());
        finite.then_some((rotation, t))
    }

    /// The residual, and the point seen from the camera and from the pivot, both along the camera's
    /// axes; `None` in or behind the center plane.
    pub(super) fn residual(
        &self,
        (rotation, pivot_in_cam): &LocalPose,
        k: &Intrinsics,
        index: usize,
    ) -> Option<(Vector2<f64>, [Vector3<f64>; 2])> {
        let from_pivot = rotation * (self.problem.points[index].coords - self.pivot);
        let x = from_pivot + pivot_in_cam;
        let seen = k.project(&Point3::from(x)).ok()?;
        Some((seen - self.problem.pixels[index], [x, from_pivot]))
    }

    /// The Jacobian of a residual with respect to a turn about the pivot and to a shift.
    pub(super) fn jacobian(
        &self,
        k: &Intrinsics,
        [x, from_pivot]: &[Vector3<f64>; 2],
    ) -> SMatrix<f64, 2, 6> {
        let (fu, fv) = (k.fu_px(), k.fv_px());
        let per_z = 1.0 / x.z;
        let by_point = SMatrix::<f64, 2, 3>::new(
            fu * per_z,
            0.0,
            -fu * x.x * per_z * per_z,
            0.0,
            fv * per_z,
            -fv * x.y * per_z * per_z,
        );
        let by_turn = by_point * -from_pivot.cross_matrix();
        let by_shift = by_point * self.unit;
        let mut jacobian = SMatrix::<f64, 2, 6>::zeros();
        jacobian.fixed_view_mut::<2, 3>(0, 0).copy_from(&by_turn);
        jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&by_shift);
        jacobian
    }

    pub(super) fn moved(
        &self,
        (rotation, pivot_in_cam): &LocalPose,
        delta: &SVector<f64, 6>,
    ) -> LocalPose {
        let turn = Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
        (
            turn.into_inner() * rotation,
            pivot_in_cam + Vector3::new(delta[3], delta[4], delta[5]) * self.unit,
        )
    }
}
