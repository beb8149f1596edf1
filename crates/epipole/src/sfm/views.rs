//! Keypoints and cameras for estimating motions, poses and points.

use super::reconstruction::SfmImage;
use crate::camera::{Camera, Distortion, Lens, LensKind, Observation};
use nalgebra::Point2;

/// The keypoints of all images with their cameras.
#[derive(Clone)]
pub(super) struct Views {
    /// Cameras; pinholes if all lenses are Brown's.
    pub(super) cameras: Vec<Camera>,
    /// Keypoints as seen by these cameras.
    pub(super) pixels: Vec<Vec<Point2<f64>>>,
    /// Rays of all keypoints, if some lens is not Brown's.
    observed: Option<Vec<Vec<Option<Observation>>>>,
}

impl Views {
    /// * `cameras`: camera of each image
    pub(super) fn new(images: &[SfmImage], cameras: &[Camera]) -> Self {
        let pinhole = |camera: &Camera| Camera {
            lens: Lens::NONE,
            ..*camera
        };
        if (cameras.iter()).all(|camera| camera.lens.kind() == LensKind::Brown) {
            return Self {
                cameras: cameras.iter().map(pinhole).collect(),
                pixels: undistort_keypoints(images, cameras),
                observed: None,
            };
        }
        Self {
            observed: Some(observe_keypoints(images, cameras)),
            cameras: cameras.to_vec(),
            pixels: images.iter().map(|image| image.keypoints.clone()).collect(),
        }
    }

    /// Returns the view of a keypoint; `None` where its lens has no ray.
    pub(super) fn of(&self, image: usize, keypoint: usize) -> Option<View<'_>> {
        match &self.observed {
            None => Some(View::Pixel(self.pixels[image][keypoint])),
            Some(observations) => observations[image][keypoint].as_ref().map(View::Ray),
        }
    }
}

/// An undistorted keypoint.
#[derive(Debug, Clone, Copy)]
pub(super) enum View<'a> {
    /// Pixel of a pinhole camera.
    Pixel(Point2<f64>),
    Ray(&'a Observation),
}

/// Computes the rays of all keypoints; `None` for keypoints beyond the range of the lens model.
fn observe_keypoints(images: &[SfmImage], cameras: &[Camera]) -> Vec<Vec<Option<Observation>>> {
    let mut observations: Vec<Vec<Option<Observation>>> = vec![Vec::new(); images.len()];
    crate::math::parallel::for_each_chunk(&mut observations, 1, |index, observations| {
        let observe = |pixel| cameras[index].observe(pixel).ok();
        observations[0] = images[index].keypoints.iter().map(observe).collect();
    });
    observations
}

/// Undistorts all keypoints.
fn undistort_keypoints(images: &[SfmImage], cameras: &[Camera]) -> Vec<Vec<Point2<f64>>> {
    images
        .iter()
        .zip(cameras)
        .map(|(image, camera)| {
            let k = &camera.intrinsics;
            let distortion = match &camera.lens {
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
