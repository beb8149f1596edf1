//! Bundler's `bundle.out`, version 0.3, with the names of its images in `list.txt`.
//!
//! Cameras look along −z with y up; pixels are relative to the principal point, x right, y up. The
//! file has one focal length and two radial terms per camera, but neither principal point nor image
//! size. The principal point is the center of the image, whose size is read from its file, or else
//! is the smallest that holds all keypoints.
//!
//! Source: Snavely, "Bundler v0.4 User's Manual", §"Output format and scene representation".

use super::{CameraList, Model, ModelFile, ModelFolder, ModelImage, ModelPoint};
use crate::rotation::{FOUR_DIGITS, half_turn, pose, rotation_from_matrix};
use crate::text::number;
use crate::{Error, Result, text};
use epipole::camera::{Camera, Distortion, Intrinsics, Lens, LensKind, RigidTransform};
use nalgebra::{Matrix3, Point2, Point3, Vector3};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Maximum side of an image, pixels; keypoints beyond it are not pixels.
const MAX_SIDE_PX: f64 = 1e6;

/// Words of a text with their line numbers.
struct Words<'a, I: Iterator<Item = (usize, &'a str)>>(I);

impl<'a, I: Iterator<Item = (usize, &'a str)>> Words<'a, I> {
    fn word(&mut self) -> Result<(usize, &'a str)> {
        (self.0.next()).ok_or_else(|| Error::malformed("the file ends before its last point"))
    }

    fn number(&mut self) -> Result<f64> {
        let (line, word) = self.word()?;
        number(line, word)
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for value in &mut numbers {
            *value = self.number()?;
        }
        Ok(numbers)
    }

    fn whole<T: std::str::FromStr>(&mut self) -> Result<T> {
        let (line, word) = self.word()?;
        (word.parse()).map_err(|_| Error::at(line, format!("\"{word}\" is no whole number here")))
    }
}

/// Reads the names of `list.txt`, which may be followed by 0 and a focal length.
fn names(text: &str) -> Vec<String> {
    let name = |line: &str| {
        let line = line.trim();
        let mut words = line.rsplitn(3, ' ');
        let (last, before, rest) = (words.next(), words.next(), words.next());
        match (rest, before, last.map(str::parse::<f64>)) {
            (Some(rest), Some("0"), Some(Ok(_))) => rest.trim_end().to_owned(),
            _ => line.to_owned(),
        }
    };
    text.lines()
        .filter(|line| !line.trim().is_empty())
        .map(name)
        .collect()
}

/// A camera of the file, and its keypoints by number.
struct Entry {
    focal: [f64; 3],
    cam_from_world: RigidTransform,
    keypoints: BTreeMap<u64, Point2<f64>>,
}

