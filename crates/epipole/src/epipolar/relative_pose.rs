//! Where the second camera is, up to the length of the step, and F with it.

use super::from_cameras::NO_BASELINE;
use super::{essential_from_motion, fundamental_from_essential};
use crate::Result;
use crate::camera::{Intrinsics, RigidTransform, cross_matrix};
use crate::math::scaling::unit;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The motion between two calibrated cameras, up to the length of the translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePose {
    /// R of `cam2_from_cam1`.
    pub rotation: Matrix3<f64>,
    /// t of `cam2_from_cam1`, of length 1.
    pub direction: Vector3<f64>,
    /// The fundamental matrix of the pixels, unit Frobenius norm.
    pub fundamental: Matrix3<f64>,
}

impl RelativePose {
    /// The pose of a motion between cameras with intrinsics `k1` and `k2`; the length of t is dropped.
    ///
    /// # Errors
    /// As [`essential_from_motion`] and [`fundamental_from_essential`]; a motion without a step has no
    /// direction.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Intrinsics, RigidTransform};
    /// use epipole::epipolar::{RelativePose, sampson_px};
    /// use nalgebra::{Point3, Vector3};
    /// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
    /// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-3.0, 0.0, 4.0), Vector3::new(0.0, 0.1, 0.0));
    /// let pose = RelativePose::from_motion(&cam2_from_cam1, &k, &k)?;
    /// assert!((pose.direction - Vector3::new(-0.6, 0.0, 0.8)).norm() < 1e-12);
    /// let x = Point3::new(1.0, -0.5, 6.0);
    /// let (p1, p2) = (k.project(&x)?, k.project(&(cam2_from_cam1 * x))?);
    /// assert!(sampson_px(&pose.fundamental, &p1, &p2) < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn from_motion(
        cam2_from_cam1: &RigidTransform,
        k1: &Intrinsics,
        k2: &Intrinsics,
    ) -> Result<Self> {
        let essential = essential_from_motion(cam2_from_cam1)?;
        Ok(Self {
            rotation: cam2_from_cam1.rotation.to_rotation_matrix().into_inner(),
            direction: unit(&cam2_from_cam1.translation.vector).ok_or(NO_BASELINE)?,
            fundamental: fundamental_from_essential(&essential, k1, k2)?,
        })
    }

    /// A pose with its fundamental matrix, for cameras with intrinsics `k1` and `k2`.
    ///
    /// # Errors
    /// As [`fundamental_from_essential`].
    pub(crate) fn checked(
        rotation: Matrix3<f64>,
        direction: Vector3<f64>,
        k1: &Intrinsics,
        k2: &Intrinsics,
    ) -> Result<Self> {
        let essential = cross_matrix(&direction) * rotation;
        Ok(Self {
            rotation,
            direction,
            fundamental: fundamental_from_essential(&essential, k1, k2)?,
        })
    }

    /// [`checked`](Self::checked) for a candidate that is yet to be judged: without a fundamental
    /// matrix it keeps zeros in its place, which no match fits, so it is never the answer.
    pub(crate) fn new(
        rotation: Matrix3<f64>,
        direction: Vector3<f64>,
        k1: &Intrinsics,
        k2: &Intrinsics,
    ) -> Self {
        Self::checked(rotation, direction, k1, k2).unwrap_or(Self {
            rotation,
            direction,
            fundamental: Matrix3::zeros(),
        })
    }

    /// `[t]ₓ R` with unit Frobenius norm.
    pub fn essential(&self) -> Matrix3<f64> {
        cross_matrix(&self.direction) * self.rotation * core::f64::consts::FRAC_1_SQRT_2
    }

    /// R and t as a transform; t has length 1.
    pub fn cam2_from_cam1(&self) -> RigidTransform {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation);
        RigidTransform::from_parts(
            Translation3::from(self.direction),
            UnitQuaternion::from_rotation_matrix(&rotation),
        )
    }
}
