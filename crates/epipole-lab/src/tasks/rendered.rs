//! Rendered photographs of the samples.

use super::board_sample;
use crate::project::Sample;
use epipole::camera::{Camera, Intrinsics, PosedCamera, look_at};
use epipole::math::random::Random;
use epipole::stereo::PixelMap;
use epipole_scenes::{Sampling, Scene, still_life_camera};
use image::RgbImage;
use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};

/// Width and height of a rendered photograph, pixels.
const RENDERED: (u32, u32) = (480, 360);

/// Renders a photograph of a sample. Returns it with its focal length in pixels, if its file would
/// contain one.
///
/// # Errors
/// A message, if the sample has no photograph with this index.
pub(super) fn render(sample: Sample, index: u8) -> Result<(RgbImage, Option<f64>), String> {
    if index >= sample.len() {
        return Err("the sample has no such photograph".to_owned());
    }
    let sentence = |error: epipole::Error| error.to_string();
    if sample == Sample::Board {
        let image = board_sample::photograph(index).map_err(sentence)?;
        let image = image.ok_or("the sample has no such photograph")?;
        return Ok((image, None));
    }
    let camera = match sample {
        Sample::Turned => turned(index),
        Sample::Twice => around_table(4)?,
        Sample::Mixed => around_table(3 + index % 3)?,
        Sample::Upright => held(index)?,
        _ => around_table(index)?,
    };
    let focal_px = camera.camera.intrinsics.fu_px();
    let image = match sample {
        Sample::Plane => {
            let print = still_life_camera(PRINTED.0, PRINTED.1);
            let picture = Scene::still_life().render(&print, PRINTED.0, PRINTED.1, Sampling::Full);
            hung(&picture.map_err(sentence)?.image, index).map_err(sentence)?
        }
        Sample::Mixed if index >= 3 => hung(&carpet(), index - 3).map_err(sentence)?,
        _ => photographed(&camera, sample, index)?,
    };
    Ok((image, Some(focal_px)))
}

/// Renders the still life as seen by a camera.
fn photographed(camera: &PosedCamera, sample: Sample, index: u8) -> Result<RgbImage, String> {
    let (width, height) = match is_upright(sample, index) {
        true => (RENDERED.1, RENDERED.0),
        false => RENDERED,
    };
    let picture = Scene::still_life().render(camera, width, height, Sampling::Full);
    Ok(picture.map_err(|error| error.to_string())?.image)
}

/// Returns one of nine cameras on an arc around the still life, every second one a little higher.
fn around_table(index: u8) -> Result<PosedCamera, String> {
    let camera = still_life_camera(RENDERED.0, RENDERED.1);
    let middle = Point3::new(0.035, -0.13, 0.05);
    let angle = (f64::from(index) - 4.0) * 8.0_f64.to_radians();
    let height = if index.is_multiple_of(2) {
        -0.43
    } else {
        -0.56
    };
    let radius = 1.38;
    let center = Point3::new(
        middle.x + radius * libm::sin(angle),
        height,
        middle.z - radius * libm::cos(angle),
    );
    let cam_from_world = look_at(&center, &middle, &Vector3::new(0.0, -1.0, 0.0))
        .map_err(|error| error.to_string())?;
    Ok(PosedCamera {
        cam_from_world,
        ..camera
    })
}

fn is_upright(sample: Sample, index: u8) -> bool {
    sample == Sample::Upright && index % 2 == 1
}

/// Returns a camera around the table; every second one is in portrait format.
fn held(index: u8) -> Result<PosedCamera, String> {
    let camera = around_table(index + 2)?;
    let (width, height) = match is_upright(Sample::Upright, index) {
        true => (RENDERED.1, RENDERED.0),
        false => RENDERED,
    };
    let intrinsics = Intrinsics::centered(camera.camera.intrinsics.fu_px(), width, height);
    Ok(PosedCamera {
        camera: Camera::pinhole(
            intrinsics.map_err(|error| error.to_string())?,
            width,
            height,
        ),
        ..camera
    })
}

/// Size of the picture on the wall, pixels.
const PRINTED: (u32, u32) = (960, 720);

/// Renders a picture on a wall from positions on an arc around its middle. The world frame is the
/// picture's: a camera at the origin sees exactly the picture at a distance of 1.
fn hung(picture: &RgbImage, index: u8) -> epipole::Result<RgbImage> {
    let print = still_life_camera(PRINTED.0, PRINTED.1);
    let k = still_life_camera(RENDERED.0, RENDERED.1).camera.intrinsics;
    let angle = (f64::from(index) - 1.5) * 13.0_f64.to_radians();
    let center = Vector3::new(0.7 * libm::sin(angle), 0.0, 1.0 - 0.7 * libm::cos(angle));
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
    // A point p of the poster has depth 1, so p - c = (I - c nᵀ) p.
    let seen = Matrix3::identity() - center * Vector3::z().transpose();
    let view_from_print = k.matrix()
        * turn.to_rotation_matrix().matrix()
        * seen
        * print.camera.intrinsics.inverse_matrix();
    let map = PixelMap::from_homography(RENDERED.0, RENDERED.1, &view_from_print, &mut ())?;
    map.warp(picture, &mut ())
}

/// Draws a texture of random patches, unrelated to the other scene.
fn carpet() -> RgbImage {
    let mut random = Random::new(3);
    let mut image = RgbImage::from_pixel(PRINTED.0, PRINTED.1, image::Rgb([120, 110, 100]));
    for _ in 0..900 {
        let side = |random: &mut Random| 4 + random.below(40) as u32;
        let (width, height) = (side(&mut random), side(&mut random));
        let left = random.below((PRINTED.0 - width) as usize) as u32;
        let top = random.below((PRINTED.1 - height) as usize) as u32;
        let color = image::Rgb([0; 3].map(|_: u8| 30 + random.below(200) as u8));
        for v in top..top + height {
            for u in left..left + width {
                image.put_pixel(u, v, color);
            }
        }
    }
    image
}

/// Returns the camera of the still life, rotated about its center.
fn turned(index: u8) -> PosedCamera {
    let camera = still_life_camera(RENDERED.0, RENDERED.1);
    let angle = (f64::from(index) - 1.5) * 5.0_f64.to_radians();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
    PosedCamera {
        cam_from_world: Isometry3::from_parts(Translation3::identity(), turn)
            * camera.cam_from_world,
        ..camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sample_has_as_many_photographs_as_it_says() {
        assert_eq!(usize::from(Sample::Board.len()), board_sample::COUNT);
        assert!(render(Sample::Board, Sample::Board.len()).is_err());
    }
}
