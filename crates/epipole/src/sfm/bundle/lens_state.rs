//! Refined parameters of a lens.

use super::options::BundleOptions;
use super::scene::Bundle;
use crate::Result;
use crate::camera::{Intrinsics, Lens, MAX_COEFFICIENTS};
use nalgebra::Vector2;

/// Capacity for the refined parameters of a lens: a factor of the focal lengths, its first
/// coefficients, the principal point's shift. Four coefficients are enough for Brown's model (k1,
/// k2, p1, p2), a fisheye and the division model. Parameters refined more often come first, as the
/// unused tail costs nothing.
pub(super) const OF_BROWN: usize = 4 + BESIDE_COEFFICIENTS;
/// The same for the rational model, too.
pub(super) const OF_ANY: usize = MAX_COEFFICIENTS + BESIDE_COEFFICIENTS;
const BESIDE_COEFFICIENTS: usize = 3;

/// The refined parameters of a lens.
#[derive(Clone)]
pub(super) struct LensState {
    /// A factor of the focal lengths.
    pub(super) focal: f64,
    /// Of the principal point.
    pub(super) shift_px: Vector2<f64>,
    pub(super) lens: Lens,
}

impl LensState {
    /// The state before refinement.
    pub(super) fn new(lens: Lens) -> Self {
        Self {
            focal: 1.0,
            shift_px: Vector2::zeros(),
            lens,
        }
    }

    /// The intrinsics after refinement.
    pub(super) fn refined(&self, k: &Intrinsics) -> Result<Intrinsics> {
        let center = k.principal_point() + self.shift_px;
        Intrinsics::new(
            k.fu_px() * self.focal,
            k.fv_px() * self.focal,
            center.x,
            center.y,
        )
    }

    pub(super) fn moved<const S: usize>(&self, step: &[f64; S]) -> Self {
        Self {
            focal: self.focal + step[0],
            shift_px: self.shift_px + Vector2::new(step[S - 2], step[S - 1]),
            lens: self.lens.moved(&step[1..S - 2]),
        }
    }
}

/// Which coefficients are refined, lens by lens.
pub(super) fn refined(bundle: &Bundle, options: &BundleOptions) -> Vec<[bool; MAX_COEFFICIENTS]> {
    let of = |lens: usize| bundle.lenses.get(lens).copied().unwrap_or_default();
    (0..bundle.num_lenses())
        .map(|lens| options.refined(of(lens).kind()))
        .collect()
}
