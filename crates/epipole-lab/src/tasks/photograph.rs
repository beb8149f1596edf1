//! Photographs: decoded or rendered, upright, reduced.

use super::{Photograph, Sample, Source};
use epipole::camera::{Camera, look_at};
use epipole::imaging::{DecodeOptions, decode_rgb};
use epipole::synthetic::{Sampling, Scene, still_life_camera};
use image::RgbImage;
use image::imageops::{FilterType, resize};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

/// Width and height of a rendered photograph, pixels.
const RENDERED: (u32, u32) = (480, 360);

/// Decodes or renders.
///
/// # Errors
/// A sentence, if a file is none that can be read.
pub(super) fn photograph(source: &Source, max_pixels: u32) -> Result<Photograph, String> {
    match source {
        Source::File(bytes) => decode(bytes, max_pixels),
        Source::Rendered(sample, index) => render(*sample, *index),
    }
}

fn decode(bytes: &[u8], max_pixels: u32) -> Result<Photograph, String> {
    let options = DecodeOptions::default();
    let decoded = decode_rgb(bytes, &options).map_err(|error| error.to_string())?;
    let as_stored = DecodeOptions {
        apply_orientation: false,
        ..options
    };
    let full_size = decoded.image.dimensions();
    let reduced = reduced_size(full_size, max_pixels);
    let is_turned = || decode_rgb(bytes, &as_stored).is_ok_and(|raw| raw.image != decoded.image);
    let as_given = reduced == full_size && !is_turned();
    let image = match reduced == full_size {
        true => decoded.image,
        false => resize(&decoded.image, reduced.0, reduced.1, FilterType::Triangle),
    };
    let factor = f64::from(reduced.0) / f64::from(full_size.0.max(1));
    Ok(Photograph {
        width: reduced.0,
        height: reduced.1,
        rgb: image.into_raw().into(),
        focal_px: decoded.focal_px.map(|focal_px| focal_px * factor),
        full_size,
        as_given,
    })
}

/// The size with the same shape that has at most so many pixels.
fn reduced_size((width, height): (u32, u32), max_pixels: u32) -> (u32, u32) {
    let pixels = f64::from(width) * f64::from(height);
    if pixels <= f64::from(max_pixels) {
        return (width, height);
    }
    let factor = libm::sqrt(f64::from(max_pixels.max(1)) / pixels);
    let side = |side: u32| ((f64::from(side) * factor).floor() as u32).max(1);
    (side(width), side(height))
}

fn render(sample: Sample, index: u8) -> Result<Photograph, String> {
    if index >= sample.len() {
        return Err("the sample has no such photograph".to_owned());
    }
    let (width, height) = RENDERED;
    let camera = match sample {
        Sample::Turned => turned(index),
        Sample::Twice => around_table(4)?,
        Sample::Table | Sample::Alone => around_table(index)?,
    };
    let picture = Scene::still_life()
        .render(&camera, width, height, Sampling::Full)
        .map_err(|error| error.to_string())?;
    let image: RgbImage = picture.image;
    Ok(Photograph {
        width,
        height,
        rgb: image.into_raw().into(),
        focal_px: Some(camera.intrinsics.fu_px()),
        full_size: RENDERED,
        as_given: true,
    })
}

/// Nine places on an arc around the still life, every other one a little higher.
fn around_table(index: u8) -> Result<Camera, String> {
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
    Ok(Camera {
        cam_from_world,
        ..camera
    })
}

/// The camera of the still life, turned about its own center.
fn turned(index: u8) -> Camera {
    let camera = still_life_camera(RENDERED.0, RENDERED.1);
    let angle = (f64::from(index) - 1.5) * 5.0_f64.to_radians();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
    Camera {
        cam_from_world: Isometry3::from_parts(Translation3::identity(), turn)
            * camera.cam_from_world,
        ..camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_photographs_keep_their_shape() {
        assert_eq!(reduced_size((4000, 3000), 3_000_000), (2000, 1500));
        assert_eq!(reduced_size((640, 480), 3_000_000), (640, 480));
        assert_eq!(reduced_size((1_000_000, 1), 100), (10_000, 1));
    }

    #[test]
    fn files_that_are_none_are_refused_in_words() {
        let refused = decode(b"no picture", 1000).expect_err("that is no picture");
        assert!(refused.len() > 10, "{refused}");
    }
}
