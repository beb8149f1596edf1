//! The two posed cameras of `epipole triangulate`.

use crate::content::Content;
use crate::failure::Failure;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole_io::camera::{Cameras, NamedCamera};
use epipole_io::model::{Model, ModelImage};
use std::path::Path;

/// Maximum number of names that a message lists.
const MAX_NAMES: usize = 12;

/// Two cameras, and the names of their images in a model.
type Pair = ([PosedCamera; 2], Option<[String; 2]>);

/// Reads the cameras of a model, a rig, or two files.
///
/// * `images`: names of two images of the model, between them a comma
///
/// # Errors
/// For a file that cannot be read, a pose that is missing, or an image that the model does not
/// have.
pub(super) fn read(
    first: &Path,
    second: Option<&Path>,
    images: Option<&str>,
) -> Result<Pair, Failure> {
    if let Some(second) = second {
        if images.is_some() {
            return Err(Failure::usage(
                "--images is for a model, not for two camera files",
            ));
        }
        return Ok(([read_posed(first)?, read_posed(second)?], None));
    }
    match (Content::read(first)?, images) {
        (Content::Model(read), images) => {
            of_model(&read.model, images).map_err(|failure| failure.about(first))
        }
        (_, Some(_)) => {
            let message = "this is no model, of which --images could name two images";
            Err(Failure::usage(message).about(first))
        }
        (Content::Cameras(_, cameras), None) => of_rig(&cameras)
            .map(|pair| (pair, None))
            .ok_or_else(|| without_pose(first, "give a second camera file with its pose")),
        (Content::Trajectory(..), None) => {
            let message =
                "a trajectory has poses, but no cameras: give a model or two camera files";
            Err(Failure::new("malformed", message).about(first))
        }
    }
}

/// Returns the camera of a file with one camera, or of a model with one image.
fn read_posed(path: &Path) -> Result<PosedCamera, Failure> {
    let pose = match Content::read(path)? {
        Content::Model(read) => match &read.model.images[..] {
            [image] => Some(camera_of(&read.model, image)),
            images => {
                let message = format!("it has {} images instead of one", images.len());
                return Err(Failure::new("malformed", message).about(path));
            }
        },
        Content::Cameras(_, cameras) => match &cameras.cameras[..] {
            [camera] => of_camera(camera),
            all => {
                let message = format!("it has {} cameras instead of one", all.len());
                return Err(Failure::new("malformed", message).about(path));
            }
        },
        Content::Trajectory(..) => None,
    };
    pose.ok_or_else(|| without_pose(path, "epipole pnp --json prints a camera with one"))
}

fn without_pose(path: &Path, advice: &str) -> Failure {
    let message = format!("there is no pose in it (cam_from_world, or R and T of a rig): {advice}");
    Failure::new("malformed", message).about(path)
}

fn of_camera(named: &NamedCamera) -> Option<PosedCamera> {
    Some(PosedCamera {
        camera: named.camera,
        cam_from_world: named.cam_from_world?,
    })
}

fn of_rig(cameras: &Cameras) -> Option<[PosedCamera; 2]> {
    let [left, right] = &cameras.cameras[..] else {
        return None;
    };
    let posed = |camera: &NamedCamera, cam_from_world| PosedCamera {
        camera: camera.camera,
        cam_from_world,
    };
    Some([
        posed(left, RigidTransform::identity()),
        posed(right, cameras.right_from_left?),
    ])
}

fn camera_of(model: &Model, image: &ModelImage) -> PosedCamera {
    PosedCamera {
        camera: model.cameras[image.camera],
        cam_from_world: image.cam_from_world,
    }
}

fn of_model(model: &Model, images: Option<&str>) -> Result<Pair, Failure> {
    let pair = match (images, &model.images[..]) {
        (Some(names), _) => images_of_names(model, names)?,
        (None, [first, second]) => [first, second],
        (None, all) => {
            let message = format!(
                "the model has {} images: name two by --images NAME1,NAME2",
                all.len()
            );
            return Err(Failure::usage(message));
        }
    };
    if std::ptr::eq(pair[0], pair[1]) {
        let message = format!("--images names {} twice: name two images", pair[0].name);
        return Err(Failure::usage(message));
    }
    Ok((
        pair.map(|image| camera_of(model, image)),
        Some(pair.map(|image| image.name.clone())),
    ))
}

/// Returns the images of two names, which may contain commas.
fn images_of_names<'a>(model: &'a Model, names: &str) -> Result<[&'a ModelImage; 2], Failure> {
    let find = |name: &str| {
        let name = name.trim();
        let mut ending = (model.images.iter())
            .filter(|image| Path::new(&image.name).ends_with(name) && !name.is_empty());
        let exact = model.images.iter().find(|image| image.name == name);
        // The end of a path is enough if it is unique.
        exact.or_else(|| ending.next().filter(|_| ending.next().is_none()))
    };
    let splits = names
        .match_indices(',')
        .map(|(at, _)| (&names[..at], &names[at + 1..]));
    let mut unknown = None;
    for (first, second) in splits {
        match (find(first), find(second)) {
            (Some(first), Some(second)) => return Ok([first, second]),
            (None, _) => unknown = unknown.or(Some(first)),
            (_, None) => unknown = Some(second),
        }
    }
    let Some(unknown) = unknown else {
        return Err(Failure::usage(
            "--images takes two names with a comma between them",
        ));
    };
    let known: Vec<&str> = (model.images.iter().take(MAX_NAMES))
        .map(|image| &*image.name)
        .collect();
    let more = match model.images.len() > MAX_NAMES {
        true => " …",
        false => "",
    };
    let message = format!(
        "the model has no image {}, or several: its images are {}{more}",
        unknown.trim(),
        known.join(", ")
    );
    Err(Failure::new("malformed", message))
}
