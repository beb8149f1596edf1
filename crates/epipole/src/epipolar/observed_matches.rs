//! Matches with the rays of both cameras.

use crate::Result;
use crate::camera::{Camera, Observation};
use crate::robust::MatchSet;
use nalgebra::Point2;

/// Unique matches that both lenses see, and their observations in images 1 and 2, in the order of
/// the set.
#[derive(Debug, Clone)]
pub(crate) struct ObservedMatches {
    pub(crate) matches: MatchSet,
    pub(crate) observations: [Vec<Observation>; 2],
}

impl ObservedMatches {
    /// Creates the matches; those with a pixel without a ray are left out, as are those that
    /// [`MatchSet::new`] leaves out.
    ///
    /// # Errors
    /// As [`MatchSet::new`].
    pub(crate) fn new(
        pixels1: &[Point2<f64>],
        pixels2: &[Point2<f64>],
        cameras: [&Camera; 2],
    ) -> Result<Self> {
        let observed = [(pixels1, cameras[0]), (pixels2, cameras[1])].map(|(pixels, camera)| {
            let observe = |pixel| camera.observe(pixel).ok();
            pixels.iter().map(observe).collect::<Vec<_>>()
        });
        let both = |i: usize| {
            observed
                .iter()
                .all(|observations| observations[i].is_some())
        };
        let matches = MatchSet::of_usable(pixels1, pixels2, both)?;
        let unique_indices = matches.unique().first_occurrences();
        let observations = observed.map(|observations| {
            unique_indices
                .iter()
                .filter_map(|&i| observations[i])
                .collect()
        });
        Ok(Self {
            matches,
            observations,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Fisheye, Intrinsics, Lens};

    #[test]
    fn matches_invisible_to_a_lens_are_left_out() {
        let pinhole = Camera::pinhole(Intrinsics::centered(200.0, 640, 640).unwrap(), 640, 640);
        let fisheye = Camera {
            lens: Lens::Fisheye(Fisheye::default()),
            ..pinhole
        };
        // The second pixel would be 270° off the axis of a fisheye.
        let middle = pinhole.intrinsics.principal_point();
        let far = Point2::new(middle.x + 300.0 * core::f64::consts::PI, middle.y);
        let pixels = [middle, far, middle];
        let observed = ObservedMatches::new(&pixels, &pixels, [&fisheye, &pinhole]).unwrap();
        assert_eq!(observed.matches.unique().places(), [Some(0), None, Some(0)]);
        assert!(
            observed
                .observations
                .iter()
                .all(|observations| observations.len() == 1)
        );
        let all = ObservedMatches::new(&pixels, &pixels, [&pinhole; 2]).unwrap();
        assert_eq!(all.matches.len(), 2);
    }
}
