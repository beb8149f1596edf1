//! COLMAP's text model: `cameras.txt`, `images.txt` and `points3D.txt`.
//!
//! Poses are `cam_from_world`, quaternions begin with w, pixel centers are at halves. COLMAP reads
//! a name up to its first blank, this reader up to the end of the line.
//!
//! Source: COLMAP's documentation, "Output format", "Text format".

use super::colmap_parts::{ImagePart, Parts, PointPart};
use super::{Model, ModelFile, colmap_rigs};
use crate::colmap::cameras::{read_cameras_text, write_cameras_text};
use crate::colmap::words::{Words, content, is_skipped};
use crate::text::number;
use crate::{Error, Result, text};
use epipole::camera::{pixel_from_colmap, pixel_to_colmap};
use nalgebra::{Point2, Point3};
use std::fmt::Write;

/// Returns the name after the first nine words.
fn name_of(line: &str) -> &str {
    let mut rest = line.trim();
    for _ in 0..9 {
        let end = rest.find(|c: char| c.is_ascii_whitespace());
        rest = rest[end.unwrap_or(rest.len())..].trim_start();
    }
    rest
}

fn read_images(text: &str) -> Result<Vec<ImagePart>> {
    let mut images = Vec::new();
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    while let Some((line, head)) = lines.next() {
        if is_skipped(head) {
            continue;
        }
        let mut words = Words::new(line, head);
        let id = words.whole("the image ID")?;
        let quaternion = words.numbers("the quaternion")?;
        let translation = words.numbers("the translation")?;
        let camera = words.whole("the camera ID")?;
        words.word("the image name")?;
        // The line of keypoints may be empty.
        let (line, second) = lines.next().unwrap_or((line, ""));
        let mut words = Words::new(line, second);
        let mut keypoints = Vec::new();
        while let Some(u) = words.next() {
            let pixel = Point2::new(number(line, u)?, words.number("y of a keypoint")?);
            words.whole::<i64>("the point ID of a keypoint")?;
            keypoints.push(pixel_from_colmap(&pixel));
        }
        images.push(ImagePart {
            id,
            name: name_of(head).to_owned(),
            camera,
            quaternion,
            translation,
            keypoints,
        });
    }
    Ok(images)
}

fn read_points(text: &str) -> Result<Vec<PointPart>> {
    let mut points = Vec::new();
    for (line, content) in content(text) {
        let mut words = Words::new(line, content);
        let id = words.whole("the point ID")?;
        let mut position = [0.0; 3];
        for value in &mut position {
            *value = words.any_number("the position")?;
        }
        let mut color = [0; 3];
        for value in &mut color {
            *value = words.whole("the color")?;
        }
        let error_px = words.any_number("the error")?;
        let mut track = Vec::new();
        while let Some(image) = words.next() {
            let image = (image.parse())
                .map_err(|_| Error::at(line, format!("an image ID cannot be \"{image}\"")))?;
            track.push((image, words.whole("the keypoint of an observation")?));
        }
        points.push(PointPart {
            id,
            position: Point3::from(position),
            color,
            error_px,
            track,
        });
    }
    Ok(points)
}

/// Reads a text model.
///
/// * `rigs`: `rigs.txt` and `frames.txt`
///
/// Also returns sentences on omitted parts.
pub(super) fn read(
    cameras: &[u8],
    images: &[u8],
    points: Option<&[u8]>,
    rigs: Option<[&[u8]; 2]>,
) -> Result<(Model, Vec<String>)> {
    let (rigs, frames) = match rigs {
        Some([rigs, frames]) => colmap_rigs::read_text(rigs, frames)?,
        None => Default::default(),
    };
    let parts = Parts {
        cameras: read_cameras_text(text::decode(cameras)?)
            .map_err(|error| error.in_file("cameras.txt"))?,
        images: read_images(text::decode(images)?).map_err(|error| error.in_file("images.txt"))?,
        points: match points {
            Some(points) => {
                read_points(text::decode(points)?).map_err(|error| error.in_file("points3D.txt"))?
            }
            None => Vec::new(),
        },
        rigs,
        frames,
    };
    parts.join()
}

