//! Calibration of cameras and rigs.

use crate::argument::{Argument, Vectors, rows};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::{NoOptions, Options};
use crate::output::{Numbers, Text, records, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::calibration::{
    self, Board, BoardView, CalibratedView, CalibrationOptions, CalibrationWarning, RigCalibration,
};
use epipole::camera::{Camera, Intrinsics, RigidTransform};
use epipole::nalgebra::{Matrix3, Point2};

records! {
    /// Calibration result of one view.
    CalibratedView as CalibratedView {
        /// Pose of the board, meters.
        cam_from_board: RigidTransform,
        /// Root mean square of its reprojection errors, pixels.
        rms_px: f64,
        /// Number of visible marks.
        num_marks: usize,
    }

    /// Two cameras mounted on a rig.
    RigCalibration as RigCalibration {
        /// Motion from the left to the right camera, meters.
        right_from_left: RigidTransform,
        /// Distance between the cameras, meters.
        baseline_m: f64,
        /// Root mean square of the reprojection errors in both cameras, pixels.
        rms_px: f64,
        /// Standard deviation of the rotation about the axes of the right camera, radians.
        std_dev_rotation_rad: [f64; 3],
        /// Standard deviation of the translation, meters.
        std_dev_translation_m: [f64; 3],
        /// Root mean square of each pair, pixels; null where not both cameras see the board.
        pairs_rms_px: Vec<Option<f64>>,
    }
}

structs! {
    /// Calibrated camera and its uncertainty.
    struct Calibration as Calibration {
        /// Camera.
        camera: Camera,
        /// Root mean square of all reprojection errors: distances, pixels.
        rms_px: f64,
        /// Standard deviation of fu, fv, cu, cv, pixels.
        std_dev_k: [f64; 4],
        /// Standard deviation of each coefficient of the lens.
        std_dev_lens: Numbers,
        /// Share of the area of the image inside the marks of some view, 0 to 1.
        coverage: f64,
        /// Result of each view; null where none was given.
        views: Vec<Option<CalibratedView>>,
        /// Causes of uncertainty that the errors do not show.
        warnings: Vec<Warning>,
    }

    /// Cause of uncertainty that the errors of a calibration do not show.
    struct Warning as CalibrationWarning {
        /// Kind: parallel, uncertainFocal, lowCoverage, badView, or other.
        kind: Text,
        /// Cause as a sentence.
        message: Text,
    }
}

impl From<CalibrationWarning> for Warning {
    fn from(warning: CalibrationWarning) -> Self {
        let kind = match warning {
            CalibrationWarning::Parallel { .. } => "parallel",
            CalibrationWarning::UncertainFocal { .. } => "uncertainFocal",
            CalibrationWarning::LowCoverage { .. } => "lowCoverage",
            CalibrationWarning::BadView { .. } => "badView",
            _ => "other",
        };
        Self {
            kind: Text(kind.to_owned()),
            message: Text(warning.to_string()),
        }
    }
}

/// Pixels of the marks in one photo, NaN for hidden ones.
struct View(BoardView);

impl Argument for View {
    fn typescript(types: &mut Types) -> String {
        Vectors::<2>::typescript(types)
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        let numbers = rows(
            name,
            value,
            2,
            "numbers, 2 for each mark, or an array of pixels",
        )?;
        if numbers.iter().any(|number| number.is_infinite()) {
            return Err(Fault::of_range(format!("{name} contains infinity")));
        }
        let pixel = |p: &[f64]| (!p[0].is_nan() && !p[1].is_nan()).then(|| Point2::new(p[0], p[1]));
        let pixels = numbers.chunks_exact(2).map(pixel).collect();
        Ok(Self(BoardView { pixels }))
    }
}

fn views(views: Vec<Option<View>>) -> Vec<Option<BoardView>> {
    views.into_iter().map(|view| Some(view?.0)).collect()
}

functions! {
    /// Intrinsics, lens, and poses of a board with the least squared reprojection errors in photos
    /// of `width` x `height` pixels. A view has the `pixels` of `findBoard`; null for a photo
    /// without a board.
    fn calibrate(
        board: Board, views: Vec<Option<View>>, width: u32, height: u32,
        options: Options<CalibrationOptions>; monitor
    ) -> Calibration {
        let (views, size) = (self::views(views), (width, height));
        let found = calibration::calibrate(&board, &views, size, &options.0, monitor)?;
        Calibration {
            camera: found.camera,
            rms_px: found.rms_px,
            std_dev_k: found.std_dev_k,
            std_dev_lens: Numbers(found.std_dev_lens),
            coverage: found.coverage,
            views: found.views,
            warnings: found.warnings.into_iter().map(Warning::from).collect(),
        }
    }

    /// Relative pose of two calibrated cameras from views of a board at the same moments. Null for
    /// a photo without a board.
    fn calibrate_rig(
        board: Board, left_camera: Camera, right_camera: Camera, left: Vec<Option<View>>,
        right: Vec<Option<View>>, options: NoOptions; monitor
    ) -> RigCalibration {
        let NoOptions = options;
        let (left, right) = (views(left), views(right));
        calibration::calibrate_rig(&board, &[left_camera, right_camera], &left, &right, monitor)?
    }

    /// Intrinsics of a camera without distortion from homographies of planes to its photos, by
    /// Zhang's closed form.
    fn intrinsics_from_planes(pixels_from_plane: Vec<Matrix3<f64>>) -> Intrinsics {
        calibration::intrinsics_from_planes(&pixels_from_plane)?
    }
}
