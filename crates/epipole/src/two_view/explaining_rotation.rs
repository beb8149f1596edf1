//! A rotation in place of another model.

use super::TwoViewOptions;
use crate::camera::{Intrinsics, RigidTransform};
use crate::robust::RansacReport;
use nalgebra::{Matrix3, Point2, Rotation3, Translation3, UnitQuaternion};

/// A rotation that explains nearly all inliers of another model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplainingRotation {
    /// The rotation; its translation is zero.
    pub cam2_from_cam1: RigidTransform,
    /// Number of inliers that it explains.
    pub num_explained: usize,
    /// Number of inliers.
    pub num_inliers: usize,
}

impl ExplainingRotation {
    /// Returns the rotation of a search if it explains nearly all inliers of another model.
    ///
    /// * `intrinsics`: intrinsics of the two cameras
    /// * `inliers`: inliers of the other model
    pub(super) fn new<'a>(
        rotation: &RansacReport<Matrix3<f64>>,
        intrinsics: [&Intrinsics; 2],
        inliers: impl Iterator<Item = (&'a Point2<f64>, &'a Point2<f64>)>,
        options: &TwoViewOptions,
    ) -> Option<Self> {
        // A rotation always fits two matches.
        if rotation.num_unique_inliers < 3 {
            return None;
        }
        let homography = homography_of_rotation(&rotation.model, intrinsics);
        let (mut num_inliers, mut num_explained) = (0, 0);
        for (p1, p2) in inliers {
            num_inliers += 1;
            num_explained += usize::from(options.fits_homography(&homography, p1, p2));
        }
        Self::if_nearly_all(&rotation.model, num_explained, num_inliers, options)
    }

    /// Returns a rotation that explains `num_explained` of the inliers, if these are nearly all.
    /// The only place for this decision, for any lens.
    pub(super) fn if_nearly_all(
        rotation: &Matrix3<f64>,
        num_explained: usize,
        num_inliers: usize,
        options: &TwoViewOptions,
    ) -> Option<Self> {
        let needed = options.max_homography_ratio * num_inliers as f64;
        (num_explained as f64 >= needed).then(|| Self {
            cam2_from_cam1: motion_of_rotation(rotation),
            num_explained,
            num_inliers,
        })
    }
}

/// Returns the motion of a camera that only rotates.
pub(super) fn motion_of_rotation(rotation: &Matrix3<f64>) -> RigidTransform {
    let rotation = Rotation3::from_matrix_unchecked(*rotation);
    RigidTransform::from_parts(
        Translation3::identity(),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

/// Returns the homography of a rotation, in pixels: `K2 R K1⁻¹`.
pub(super) fn homography_of_rotation(
    rotation: &Matrix3<f64>,
    [k1, k2]: [&Intrinsics; 2],
) -> Matrix3<f64> {
    k2.matrix() * rotation * k1.inverse_matrix()
}
