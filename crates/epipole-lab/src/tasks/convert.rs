//! Settings and errors of the core, from and to those of the Lab.

use crate::project::{BoardOptions, BoardPattern};
#[cfg(any(feature = "vision", feature = "files"))]
use crate::project::{LensCamera, LensModel};
use epipole::calibration::{Board, Pattern};
#[cfg(any(feature = "vision", feature = "files"))]
use epipole::camera::{Camera, LensKind};
#[cfg(feature = "files")]
use epipole::camera::{Intrinsics, Lens};

/// Why the core gave no answer, in words.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn sentence(error: epipole::Error) -> String {
    match error {
        epipole::Error::Canceled => "stopped".to_owned(),
        other => other.to_string(),
    }
}

/// Why a file is no photograph, in words that follow "cannot be read: ".
#[cfg(feature = "files")]
pub(super) fn unreadable(error: epipole_io::Error) -> String {
    match error {
        epipole_io::Error::BadImage { why } => why,
        other => other.to_string(),
    }
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

/// The model of a lens as the core has it.
#[cfg(any(feature = "vision", feature = "files"))]
pub(super) fn lens_kind(model: LensModel) -> LensKind {
    match model {
        LensModel::Brown => LensKind::Brown,
        LensModel::Rational => LensKind::Rational,
        LensModel::Fisheye => LensKind::Fisheye,
        LensModel::Division => LensKind::Division,
    }
}

/// A calibrated camera.
///
/// # Errors
/// A sentence, if its numbers are no camera's.
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

/// The camera as the Lab has it; the opposite of `core_lens_camera`.
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
