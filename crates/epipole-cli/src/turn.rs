//! Cameras that only turned: E and F mean nothing then, though they fit.

use epipole::camera::{Intrinsics, RigidTransform};
use epipole::homography::homography_sampson_px;
use epipole::robust::RansacOptions;
use epipole::two_view::{TwoViewOptions, find_rotation};
use nalgebra::{Point2, Rotation3, Translation3, UnitQuaternion};

/// A match can miss a turn in two dimensions, an epipolar line in one; as in
/// [`epipole::two_view`].
const TWO_DIMENSIONS: f64 = 1.25;

/// Samples of two matches. Where a turn explains as much as is asked for, a tenth is plenty.
const MAX_SAMPLES: usize = 300;

/// A turn that explains nearly all of some inliers.
pub(crate) struct Turn {
    pub(crate) cam2_from_cam1: RigidTransform,
    num_explained: usize,
    num_inliers: usize,
}

impl Turn {
    /// What there is to warn of.
    pub(crate) fn sentence(&self) -> String {
        format!(
            "a camera that only turned explains {} of the {} inliers: whether and in which direction \
             it moved cannot be told",
            self.num_explained, self.num_inliers
        )
    }
}

/// The turn that explains the inliers of another model as well, if there is one.
///
/// * `options`: those that the model was found with
pub(crate) fn find_turn(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    [k1, k2]: &[Intrinsics; 2],
    inliers: &[bool],
    options: &RansacOptions,
) -> Option<Turn> {
    let among = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        let kept = pixels.iter().zip(inliers).filter(|(_, is)| **is);
        kept.map(|(pixel, _)| *pixel).collect()
    };
    let (in1, in2) = (among(pixels1), among(pixels2));
    let reach_px = TWO_DIMENSIONS * options.max_error_px;
    let options = RansacOptions {
        // Distances in image 2 have the noise of both images.
        max_error_px: core::f64::consts::SQRT_2 * reach_px,
        max_iterations: options.max_iterations.min(MAX_SAMPLES),
        ..*options
    };
    let report = find_rotation(&in1, &in2, k1, k2, &options).ok()?;
    let homography = k2.matrix() * report.model * k1.inverse_matrix();
    let num_explained = in1
        .iter()
        .zip(&in2)
        .filter(|(p1, p2)| homography_sampson_px(&homography, p1, p2) < reach_px)
        .count();
    let needed = TwoViewOptions::default().max_homography_share * in1.len() as f64;
    // Two matches fit a turn always.
    if report.num_unique_inliers < 3 || (num_explained as f64) < needed {
        return None;
    }
    let rotation = Rotation3::from_matrix_unchecked(report.model);
    Some(Turn {
        cam2_from_cam1: RigidTransform::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_rotation_matrix(&rotation),
        ),
        num_explained,
        num_inliers: in1.len(),
    })
}
