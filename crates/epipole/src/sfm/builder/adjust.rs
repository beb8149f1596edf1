//! Bundle adjustment of a growing reconstruction, whole or in part.

use super::Builder;
use crate::camera::Intrinsics;
use crate::optim::{LmOptions, RobustLoss};
use crate::progress::Monitor;
use crate::sfm::bundle::{Bundle, BundleObservation, BundleOptions, Sensor, adjust_bundle};
use crate::sfm::reconstruction::{LOSS, Lenses};
use crate::sfm::views::Views;
use crate::{Error, Result};

impl Builder {
    /// Returns the image itself and the images that share most points with it.
    pub(in crate::sfm) fn neighborhood(&self, image: usize, count: usize) -> Vec<usize> {
        let mut shared = vec![0; self.images.len()];
        for point in self.points.iter().flatten() {
            if point
                .elements
                .iter()
                .any(|element| element.image as usize == image)
            {
                for element in &point.elements {
                    shared[element.image as usize] += 1;
                }
            }
        }
        let mut order: Vec<usize> = (0..self.images.len()).filter(|&i| shared[i] > 0).collect();
        order.sort_by_key(|&i| (std::cmp::Reverse(shared[i]), i));
        order.truncate(count);
        order
    }

    /// Adjusts everything, or some images with the points that they see. Returns the cost; `None`
    /// if nothing can be refined.
    ///
    /// # Errors
    /// [`Error::Canceled`]; cameras and points are then the best found so far.
    pub(in crate::sfm) fn adjust(
        &mut self,
        free: Option<&[usize]>,
        max_iterations: usize,
        with_intrinsics: bool,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<f64>> {
        let is_free = |image: usize| free.is_none_or(|list| list.contains(&self.frame_of(image).0));
        let mut bundle = Bundle::default();
        let mut lenses = Lenses::default();
        let mut camera_of = vec![usize::MAX; self.images.len()];
        let mut image_of = Vec::new();
        let mut track_of = Vec::new();
        let mut options = BundleOptions {
            lm: LmOptions {
                max_iterations,
                cost_tolerance: 1e-7,
                ..LmOptions::default()
            },
            loss: LOSS,
            refine_focal: with_intrinsics && self.options.refine_focal,
            refine_principal_point: with_intrinsics && self.options.refine_principal_point,
            refine_distortion: with_intrinsics && self.options.refine_distortion,
            refine_tangential: with_intrinsics && self.options.refine_tangential,
            // GPS receivers report small uncertainties even when they are wrong.
            position_loss: RobustLoss::Cauchy { width: 2.0 },
            ..BundleOptions::default()
        };
        for (track, point) in self.points.iter().enumerate() {
            let Some(point) = point else { continue };
            if !point
                .elements
                .iter()
                .any(|element| is_free(element.image as usize))
            {
                continue;
            }
            for element in &point.elements {
                let (image, sensor) = self.frame_of(element.image as usize);
                let Some(camera) = self.cameras[image] else {
                    continue;
                };
                if camera_of[image] == usize::MAX {
                    camera_of[image] = bundle.cameras.len();
                    bundle.cameras.push(camera);
                    image_of.push(image);
                    options.held_cameras.push(!is_free(image));
                    let lens = lenses.number_of(self.images[image].lens);
                    bundle.lens_of_camera.push(lens);
                    if self.is_placed {
                        (options.position_priors).push(self.images[image].position);
                    }
                }
                bundle.observations.push(BundleObservation {
                    camera: camera_of[image],
                    point: bundle.points.len(),
                    pixel: self.images[element.image as usize].keypoints[element.keypoint as usize],
                });
                bundle.sensor_of_observation.push(sensor);
            }
            bundle.points.push(point.position);
            track_of.push(track);
        }
        if let Some(rig) = self.rig {
            let lens = lenses.number_of(self.images[self.images.len() / 2].lens);
            bundle.sensors.push(Sensor { lens, ..rig });
        }
        let adjusted = match adjust_bundle(&mut bundle, &options, monitor) {
            Ok(report) => Ok(Some(report.final_cost)),
            Err(Error::Canceled) => Err(Error::Canceled),
            Err(_) => return Ok(None),
        };
        if options.refines_lens() {
            self.share_intrinsics(&bundle, &image_of, &lenses);
        }
        for (image, camera) in image_of.into_iter().zip(&bundle.cameras) {
            self.place(image, Some(*camera));
        }
        for (track, position) in track_of.into_iter().zip(&bundle.points) {
            if let Some(point) = &mut self.points[track] {
                point.position = *position;
            }
        }
        adjusted
    }

    /// Copies the refined intrinsics of a lens to all its images, registered or not.
    fn share_intrinsics(&mut self, bundle: &Bundle, image_of: &[usize], lenses: &Lenses) {
        if let (Some(rig), Some(sensor)) = (&mut self.rig, bundle.sensors.first()) {
            rig.camera = sensor.camera;
        }
        for (lens, name) in lenses.names().iter().enumerate() {
            let of_camera = bundle.lens_of_camera.iter().position(|of| *of == lens);
            let (image, refined) = match (of_camera, self.rig) {
                (Some(camera), _) => (image_of[camera], bundle.cameras[camera].camera),
                (None, Some(rig)) => (self.images.len() / 2, rig.camera),
                (None, None) => continue,
            };
            let old = self.calibration[image].intrinsics;
            let factor = refined.intrinsics.fu_px() / old.fu_px();
            let shift_px = refined.intrinsics.principal_point() - old.principal_point();
            for other in (0..self.images.len()).filter(|&i| self.images[i].lens == *name) {
                let camera = &mut self.calibration[other];
                let k = camera.intrinsics;
                let center = k.principal_point() + shift_px;
                if let Ok(k) =
                    Intrinsics::new(k.fu_px() * factor, k.fv_px() * factor, center.x, center.y)
                {
                    camera.intrinsics = k;
                }
                camera.lens = refined.lens;
            }
        }
        for (camera, refined) in self.cameras.iter_mut().zip(&self.calibration) {
            if let Some(camera) = camera {
                camera.camera = *refined;
            }
        }
        self.views = Views::new(&self.images, &self.calibration);
    }
}
