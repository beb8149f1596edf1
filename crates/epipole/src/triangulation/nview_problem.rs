//! Least-squares problem of a point's reprojection errors in many views.

use super::BEYOND_NUMBERS;
use super::quality::projection_jacobian;
use crate::Result;
use crate::camera::PosedCamera;
use crate::math::scaling::power_of_two;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Point2, Point3, SVector};

pub(super) struct Problem<'a> {
    pub(super) cameras: &'a [PosedCamera],
    pub(super) pixels: &'a [Point2<f64>],
    pub(super) loss: RobustLoss,
    /// Unit of length of the steps.
    pub(super) unit: f64,
}

impl Problem<'_> {
    /// Refines an initial point in front of all cameras.
    pub(super) fn refined(&self, start: Point3<f64>) -> Result<Point3<f64>> {
        let mut point = start;
        minimize_fixed(self, &mut point, &LmOptions::default())?;
        if point.iter().all(|x| x.is_finite()) {
            Ok(point)
        } else {
            Err(BEYOND_NUMBERS)
        }
    }
}

impl FixedProblem<3> for Problem<'_> {
    type Parameters = Point3<f64>;

    fn accumulate(&self, point: &Point3<f64>, normal: &mut NormalEquations<3>) {
        for (camera, pixel) in self.cameras.iter().zip(self.pixels) {
            match camera.project(point) {
                Ok(projected) => normal.add(
                    &(projected - pixel),
                    &(projection_jacobian(camera, point) * self.unit),
                    &self.loss,
                ),
                Err(_) => normal.cost = f64::INFINITY,
            }
        }
    }

    fn cost(&self, point: &Point3<f64>) -> f64 {
        let mut total = 0.0;
        for (camera, pixel) in self.cameras.iter().zip(self.pixels) {
            match camera.project(point) {
                Ok(projected) => total += 0.5 * self.loss.rho((projected - pixel).norm_squared()),
                Err(_) => return f64::INFINITY,
            }
        }
        total
    }

    fn plus(&self, point: &Point3<f64>, delta: &SVector<f64, 3>) -> Point3<f64> {
        point + delta * self.unit
    }

    fn parameter_norm(&self, point: &Point3<f64>) -> f64 {
        ((point - self.cameras[0].center_in_world()) / self.unit).norm()
    }
}

/// Returns the size of the longest baseline from the first camera, a power of two.
pub(super) fn baseline_unit(cameras: &[PosedCamera]) -> f64 {
    let origin = cameras[0].center_in_world();
    let baselines = cameras[1..]
        .iter()
        .map(|c| (c.center_in_world() - origin).amax());
    power_of_two(baselines.fold(0.0, f64::max))
}
