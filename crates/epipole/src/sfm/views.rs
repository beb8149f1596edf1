//! Keypoints as motions, poses and points are found from them: without what the lens did.

use super::lens::SfmLens;
use super::reconstruction::SfmImage;
use super::wide::{SeenRays, Wide};
use crate::camera::{Intrinsics, Observation};
use nalgebra::Point2;

/// The keypoints of all images.
#[derive(Clone)]
pub(super) enum Views {
    /// All lenses are Brown's: as cameras without distortion would show them.
    Pinhole(Vec<Vec<Point2<f64>>>),
    /// Some lens is not: rays, which may point anywhere.
    Rays { wide: &'static Wide, seen: SeenRays },
}

impl Views {
    /// * `intrinsics`, `lenses`: of each image
    pub(super) fn new(images: &[SfmImage], intrinsics: &[Intrinsics], lenses: &[SfmLens]) -> Self {
        match lenses.iter().find_map(SfmLens::beyond_brown) {
            None => Self::Pinhole(undistorted(images, intrinsics, lenses)),
            Some(wide) => Self::Rays {
                wide,
                seen: (wide.rays)(images, intrinsics, lenses),
            },
        }
    }

    /// How one keypoint was seen; `None` where its lens sees no ray.
    pub(super) fn of(&self, image: usize, keypoint: usize) -> Option<View<'_>> {
        match self {
            Self::Pinhole(pixels) => Some(View::Pixel(pixels[image][keypoint])),
            Self::Rays { seen, .. } => seen[image][keypoint].as_ref().map(View::Ray),
        }
    }
}

/// A keypoint without what the lens did.
#[derive(Debug, Clone, Copy)]
pub(super) enum View<'a> {
    /// Of a pinhole camera.
    Pixel(Point2<f64>),
    Ray(&'a Observation),
}

/// All keypoints as a camera without distortion would show them.
fn undistorted(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    lenses: &[SfmLens],
) -> Vec<Vec<Point2<f64>>> {
    images
        .iter()
        .zip(intrinsics.iter().zip(lenses))
        .map(|(image, (k, lens))| {
            if lens.is_none() {
                return image.keypoints.clone();
            }
            let distortion = lens.brown();
            let center = k.principal_point();
            image
                .keypoints
                .iter()
                .map(|pixel| {
                    let ray = k.ray(pixel);
                    let bent = Point2::new(ray.x, ray.y);
                    // Keypoints are finite, so there is always a nearest one.
                    let straight = distortion.undistort_nearest(&bent).unwrap_or(bent);
                    Point2::new(
                        k.fu_px() * straight.x + center.x,
                        k.fv_px() * straight.y + center.y,
                    )
                })
                .collect()
        })
        .collect()
}
