//! Calibration of a camera from photographs of boards.

use super::board::BoardOf;
#[cfg(feature = "vision")]
use super::task::{Monitor, Progress, Run};
use super::task::{Query, Task};
use crate::project::{CalibrationOptions, InputPhoto, Key, LensCamera, Project, Step};
use serde::{Deserialize, Serialize};

/// Calibration results for one photograph.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ViewFound {
    /// Root mean square of its reprojection errors, pixels.
    pub rms_px: f64,
    /// Number of visible marks.
    pub num_marks: u32,
    /// Rotation of camera from board, as a quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// Translation of camera from board, meters.
    pub translation: [f64; 3],
}

/// A calibrated camera with its uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// The camera.
    pub camera: LensCamera,
    /// Root mean square of all reprojection errors, pixels.
    pub rms_px: f64,
    /// One standard deviation of focal lengths and principal point, pixels.
    pub std_dev_k: [f64; 4],
    /// One standard deviation of each distortion parameter.
    pub std_dev_lens: Vec<f64>,
    /// Fraction of the image covered by boards.
    pub coverage: f64,
    /// Results of each photograph given.
    pub views: Vec<Option<ViewFound>>,
    /// Reasons why it is less accurate than the errors suggest: index of the photograph concerned,
    /// if any, and a message.
    pub warnings: Vec<(Option<u32>, String)>,
}

/// Calibrates a camera.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibrate {
    /// The board and the lens.
    pub options: CalibrationOptions,
    /// Width and height of all photographs, pixels.
    pub size: (u32, u32),
    /// Marks of each photograph, as [`BoardFound::marks`](super::BoardFound::marks); empty if the
    /// board was not found.
    pub views: Vec<Vec<Option<[f64; 2]>>>,
}

impl Task for Calibrate {
    type Output = Calibration;
}

/// Query for the camera calibrated from the boards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CalibrationOfBoards;

impl Query for CalibrationOfBoards {
    type Task = Calibrate;
    const STEP: Step = Step::Calibrate;

    fn all(_project: &Project) -> Vec<Self> {
        vec![Self]
    }

    /// Returns a key once all photographs are searched, if two boards were found.
    fn key(self, project: &Project) -> Option<Key> {
        let views = project.board_views()?;
        if views.iter().filter(|marks| !marks.is_empty()).count() < 2 {
            return None;
        }
        let boards = project.boards_taking_part();
        let keys = boards
            .iter()
            .map(|photo| Some(BoardOf(photo.id).key(project)?.0));
        let keys: Vec<u64> = keys.collect::<Option<_>>()?;
        Some(Key::of(&(
            "calibration",
            keys,
            project.document.settings.calibration,
        )))
    }

    fn is_ready(self, _project: &Project, _is_imported: bool) -> bool {
        true
    }

    fn priority(self, project: &Project) -> u8 {
        match project.view.step {
            Step::Calibrate => 1,
            _ => 91,
        }
    }

    fn task(self, project: &Project) -> Option<Calibrate> {
        Some(Calibrate {
            options: project.document.settings.calibration,
            size: project.size_of_boards()?,
            views: (project.board_views()?.into_iter())
                .map(<[_]>::to_vec)
                .collect(),
        })
    }

    fn label(self, _project: &Project) -> String {
        "Calibrating".to_owned()
    }
}

impl Project {
    /// Returns the marks of each photograph that takes part, empty if the board was not found or
    /// the size differs; `None` until all are searched.
    fn board_views(&self) -> Option<Vec<&[Option<[f64; 2]>]>> {
        let size = self.size_of_boards();
        let marks = |photo: &&InputPhoto| {
            let found = self.get(BoardOf(photo.id))?;
            let fits = Some(found.picture.full_size) == size;
            Some(if fits { &found.marks[..] } else { &[] })
        };
        self.boards_taking_part().iter().map(marks).collect()
    }

    /// Returns the index of a photograph among those of the calibration.
    pub fn place_of_board(&self, photo: &InputPhoto) -> Option<usize> {
        let boards = self.boards_taking_part();
        boards.iter().position(|other| other.id == photo.id)
    }
}

#[cfg(feature = "vision")]
impl Run for Calibrate {
    /// Calibrates just as `epipole calibrate` does.
    fn run(self, monitor: Monitor<'_>) -> Result<Calibration, String> {
        use super::convert::{core_board, lab_lens_camera, lens_kind};
        use epipole::calibration::{BoardView, calibrate};
        use epipole::progress::Status;
        use nalgebra::Point2;
        let Self {
            options,
            size,
            views,
        } = self;
        let board = core_board(&options.board, options.square_m)?;
        let view = |marks: &Vec<Option<[f64; 2]>>| {
            (!marks.is_empty()).then(|| BoardView {
                pixels: marks.iter().map(|mark| mark.map(Point2::from)).collect(),
            })
        };
        let views: Vec<_> = views.iter().map(view).collect();
        let how =
            epipole::calibration::CalibrationOptions::default().with_lens(lens_kind(options.lens));
        let mut watch =
            |status: Status| monitor(Progress::Share(status.fraction, status.stage.words()));
        let found = calibrate(&board, &views, size, &how, &mut watch);
        let found = found.map_err(|error| match error {
        epipole::Error::Canceled => "stopped".to_owned(),
        epipole::Error::TooFew { .. } | epipole::Error::Degenerate { .. } => format!(
            "{error}. Photograph the board, large in the picture, from ten to twenty sides, turned by 30° to 45° \
             about several axes"
        ),
        other => other.to_string(),
    })?;
        Ok(Calibration {
            camera: lab_lens_camera(&found.camera),
            rms_px: found.rms_px,
            std_dev_k: found.std_dev_k,
            std_dev_lens: found.std_dev_lens,
            coverage: found.coverage,
            views: (found.views.iter())
                .map(|v| v.as_ref().map(plain))
                .collect(),
            warnings: found.warnings.iter().map(warning).collect(),
        })
    }
}

#[cfg(feature = "vision")]
fn plain(view: &epipole::calibration::CalibratedView) -> ViewFound {
    ViewFound {
        rms_px: view.rms_px,
        num_marks: view.num_marks as u32,
        rotation: view.cam_from_board.rotation.coords.into(),
        translation: view.cam_from_board.translation.vector.into(),
    }
}

#[cfg(feature = "vision")]
fn warning(warning: &epipole::calibration::CalibrationWarning) -> (Option<u32>, String) {
    use epipole::calibration::CalibrationWarning;
    let place = match warning {
        CalibrationWarning::BadView { number, .. } => number.checked_sub(1).map(|n| n as u32),
        _ => None,
    };
    (place, warning.to_string())
}
