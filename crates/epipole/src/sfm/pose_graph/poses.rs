//! Poses of a graph: in the plane, in space, and similarities in space.

use crate::optim::EdgeTerms;
use nalgebra::{
    Isometry2, Isometry3, Matrix3, Rotation2, SMatrix, SVector, Similarity3, Translation2,
    Translation3, UnitComplex, UnitQuaternion, Vector2, Vector3,
};

/// A pose of a graph's vertices: SE(2), SE(3) or Sim(3), with `D` degrees of freedom.
pub trait GraphPose<const D: usize>: Clone + Copy + PartialEq + Send + Sync {
    /// Returns the error of an edge, from the difference `measured⁻¹ · a⁻¹ · b`.
    fn error(a: &Self, b: &Self, measured: &Self) -> SVector<f64, D>;
    /// Returns the error with its Jacobians for steps on the right, `pose · exp(δ)`.
    fn linearize(a: &Self, b: &Self, measured: &Self) -> EdgeTerms<D>;
    /// Returns `self · exp(delta)`.
    fn plus(&self, delta: &SVector<f64, D>) -> Self;
    /// Returns the squared length of the translation.
    fn translation_sq(&self) -> f64;
    /// Returns whether every number is finite.
    fn is_finite(&self) -> bool;
    /// Converts to a similarity; a pose in the plane lies in x and y.
    fn to_similarity(&self) -> Similarity3<f64>;
    /// Returns the part of a similarity that a pose of this kind represents.
    fn from_similarity(pose: &Similarity3<f64>) -> Self;
}

/// Wraps an angle to (−π, π].
fn wrap_angle(angle_rad: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let num_rotations = (angle_rad / TAU).round();
    let angle = angle_rad - num_rotations * TAU;
    if angle <= -PI { angle + TAU } else { angle }
}

impl GraphPose<3> for Isometry2<f64> {
    fn error(a: &Self, b: &Self, measured: &Self) -> SVector<f64, 3> {
        let difference = measured.inv_mul(&a.inv_mul(b));
        let t = difference.translation.vector;
        SVector::<f64, 3>::new(t.x, t.y, wrap_angle(difference.rotation.angle()))
    }

    fn linearize(a: &Self, b: &Self, measured: &Self) -> EdgeTerms<3> {
        let b_in_a = a.inv_mul(b);
        let difference = measured.inv_mul(&b_in_a);
        let undo = measured.rotation.inverse().to_rotation_matrix();
        let rotation = difference.rotation.to_rotation_matrix();
        let mut from = SMatrix::<f64, 3, 3>::zeros();
        let mut to = SMatrix::<f64, 3, 3>::zeros();
        from.fixed_view_mut::<2, 2>(0, 0).copy_from(&-undo.matrix());
        // A rotation of a by ω moves points in its frame by −ω × x, where ω × (x, y) = ω (−y, x).
        let t = b_in_a.translation.vector;
        let swept: Vector2<f64> = undo * Vector2::new(t.y, -t.x);
        from[(0, 2)] = swept.x;
        from[(1, 2)] = swept.y;
        from[(2, 2)] = -1.0;
        to.fixed_view_mut::<2, 2>(0, 0).copy_from(rotation.matrix());
        to[(2, 2)] = 1.0;
        EdgeTerms {
            residual: Self::error(a, b, measured),
            from,
            to,
        }
    }

    fn plus(&self, delta: &SVector<f64, 3>) -> Self {
        let delta_rotation = UnitComplex::from_rotation_matrix(&Rotation2::new(delta[2]));
        let shift = self.rotation * Vector2::new(delta[0], delta[1]);
        let mut rotation = self.rotation * delta_rotation;
        rotation.renormalize();
        Isometry2::from_parts(
            Translation2::from(self.translation.vector + shift),
            rotation,
        )
    }

    fn translation_sq(&self) -> f64 {
        self.translation.vector.norm_squared()
    }

    fn is_finite(&self) -> bool {
        self.translation.vector.iter().all(|x| x.is_finite())
            && self.rotation.re.is_finite()
            && self.rotation.im.is_finite()
    }

