//! A relative pose together with the focal length of both cameras.

use crate::camera::Intrinsics;
use crate::epipolar::RelativePose;
use nalgebra::{Matrix3, Point2, Vector3};

/// The motion between two cameras that share a focal length, up to the length of the translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseWithFocal {
    /// The motion.
    pub pose: RelativePose,
    /// F of the pixels, unit Frobenius norm.
    pub fundamental: Matrix3<f64>,
    /// The focal length of both cameras, pixels.
    pub focal_px: f64,
    /// Its standard deviation, pixels, from the errors of the inliers and how they depend on it,
    /// there and at other focal lengths that explain the matches nearly as well. `None` for a
    /// candidate that is yet to be judged, and where the focal length makes no difference at all.
    pub focal_std_px: Option<f64>,
}

/// A focal length whose standard deviation is a larger share of it says no more than a guess.
const TELLING: f64 = 0.1;

impl PoseWithFocal {
    /// Whether the matches tell the focal length, to a tenth of it.
    pub fn tells_focal(&self) -> bool {
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