/// Reads a file.
///
/// * `lists`: names of the list of images, of which the first that exists is read
///
/// Also returns sentences on omitted parts.
pub(super) fn read(
    bytes: &[u8],
    lists: &[String],
    folder: &dyn ModelFolder,
) -> Result<(Model, Vec<String>)> {
    let text = text::decode(bytes)?;
    let words = text::lines(text);
    let words = words.flat_map(|(n, line)| line.split_ascii_whitespace().map(move |w| (n, w)));
    let mut words = Words(words);
    let (num_cameras, num_points) = (words.whole::<u64>()?, words.whole::<u64>()?);
    let mut entries = Vec::new();
    for index in 0..num_cameras {
        let focal = words.numbers::<3>()?;
        let matrix = Matrix3::from_row_slice(&words.numbers::<9>()?);
        let translation = Vector3::from(words.numbers::<3>()?);
        // A camera without a pose is all zeros.
        if focal[0] == 0.0 {
            entries.push(None);
            continue;
        }
        let rotation = rotation_from_matrix(&matrix, FOUR_DIGITS)
            .ok_or_else(|| Error::malformed(format!("camera {index} has no rotation")))?;
        let pose = pose(half_turn() * rotation, half_turn() * translation);
        entries.push(Some(Entry {
            focal,
            cam_from_world: pose.ok_or_else(|| Error::malformed("a pose is not finite"))?,
            keypoints: BTreeMap::new(),
        }));
    }
    let (mut points, mut tracks) = (Vec::new(), Vec::new());
    for _ in 0..num_points {
        let position = Point3::from(words.numbers::<3>()?);
        let color = [words.whole()?, words.whole()?, words.whole()?];
        let mut track = Vec::new();
        for _ in 0..words.whole::<u64>()? {
            let (camera, key) = (words.whole::<usize>()?, words.whole::<u64>()?);
            let [x, y] = words.numbers()?;
            let entry = entries.get_mut(camera).and_then(Option::as_mut);
            let entry = entry.ok_or_else(|| {
                Error::malformed(format!(
                    "a point is seen by camera {camera}, which is not there"
                ))
            })?;
            entry.keypoints.insert(key, Point2::new(x, y));
            track.push((camera, key));
        }
        points.push((position, color));
        tracks.push(track);
    }
    let list = lists.iter().find_map(|name| folder.file(name));
    let names = match &list {
        Some(bytes) => names(text::decode(bytes)?),
        None => Vec::new(),
    };
    let mut notes = Vec::new();
    if list.is_none() {
        notes.push(format!("{} is not there: images are numbered", lists[0]));
    }
    if list.is_some() && names.len() < entries.len() {
        notes.push(format!(
            "the list has {} names for {} cameras: the others are numbered",
            names.len(),
            entries.len()
        ));
    }
    let smallest = size(&entries)?;
    let mut num_unknown = 0_usize;
    let (mut cameras, mut images) = (CameraList::default(), Vec::new());
    let mut image_of_camera = vec![0; entries.len()];
    let mut num_without = 0_usize;
    for (index, entry) in entries.iter().enumerate() {
        let Some(entry) = entry else {
            num_without += 1;
            continue;
        };
        let size = names.get(index).and_then(|name| folder.image_size(name));
        num_unknown += usize::from(size.is_none());
        let (width, height) = size.unwrap_or(smallest);
        let [f, k1, k2] = entry.focal;
        let lens = Lens::from_coefficients(LensKind::Brown, &[k1, k2, 0.0, 0.0, 0.0])?;
        let intrinsics = Intrinsics::centered(f, width, height)?;
        let center = intrinsics.principal_point();
        image_of_camera[index] = images.len();
        images.push(ModelImage {
            id: u32::try_from(index + 1).unwrap_or(u32::MAX),
            name: (names.get(index).cloned()).unwrap_or_else(|| format!("{index}")),
            camera: cameras.number_of(Camera {
                width,
                height,
                intrinsics,
                lens,
            }),
            cam_from_world: entry.cam_from_world,
            keypoints: (entry.keypoints.values())
                .map(|p| Point2::new(center.x + p.x, center.y - p.y))
                .collect(),
        });
    }
    if num_unknown > 0 {
        let (width, height) = smallest;
        notes.push(format!(
            "the file has no image sizes, and {num_unknown} images are not there: {width} × {height} \
             holds all keypoints"
        ));
    }
    if num_without > 0 {
        notes.push(format!("{num_without} images have no pose: left out"));
    }
    let place_of_key: Vec<BTreeMap<u64, usize>> = (entries.iter())
        .map(|entry| {
            let keys = entry.iter().flat_map(|entry| entry.keypoints.keys());
            keys.enumerate().map(|(place, key)| (*key, place)).collect()
        })
        .collect();
    let points = (1..).zip(points).zip(tracks);
    let points = points.map(|((id, (position, color)), track)| ModelPoint {
        id,
        position,
        color,
        error_px: None,
        track: (track.into_iter())
            .map(|(camera, key)| (image_of_camera[camera], place_of_key[camera][&key]))
            .collect(),
    });
    let model = Model {
        points: points.collect(),
        cameras: cameras.into_list(),
        images,
        ..Model::default()
    };
    Ok((model, notes))
}

/// Returns the smallest even size that holds all keypoints around its center, pixels.
fn size(entries: &[Option<Entry>]) -> Result<(u32, u32)> {
    let mut farthest = Vector3::new(1.0_f64, 1.0, 0.0);
    let keypoints = (entries.iter().flatten()).flat_map(|entry| entry.keypoints.values());
    for p in keypoints {
        farthest.x = farthest.x.max(p.x.abs());
        farthest.y = farthest.y.max(p.y.abs());
    }
    if 2.0 * farthest.x.max(farthest.y) > MAX_SIDE_PX {
        return Err(Error::malformed(format!(
            "a keypoint is {} pixels off the middle of its image",
            farthest.x.max(farthest.y)
        )));
    }
    Ok((2 * farthest.x.ceil() as u32, 2 * farthest.y.ceil() as u32))
}

