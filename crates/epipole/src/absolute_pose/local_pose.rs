//! A pose that rotates about a point near the data.

use super::point_errors::Pose;
use crate::math::nearest_orthogonal;
use nalgebra::{Matrix2x3, Rotation3, SMatrix, SVector, Vector3};

/// Rotation, and the pivot in the camera frame.
pub(super) type LocalPose = Pose;

/// Center of rotation, chosen so that rotations and shifts have nearly independent effects on the
/// pixels.
pub(super) struct Pivot {
    /// Position in the world.
    pub(super) position: Vector3<f64>,
    /// Unit of length of the shifts.
    unit: f64,
}

impl Pivot {
    /// Computes the mean of the points, weighted by their inverse squared depth, so that
    /// extremely far points have no effect.
    ///
    /// * `points`: points in the world with their depths
    pub(super) fn new(
        points: impl Iterator<Item = (Vector3<f64>, f64)> + Clone,
        (rotation, t): &Pose,
    ) -> Self {
        let depths = points.clone().map(|(_, depth)| depth);
        let nearest = depths.filter(|z| *z > 0.0).fold(f64::INFINITY, f64::min);
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for (x, depth) in points {
            let nearness = nearest / depth;
            // Points behind the camera make the initial cost infinite; they do not affect the
            // pivot.
            if nearness > 0.0 {
                sum += x * (nearness * nearness);
                total += nearness * nearness;
            }
        }
        let position = if total > 0.0 {
            sum / total
        } else {
            Vector3::zeros()
        };
        let distance = (rotation * position + t).norm();
        Self {
            position,
            unit: if distance > 0.0 { distance } else { 1.0 },
        }
    }

    pub(super) fn local(&self, (rotation, t): &Pose) -> LocalPose {
        (*rotation, rotation * self.position + t)
    }

    /// Returns `None` if the pose is not finite.
    pub(super) fn in_world(&self, (rotation, pivot_in_cam): &LocalPose) -> Option<Pose> {
        let rotation = nearest_orthogonal(rotation);
        let t = pivot_in_cam - rotation * self.position;
        let finite = rotation.iter().chain(t.iter()).all(|x| x.is_finite());
        finite.then_some((rotation, t))
    }

    /// Returns a point relative to the camera and relative to the pivot, both along the camera's
    /// axes.
    pub(super) fn places(
        &self,
        (rotation, pivot_in_cam): &LocalPose,
        point: &Vector3<f64>,
    ) -> [Vector3<f64>; 2] {
        let from_pivot = rotation * (point - self.position);
        [from_pivot + pivot_in_cam, from_pivot]
    }

    /// Returns the Jacobian of an error by a rotation about the pivot and a shift.
    ///
    /// * `by_point`: derivative of the error by the point in the camera frame
    pub(super) fn jacobian(
        &self,
        by_point: &Matrix2x3<f64>,
        from_pivot: &Vector3<f64>,
    ) -> SMatrix<f64, 2, 6> {
        let by_rotation = by_point * -from_pivot.cross_matrix();
        let by_shift = by_point * self.unit;
        let mut jacobian = SMatrix::<f64, 2, 6>::zeros();
        jacobian
            .fixed_view_mut::<2, 3>(0, 0)
            .copy_from(&by_rotation);
        jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&by_shift);
        jacobian
    }

    pub(super) fn moved(
        &self,
        (rotation, pivot_in_cam): &LocalPose,
        delta: &SVector<f64, 6>,
    ) -> LocalPose {
        let delta_rotation =
            Rotation3::from_scaled_axis(Vector3::new(delta[0], delta[1], delta[2]));
        (
            delta_rotation.into_inner() * rotation,
            pivot_in_cam + Vector3::new(delta[3], delta[4], delta[5]) * self.unit,
        )
    }
}
