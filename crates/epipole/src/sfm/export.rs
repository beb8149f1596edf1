//! Reconstructions as files: COLMAP's text model and PLY point clouds.

use super::reconstruction::{Reconstruction, SfmImage};
use crate::camera::{Camera, Lens, LensKind, pixel_to_colmap};
use std::fmt::Write;

/// The three files of COLMAP's text model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ColmapModel {
    /// `cameras.txt`.
    pub cameras: String,
    /// `images.txt`.
    pub images: String,
    /// `points3D.txt`.
    pub points: String,
}

impl Reconstruction {
    /// COLMAP's text model: `cameras.txt`, `images.txt` and `points3D.txt`.
    ///
    /// Cameras are `PINHOLE`, or `OPENCV` if a lens of Brown's model bends rays, `FULL_OPENCV` if
    /// it has a k3, and for the rational model; `OPENCV_FISHEYE` for fisheyes, `DIVISION` for the
    /// division model, which COLMAP has from its version 4 on. COLMAP takes points seen 90° and
    /// more off the axis of a fisheye to be behind the camera. Images with equal size, intrinsics
    /// and lens share a camera. Principal points and keypoints are moved by half a pixel, from
    /// centers at integers to COLMAP's convention, as by [`pixel_to_colmap`]. IDs of images,
    /// cameras and points start at 1; an image has its index plus 1. A name takes the rest of its
    /// line, so line breaks in it become `_`.
    ///
    /// * `images`: those that the reconstruction was made of
    pub fn to_colmap(&self, images: &[SfmImage]) -> ColmapModel {
        // Writing to a string cannot fail.
        let mut cameras = String::from("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
        let mut kinds = Vec::new();
        let mut camera_of_image = vec![0; images.len()];
        for (index, (image, camera)) in images.iter().zip(&self.cameras).enumerate() {
            let Some(camera) = camera else { continue };
            let kind = Camera {
                width: image.width,
                height: image.height,
                ..camera.camera
            };
            let id = kinds
                .iter()
                .position(|other| *other == kind)
                .unwrap_or_else(|| {
                    kinds.push(kind);
                    kinds.len() - 1
                });
            camera_of_image[index] = id + 1;
        }
        for (id, kind) in kinds.iter().enumerate() {
            let Camera { width, height, .. } = kind;
            let [fx, fy, cx, cy] = kind.intrinsics.to_colmap();
            let (model, more) = model_of(&kind.lens);
            let id = id + 1;
            let _ = writeln!(
                cameras,
                "{id} {model} {width} {height} {fx} {fy} {cx} {cy}{more}"
            );
        }

        let mut point_of_keypoint: Vec<Vec<usize>> = images
            .iter()
            .map(|image| vec![0; image.keypoints.len()])
            .collect();
        for (index, point) in self.points.iter().enumerate() {
            for element in &point.track {
                point_of_keypoint[element.image as usize][element.keypoint as usize] = index + 1;
            }
        }
        let mut list = String::from(
            "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n",
        );
        for (index, (image, camera)) in images.iter().zip(&self.cameras).enumerate() {
            let Some(camera) = camera else { continue };
            let (q, t) = (
                camera.cam_from_world.rotation,
                camera.cam_from_world.translation.vector,
            );
            let _ = writeln!(
                list,
                "{} {} {} {} {} {} {} {} {} {}",
                index + 1,
                q.w,
                q.i,
                q.j,
                q.k,
                t.x,
                t.y,
                t.z,
                camera_of_image[index],
                image.name.replace(['\n', '\r'], "_")
            );
            for (n, (keypoint, point)) in image
                .keypoints
                .iter()
                .zip(&point_of_keypoint[index])
                .enumerate()
            {
                let space = if n == 0 { "" } else { " " };
                let pixel = pixel_to_colmap(keypoint);
                let (x, y) = (pixel.x, pixel.y);
                if *point == 0 {
                    let _ = write!(list, "{space}{x} {y} -1");
                } else {
                    let _ = write!(list, "{space}{x} {y} {point}");
                }
            }
            list.push('\n');
        }

        let mut points = String::from(
            "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n",
        );
        for (index, point) in self.points.iter().enumerate() {
            let ([r, g, b], p) = (point.color, point.position);
            let _ = write!(
                points,
                "{} {} {} {} {r} {g} {b} {}",
                index + 1,
                p.x,
                p.y,
                p.z,
                point.error_px
            );
            for element in &point.track {
                let _ = write!(points, " {} {}", element.image + 1, element.keypoint);
            }
            points.push('\n');
        }
        ColmapModel {
            cameras,
            images: list,
            points,
        }
    }

    /// The points with their colors as a binary little-endian PLY file.
    pub fn to_ply(&self) -> Vec<u8> {
        let mut bytes = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
             property float x\nproperty float y\nproperty float z\n\
             property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
            self.points.len()
        )
        .into_bytes();
        for point in &self.points {
            for value in point.position.iter() {
                bytes.extend((*value as f32).to_le_bytes());
            }
            bytes.extend(point.color);
        }
        bytes
    }
}

