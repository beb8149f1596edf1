//! Poses and points during refinement, for any lens.

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

/// `cam_from_world`, with its rotation also as a matrix.
#[derive(Clone)]
pub(crate) struct PoseState {
    pub(crate) rotation: UnitQuaternion<f64>,
    matrix: Matrix3<f64>,
    pub(crate) translation: Vector3<f64>,
}

impl PoseState {
    pub(crate) fn new(rotation: UnitQuaternion<f64>, translation: Vector3<f64>) -> Self {
        Self {
            rotation,
            matrix: *rotation.to_rotation_matrix().matrix(),
            translation,
        }
    }

    /// Returns `R X`.
    #[inline]
    pub(crate) fn rotated(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.matrix * point.coords
    }

    /// Returns the derivatives by the six parameters of [`PoseState::moved`] and by the point X,
    /// from `by_p`, the derivative by `R X + t`.
    #[inline]
    pub(crate) fn derivatives(
        &self,
        rotated: &Vector3<f64>,
        by_p: &Vector3<f64>,
    ) -> ([f64; 6], [f64; 3]) {
        // exp(δ) R X moves by δ × R X, and g · (δ × q) = δ · (q × g).
        let by_rotation = rotated.cross(by_p);
        let by_pose = [
            by_rotation.x,
            by_rotation.y,
            by_rotation.z,
            by_p.x,
            by_p.y,
            by_p.z,
        ];
        (by_pose, self.matrix.tr_mul(by_p).into())
    }

    /// Returns the camera's center `−Rᵀ t`, and the derivatives of its coordinates by the six
    /// parameters of [`PoseState::moved`].
    pub(crate) fn center(&self) -> (Point3<f64>, [[f64; 6]; 3]) {
        let center = Point3::from(-self.matrix.tr_mul(&self.translation));
        // −Rᵀ exp(−δ) (t + d): the axis e moves by −(R e) · d + δ · (t × R e).
        let by_pose = core::array::from_fn(|axis| {
            let r: Vector3<f64> = self.matrix.column(axis).into();
            let by_rotation = self.translation.cross(&r);
            [
                by_rotation.x,
                by_rotation.y,
                by_rotation.z,
                -r.x,
                -r.y,
                -r.z,
            ]
        });
        (center, by_pose)
    }

    /// Returns `exp(δ) R` and `t + d` for the step (δ, d); identical bits for a zero step, so that
    /// a held camera does not move.
    pub(crate) fn moved(&self, step: [f64; 6]) -> Self {
        let [a, b, c, x, y, z] = step;
        let rotation = if [a, b, c] == [0.0; 3] {
            self.rotation
        } else {
            let delta = UnitQuaternion::from_scaled_axis(Vector3::new(a, b, c));
            UnitQuaternion::new_normalize((delta * self.rotation).into_inner())
        };
        Self::new(rotation, self.translation + Vector3::new(x, y, z))
    }
}

/// Writes the points after a step to `into`.
pub(crate) fn move_points(from: &[Point3<f64>], step: &[[f64; 3]], into: &mut [Point3<f64>]) {
    for ((old, new), d) in from.iter().zip(into).zip(step) {
        *new = old + Vector3::from(*d);
    }
}

/// Returns `Σ ‖X‖²`.
pub(crate) fn sum_of_squares(points: &[Point3<f64>]) -> f64 {
    points.iter().map(|p| p.coords.norm_squared()).sum()
}
