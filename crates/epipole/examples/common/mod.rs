//! Shared by the examples: photographs from files, or rendered ones.

#![allow(dead_code, reason = "every example uses a part of this")]

use epipole::prelude::*;
use epipole::sfm::Photo;
use epipole_io::photo::{DecodeOptions, decode_gray, decode_rgb};
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};

pub(crate) type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Size of rendered photographs.
pub(crate) const SIZE: (u32, u32) = (320, 240);

pub(crate) fn arguments() -> Vec<String> {
    std::env::args().skip(1).collect()
}

/// Gray values in [0, 1] of an image file.
pub(crate) fn read_gray(path: &str) -> Outcome<GrayImage32> {
    Ok(decode_gray(&std::fs::read(path)?, &DecodeOptions::default())?.image)
}

/// A table with objects, rendered from a moved camera: the camera, the image and the
/// depth of each pixel.
pub(crate) fn render(
    moved_from_start: &RigidTransform,
) -> Result<(PosedCamera, Photograph), Error> {
    let start = still_life_camera(SIZE.0, SIZE.1);
    let camera = PosedCamera {
        cam_from_world: moved_from_start * start.cam_from_world,
        ..start
    };
    let photo = Scene::still_life().render(&camera, SIZE.0, SIZE.1, Sampling::Full)?;
    Ok((camera, photo))
}

/// The same as gray values.
pub(crate) fn gray(photo: &Photograph) -> GrayImage32 {
    gray_to_f32(&rgb_to_gray(&photo.image))
}

/// Places in a photograph.
type Pixels = Vec<Point2<f64>>;

/// Matching pixels of two images, wrong matches among them.
pub(crate) fn matches(
    first: &GrayImage32,
    second: &GrayImage32,
) -> Result<(Pixels, Pixels), Error> {
    let options = SiftOptions::default();
    let [a, b] = [
        detect_sift(first, &options, &mut ())?,
        detect_sift(second, &options, &mut ())?,
    ];
    let matches = match_descriptors(
        &a.descriptors,
        &b.descriptors,
        &MatchOptions::default(),
        &mut (),
    )?;
    let place = |m: &epipole::feature::Match| {
        (a.keypoints[m.index1].point(), b.keypoints[m.index2].point())
    };
    Ok(matches.iter().map(place).unzip())
}

/// Photographs from files; without any, three of the table from left to right.
pub(crate) fn photos(paths: &[String]) -> Outcome<Vec<Photo>> {
    let mut photos = Vec::new();
    for path in paths {
        let image = decode_rgb(&std::fs::read(path)?, &DecodeOptions::default())?.image;
        let name = path.clone();
        photos.push(Photo {
            name,
            image,
            ..Photo::default()
        });
    }
    if paths.is_empty() {
        for x in [0.0, -0.15, -0.3] {
            let rotation = Vector3::new(0.0, -0.6 * x, 0.0);
            let step = RigidTransform::new(Vector3::new(x, 0.0, 0.0), rotation);
            let image = render(&step)?.1.image;
            let name = format!("{x}.png");
            photos.push(Photo {
                name,
                image,
                ..Photo::default()
            });
        }
    }
    Ok(photos)
}
