//! COLMAP's binary model: `cameras.bin`, `images.bin` and `points3D.bin`.
//!
//! Values as in text, little-endian; names end with a byte 0, so they may contain blanks.
//!
//! Source: COLMAP's documentation, "Output format", "Binary file format"; COLMAP 4,
//! `src/colmap/scene/reconstruction_io_binary.cc`.

use super::colmap_parts::{ImagePart, Parts, PointPart};
use super::{Model, ModelFile, colmap_rigs};
use crate::bytes::{Bytes, extend};
use crate::colmap::cameras::{read_cameras_binary, write_cameras_binary};
use crate::{Error, Result};
use epipole::camera::{pixel_from_colmap, pixel_to_colmap};
use nalgebra::{Point2, Point3};

/// Point ID of a keypoint without one.
const NO_POINT: u64 = u64::MAX;

fn read_images(bytes: &[u8]) -> Result<Vec<ImagePart>> {
    let mut bytes = Bytes::new(bytes);
    let mut images = Vec::new();
    for _ in 0..bytes.count("images", 73)? {
        let id = bytes.u32()?;
        let quaternion = bytes.f64s()?;
        let translation = bytes.f64s()?;
        let camera = bytes.u32()?;
        let name = bytes.c_string()?;
        let mut keypoints = Vec::new();
        for _ in 0..bytes.count("keypoints", 24)? {
            let [x, y] = bytes.f64s()?;
            bytes.u64()?;
            if !(x.is_finite() && y.is_finite()) {
                return Err(Error::malformed(format!(
                    "a keypoint of image {id} ({name}) is at ({x}, {y})"
                )));
            }
            keypoints.push(pixel_from_colmap(&Point2::new(x, y)));
        }
        images.push(ImagePart {
            id,
            name,
            camera,
            quaternion,
            translation,
            keypoints,
        });
    }
    bytes.end()?;
    Ok(images)
}

fn read_points(bytes: &[u8]) -> Result<Vec<PointPart>> {
    let mut bytes = Bytes::new(bytes);
    let mut points = Vec::new();
    for _ in 0..bytes.count("points", 51)? {
        let id = bytes.u64()?;
        let position = Point3::from(bytes.f64s::<3>()?);
        let color = [bytes.u8()?, bytes.u8()?, bytes.u8()?];
        let error_px = bytes.f64()?;
        let mut track = Vec::new();
        for _ in 0..bytes.count("observations", 8)? {
            track.push((bytes.u32()?, bytes.u32()?));
        }
        points.push(PointPart {
            id,
            position,
            color,
            error_px,
            track,
        });
    }
    bytes.end()?;
    Ok(points)
}

/// Reads a binary model.
///
/// * `rigs`: `rigs.bin` and `frames.bin`
///
/// Also returns sentences on omitted parts.
pub(super) fn read(
    cameras: &[u8],
    images: &[u8],
    points: Option<&[u8]>,
    rigs: Option<[&[u8]; 2]>,
) -> Result<(Model, Vec<String>)> {
    let (rigs, frames) = match rigs {
        Some([rigs, frames]) => colmap_rigs::read_binary(rigs, frames)?,
        None => Default::default(),
    };
    let parts = Parts {
        cameras: read_cameras_binary(cameras).map_err(|error| error.in_file("cameras.bin"))?,
        images: read_images(images).map_err(|error| error.in_file("images.bin"))?,
        points: match points {
            Some(points) => read_points(points).map_err(|error| error.in_file("points3D.bin"))?,
            None => Vec::new(),
        },
        rigs,
        frames,
    };
    parts.join()
}

impl Model {
    /// Writes COLMAP's binary model: `cameras.bin`, `images.bin`, `points3D.bin`, and `rigs.bin`
    /// with `frames.bin`, with the cameras and IDs of [`to_colmap_text`](Self::to_colmap_text).
    /// Names may contain blanks; a byte 0 in them becomes `_`.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an index of the model is wrong.
    pub fn to_colmap_binary(&self) -> Result<Vec<ModelFile>> {
        self.check()?;
        let mut images = (self.images.len() as u64).to_le_bytes().to_vec();
        for (image, point_of_keypoint) in self.images.iter().zip(self.point_of_keypoint()) {
            let (q, t) = (
                image.cam_from_world.rotation,
                image.cam_from_world.translation.vector,
            );
            images.extend(image.id.to_le_bytes());
            extend(&mut images, &[q.w, q.i, q.j, q.k, t.x, t.y, t.z]);
            images.extend(self.camera_id(image.camera).to_le_bytes());
            images.extend(image.name.replace('\0', "_").as_bytes());
            images.push(0);
            images.extend((image.keypoints.len() as u64).to_le_bytes());
            for (keypoint, point) in image.keypoints.iter().zip(point_of_keypoint) {
                let pixel = pixel_to_colmap(keypoint);
                extend(&mut images, &[pixel.x, pixel.y]);
                let id = point.map_or(NO_POINT, |point| self.points[point].id);
                images.extend(id.to_le_bytes());
            }
        }
        let mut points = (self.points.len() as u64).to_le_bytes().to_vec();
        for point in &self.points {
            points.extend(point.id.to_le_bytes());
            extend(&mut points, point.position.coords.as_slice());
            points.extend(point.color);
            extend(&mut points, &[point.error_px.unwrap_or(-1.0)]);
            points.extend((point.track.len() as u64).to_le_bytes());
            for &(image, keypoint) in &point.track {
                points.extend(self.images[image].id.to_le_bytes());
                points.extend((keypoint as u32).to_le_bytes());
            }
        }
        let cameras = write_cameras_binary(&self.numbered_cameras());
        let mut files = vec![
            ModelFile::new("cameras.bin", cameras),
            ModelFile::new("images.bin", images),
            ModelFile::new("points3D.bin", points),
        ];
        files.extend(self.rigs_binary());
        Ok(files)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns `cameras.bin` of one SIMPLE_RADIAL camera with ID 12.
    fn cameras() -> Vec<u8> {
        let mut bytes = vec![1, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 0, 2, 0, 0, 0];
        bytes.extend(640u64.to_le_bytes());
        bytes.extend(480u64.to_le_bytes());
        extend(&mut bytes, &[500.0, 320.0, 240.0, 0.1]);
        bytes
    }

    #[test]
    fn bytes_are_those_of_the_definition() {
        let [(id, Ok(camera))] = read_cameras_binary(&cameras()).unwrap()[..] else {
            panic!("one camera");
        };
        assert_eq!((id, camera.width, camera.height), (12, 640, 480));
        assert_eq!(camera.intrinsics.principal_point().y, 239.5);
        let written = write_cameras_binary(&[(7, camera)]);
        // ID 7, OPENCV, eight parameters.
        assert_eq!(written[8..16], [7, 0, 0, 0, 4, 0, 0, 0]);
        assert_eq!(written.len(), 8 + 24 + 8 * 8);
    }

    #[test]
    fn counts_are_checked_against_the_file() {
        let of = |bytes: &[u8]| read_cameras_binary(bytes).unwrap_err().to_string();
        let mut many = cameras();
        many[7] = 255;
        assert!(of(&many).contains("cameras do not fit in the remaining 56 bytes"));
        assert!(of(&cameras()[..60]).contains("the file ends"));
        assert!(of(&[cameras(), vec![0]].concat()).contains("1 bytes follow"));
        let mut other = cameras();
        other[12] = 7;
        let listed = read_cameras_binary(&[other, vec![0; 8]].concat()).unwrap();
        let why = listed[0].1.as_ref().unwrap_err();
        assert!(why.contains("FOV is not supported"), "{why}");
    }
}