    fn to_similarity(&self) -> Similarity3<f64> {
        let t = self.translation.vector;
        let half = 0.5 * self.rotation.angle();
        let (sin, cos) = (libm::sin(half), libm::cos(half));
        let rotation = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(cos, 0.0, 0.0, sin));
        Similarity3::from_parts(Translation3::new(t.x, t.y, 0.0), rotation, 1.0)
    }

    fn from_similarity(pose: &Similarity3<f64>) -> Self {
        let t = pose.isometry.translation.vector;
        let x = pose.isometry.rotation * Vector3::x();
        let rotation = UnitComplex::new(libm::atan2(x.y, x.x));
        Isometry2::from_parts(Translation2::new(t.x, t.y), rotation)
    }
}

/// Returns the quaternion with a nonnegative real part, split into real and vector part.
fn canonical_parts(rotation: &UnitQuaternion<f64>) -> (f64, Vector3<f64>) {
    let (w, v) = (rotation.w, rotation.imag());
    if w < 0.0 { (-w, -v) } else { (w, v) }
}

/// Computes error and Jacobians for similarities; a rigid transform is one with scale 1.
#[allow(
    clippy::type_complexity,
    reason = "a tuple of what one edge gives, used once"
)]
fn similarity_terms(
    a: &Similarity3<f64>,
    b: &Similarity3<f64>,
    measured: &Similarity3<f64>,
) -> (SVector<f64, 7>, SMatrix<f64, 7, 7>, SMatrix<f64, 7, 7>) {
    let b_in_a = a.inverse() * b;
    let difference = measured.inverse() * b_in_a;
    let (w, v) = canonical_parts(&difference.isometry.rotation);
    let t = difference.isometry.translation.vector;
    let mut error = SVector::<f64, 7>::zeros();
    error.fixed_rows_mut::<3>(0).copy_from(&t);
    error.fixed_rows_mut::<3>(3).copy_from(&v);
    error[6] = libm::log(difference.scaling());

    let rotation = |s: &Similarity3<f64>| *s.isometry.rotation.to_rotation_matrix().matrix();
    // On the right of b: its translation is rotated and scaled, its quaternion multiplied.
    let mut to = SMatrix::<f64, 7, 7>::zeros();
    to.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&(rotation(&difference) * difference.scaling()));
    to.fixed_view_mut::<3, 3>(3, 3)
        .copy_from(&((Matrix3::identity() * w + v.cross_matrix()) * 0.5));
    to[(6, 6)] = 1.0;
    // On the right of a: the inverse of the step acts on b in the frame of a.
    let undo = rotation(measured).transpose();
    let scaled_undo = undo / measured.scaling();
    let translation = b_in_a.isometry.translation.vector;
    let mut from = SMatrix::<f64, 7, 7>::zeros();
    from.fixed_view_mut::<3, 3>(0, 0).copy_from(&-scaled_undo);
    from.fixed_view_mut::<3, 3>(0, 3)
        .copy_from(&(scaled_undo * translation.cross_matrix()));
    from.fixed_view_mut::<3, 1>(0, 6)
        .copy_from(&-(scaled_undo * translation));
    from.fixed_view_mut::<3, 3>(3, 3)
        .copy_from(&((v.cross_matrix() - Matrix3::identity() * w) * undo * 0.5));
    from[(6, 6)] = -1.0;
    (error, from, to)
}

fn similarity_plus(pose: &Similarity3<f64>, delta: &SVector<f64, 7>) -> Similarity3<f64> {
    let shift = pose.isometry.rotation * Vector3::new(delta[0], delta[1], delta[2]);
    let delta_rotation =
        UnitQuaternion::from_scaled_axis(Vector3::new(delta[3], delta[4], delta[5]));
    let mut rotation = pose.isometry.rotation * delta_rotation;
    rotation.renormalize();
    let translation = pose.isometry.translation.vector + shift * pose.scaling();
    // Keep the scale away from zero and infinity, where the similarity degenerates.
    let scale = (pose.scaling() * libm::exp(delta[6])).clamp(1e-100, 1e100);
    Similarity3::from_parts(Translation3::from(translation), rotation, scale)
}

impl GraphPose<6> for Isometry3<f64> {
    fn error(a: &Self, b: &Self, measured: &Self) -> SVector<f64, 6> {
        let difference = measured.inv_mul(&a.inv_mul(b));
        let (t, (_, v)) = (
            difference.translation.vector,
            canonical_parts(&difference.rotation),
        );
        SVector::<f64, 6>::new(t.x, t.y, t.z, v.x, v.y, v.z)
    }

