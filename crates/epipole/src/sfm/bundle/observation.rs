//! Observations of points by cameras.

use crate::{Error, Result};
use nalgebra::Point2;

/// Pixel at which a camera saw a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BundleObservation {
    /// Index of the camera.
    pub camera: usize,
    /// Index of the point.
    pub point: usize,
    /// Observed pixel.
    pub pixel: Point2<f64>,
}

/// Checks that observations refer to existing cameras and points and are finite.
pub(in crate::sfm) fn observation_pairs(
    observations: &[BundleObservation],
    num_cameras: usize,
    num_points: usize,
) -> Result<Vec<(u32, u32)>> {
    if observations.is_empty() {
        return Err(Error::TooFew {
            what: "a bundle adjustment from observations",
            needed: 1,
            got: 0,
        });
    }
    observations
        .iter()
        .map(|o| {
            if o.camera >= num_cameras || o.point >= num_points {
                return Err(Error::OutOfRange {
                    what: "an observation's camera or point",
                    requirement: "the index of an existing one",
                    value: if o.camera >= num_cameras {
                        o.camera as f64
                    } else {
                        o.point as f64
                    },
                });
            }
            if !(o.pixel.x.is_finite() && o.pixel.y.is_finite()) {
                return Err(Error::NotFinite {
                    what: "an observation's pixel",
                });
            }
            Ok((o.camera as u32, o.point as u32))
        })
        .collect()
}
