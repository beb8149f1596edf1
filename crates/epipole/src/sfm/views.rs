//! Keypoints and cameras from which motions, poses and points are found.

use super::reconstruction::SfmImage;
use crate::camera::{Camera, Distortion, Intrinsics, Lens, LensKind, Observation};
use nalgebra::Point2;

/// The keypoints of all images with their cameras.
#[derive(Clone)]
pub(super) struct Views {
    /// Pinholes where all lenses are Brown's.
    pub(super) cameras: Vec<Camera>,
    /// Keypoints as these cameras see them.
    pub(super) pixels: Vec<Vec<Point2<f64>>>,
    /// Rays of all keypoints, where some lens is not Brown's.
    observed: Option<Vec<Vec<Option<Observation>>>>,
}

impl Views {
    /// * `intrinsics`, `lenses`: of each image
    pub(super) fn new(images: &[SfmImage], intrinsics: &[Intrinsics], lenses: &[Lens]) -> Self {
        let pinhole =
            |(image, k): (&SfmImage, &Intrinsics)| Camera::pinhole(*k, image.width, image.height);
        let cameras = images.iter().zip(intrinsics).map(pinhole);
        if lenses.iter().all(|lens| lens.kind() == LensKind::Brown) {
            return Self {
                cameras: cameras.collect(),
                pixels: undistorted(images, intrinsics, lenses),
                observed: None,
            };
        }
        let bent = |(camera, lens): (Camera, &Lens)| Camera {
            lens: *lens,
            ..camera
        };
        let cameras: Vec<Camera> = cameras.zip(lenses).map(bent).collect();
        Self {
            observed: Some(observed(images, &cameras)),
            cameras,
            pixels: images.iter().map(|image| image.keypoints.clone()).collect(),
        }
    }

    /// View of a keypoint; `None` where its lens sees no ray.
    pub(super) fn of(&self, image: usize, keypoint: usize) -> Option<View<'_>> {
        match &self.observed {
            None => Some(View::Pixel(self.pixels[image][keypoint])),
            Some(seen) => seen[image][keypoint].as_ref().map(View::Ray),
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
fn observed(images: &[SfmImage], cameras: &[Camera]) -> Vec<Vec<Option<Observation>>> {
    let mut seen: Vec<Vec<Option<Observation>>> = vec![Vec::new(); images.len()];
    crate::optim::parallel::for_each_chunk(&mut seen, 1, |index, seen| {
        let observe = |pixel| cameras[index].observe(pixel).ok();
        seen[0] = images[index].keypoints.iter().map(observe).collect();
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
