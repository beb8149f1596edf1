//! Relative pose with the focal length of both cameras.

use crate::camera::Intrinsics;
use crate::epipolar::RelativePose;
use nalgebra::{Matrix3, Point2, Vector3};

/// Motion between two cameras with a common focal length, up to the length of the translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseWithFocal {
    /// The motion.
    pub pose: RelativePose,
    /// F of the pixels, unit Frobenius norm.
    pub fundamental: Matrix3<f64>,
    /// Focal length of both cameras, pixels.
    pub focal_px: f64,
    /// Standard deviation of the focal length, pixels, from the errors of the inliers and their
    /// dependence on the focal length, at this value and at others that explain the matches nearly
    /// as well. `None` for a candidate that is not yet scored, and if the focal length has no
    /// effect.
    pub focal_std_px: Option<f64>,
}

/// Relative standard deviation above which a focal length is no better than a guess.
const TELLING: f64 = 0.1;

impl PoseWithFocal {
    /// Returns whether the matches determine the focal length to within a tenth.
    pub fn constrains_focal(&self) -> bool {
        self.focal_std_px
            .is_some_and(|std_px| std_px < TELLING * self.focal_px)
    }

    pub(in crate::epipolar) fn new(
        pose: (Matrix3<f64>, Vector3<f64>),
        focal_px: f64,
        centers: &[Point2<f64>; 2],
    ) -> Option<Self> {
        let camera = |c: &Point2<f64>| Intrinsics::new(focal_px, focal_px, c.x, c.y).ok();
        let (k1, k2) = (camera(&centers[0])?, camera(&centers[1])?);
        let pose = RelativePose::from(pose);
        Some(Self {
            fundamental: pose.fundamental_or_zeros(&k1, &k2),
            pose,
            focal_px,
            focal_std_px: None,
        })
    }
}
