//! Matches and principal points for the estimation of the focal length.

use crate::camera::plausible_focals_px;
use crate::epipolar::coordinates::{CommonFrame, Coordinates};
use crate::epipolar::estimate_fundamental::refuse_collinear;
use crate::epipolar::refine_focal::FocalCenters;
use crate::robust::MatchSet;
use crate::{Error, Result};
use core::ops::Range;
use nalgebra::Point2;

/// Estimator of relative poses of two cameras with a common unknown focal length.
///
/// A sample is six matches, and only solutions with the six points in front of both cameras and a
/// plausible focal length are scored: at least a fifth of the distance from the principal points
/// within which three quarters of the matches are, and at most twenty times the distance of the
/// farthest match. The error is the Sampson error in pixels; refinement minimizes it over rotation,
/// direction and focal length. At the end the model is compared with the best motions for focal
/// lengths over the plausible range, since all samples may lead to the valley of a wrong one. Equal
/// matches count once.
///
/// Source: as [`essential_6point`](crate::epipolar::essential_6point).
#[derive(Debug, Clone)]
pub(in crate::epipolar) struct FocalEstimator {
    pub(in crate::epipolar) matches: MatchSet,
    pub(in crate::epipolar) pixels: Coordinates,
    pub(in crate::epipolar) in_frame: Coordinates,
    pub(in crate::epipolar) frame: CommonFrame,
    pub(in crate::epipolar) centers: [Point2<f64>; 2],
    pub(in crate::epipolar) centers_in_frame: FocalCenters,
    pub(in crate::epipolar) focals_px: Range<f64>,
}

pub(super) const NAME: &str = "a relative pose with a focal length from matches";

impl FocalEstimator {
    /// Prepares the estimation.
    ///
    /// * `principal1`, `principal2`: principal points of the two images, pixels
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 6 matches, [`Error::Degenerate`]
    /// if all pixels of an image are equal or on one line, [`Error::NotFinite`] for principal
    /// points that are not finite.
    pub(super) fn new(
        matches: MatchSet,
        principal1: &Point2<f64>,
        principal2: &Point2<f64>,
    ) -> Result<Self> {
        matches.at_least(6, NAME)?;
        let centers = [*principal1, *principal2];
        if !centers.iter().all(|c| c.x.is_finite() && c.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "a principal point",
            });
        }
        refuse_collinear(&matches, NAME)?;
        let pixels = Coordinates::voting(&matches);
        let frame = CommonFrame::new(&matches);
        let far = (0..matches.len()).map(|i| {
            let (p1, p2) = matches.pair(i);
            (p1 - centers[0]).norm().max((p2 - centers[1]).norm())
        });
        let mut far: Vec<_> = far.collect();
        Ok(Self {
            focals_px: plausible_focals_px(&mut far),
            in_frame: pixels.mapped(&frame),
            centers_in_frame: FocalCenters::new(&frame, &centers),
            matches,
            pixels,
            frame,
            centers,
        })
    }

    /// Restricts the problem to some of the matches; `None` for fewer than 6.
    pub(in crate::epipolar) fn subset(&self, indices: &[usize]) -> Option<Self> {
        let pairs = indices.iter().map(|index| self.matches.pair(*index));
        let (pixels1, pixels2): (Vec<_>, Vec<_>) = pairs.unzip();
        let matches = MatchSet::new(&pixels1, &pixels2).ok()?;
        matches.at_least(6, NAME).ok()?;
        let pixels = Coordinates::voting(&matches);
        Some(Self {
            in_frame: pixels.mapped(&self.frame),
            matches,
            pixels,
            ..self.clone()
        })
    }

    pub(super) fn is_usable(&self, focal_px: f64) -> bool {
        self.focals_px.contains(&focal_px)
    }
}