impl Model {
    /// Writes Bundler's `bundle.out` and `list.txt`. Pixels are relative to the principal point,
    /// and vertical coordinates are multiplied by fx / fy, because Bundler has one focal length.
    /// Projections are preserved; principal points and image sizes are lost.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for lenses with more than k1 and k2, [`Error::Malformed`] if an index
    /// of the model is wrong.
    pub fn to_bundler(&self) -> Result<Vec<ModelFile>> {
        self.check()?;
        let mut radial = Vec::new();
        for camera in &self.cameras {
            let Lens::Brown(Distortion { k1, k2, p1, p2, k3 }) = camera.lens else {
                return Err(beyond(&camera.lens));
            };
            if [p1, p2, k3] != [0.0; 3] {
                return Err(beyond(&camera.lens));
            }
            radial.push([camera.intrinsics.fu_px(), k1, k2]);
        }
        // Writing to a string cannot fail.
        let mut text = format!(
            "# Bundle file v0.3\n{} {}\n",
            self.images.len(),
            self.points.len()
        );
        let mut list = String::new();
        for image in &self.images {
            let [f, k1, k2] = radial[image.camera];
            let r = (half_turn() * image.cam_from_world.rotation).to_rotation_matrix();
            let t = half_turn() * image.cam_from_world.translation.vector;
            let _ = writeln!(text, "{f} {k1} {k2}");
            for i in 0..3 {
                let _ = writeln!(text, "{} {} {}", r[(i, 0)], r[(i, 1)], r[(i, 2)]);
            }
            let _ = writeln!(text, "{} {} {}", t.x, t.y, t.z);
            let _ = writeln!(list, "{}", image.name.replace(['\n', '\r'], "_"));
        }
        for point in &self.points {
            let (p, [r, g, b]) = (point.position, point.color);
            let _ = write!(text, "{} {} {}\n{r} {g} {b}\n", p.x, p.y, p.z);
            let _ = write!(text, "{}", point.track.len());
            for &(image, keypoint) in &point.track {
                let camera = &self.cameras[self.images[image].camera].intrinsics;
                let offset = self.images[image].keypoints[keypoint] - camera.principal_point();
                let y = -offset.y * (camera.fu_px() / camera.fv_px());
                let _ = write!(text, " {image} {keypoint} {} {y}", offset.x);
            }
            text.push('\n');
        }
        Ok(vec![
            ModelFile::new("bundle.out", text),
            ModelFile::new("list.txt", list),
        ])
    }
}

fn beyond(lens: &Lens) -> Error {
    Error::unsupported(format!(
        "Bundler has lenses of k1 and k2 alone, not {} ones with {:?}: undistort the images first",
        lens.kind().name(),
        lens.coefficients()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "# Bundle file v0.3\n2 1\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n\
                        100 0.1 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n\
                        0.5 1 -2\n10 20 30\n1 1 3 26.5625 53.125\n";

    #[test]
    fn a_camera_looks_along_minus_z_with_y_up() {
        let list =
            |name: &str| (name == "list.txt").then(|| b"a b.jpg 0 532.5\nc d.jpg\n".to_vec());
        let (model, notes) = read(FILE.as_bytes(), &["list.txt".to_owned()], &list).unwrap();
        assert_eq!(model.images.len(), 1);
        assert_eq!((model.images[0].id, &*model.images[0].name), (2, "c d.jpg"));
        assert_eq!((model.cameras[0].width, model.cameras[0].height), (54, 108));
        // r² = 0.3125, so the ray (0.25, −0.5) is scaled by 1.03125; the file is off.
        let pixel = model.cameras[0]
            .project(&(model.images[0].cam_from_world * model.points[0].position))
            .unwrap();
        assert!((pixel - Point2::new(26.5 + 25.78125, 53.5 - 51.5625)).norm() < 1e-12);
        let keypoint = model.images[0].keypoints[0];
        assert_eq!(keypoint, Point2::new(26.5 + 26.5625, 53.5 - 53.125));
        assert_eq!(model.points[0].track, [(0, 0)]);
        assert_eq!(notes.len(), 2, "{notes:?}");
        assert_eq!(
            names("x 0 5\ny 1 5\nz 0 q\n\n")[..],
            ["x", "y 1 5", "z 0 q"]
        );
    }

    #[cfg(feature = "photos")]
    #[test]
    fn the_middle_is_that_of_the_image_if_it_is_there() {
        let file = |name: &str| match name {
            "list.txt" => Some(b"./a.pgm 0 532.5\n./photos/b.pgm\n".to_vec()),
            "photos/b.pgm" => Some(b"P5 60 120 255\n".repeat(9)),
            _ => None,
        };
        let (model, notes) = read(FILE.as_bytes(), &["list.txt".to_owned()], &file).unwrap();
        assert_eq!((model.cameras[0].width, model.cameras[0].height), (60, 120));
        assert_eq!(
            model.images[0].keypoints[0],
            Point2::new(29.5 + 26.5625, 59.5 - 53.125)
        );
        assert_eq!(notes, ["1 images have no pose: left out"]);
        let short = |name: &str| (name == "list.txt").then(|| b"a.jpg\n".to_vec());
        let (model, notes) = read(FILE.as_bytes(), &["list.txt".to_owned()], &short).unwrap();
        assert_eq!(model.images[0].name, "1");
        assert!(
            notes[0].starts_with("the list has 1 names for 2 cameras"),
            "{notes:?}"
        );
    }

    #[test]
    fn wrong_values_are_named() {
        let of = |text: &str| {
            let read = read(text.as_bytes(), &["list.txt".to_owned()], &|_: &str| None);
            read.unwrap_err().to_string()
        };
        assert!(of(&FILE[..60]).contains("the file ends"));
        assert!(of(&FILE.replace("1 1 3", "1 0 3")).contains("camera 0, which is not there"));
        assert!(of(&FILE.replace("1 0 0", "1 1 0")).contains("camera 1 has no rotation"));
        assert!(of(&FILE.replace("26.5625", "1e300")).contains("off the middle"));
        assert!(of(&FILE.replace("2 1\n", "2 x\n")).starts_with("line 2"));
    }
}
