//! Conversion of settings and errors between the core and the Lab.

use crate::project::{BoardOptions, BoardPattern};
#[cfg(any(feature = "vision", feature = "files"))]
use crate::project::{LensCamera, LensModel};
use epipole::calibration::{Board, Pattern};
#[cfg(any(feature = "vision", feature = "files"))]
use epipole::camera::{Camera, LensKind};
#[cfg(feature = "files")]
use epipole::camera::{Intrinsics, Lens};

/// Returns the message of a core error.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn sentence(error: epipole::Error) -> String {
    match error {
        epipole::Error::Canceled => "stopped".to_owned(),
        other => other.to_string(),
    }
}

/// Returns the reason why a file is not a photograph, to follow "cannot be read: ".
#[cfg(feature = "files")]
pub(super) fn unreadable(error: epipole_io::Error) -> String {
    match error {
        epipole_io::Error::BadImage { why } => why,
        other => other.to_string(),
    }
}

/// Converts the board.
///
/// # Errors
/// A message, if it is invalid.
pub(super) fn core_board(options: &BoardOptions, square_m: f64) -> Result<Board, String> {
    let pattern = match options.pattern {
        BoardPattern::Chessboard => Pattern::Chessboard,
        BoardPattern::Circles => Pattern::AsymmetricCircles,
    };
    let (columns, rows) = (options.columns as usize, options.rows as usize);
    Board::new(pattern, columns, rows, square_m).map_err(|error| error.to_string())
}

/// Converts the distortion model.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn lens_kind(model: LensModel) -> LensKind {
    match model {
        LensModel::Brown => LensKind::Brown,
        LensModel::Rational => LensKind::Rational,
        LensModel::Fisheye => LensKind::Fisheye,
        LensModel::Division => LensKind::Division,
    }
}

/// Converts a calibrated camera to a type of the core.
///
/// # Errors
/// A message, if its numbers are invalid.
#[cfg(feature = "files")]
pub(super) fn core_lens_camera(camera: &LensCamera) -> Result<Camera, String> {
    let [fu, fv, cu, cv] = camera.k;
    let sentence = |error: epipole::Error| error.to_string();
    Ok(Camera {
        intrinsics: Intrinsics::new(fu, fv, cu, cv).map_err(sentence)?,
        lens: Lens::from_coefficients(lens_kind(camera.lens), &camera.coefficients)
            .map_err(sentence)?,
        width: camera.size.0,
        height: camera.size.1,
    })
}

/// Converts a calibrated camera from the core; inverse of `core_lens_camera`.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn lab_lens_camera(camera: &Camera) -> LensCamera {
    let lens = match camera.lens.kind() {
        LensKind::Brown => LensModel::Brown,
        LensKind::Rational => LensModel::Rational,
        LensKind::Fisheye => LensModel::Fisheye,
        LensKind::Division => LensModel::Division,
    };
    let (k, center) = (camera.intrinsics, camera.intrinsics.principal_point());
    LensCamera {
        size: (camera.width, camera.height),
        k: [k.fu_px(), k.fv_px(), center.x, center.y],
        lens,
        coefficients: camera.lens.coefficients().to_vec(),
    }
}
