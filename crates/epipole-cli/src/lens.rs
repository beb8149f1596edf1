//! Reading calibrated cameras.

use crate::failure::Failure;
use crate::files;
use crate::matrices::FAR;
use clap::ValueEnum;
use epipole::camera::{Camera, LensKind, RigidTransform};
use epipole_io::camera::{Cameras, read_cameras};
use epipole_io::photo::sensor_size;
use nalgebra::Point2;
use std::path::Path;

/// Lens model on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// Five coefficients (Brown and Conrady), for usual lenses.
    Brown,
    /// Eight coefficients, for wide angles.
    Rational,
    /// Four coefficients (Kannala and Brandt), for views of 120° and more.
    Fisheye,
    /// One coefficient (Fitzgibbon's division model), for strong distortion and few boards.
    Division,
}

impl From<Model> for LensKind {
    fn from(model: Model) -> Self {
        match model {
            Model::Brown => Self::Brown,
            Model::Rational => Self::Rational,
            Model::Fisheye => Self::Fisheye,
            Model::Division => Self::Division,
        }
    }
}

/// Returns the fraction of an image without rays: beyond the fold of its lens model, or more than
/// 180° off the axis.
pub(crate) fn unseen_ratio(camera: &Camera) -> f64 {
    const SIDE: u32 = 24;
    let at = |n: u32, size: u32| f64::from(size) * (f64::from(n) + 0.5) / f64::from(SIDE) - 0.5;
    let places = (0..SIDE * SIDE)
        .map(|n| Point2::new(at(n % SIDE, camera.width), at(n / SIDE, camera.height)));
    let unseen = places
        .filter(|place| camera.unproject(place).is_err())
        .count();
    unseen as f64 / f64::from(SIDE * SIDE)
}

/// Reads a camera from a file of any format, `FILE` or `FILE#NAME`. Without a name, takes the first
/// camera with the size of the photo, or else the first.
///
/// * `photo`: a photo by the camera, whose size is used if the file has none
///
/// # Errors
/// A failure that names the file and the problem.
pub(crate) fn read(path: &Path, photo: Option<&Path>) -> Result<Camera, Failure> {
    let (path, name) = split_name(path);
    let size = photo.and_then(size_of);
    let cameras = read_all(path, size)?;
    if let Some(name) = name {
        return cameras.named(name).copied().ok_or_else(|| {
            let names: Vec<&str> = cameras.cameras.iter().map(|c| &*c.name).take(12).collect();
            let message = format!(
                "there is no camera {name} in it; there are {}",
                names.join(", ")
            );
            let notes = cameras.notes.iter().map(|note| format!("; {note}"));
            Failure::new("malformed", message + &notes.collect::<String>()).about(path)
        });
    }
    check_whole(&cameras, path)?;
    let fits = |camera: &Camera| {
        let (width, height) = (camera.width, camera.height);
        size.is_some_and(|size| size == (width, height) || size == (height, width))
    };
    let mut all = cameras.cameras.iter().map(|named| named.camera);
    let first = all.clone().next();
    let chosen = all.find(fits).or(first);
    chosen.ok_or_else(|| Failure::new("malformed", "there is no camera in it").about(path))
}

/// Reads the right camera of a stereo rig.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_right(path: &Path, photo: Option<&Path>) -> Result<Camera, Failure> {
    let cameras = read_all(path, photo.and_then(size_of))?;
    check_whole(&cameras, path)?;
    let right = cameras.cameras.get(1).ok_or_else(|| no_right(path))?;
    Ok(right.camera)
}

/// Reads a stereo rig: left camera, right camera and right_from_left.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_rig(
    path: &Path,
    photo: Option<&Path>,
) -> Result<([Camera; 2], RigidTransform), Failure> {
    let rig = read_all(path, photo.and_then(size_of))?;
    check_whole(&rig, path)?;
    let [left, right] = &rig.cameras[..] else {
        return Err(match rig.cameras.len() {
            1 => no_right(path),
            count => {
                Failure::new("malformed", format!("a rig has two cameras, not {count}")).about(path)
            }
        });
    };
    let right_from_left = rig.right_from_left.ok_or_else(|| {
        let message = "there are two cameras in it, but no motion between them (such as R and T)";
        Failure::new("malformed", message).about(path)
    })?;
    let translation = right_from_left.translation.vector;
    if translation.iter().any(|x| x.abs() > *FAR.end()) {
        let message = "the translation between the cameras is not three numbers of meters";
        return Err(Failure::new("malformed", message).about(path));
    }
    Ok(([left.camera, right.camera], right_from_left))
}

fn no_right(path: &Path) -> Failure {
    Failure::new(
        "malformed",
        "there is no right camera in it; calibrate with --right",
    )
    .about(path)
}

/// Refuses a file with unsupported cameras if no name was given, because the right one may be among
/// them.
fn check_whole(cameras: &Cameras, path: &Path) -> Result<(), Failure> {
    let Some(note) = cameras.notes.first() else {
        return Ok(());
    };
    let names: Vec<String> = (cameras.cameras.iter().take(3))
        .map(|named| format!("{}#{}", path.display(), named.name))
        .collect();
    let message = format!("{note}; choose one of the others: {}", names.join(", "));
    Err(Failure::new("unsupported", message).about(path))
}

fn read_all(path: &Path, size: Option<(u32, u32)>) -> Result<Cameras, Failure> {
    let bytes = files::read_bytes(path)?;
    let read = read_cameras(&bytes, size);
    let (_, cameras) = read.map_err(|error| Failure::from(error).about(path))?;
    Ok(cameras)
}

/// Splits a path at its last `#` into file and name, unless a file has the whole name.
fn split_name(path: &Path) -> (&Path, Option<&str>) {
    match path.to_str().and_then(|text| text.rsplit_once('#')) {
        Some((file, name)) if !path.exists() => (Path::new(file), Some(name)),
        _ => (path, None),
    }
}

/// Returns width and height of a photo as stored, if its header can be read.
pub(crate) fn size_of(photo: &Path) -> Option<(u32, u32)> {
    sensor_size(&std::fs::read(photo).ok()?).ok()
}
