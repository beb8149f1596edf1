//! Options of bundle adjustment.

use crate::camera::{LensKind, MAX_COEFFICIENTS};
use crate::optim::{LmOptions, RobustLoss};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Point3, Vector3};

/// Method to fix the gauge: position, orientation and scale of the world are not observable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Gauge {
    /// The first camera and one coordinate of another camera's translation are held fixed: exactly
    /// the seven free dimensions.
    #[default]
    TwoCameras,
    /// Nothing is fixed; damping alone keeps the solution in place.
    Free,
}

/// Options of [`adjust_bundle`](super::adjust_bundle).
#[derive(Debug, Clone, PartialEq, Default, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct BundleOptions {
    /// Stopping criteria of the solver.
    pub lm: LmOptions,
    /// Loss of each reprojection error; width in pixels.
    pub loss: RobustLoss,
    /// Gauge while fewer than two cameras are held.
    pub gauge: Gauge,
    /// Cameras held fixed, by index; missing entries are free.
    pub held_cameras: Vec<bool>,
    /// Points held fixed, by index; missing entries are free.
    pub held_points: Vec<bool>,
    /// Refine a factor of the focal lengths, one per lens.
    pub refine_focal: bool,
    /// Refine the principal points: one shift per lens, pixels.
    pub refine_principal_point: bool,
    /// Refine the radial terms of each lens: k1 and k2 of Brown's model, k1 to k6 of the rational
    /// one, k1 to k4 of a fisheye, k of the division model.
    pub refine_distortion: bool,
    /// Refine the tangential terms p1 and p2 of each lens; fisheyes and the division model have
    /// none.
    pub refine_tangential: bool,
    /// Priors of camera positions, by index; missing entries are unknown. With any prior, no camera
    /// is held by the gauge.
    pub position_priors: Vec<Option<PositionPrior>>,
    /// Loss of the position priors; width in standard deviations.
    pub position_loss: RobustLoss,
}

impl BundleOptions {
    /// Returns whether any lens parameter is refined.
    pub(in crate::sfm) fn refines_lens(&self) -> bool {
        self.refine_focal
            || self.refine_principal_point
            || self.refine_distortion
            || self.refine_tangential
    }

    /// Returns which coefficients of a lens are refined, in OpenCV's order.
    pub(super) fn refined(&self, kind: LensKind) -> [bool; MAX_COEFFICIENTS] {
        let (radial, tangential) = (self.refine_distortion, self.refine_tangential);
        let mut refined = [false; MAX_COEFFICIENTS];
        match kind {
            LensKind::Brown => refined[..2].fill(radial),
            LensKind::Rational => refined.fill(radial),
            LensKind::Fisheye => refined[..4].fill(radial),
            LensKind::Division => refined[0] = radial,
        }
        if matches!(kind, LensKind::Brown | LensKind::Rational) {
            refined[2..4].fill(tangential);
        }
        refined
    }

    /// Rejects invalid losses and priors.
    pub(super) fn check(&self) -> Result<()> {
        self.loss.check()?;
        self.position_loss.check()?;
        self.position_priors
            .iter()
            .flatten()
            .try_for_each(PositionPrior::check)
    }
}

/// Prior of a camera position, such as from GPS;
/// [`local_from_geodetic`](crate::math::local_from_geodetic) converts degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct PositionPrior {
    /// Camera center in the world.
    pub center_in_world: Point3<f64>,
    /// Standard deviation along each world axis, in world units.
    pub sigma: Vector3<f64>,
}

impl PositionPrior {
    /// Rejects values that are not finite and standard deviations that are not positive.
    pub(in crate::sfm) fn check(&self) -> Result<()> {
        if !self.center_in_world.iter().all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "the known position of a camera",
            });
        }
        match self.sigma.iter().find(|s| !(**s > 0.0 && s.is_finite())) {
            Some(&value) => Err(Error::OutOfRange {
                what: "the standard deviation of a known position",
                requirement: "greater than 0 and finite",
                value,
            }),
            None => Ok(()),
        }
    }
}
