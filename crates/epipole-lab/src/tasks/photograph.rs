//! Photographs: decoded or rendered, upright, without the distortion of a lens that is known, reduced.

use super::board_sample;
use super::convert::{core_lens_camera, to_image};
use super::{LensCamera, Photograph, Sample, Source};
use epipole::calibration::{Keep, Undistortion};
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
/// * `camera`: files of its size are redrawn as it would show them without its distortion
///
/// # Errors
/// A sentence, if a file is none that can be read, or no flat picture can show what the camera sees.
pub(super) fn photograph(
    source: &Source,
    max_pixels: u32,
    camera: Option<&LensCamera>,
) -> Result<Photograph, String> {
    let Source::File(bytes) = source else {
        return read(source);
    };
    let mut photograph = read(source)?;
    if let Some(camera) = camera.filter(|camera| camera.size == photograph.full_size) {
        photograph = undistorted(&photograph, camera)?;
    }
    photograph = reduced(photograph, max_pixels)?;
    // Only what was not changed here needs to be decoded once more.
    photograph.as_given = photograph.as_given && shows(bytes, &photograph);
    Ok(photograph)
}

/// The photograph of full size, upright.
///
/// # Errors
/// A sentence, if a file is none that can be read.
pub(super) fn read(source: &Source) -> Result<Photograph, String> {
    match source {
        Source::File(bytes) => decode(bytes),
        Source::Rendered(sample, index) => render(*sample, *index),
    }
}

/// Whether a file shows these pixels without being turned.
fn shows(bytes: &[u8], photograph: &Photograph) -> bool {
    let as_stored = DecodeOptions {
        apply_orientation: false,
        ..DecodeOptions::default()
    };
    let stored = decode_rgb(bytes, &as_stored);
    stored.is_ok_and(|stored| {
        stored.image.dimensions() == (photograph.width, photograph.height)
            && stored.image.as_raw()[..] == photograph.rgb[..]
    })
}

/// Just as `epipole undistort` does.
fn undistorted(photograph: &Photograph, camera: &LensCamera) -> Result<Photograph, String> {
    let flat = Undistortion::new(&core_lens_camera(camera)?, Keep::Valid)
        .map_err(|error| format!("its lens cannot be undone: {error}"))?;
    let center = flat.intrinsics.principal_point();
    let image = flat.map.warp_rgb(&to_image(photograph)?);
    Ok(Photograph {
        rgb: image.into_raw().into(),
        k: Some([
            flat.intrinsics.fu_px(),
            flat.intrinsics.fv_px(),
            center.x,
            center.y,
        ]),
        as_given: false,
        ..*photograph
    })
}

/// The same with at most so many pixels.
///
/// # Errors
/// A sentence, if it did not arrive whole.
pub(super) fn reduced(photograph: Photograph, max_pixels: u32) -> Result<Photograph, String> {
    let before = (photograph.width, photograph.height);
    let after = reduced_size(before, max_pixels);
    if after == before {
        return Ok(photograph);
    }
    let image = resize(
        &to_image(&photograph)?,
        after.0,
        after.1,
        FilterType::Triangle,
    );
    let share = |after: u32, before: u32| f64::from(after) / f64::from(before.max(1));
    let (across, down) = (share(after.0, before.0), share(after.1, before.1));
    // Pixel centers are whole numbers, so a photograph begins half a pixel before the first.
    let k = |[fu, fv, cu, cv]: [f64; 4]| {
        [
            fu * across,
            fv * down,
            (cu + 0.5) * across - 0.5,
            (cv + 0.5) * down - 0.5,
        ]
    };
    Ok(Photograph {
        width: after.0,
        height: after.1,
        rgb: image.into_raw().into(),
        focal_px: photograph.focal_px.map(|focal_px| focal_px * across),
        k: photograph.k.map(k),
        as_given: false,
        ..photograph
    })
}

fn decode(bytes: &[u8]) -> Result<Photograph, String> {
    let decoded =
        decode_rgb(bytes, &DecodeOptions::default()).map_err(|error| error.to_string())?;
    let (width, height) = decoded.image.dimensions();
    Ok(Photograph {
        width,
        height,
        rgb: decoded.image.into_raw().into(),
        focal_px: decoded.focal_px,
        k: None,
        full_size: (width, height),
        as_given: true,
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
    let sentence = |error: epipole::Error| error.to_string();
    let camera = match sample {
        Sample::Board => {
            let image = board_sample::photograph(index).map_err(sentence)?;
            let image = image.ok_or("the sample has no such photograph")?;
            return Ok(rendered(image, None));
        }
        Sample::Turned => turned(index),
        Sample::Twice => around_table(4)?,
        Sample::Table | Sample::Alone => around_table(index)?,
    };
    let picture = Scene::still_life()
        .render(&camera, width, height, Sampling::Full)
        .map_err(sentence)?;
    Ok(rendered(picture.image, Some(camera.intrinsics.fu_px())))
}

fn rendered(image: RgbImage, focal_px: Option<f64>) -> Photograph {
    let (width, height) = image.dimensions();
    Photograph {
        width,
        height,
        rgb: image.into_raw().into(),
        focal_px,
        k: None,
        full_size: (width, height),
        as_given: true,
    }
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
    fn the_sample_has_as_many_photographs_as_it_says() {
        assert_eq!(usize::from(Sample::Board.len()), board_sample::COUNT);
        assert!(render(Sample::Board, Sample::Board.len()).is_err());
    }

    #[test]
    fn files_that_are_none_are_refused_in_words() {
        let refused = decode(b"no picture").expect_err("that is no picture");
        assert!(refused.len() > 10, "{refused}");
    }
}
