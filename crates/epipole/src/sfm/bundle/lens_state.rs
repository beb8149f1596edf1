//! Refined parameters of a lens.

use super::options::BundleOptions;
use crate::Result;
use crate::camera::{Camera, Intrinsics, Lens, MAX_COEFFICIENTS};
use nalgebra::Vector2;

/// Capacity for the refined parameters of a lens: a factor of the focal lengths, its first
/// coefficients, the principal point's shift. Four coefficients are enough for Brown's model (k1,
/// k2, p1, p2), a fisheye and the division model. Parameters refined more often come first, as the
/// unused tail costs nothing.
pub(super) const OF_BROWN: usize = 4 + BESIDE_COEFFICIENTS;
/// Capacity for any lens, including the rational model.
pub(super) const OF_ANY: usize = MAX_COEFFICIENTS + BESIDE_COEFFICIENTS;
const BESIDE_COEFFICIENTS: usize = 3;

/// The refined parameters of a lens.
#[derive(Clone)]
pub(super) struct LensState {
    /// Factor of the focal lengths.
    pub(super) focal: f64,
    /// Shift of the principal point.
    pub(super) shift_px: Vector2<f64>,
    pub(super) lens: Lens,
}

impl LensState {
    /// Returns the state before refinement.
    pub(super) fn new(lens: Lens) -> Self {
        Self {
            focal: 1.0,
            shift_px: Vector2::zeros(),
            lens,
        }
    }

    /// Returns the camera after refinement.
    pub(super) fn refined(&self, camera: &Camera) -> Result<Camera> {
        let k = &camera.intrinsics;
        let center = k.principal_point() + self.shift_px;
        let [fu_px, fv_px] = [k.fu_px(), k.fv_px()].map(|focal_px| focal_px * self.focal);
        Ok(Camera {
            intrinsics: Intrinsics::new(fu_px, fv_px, center.x, center.y)?,
            lens: self.lens,
            ..*camera
        })
    }

    pub(super) fn moved<const S: usize>(&self, step: &[f64; S]) -> Self {
        Self {
            focal: self.focal + step[0],
            shift_px: self.shift_px + Vector2::new(step[S - 2], step[S - 1]),
            lens: self.lens.moved(&step[1..S - 2]),
        }
    }
}

/// Returns which coefficients are refined, for each lens.
pub(super) fn refined(lenses: &[Lens], options: &BundleOptions) -> Vec<[bool; MAX_COEFFICIENTS]> {
    (lenses.iter())
        .map(|lens| options.refined(lens.kind()))
        .collect()
}
