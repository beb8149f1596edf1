//! The way between plain messages and the core.

use super::camera_found::CameraFound;
#[cfg(feature = "vision")]
use super::photograph::Calibrated;
use super::photograph::Photograph;
use super::reconstruction::ImagePoints;
#[cfg(feature = "files")]
use super::reconstruction::{Component, PointFound};
use crate::project::{BoardOptions, BoardPattern};
#[cfg(feature = "files")]
use crate::project::{LensCamera, LensModel};
use epipole::calibration::{Board, Pattern};
#[cfg(feature = "files")]
use epipole::camera::{Camera, Lens, LensKind};
use epipole::camera::{Intrinsics, PosedCamera, RigidTransform};
use epipole::sfm::SfmImage;
#[cfg(feature = "files")]
use epipole::sfm::{Reconstruction, ScenePoint, TrackElement};
use image::RgbImage;
#[cfg(feature = "files")]
use nalgebra::Point3;
use nalgebra::{Point2, Quaternion, Translation3, UnitQuaternion};

/// Why the core gave no answer, in words.
#[cfg(feature = "vision")]
pub(super) fn sentence(error: epipole::Error) -> String {
    match error {
        epipole::Error::Canceled => "stopped".to_owned(),
        other => other.to_string(),
    }
}

/// Why a file is no photograph, in words that follow "cannot be read: ".
#[cfg(feature = "files")]
pub(super) fn unreadable(error: epipole::Error) -> String {
    match error {
        epipole::Error::BadImage { why } => why,
        other => other.to_string(),
    }
}

/// The pixels as an image.
pub(super) fn to_image(photograph: &Photograph) -> Result<RgbImage, String> {
    RgbImage::from_raw(
        photograph.width,
        photograph.height,
        photograph.rgb.0.to_vec(),
    )
    .ok_or_else(|| "the photograph did not arrive whole".to_owned())
}

#[cfg(feature = "vision")]
/// The intrinsics of a photograph.
pub(super) fn intrinsics(camera: &Calibrated) -> Result<Intrinsics, String> {
    let [fu, fv, cu, cv] = camera.k;
    Intrinsics::new(fu, fv, cu, cv).map_err(|error| error.to_string())
}

/// The board.
///
/// # Errors
/// A sentence, if it is none.
pub(super) fn core_board(options: &BoardOptions, square_m: f64) -> Result<Board, String> {
    let pattern = match options.pattern {
        BoardPattern::Chessboard => Pattern::Chessboard,
        BoardPattern::Circles => Pattern::AsymmetricCircles,
    };
    let (columns, rows) = (options.columns as usize, options.rows as usize);
    Board::new(pattern, columns, rows, square_m).map_err(|error| error.to_string())
}

/// A calibrated camera.
///
/// # Errors
/// A sentence, if its numbers are no camera's.
#[cfg(feature = "files")]
pub(super) fn core_lens_camera(camera: &LensCamera) -> Result<Camera, String> {
    let kind = match camera.lens {
        LensModel::Brown => LensKind::Brown,
        LensModel::Rational => LensKind::Rational,
        LensModel::Fisheye => LensKind::Fisheye,
    };
    let [fu, fv, cu, cv] = camera.k;
    let sentence = |error: epipole::Error| error.to_string();
    Ok(Camera {
        intrinsics: Intrinsics::new(fu, fv, cu, cv).map_err(sentence)?,
        lens: Lens::from_coefficients(kind, &camera.coefficients).map_err(sentence)?,
        width: camera.size.0,
        height: camera.size.1,
    })
}

/// The photographs as the core has them.
pub(super) fn sfm_images(images: &[ImagePoints]) -> Vec<SfmImage> {
    let plain = |image: &ImagePoints| SfmImage {
        name: image.name.clone(),
        width: image.camera.width,
        height: image.camera.height,
        keypoints: image
            .points
            .iter()
            .map(|p| Point2::new(p[0], p[1]))
            .collect(),
        colors: image.colors.clone(),
        ..SfmImage::default()
    };
    images.iter().map(plain).collect()
}

/// A camera as the core has it, the same to the last bit.
///
/// # Errors
/// A sentence, if its numbers are no camera's.
pub(super) fn core_camera(
    camera: &CameraFound,
    (width, height): (u32, u32),
    lens: Lens,
) -> Result<PosedCamera, String> {
    let [fu, fv, cu, cv] = camera.intrinsics;
    let [i, j, k, w] = camera.rotation;
    let [x, y, z] = camera.translation;
    Ok(PosedCamera {
        camera: Camera {
            width,
            height,
            intrinsics: Intrinsics::new(fu, fv, cu, cv).map_err(|error| error.to_string())?,
            lens,
        },
        cam_from_world: RigidTransform::from_parts(
            Translation3::new(x, y, z),
            UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
        ),
    })
}

#[cfg(feature = "files")]
/// A component as the core has it.
///
/// * `images`: those that it was made of
///
/// # Errors
/// As [`core_camera`].
pub(super) fn core_reconstruction(
    component: &Component,
    images: &[ImagePoints],
) -> Result<Reconstruction, String> {
    let camera = |(camera, image): (&Option<CameraFound>, &ImagePoints)| {
        let size = (image.camera.width, image.camera.height);
        // One lens took them all.
        let camera = (camera.as_ref()).map(|camera| core_camera(camera, size, component.lens));
        camera.transpose()
    };
    let element = |&(image, keypoint): &(u32, u32)| TrackElement { image, keypoint };
    let point = |point: &PointFound| ScenePoint {
        position: Point3::from(point.position),
        color: point.color,
        track: point.track.iter().map(element).collect(),
        error_px: point.error_px,
    };
    Ok(Reconstruction {
        cameras: component
            .cameras
            .iter()
            .zip(images)
            .map(camera)
            .collect::<Result<_, _>>()?,
        points: component.points.iter().map(point).collect(),
        is_placed: false,
    })
}
