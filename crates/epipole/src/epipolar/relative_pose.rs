//! Relative pose of two cameras, up to the length of the translation.

use super::from_cameras::NO_BASELINE;
use super::{essential_from_motion, fundamental_from_essential};
use crate::Result;
use crate::camera::{Intrinsics, RigidTransform, cross_matrix};
use crate::math::scaling::unit;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Motion between two calibrated cameras, up to the length of the translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePose {
    /// R of `cam2_from_cam1`.
    pub rotation: Matrix3<f64>,
    /// t of `cam2_from_cam1`, of length 1.
    pub direction: Vector3<f64>,
}

impl RelativePose {
    /// Creates the pose of a motion; the length of t is dropped.
    ///
    /// # Errors
    /// As [`essential_from_motion`]; a motion without translation has no direction.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::RigidTransform;
    /// use epipole::epipolar::RelativePose;
    /// use nalgebra::Vector3;
    /// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-3.0, 0.0, 4.0), Vector3::new(0.0, 0.1, 0.0));
    /// let pose = RelativePose::from_motion(&cam2_from_cam1)?;
    /// assert!((pose.direction - Vector3::new(-0.6, 0.0, 0.8)).norm() < 1e-12);
    /// # Ok(()) }
    /// ```
    pub fn from_motion(cam2_from_cam1: &RigidTransform) -> Result<Self> {
        essential_from_motion(cam2_from_cam1)?;
        Ok(Self {
            rotation: cam2_from_cam1.rotation.to_rotation_matrix().into_inner(),
            direction: unit(&cam2_from_cam1.translation.vector).ok_or(NO_BASELINE)?,
        })
    }

    /// Returns `[t]ₓ R` with unit Frobenius norm.
    pub fn essential(&self) -> Matrix3<f64> {
        cross_matrix(&self.direction) * self.rotation * core::f64::consts::FRAC_1_SQRT_2
    }

    /// Returns F of the pixels of pinhole cameras with intrinsics `k1` and `k2`, unit Frobenius
    /// norm.
    ///
    /// # Errors
    /// As [`fundamental_from_essential`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Intrinsics, RigidTransform};
    /// use epipole::epipolar::{RelativePose, sampson_px};
    /// use nalgebra::{Point3, Vector3};
    /// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
    /// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-3.0, 0.0, 4.0), Vector3::new(0.0, 0.1, 0.0));
    /// let f = RelativePose::from_motion(&cam2_from_cam1)?.fundamental(&k, &k)?;
    /// let x = Point3::new(1.0, -0.5, 6.0);
    /// let (p1, p2) = (k.project(&x)?, k.project(&(cam2_from_cam1 * x))?);
    /// assert!(sampson_px(&f, &p1, &p2) < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn fundamental(&self, k1: &Intrinsics, k2: &Intrinsics) -> Result<Matrix3<f64>> {
        let essential = cross_matrix(&self.direction) * self.rotation;
        fundamental_from_essential(&essential, k1, k2)
    }

    /// Returns F of an unscored candidate: if there is none, zeros, which no match fits.
    pub(crate) fn fundamental_or_zeros(&self, k1: &Intrinsics, k2: &Intrinsics) -> Matrix3<f64> {
        self.fundamental(k1, k2)
            .unwrap_or_else(|_| Matrix3::zeros())
    }

    /// Reverses the direction of the translation.
    pub(super) fn back(self) -> Self {
        Self {
            direction: -self.direction,
            ..self
        }
    }

    /// Returns R and t as a transform; t has length 1.
    pub fn cam2_from_cam1(&self) -> RigidTransform {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation);
        RigidTransform::from_parts(
            Translation3::from(self.direction),
            UnitQuaternion::from_rotation_matrix(&rotation),
        )
    }
}

impl From<(Matrix3<f64>, Vector3<f64>)> for RelativePose {
    /// Creates a pose from R and a t of length 1.
    fn from((rotation, direction): (Matrix3<f64>, Vector3<f64>)) -> Self {
        Self {
            rotation,
            direction,
        }
    }
}
