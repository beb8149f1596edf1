//! Keypoints as motions, poses and points are found from them: without what the lens did.

use super::reconstruction::SfmImage;
use crate::camera::{Camera, Distortion, Intrinsics, Lens, LensKind, Observation};
use nalgebra::Point2;

/// The keypoints of all images.
#[derive(Clone)]
pub(super) enum Views {
    /// All lenses are Brown's: as cameras without distortion would show them.
    Pinhole(Vec<Vec<Point2<f64>>>),
    /// Some lens is not: rays, which may point anywhere.
    Rays(Vec<Vec<Option<Observation>>>),
}

impl Views {
    /// * `intrinsics`, `lenses`: of each image
    pub(super) fn new(images: &[SfmImage], intrinsics: &[Intrinsics], lenses: &[Lens]) -> Self {
        match lenses.iter().all(|lens| lens.kind() == LensKind::Brown) {
            true => Self::Pinhole(undistorted(images, intrinsics, lenses)),
            false => Self::Rays(observed(images, intrinsics, lenses)),
        }
    }

    /// How one keypoint was seen; `None` where its lens sees no ray.
    pub(super) fn of(&self, image: usize, keypoint: usize) -> Option<View<'_>> {
        match self {
            Self::Pinhole(pixels) => Some(View::Pixel(pixels[image][keypoint])),
            Self::Rays(seen) => seen[image][keypoint].as_ref().map(View::Ray),
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

/// The rays of all keypoints. Keypoints beyond what a lens model bends rays to have none.
fn observed(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    lenses: &[Lens],
) -> Vec<Vec<Option<Observation>>> {
    let mut seen: Vec<Vec<Option<Observation>>> = vec![Vec::new(); images.len()];
    crate::optim::parallel::for_each_chunk(&mut seen, 1, |index, seen| {
        let image = &images[index];
        let camera = Camera {
            lens: lenses[index],
            ..Camera::pinhole(intrinsics[index], image.width, image.height)
        };
        let observe = |pixel| camera.observe(pixel).ok();
        seen[0] = image.keypoints.iter().map(observe).collect();
    });
    seen
}

/// All keypoints as a camera without distortion would show them.
fn undistorted(
    images: &[SfmImage],
    intrinsics: &[Intrinsics],
    lenses: &[Lens],
) -> Vec<Vec<Point2<f64>>> {
    images
        .iter()
        .zip(intrinsics.iter().zip(lenses))
        .map(|(image, (k, lens))| {
            let distortion = match lens {
                Lens::Brown(distortion) if *distortion != Distortion::NONE => distortion,
                _ => return image.keypoints.clone(),
            };
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