impl Model {
    /// Writes COLMAP's text model: `cameras.txt`, `images.txt` and `points3D.txt`, and if a rig has
    /// several cameras, `rigs.txt` and `frames.txt`, which COLMAP reads since 3.12.
    ///
    /// Cameras are `PINHOLE`; `OPENCV` for Brown's lens, `FULL_OPENCV` if it has a k3 and for the
    /// rational lens; `OPENCV_FISHEYE` for fisheyes; `DIVISION` for the division model, which
    /// COLMAP supports since version 4. COLMAP treats points 90° and more off the axis of a fisheye
    /// as behind the camera. A name extends to the end of its line, so line breaks in it become
    /// `_`; COLMAP itself reads it up to the first blank, in text files only.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an index of the model is wrong.
    pub fn to_colmap_text(&self) -> Result<Vec<ModelFile>> {
        self.check()?;
        let point_of_keypoint = self.point_of_keypoint();
        let mut images = String::from(
            "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n",
        );
        for (image, point_of_keypoint) in self.images.iter().zip(&point_of_keypoint) {
            let (q, t) = (
                image.cam_from_world.rotation,
                image.cam_from_world.translation.vector,
            );
            let _ = writeln!(
                images,
                "{} {} {} {} {} {} {} {} {} {}",
                image.id,
                q.w,
                q.i,
                q.j,
                q.k,
                t.x,
                t.y,
                t.z,
                self.camera_id(image.camera),
                image.name.replace(['\n', '\r'], "_")
            );
            for (n, (keypoint, point)) in image.keypoints.iter().zip(point_of_keypoint).enumerate()
            {
                let space = if n == 0 { "" } else { " " };
                let pixel = pixel_to_colmap(keypoint);
                let (x, y) = (pixel.x, pixel.y);
                let _ = match point {
                    Some(point) => write!(images, "{space}{x} {y} {}", self.points[*point].id),
                    None => write!(images, "{space}{x} {y} -1"),
                };
            }
            images.push('\n');
        }
        let mut points = String::from(
            "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n",
        );
        for point in &self.points {
            let ([r, g, b], p) = (point.color, point.position);
            let error_px = point.error_px.unwrap_or(-1.0);
            let _ = write!(
                points,
                "{} {} {} {} {r} {g} {b} {error_px}",
                point.id, p.x, p.y, p.z
            );
            for &(image, keypoint) in &point.track {
                let _ = write!(points, " {} {keypoint}", self.images[image].id);
            }
            points.push('\n');
        }
        let mut files = vec![
            ModelFile::new("cameras.txt", write_cameras_text(&self.numbered_cameras())),
            ModelFile::new("images.txt", images),
            ModelFile::new("points3D.txt", points),
        ];
        files.extend(self.rigs_text());
        Ok(files)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERAS: &str = "# Camera list\n\n12 SIMPLE_RADIAL 640 480 500 320 240 0.1\r\n";
    const IMAGES: &str = "# Image list\n9 2 0 0 0 1 2 3 12 a b  #1.jpg\n1.5 2.5 -1 320 240 77\n\
                          4 0 1 0 0 0 0 0 12 é.png\n\n# end\n7 1 0 0 0 0 0 0 12 last";
    const POINTS: &str = "77 0 0 5 10 20 30 -1 9 1 4 0 8 0\n78 nan 0 0 1 2 3 0\n";

    #[test]
    fn ids_names_and_empty_lines_are_read() {
        let (model, notes) = read(
            CAMERAS.as_bytes(),
            IMAGES.as_bytes(),
            Some(POINTS.as_bytes()),
            None,
        )
        .unwrap();
        let names = model.images.iter().map(|image| (image.id, &*image.name));
        let names: Vec<_> = names.collect();
        assert_eq!(names, [(9, "a b  #1.jpg"), (4, "é.png"), (7, "last")]);
        assert_eq!(model.cameras[0].intrinsics.principal_point().x, 319.5);
        assert_eq!(model.images[0].keypoints[1], Point2::new(319.5, 239.5));
        // The quaternion has length 2.
        assert_eq!(
            model.images[0].cam_from_world,
            epipole::camera::RigidTransform::translation(1.0, 2.0, 3.0)
        );
        assert_eq!(model.points.len(), 1);
        assert_eq!(model.points[0].id, 77);
        let point = &model.points[0];
        assert_eq!((point.error_px, &point.track), (None, &vec![(0, 1)]));
        assert_eq!(notes.len(), 2, "{notes:?}");
        assert!(notes[0].contains("1 point has") && notes[1].contains("2 observations"));
    }

    #[test]
    fn wrong_values_are_named() {
        let of = |cameras: &str, images: &str, points: &str| {
            let read = read(
                cameras.as_bytes(),
                images.as_bytes(),
                Some(points.as_bytes()),
                None,
            );
            read.unwrap_err().to_string()
        };
        assert_eq!(
            of("1 PINHOLE 640 480 500\n", "", ""),
            "cameras.txt, line 1: camera model PINHOLE has 4 parameters, not 1"
        );
        assert_eq!(
            of("", "\n1 1 0 0 0 0 x", ""),
            "images.txt, line 2: \"x\" is not a number"
        );
        assert!(of("", "1 1 0 0 0 0 0 0 1 a", "").contains("camera 1, which is not listed"));
        assert!(of(CAMERAS, "1 0 0 0 0 0 0 0 12 a", "").contains("quaternion is 0"));
        assert!(of(CAMERAS, "1 1 0 0 0 0 0 0 12", "").contains("image name is missing"));
        assert!(of(CAMERAS, "1 1 0 0 0 0 0 0 12 a\n1 2", "").contains("line 2"));
        let twice = "1 1 0 0 0 0 0 0 12 a\n\n1 1 0 0 0 0 0 0 12 b\n\n";
        assert!(of(CAMERAS, twice, "").contains("two images have ID 1"));
        assert!(of(&CAMERAS.repeat(2), "", "").contains("two cameras have ID 12"));
        assert!(of("", "", "1 0 0 0 256 0 0 0").contains("the color cannot be \"256\""));
    }
}
