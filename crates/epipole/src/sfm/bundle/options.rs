//! Options of bundle adjustment.

use crate::camera::{LensKind, MAX_COEFFICIENTS};
use crate::optim::{LmOptions, RobustLoss};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::{Point3, Vector3};

/// Fixes the gauge: position, orientation and scale of the world are not observable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Gauge {
    /// The first camera and one coordinate of another one's translation are held fixed: exactly
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
    /// When to stop.
    pub lm: LmOptions,
    /// The loss of each reprojection error; its width is in pixels.
    pub loss: RobustLoss,
    /// Used only while fewer than two cameras are held.
    pub gauge: Gauge,
    /// Cameras that stay where they are, by index; missing entries are free.
    pub held_cameras: Vec<bool>,
    /// Points that stay where they are, by index; missing entries are free.
    pub held_points: Vec<bool>,
    /// Refine one factor for the focal lengths of each lens.
    pub refine_focal: bool,
    /// Refine where the principal points are: one shift for each lens, pixels.
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
    /// The loss of the position priors; its width is in standard deviations.
    pub position_loss: RobustLoss,
}

impl BundleOptions {
    /// Whether anything of the lenses is refined.
    pub(in crate::sfm) fn refines_lens(&self) -> bool {
        self.refine_focal
            || self.refine_principal_point
            || self.refine_distortion
            || self.refine_tangential
    }

    /// Which coefficients of a lens are refined, in OpenCV's order.
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

    /// Refuses losses and priors that make no sense.
    pub(super) fn check(&self) -> Result<()> {
        self.loss.check()?;
        self.position_loss.check()?;
        self.position_priors
            .iter()
            .flatten()
            .try_for_each(PositionPrior::check)
    }
}

/// A camera position measured otherwise, such as by GPS: see
/// [`local_from_geodetic`](crate::math::local_from_geodetic) for converting its degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct PositionPrior {
    /// The camera's center in the world.
    pub center_in_world: Point3<f64>,
    /// Standard deviation along each axis of the world, in its unit.
    pub sigma: Vector3<f64>,
}

impl PositionPrior {
    /// Refuses values that are not finite or of no width.
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
