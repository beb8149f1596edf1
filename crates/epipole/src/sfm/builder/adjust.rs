//! Bundle adjustment of a growing reconstruction, or of a part of it.

use super::{Builder, undistorted};
use crate::camera::Intrinsics;
use crate::optim::{Iteration, LmOptions, RobustLoss};
use crate::sfm::bundle::{Bundle, BundleOptions, Observation, adjust_bundle};
use std::ops::ControlFlow;

impl Builder<'_> {
    /// The image itself and those that share most points with it.
    pub(super) fn neighborhood(&self, image: usize, count: usize) -> Vec<usize> {
        let mut shared = vec![0; self.images.len()];
        for point in self.points.iter().flatten() {
            if point
                .seen
                .iter()
                .any(|element| element.image as usize == image)
            {
                for element in &point.seen {
                    shared[element.image as usize] += 1;
                }
            }
        }
        let mut order: Vec<usize> = (0..self.images.len()).filter(|&i| shared[i] > 0).collect();
        order.sort_by_key(|&i| (std::cmp::Reverse(shared[i]), i));
        order.truncate(count);
        order
    }

    /// Bundle adjustment of everything, or of some images with the points that they see; returns
    /// the cost.
    pub(in crate::sfm) fn adjust(
        &mut self,
        free: Option<&[usize]>,
        max_iterations: usize,
        with_intrinsics: bool,
    ) -> Option<f64> {
        let is_free = |image: usize| free.is_none_or(|list| list.contains(&self.frame_of(image).0));
        let mut bundle = Bundle {
            distortion: self.distortion,
            sensors: self.rig.into_iter().collect(),
            ..Bundle::default()
        };
        let mut camera_of = vec![usize::MAX; self.images.len()];
        let mut image_of = Vec::new();
        let mut track_of = Vec::new();
        let mut options = BundleOptions {
            lm: LmOptions {
                max_iterations,
                cost_tolerance: 1e-7,
                ..LmOptions::default()
            },
            // A pixel and a half: beyond it matches are more often wrong than imprecise.
            loss: RobustLoss::Cauchy { width: 1.5 },
            refine_focal: with_intrinsics && self.options.refine_focal,
            refine_distortion: with_intrinsics && self.options.refine_distortion,
            ..BundleOptions::default()
        };
        for (track, point) in self.points.iter().enumerate() {
            let Some(point) = point else { continue };
            if !point
                .seen
                .iter()
                .any(|element| is_free(element.image as usize))
            {
                continue;
            }
            for element in &point.seen {
                let (image, sensor) = self.frame_of(element.image as usize);
                let Some(camera) = self.cameras[image] else {
                    continue;
                };
                if camera_of[image] == usize::MAX {
                    camera_of[image] = bundle.cameras.len();
                    bundle.cameras.push(camera);
                    image_of.push(image);
                    options.held_cameras.push(!is_free(image));
                }
                bundle.observations.push(Observation {
                    camera: camera_of[image],
                    point: bundle.points.len(),
                    pixel: self.images[element.image as usize].keypoints[element.keypoint as usize],
                });
                bundle.sensor_of_observation.push(sensor);
            }
            bundle.points.push(point.position);
            track_of.push(track);
        }
        let mut go_on = |_: &Iteration| ControlFlow::Continue(());
        let report = adjust_bundle(&mut bundle, &options, &mut go_on).ok()?;
        for (image, camera) in image_of.into_iter().zip(&bundle.cameras) {
            self.place(image, Some(*camera));
        }
        for (track, position) in track_of.into_iter().zip(&bundle.points) {
            if let Some(point) = &mut self.points[track] {
                point.position = *position;
            }
        }
        if options.refine_focal || options.refine_distortion {
            self.share_intrinsics(&bundle);
        }
        Some(report.final_cost)
    }

    /// Gives refined intrinsics to the images that are still to come.
    fn share_intrinsics(&mut self, bundle: &Bundle) {
        let registered = (0..self.images.len()).find(|&image| self.cameras[image].is_some());
        if let Some(camera) = registered.and_then(|image| self.cameras[image])
            && let Some(image) = registered
        {
            let factor = camera.intrinsics.fu_px() / self.intrinsics[image].fu_px();
            for k in &mut self.intrinsics {
                let center = k.principal_point();
                if let Ok(refined) =
                    Intrinsics::new(k.fu_px() * factor, k.fv_px() * factor, center.x, center.y)
                {
                    *k = refined;
                }
            }
        }
        for (camera, intrinsics) in self.cameras.iter_mut().zip(&self.intrinsics) {
            if let Some(camera) = camera {
                camera.intrinsics = *intrinsics;
            }
        }
        self.distortion = bundle.distortion;
        self.pixels = undistorted(self.images, &self.intrinsics, self.distortion);
    }
}
