//! Errors of matches, pixels, by the models of two views.

use epipole::camera::{Camera, Observation, RigidTransform};
use epipole::epipolar::{decompose_essential, sampson_px, tangent_sampson_px};
use epipole::homography::homography_sampson_px;
use nalgebra::{Matrix3, Point2};

/// Matching pixels of two images.
pub(super) type Pixels<'a> = [&'a [Point2<f64>]; 2];

fn each(pixels: Pixels<'_>, error_px: impl Fn(&Point2<f64>, &Point2<f64>) -> f64) -> Vec<f64> {
    let pairs = pixels[0].iter().zip(pixels[1]);
    pairs.map(|(a, b)| error_px(a, b)).collect()
}

/// Returns the errors of F.
pub(super) fn of_fundamental(pixels: Pixels<'_>, f: &Matrix3<f64>) -> Vec<f64> {
    each(pixels, |a, b| sampson_px(f, a, b))
}

/// Returns the errors of an H of pixels.
pub(super) fn of_homography(pixels: Pixels<'_>, h: &Matrix3<f64>) -> Vec<f64> {
    each(pixels, |a, b| homography_sampson_px(h, a, b))
}

/// Matches seen through lenses. The error is infinite at a pixel without a ray.
pub(super) struct ObservedPixels(Vec<Option<[Observation; 2]>>);

impl ObservedPixels {
    pub(super) fn new(cameras: [&Camera; 2], pixels: Pixels<'_>) -> Self {
        let pairs = pixels[0].iter().zip(pixels[1]);
        let observed = pairs.map(|(a, b)| {
            let (one, two) = (cameras[0].observe(a).ok()?, cameras[1].observe(b).ok()?);
            Some([one, two])
        });
        Self(observed.collect())
    }

    fn each(&self, error_px: impl Fn(&Observation, &Observation) -> f64) -> Vec<f64> {
        let error = |[a, b]: &[Observation; 2]| error_px(a, b);
        let of = |observed: &Option<_>| observed.as_ref().map_or(f64::INFINITY, error);
        self.0.iter().map(of).collect()
    }

    /// Returns the errors of a motion.
    pub(super) fn of_motion(&self, motion: &RigidTransform) -> Vec<f64> {
        self.each(|a, b| tangent_sampson_px(motion, a, b))
    }

    /// Returns the errors of E, for each match by the motion that fits it best, because none is
    /// chosen in a degenerate configuration.
    pub(super) fn of_essential(&self, essential: &Matrix3<f64>) -> epipole::Result<Vec<f64>> {
        let motions = decompose_essential(essential)?;
        Ok(self.each(|a, b| {
            let errors = motions
                .iter()
                .map(|motion| tangent_sampson_px(motion, a, b));
            errors.fold(f64::INFINITY, f64::min)
        }))
    }

    /// Returns the errors of an H of rays, in image 2.
    pub(super) fn of_homography(&self, homography: &Matrix3<f64>) -> Vec<f64> {
        self.each(|a, b| {
            let off = b.offset_px(&(homography * a.ray()));
            off.map_or(f64::INFINITY, |off| off.norm())
        })
    }
}
