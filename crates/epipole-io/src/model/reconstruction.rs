//! Models of the library's reconstructions, and back.

use super::{CameraList, Model, ModelImage, ModelPoint};
use crate::Result;
use epipole::camera::{Camera, PosedCamera};
use epipole::sfm::{Reconstruction, ScenePoint, SfmImage, TrackElement};

impl Model {
    /// The registered images of a reconstruction and its points. Images with equal size, intrinsics
    /// and lens share a camera; the number of an image is its index plus 1. Observations by images
    /// without a camera are left out.
    ///
    /// * `images`: those that the reconstruction was made of
    pub fn from_reconstruction(reconstruction: &Reconstruction, images: &[SfmImage]) -> Self {
        let mut cameras = CameraList::default();
        let mut model = Self::default();
        let mut place_of_image = vec![None; images.len()];
        for (index, (image, posed)) in images.iter().zip(&reconstruction.cameras).enumerate() {
            let Some(posed) = posed else { continue };
            place_of_image[index] = Some(model.images.len());
            model.images.push(ModelImage {
                id: index as u32 + 1,
                name: image.name.clone(),
                camera: cameras.number_of(Camera {
                    width: image.width,
                    height: image.height,
                    intrinsics: posed.intrinsics,
                    lens: reconstruction.lens(index),
                }),
                cam_from_world: posed.cam_from_world,
                keypoints: image.keypoints.clone(),
            });
        }
        let place = |element: &TrackElement| {
            let image = (*place_of_image.get(element.image as usize)?)?;
            let keypoint = element.keypoint as usize;
            (keypoint < model.images[image].keypoints.len()).then_some((image, keypoint))
        };
        let points = reconstruction.points.iter().map(|point| ModelPoint {
            position: point.position,
            color: point.color,
            error_px: Some(point.error_px),
            track: point.track.iter().filter_map(place).collect(),
        });
        model.points = points.collect();
        model.cameras = cameras.into_list();
        model
    }

    /// A reconstruction and its images, in the order of the model. Images that share a camera share
    /// a lens number. Points with fewer than two observations are left out; errors that the model
    /// does not have are computed.
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) if an index of the model is wrong.
    pub fn to_reconstruction(&self) -> Result<(Reconstruction, Vec<SfmImage>)> {
        self.check()?;
        let image = |image: &ModelImage| SfmImage {
            name: image.name.clone(),
            width: self.cameras[image.camera].width,
            height: self.cameras[image.camera].height,
            keypoints: image.keypoints.clone(),
            lens: image.camera,
            ..SfmImage::default()
        };
        let images: Vec<SfmImage> = self.images.iter().map(image).collect();
        let posed = |image: &ModelImage| PosedCamera {
            intrinsics: self.cameras[image.camera].intrinsics,
            cam_from_world: image.cam_from_world,
        };
        let lens = |image: &ModelImage| self.cameras[image.camera].lens;
        let mut reconstruction = Reconstruction {
            cameras: self.images.iter().map(|image| Some(posed(image))).collect(),
            lenses: self.images.iter().map(lens).collect(),
            ..Reconstruction::default()
        };
        for point in &self.points {
            let element = |&(image, keypoint): &(usize, usize)| TrackElement {
                image: image as u32,
                keypoint: keypoint as u32,
            };
            let mut track: Vec<TrackElement> = point.track.iter().map(element).collect();
            track.sort_by_key(|element| (element.image, element.keypoint));
            track.dedup();
            if track.len() < 2 {
                continue;
            }
            let mut sum = 0.0;
            for element in &track {
                let image = element.image as usize;
                if let Some(pixel) = reconstruction.project(image, &point.position) {
                    let seen = images[image].keypoints[element.keypoint as usize];
                    sum += (pixel - seen).norm_squared();
                }
            }
            let rms_px = (sum / track.len() as f64).sqrt();
            reconstruction.points.push(ScenePoint {
                position: point.position,
                color: point.color,
                error_px: point.error_px.unwrap_or(rms_px),
                track,
            });
        }
        Ok((reconstruction, images))
    }
}
