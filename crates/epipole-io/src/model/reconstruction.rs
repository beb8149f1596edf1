//! Conversion between models and the library's reconstructions.

use super::{CameraList, Model, ModelImage, ModelPoint};
use crate::Result;
use epipole::camera::PosedCamera;
use epipole::sfm::{Reconstruction, ScenePoint, SfmImage, TrackElement};

impl Model {
    /// Converts the registered images of a reconstruction and its points. Images with equal size,
    /// intrinsics and lens share a camera; the ID of an image is its index plus 1. Observations by
    /// images without a camera are left out.
    ///
    /// * `images`: images of the reconstruction
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
                camera: cameras.number_of(posed.camera),
                cam_from_world: posed.cam_from_world,
                keypoints: image.keypoints.clone(),
            });
        }
        let place = |element: &TrackElement| {
            let image = (*place_of_image.get(element.image as usize)?)?;
            let keypoint = element.keypoint as usize;
            (keypoint < model.images[image].keypoints.len()).then_some((image, keypoint))
        };
        let points = (1..).zip(&reconstruction.points);
        let points = points.map(|(id, point)| ModelPoint {
            id,
            position: point.position,
            color: point.color,
            error_px: Some(point.error_px),
            track: point.track.iter().filter_map(place).collect(),
        });
        model.points = points.collect();
        model.cameras = cameras.into_list();
        model
    }

    /// Converts to a reconstruction and its images, in the order of the model. Images that share a
    /// camera share a lens number. Points with fewer than two observations are left out; missing
    /// errors are computed.
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) if an index of the model is wrong.
    pub fn to_reconstruction(&self) -> Result<(Reconstruction, Vec<SfmImage>)> {
        self.check()?;
        let image = |image: &ModelImage| SfmImage {
            name: image.name.clone(),
            keypoints: image.keypoints.clone(),
            lens: image.camera,
            ..SfmImage::default()
        };
        let images: Vec<SfmImage> = self.images.iter().map(image).collect();
        let posed = |image: &ModelImage| PosedCamera {
            camera: self.cameras[image.camera],
            cam_from_world: image.cam_from_world,
        };
        let mut reconstruction = Reconstruction {
            cameras: self.images.iter().map(|image| Some(posed(image))).collect(),
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
                    let observed = images[image].keypoints[element.keypoint as usize];
                    sum += (pixel - observed).norm_squared();
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

#[cfg(test)]
mod written;

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::camera::{
        Camera, Distortion, Division, Fisheye, Intrinsics, Lens, RationalDistortion, RigidTransform,
    };
    use nalgebra::{Point2, Point3};

    fn small() -> (Reconstruction, Vec<SfmImage>) {
        let image = |name: &str| SfmImage {
            name: name.into(),
            keypoints: vec![Point2::new(1.0, 2.0), Point2::new(319.5, 239.5)],
            ..SfmImage::default()
        };
        let images = vec![image("a.png"), image("b.png"), image("c.png")];
        let camera = |x: f64| {
            Some(PosedCamera {
                camera: Camera::pinhole(Intrinsics::centered(700.0, 640, 480).unwrap(), 640, 480),
                cam_from_world: RigidTransform::translation(x, 0.0, 0.0),
            })
        };
        let element = |image| TrackElement { image, keypoint: 1 };
        let reconstruction = Reconstruction {
            cameras: vec![camera(0.0), None, camera(-1.0)],
            points: vec![ScenePoint {
                position: Point3::new(0.0, 0.0, 5.0),
                color: [10, 20, 30],
                track: vec![element(0), element(2)],
                error_px: 140.0 / 2f64.sqrt(),
            }],
            ..Reconstruction::default()
        };
        (reconstruction, images)
    }

    fn text(reconstruction: &Reconstruction, images: &[SfmImage]) -> [String; 3] {
        let model = Model::from_reconstruction(reconstruction, images);
        let files = model.to_colmap_text().unwrap();
        [0, 1, 2].map(|i| String::from_utf8(files[i].bytes.clone()).unwrap())
    }

    #[test]
    fn the_text_model_is_half_a_pixel_ahead() {
        let (reconstruction, images) = small();
        let [cameras, list, points] = text(&reconstruction, &images);
        assert_eq!(
            cameras.lines().nth(1),
            Some("1 PINHOLE 640 480 700 700 320 240")
        );
        let lines: Vec<&str> = list.lines().collect();
        assert_eq!(lines[2], "1 1 0 0 0 0 0 0 1 a.png");
        assert_eq!(lines[3], "1.5 2.5 -1 320 240 1");
        assert_eq!(lines[4], "3 1 0 0 0 -1 0 0 1 c.png");
        assert_eq!(lines.len(), 6);
        let point = points.lines().nth(1).unwrap();
        assert!(point.starts_with("1 0 0 5 10 20 30 ") && point.ends_with(" 1 1 3 1"));
        let error: f64 = point.split(' ').nth(7).unwrap().parse().unwrap();
        assert!((error - 140.0 / 2f64.sqrt()).abs() < 1e-9);
    }

    /// The names and the order of the parameters are those of COLMAP 4's list of models.
    #[test]
    fn each_lens_has_its_model() {
        let (mut reconstruction, images) = small();
        for (lens, expected) in [
            (
                Lens::Fisheye(Fisheye {
                    coefficients: [0.01, -0.02, 0.003, 0.0],
                }),
                "1 OPENCV_FISHEYE 640 480 700 700 320 240 0.01 -0.02 0.003 0",
            ),
            (
                Lens::Division(Division { k: -0.25 }),
                "1 DIVISION 640 480 700 700 320 240 -0.25",
            ),
            (
                Lens::Rational(RationalDistortion {
                    numerator: Distortion {
                        k1: 0.5,
                        k2: 0.25,
                        p1: 0.001,
                        p2: -0.002,
                        k3: 0.125,
                    },
                    denominator: [0.75, 0.5, -0.25],
                }),
                "1 FULL_OPENCV 640 480 700 700 320 240 0.5 0.25 0.001 -0.002 0.125 0.75 0.5 -0.25",
            ),
        ] {
            for camera in reconstruction.cameras.iter_mut().flatten() {
                camera.camera.lens = lens;
            }
            let [cameras, ..] = text(&reconstruction, &images);
            assert_eq!(cameras.lines().nth(1), Some(expected));
        }
    }

    #[test]
    fn distortion_changes_the_camera_model() {
        let (mut reconstruction, images) = small();
        let bent = Distortion {
            k1: -0.1,
            p2: 0.002,
            ..Distortion::NONE
        };
        let far = Distortion { k3: 0.5, ..bent };
        for (image, lens) in [(0, bent), (2, far)] {
            if let Some(camera) = &mut reconstruction.cameras[image] {
                camera.camera.lens = lens.into();
            }
        }
        let [cameras, ..] = text(&reconstruction, &images);
        let lines: Vec<&str> = cameras.lines().skip(1).collect();
        assert_eq!(
            lines,
            [
                "1 OPENCV 640 480 700 700 320 240 -0.1 0 0 0.002",
                "2 FULL_OPENCV 640 480 700 700 320 240 -0.1 0 0 0.002 0.5 0 0 0",
            ]
        );
    }

    #[test]
    fn a_reconstruction_survives_its_model() {
        let (reconstruction, images) = small();
        let model = Model::from_reconstruction(&reconstruction, &images);
        let (back, registered) = model.to_reconstruction().unwrap();
        assert_eq!(back.cameras[1], reconstruction.cameras[2]);
        assert_eq!(registered[1].name, "c.png");
        assert_eq!(back.points[0].track[1].image, 1);
        assert_eq!(back.points[0].error_px, reconstruction.points[0].error_px);
        // A missing error is computed: 0 in a, 140 px in c.
        let mut unknown = model;
        unknown.points[0].error_px = None;
        let (back, _) = unknown.to_reconstruction().unwrap();
        assert!((back.points[0].error_px - 140.0 / 2f64.sqrt()).abs() < 1e-9);
        unknown.points[0].track.pop();
        assert!(unknown.to_reconstruction().unwrap().0.points.is_empty());
        unknown.points[0].track[0].1 = 2;
        assert!(unknown.to_reconstruction().is_err());
    }
}
