//! A camera from boards.

use super::convert::core_board;
use super::{Calibration, CalibrationOptions, LensCamera, LensModel, Progress, Told, ViewFound};
use epipole::calibration::{BoardView, CalibratedView, CalibrationWarning, calibrate};
use epipole::camera::LensKind;
use epipole::progress::Status;
use nalgebra::Point2;

/// Calibrates just as `epipole calibrate` does.
///
/// * `views`: the marks of each photograph, as [`BoardFound::marks`](super::BoardFound::marks)
///
/// # Errors
/// A sentence that says what to do: too few boards, or parallel ones; and if `progress` wants no
/// more.
pub(super) fn calibration(
    options: &CalibrationOptions,
    size: (u32, u32),
    views: &[Vec<Option<[f64; 2]>>],
    progress: Progress<'_>,
) -> Result<Calibration, String> {
    let board = core_board(&options.board, options.square_m)?;
    let view = |marks: &Vec<Option<[f64; 2]>>| {
        (!marks.is_empty()).then(|| BoardView {
            pixels: marks.iter().map(|mark| mark.map(Point2::from)).collect(),
        })
    };
    let views: Vec<_> = views.iter().map(view).collect();
    let how = epipole::calibration::CalibrationOptions::default().with_lens(match options.lens {
        LensModel::Brown => LensKind::Brown,
        LensModel::Rational => LensKind::Rational,
        LensModel::Fisheye => LensKind::Fisheye,
    });
    let mut watch = |status: Status| progress(Told::Share(status.share, status.stage.words()));
    let found = calibrate(&board, &views, size, &how, &mut watch);
    let found = found.map_err(|error| match error {
        epipole::Error::Canceled => "stopped".to_owned(),
        epipole::Error::TooFew { .. } | epipole::Error::Degenerate { .. } => format!(
            "{error}. Photograph the board, large in the picture, from ten to twenty sides, turned by 30° to 45° \
             about several axes"
        ),
        other => other.to_string(),
    })?;
    let k = found.camera.intrinsics;
    let center = k.principal_point();
    Ok(Calibration {
        camera: LensCamera {
            size,
            k: [k.fu_px(), k.fv_px(), center.x, center.y],
            lens: options.lens,
            coefficients: found.camera.lens.coefficients(),
        },
        rms_px: found.rms_px,
        std_dev_k: found.std_dev_k,
        std_dev_lens: found.std_dev_lens,
        coverage: found.coverage,
        views: (found.views.iter())
            .map(|v| v.as_ref().map(plain))
            .collect(),
        warnings: found.warnings.iter().map(told).collect(),
    })
}

fn plain(view: &CalibratedView) -> ViewFound {
    ViewFound {
        rms_px: view.rms_px,
        num_marks: view.num_marks as u32,
        rotation: view.cam_from_board.rotation.coords.into(),
        translation: view.cam_from_board.translation.vector.into(),
    }
}

fn told(warning: &CalibrationWarning) -> (Option<u32>, String) {
    let place = match warning {
        CalibrationWarning::BadView { number, .. } => number.checked_sub(1).map(|n| n as u32),
        _ => None,
    };
    (place, warning.to_string())
}