/// COLMAP's model of a lens, and its parameters behind those of the intrinsics.
fn model_of(lens: &Lens) -> (&'static str, String) {
    let all = &lens.coefficients()[..];
    let (model, numbers) = match lens.kind() {
        LensKind::Brown if lens.is_none() => ("PINHOLE", &[][..]),
        LensKind::Brown if all[4] == 0.0 => ("OPENCV", &all[..4]),
        LensKind::Brown | LensKind::Rational => ("FULL_OPENCV", all),
        LensKind::Fisheye => ("OPENCV_FISHEYE", all),
        LensKind::Division => ("DIVISION", all),
    };
    let mut more = String::new();
    for number in numbers {
        let _ = write!(more, " {number}");
    }
    // Below the line.
    if model == "FULL_OPENCV" && numbers.len() == 5 {
        more.push_str(" 0 0 0");
    }
    (model, more)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{
        Distortion, Division, Fisheye, Intrinsics, Lens, PosedCamera, RationalDistortion,
        RigidTransform,
    };
    use crate::sfm::{ScenePoint, TrackElement};
    use nalgebra::{Point2, Point3};

    fn small() -> (Reconstruction, Vec<SfmImage>) {
        let image = |name: &str| SfmImage {
            name: name.into(),
            width: 640,
            height: 480,
            keypoints: vec![Point2::new(1.0, 2.0), Point2::new(319.5, 239.5)],
            colors: vec![[1, 2, 3], [10, 20, 30]],
            ..SfmImage::default()
        };
        let images = vec![image("a.png"), image("b.png"), image("c.png")];
        let camera = |x: f64| {
            Some(PosedCamera {
                camera: Camera::pinhole(Intrinsics::centered(700.0, 640, 480).unwrap(), 640, 480),
                cam_from_world: RigidTransform::translation(x, 0.0, 0.0),
            })
        };
        let mut reconstruction = Reconstruction {
            cameras: vec![camera(0.0), None, camera(-1.0)],
            points: vec![ScenePoint {
                position: Point3::new(0.0, 0.0, 5.0),
                color: [0; 3],
                track: vec![
                    TrackElement {
                        image: 0,
                        keypoint: 1,
                    },
                    TrackElement {
                        image: 2,
                        keypoint: 1,
                    },
                ],
                error_px: 0.0,
            }],
            ..Reconstruction::default()
        };
        reconstruction.finish_points(&images);
        (reconstruction, images)
    }

    #[test]
    fn the_text_model_is_half_a_pixel_ahead() {
        let (reconstruction, images) = small();
        let model = reconstruction.to_colmap(&images);
        assert_eq!(
            model.cameras.lines().nth(1),
            Some("1 PINHOLE 640 480 700 700 320 240")
        );
        let lines: Vec<&str> = model.images.lines().collect();
        assert_eq!(lines[2], "1 1 0 0 0 0 0 0 1 a.png");
        assert_eq!(lines[3], "1.5 2.5 -1 320 240 1");
        assert_eq!(lines[4], "3 1 0 0 0 -1 0 0 1 c.png");
        assert_eq!(lines.len(), 6);
        let point = model.points.lines().nth(1).unwrap();
        assert!(point.starts_with("1 0 0 5 10 20 30 ") && point.ends_with(" 1 1 3 1"));
        // Shown exactly in a; 140 pixels off in c.
        let error: f64 = point.split(' ').nth(7).unwrap().parse().unwrap();
        assert!((error - 140.0 / 2f64.sqrt()).abs() < 1e-9);
    }

    /// The names and the order of the parameters are those of COLMAP 4's list of models.
    #[test]
    fn each_lens_has_its_model() {
        let (mut reconstruction, images) = small();
        let line = |reconstruction: &Reconstruction| {
            let model = reconstruction.to_colmap(&images);
            model.cameras.lines().nth(1).unwrap().to_owned()
        };
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
            assert_eq!(line(&reconstruction), expected);
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
        let model = reconstruction.to_colmap(&images);
        let lines: Vec<&str> = model.cameras.lines().skip(1).collect();
        assert_eq!(
            lines,
            [
                "1 OPENCV 640 480 700 700 320 240 -0.1 0 0 0.002",
                "2 FULL_OPENCV 640 480 700 700 320 240 -0.1 0 0 0.002 0.5 0 0 0",
            ]
        );
    }

    #[test]
    fn the_cloud_has_fifteen_bytes_a_point() {
        let (reconstruction, _) = small();
        let ply = reconstruction.to_ply();
        let header = ply.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
        assert_eq!(ply.len() - header, 15);
        assert_eq!(&ply[header + 8..header + 12], 5f32.to_le_bytes());
        assert_eq!(&ply[header + 12..], [10, 20, 30]);
    }
}