    fn linearize(a: &Self, b: &Self, measured: &Self) -> EdgeTerms<6> {
        let lift = |pose: &Self| Similarity3::from_isometry(*pose, 1.0);
        let (error, from, to) = similarity_terms(&lift(a), &lift(b), &lift(measured));
        EdgeTerms {
            residual: error.fixed_rows::<6>(0).into_owned(),
            from: from.fixed_view::<6, 6>(0, 0).into_owned(),
            to: to.fixed_view::<6, 6>(0, 0).into_owned(),
        }
    }

    fn plus(&self, delta: &SVector<f64, 6>) -> Self {
        let mut step = SVector::<f64, 7>::zeros();
        step.fixed_rows_mut::<6>(0).copy_from(delta);
        similarity_plus(&Similarity3::from_isometry(*self, 1.0), &step).isometry
    }

    fn translation_sq(&self) -> f64 {
        self.translation.vector.norm_squared()
    }

    fn is_finite(&self) -> bool {
        self.translation.vector.iter().all(|x| x.is_finite())
            && self.rotation.coords.iter().all(|x| x.is_finite())
    }

    fn to_similarity(&self) -> Similarity3<f64> {
        Similarity3::from_isometry(*self, 1.0)
    }

    fn from_similarity(pose: &Similarity3<f64>) -> Self {
        pose.isometry
    }
}

impl GraphPose<7> for Similarity3<f64> {
    fn error(a: &Self, b: &Self, measured: &Self) -> SVector<f64, 7> {
        similarity_terms(a, b, measured).0
    }

    fn linearize(a: &Self, b: &Self, measured: &Self) -> EdgeTerms<7> {
        let (residual, from, to) = similarity_terms(a, b, measured);
        EdgeTerms { residual, from, to }
    }

    fn plus(&self, delta: &SVector<f64, 7>) -> Self {
        similarity_plus(self, delta)
    }

    fn translation_sq(&self) -> f64 {
        self.isometry.translation.vector.norm_squared()
    }

    fn is_finite(&self) -> bool {
        self.isometry.is_finite() && self.scaling().is_finite()
    }

    fn to_similarity(&self) -> Similarity3<f64> {
        *self
    }

    fn from_similarity(pose: &Similarity3<f64>) -> Self {
        *pose
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    fn random_similarity(random: &mut Random, amount: f64) -> Similarity3<f64> {
        let mut draw = || Vector3::from_fn(|_, _| amount * random.normal());
        let (t, r, s) = (draw(), draw(), draw());
        Similarity3::new(t, r, libm::exp(0.3 * s.x))
    }

    fn check_pose<T: GraphPose<D>, const D: usize>(a: T, b: T, measured: T) {
        let terms = T::linearize(&a, &b, &measured);
        assert!((terms.residual - T::error(&a, &b, &measured)).norm() < 1e-14);
        let mut analytic = DMatrix::zeros(D, 2 * D);
        analytic.view_mut((0, 0), (D, D)).copy_from(&terms.from);
        analytic.view_mut((0, D), (D, D)).copy_from(&terms.to);
        let residuals = |d: &DVector<f64>| {
            let da = SVector::<f64, D>::from_column_slice(&d.as_slice()[..D]);
            let db = SVector::<f64, D>::from_column_slice(&d.as_slice()[D..]);
            let error = T::error(&a.plus(&da), &b.plus(&db), &measured);
            DVector::from_column_slice(error.as_slice())
        };
        let worst = check_jacobian(&analytic, &residuals, 1e-6);
        assert!(worst < 1e-7, "D = {D}: {worst}");
    }

    #[test]
    fn jacobians_are_those_of_central_differences() {
        let mut random = Random::new(41);
        for _ in 0..20 {
            let mut draw = || random_similarity(&mut random, 0.6);
            let (a, b, z) = (draw(), draw(), draw());
            check_pose(a, b, z);
            check_pose(a.isometry, b.isometry, z.isometry);
            let flat = |s: &Similarity3<f64>| {
                let t = s.isometry.translation.vector;
                Isometry2::new(Vector2::new(t.x, t.y), t.z)
            };
            check_pose(flat(&a), flat(&b), flat(&z));
        }
    }

    #[test]
    fn angles_are_wrapped() {
        assert!((wrap_angle(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
        assert_eq!(wrap_angle(std::f64::consts::PI), std::f64::consts::PI);
        assert_eq!(wrap_angle(-std::f64::consts::PI), std::f64::consts::PI);
    }
}
