//! Calibration of one camera from several views of a board.

#[cfg(test)]
mod tests;

use super::advice::{CalibrationWarning, warnings};
use super::calibrated_view::CalibratedView;
use super::coverage::coverage;
use super::problem::{
    DetectedMark, OF_CAMERA, Problem, SHARED, State, camera_numbers, intrinsics_of, lens_of,
    pose_state, strict,
};
use super::start::{board_pose, plain, starts};
use super::uncertainty::standard_deviations;
use super::{Board, BoardView};
use crate::camera::{Camera, Intrinsics, LensKind, RigidTransform};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use derive_setters::Setters;
use nalgebra::Point3;

pub(super) const WHAT: &str = "a calibration";

/// Options of [`calibrate`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct CalibrationOptions {
    /// Lens model.
    pub lens: LensKind,
    /// Maximum number of refinement steps.
    pub max_iterations: usize,
}

impl Default for CalibrationOptions {
    /// Returns five distortion coefficients and at most 200 steps.
    fn default() -> Self {
        Self {
            lens: LensKind::Brown,
            max_iterations: 200,
        }
    }
}

/// A calibrated camera and its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The camera.
    pub camera: Camera,
    /// Root mean square of all reprojection errors, as distances rather than coordinates, pixels.
    pub rms_px: f64,
    /// Standard deviations of fu, fv, cu, cv, pixels.
    pub std_dev_k: [f64; 4],
    /// Standard deviation of each lens coefficient.
    pub std_dev_lens: Vec<f64>,
    /// Fraction of the image's area, 0 to 1, inside the marks of some view.
    pub coverage: f64,
    /// Result of each input view; `None` for `None`.
    pub views: Vec<Option<CalibratedView>>,
    /// Causes of uncertainty that the errors do not show.
    pub warnings: Vec<CalibrationWarning>,
}

/// Estimates intrinsics, distortion and poses of the board: minimizes the sum of squared
/// reprojection errors.
///
/// * `views`: pixels of the marks, for instance from [`find_board`](super::find_board); `None` for
///   an image without a board, to keep the order of the images
/// * `width`, `height`: size of all images, pixels
///
/// The initial intrinsics are Zhang's closed form, or one with the principal point in the middle,
/// whichever leads to smaller errors; for a fisheye, equidistant lenses of several focal lengths.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two views, and for a view with fewer than four marks;
/// [`Error::Degenerate`] if a view's marks are on one line, and if all boards are parallel or fit
/// no camera; [`Error::SizeMismatch`] for views of another board, [`Error::NotFinite`] for NaN and
/// infinities, [`Error::OutOfRange`] for an image without pixels, [`Error::Canceled`]. The only
/// stage is [`Stage::Calibration`].
///
/// Source: Zhang 2000, "A flexible new technique for camera calibration", §3.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{Board, BoardView, CalibrationOptions, Pattern, calibrate};
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let board = Board::new(Pattern::Chessboard, 7, 5, 0.03)?;
/// let k = Intrinsics::new(600.0, 605.0, 322.0, 238.0)?;
/// let mut views = Vec::new();
/// for rotation_vector in [[0.5, 0.0, 0.1], [-0.5, 0.1, 0.0], [0.0, 0.5, 0.0], [0.1, -0.5, 0.2]] {
///     let pose = RigidTransform::new(Vector3::new(-0.09, -0.06, 0.4), Vector3::from(rotation_vector));
///     let pixel = |mark| {
///         let p = board.mark(mark);
///         k.project(&(pose * Point3::new(p.x, p.y, 0.0))).ok()
///     };
///     views.push(Some(BoardView { pixels: (0..board.num_marks()).map(pixel).collect() }));
/// }
/// let found = calibrate(&board, &views, (640, 480), &CalibrationOptions::default(), &mut ())?;
/// assert!(found.rms_px < 1e-6);
/// assert!((found.camera.intrinsics.fv_px() - 605.0).abs() < 1e-3);
/// # Ok(()) }
/// ```
#[doc(alias = "calibrateCamera")]
pub fn calibrate(
    board: &Board,
    views: &[Option<BoardView>],
    size: (u32, u32),
    options: &CalibrationOptions,
    monitor: &mut dyn Monitor,
) -> Result<Calibration> {
    report(monitor, Stage::Calibration, 0.0)?;
    check(board, views, size)?;
    let found_views: Vec<&BoardView> = views.iter().flatten().collect();
    if found_views.len() < 2 {
        return Err(Error::TooFew {
            what: "a calibration from views of a board",
            needed: 2,
            got: found_views.len(),
        });
    }
    let kind = options.lens;
    let problem = Problem::new(
        marks(board),
        observations(&found_views, 0),
        found_views.len(),
        [kind; 2],
        held(kind),
    );
    let mut best: Option<(f64, State)> = None;
    let mut failure = None;
    let starts = starts(board, &found_views, size, kind)?;
    let num_starts = starts.len() as f32;
    for (index, start) in starts.into_iter().enumerate() {
        let fraction = index as f32 / num_starts;
        let mut step = Part::new(monitor, fraction, fraction).of_stage(Stage::Calibration);
        match refine_from(
            board,
            &found_views,
            start,
            size,
            options,
            &problem,
            &mut step,
        ) {
            Err(Error::Canceled) => return Err(Error::Canceled),
            Ok((cost, state)) => {
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, state));
                }
            }
            Err(error) => failure = Some(error),
        }
    }
    let Some((_, state)) = best else {
        return Err(failure.unwrap_or(Error::Degenerate {
            what: WHAT,
            why: "the views of the board fit no camera",
        }));
    };
    let numbers = state.cameras[0];
    let camera = Camera {
        intrinsics: intrinsics_of(&numbers)?,
        lens: lens_of(kind, &numbers),
        width: size.0,
        height: size.1,
    };
    let open = Error::Degenerate {
        what: WHAT,
        why: "the boards are parallel, or so small in the picture that any focal length fits them; tilt the board \
              by some 30°, each time another way, and let it fill the picture",
    };
    let deviations = standard_deviations(&problem, &state).ok_or(open.clone())?;
    let of_camera: [f64; OF_CAMERA] = core::array::from_fn(|i| deviations[6 + i]);
    let std_dev_k: [f64; 4] = core::array::from_fn(|i| of_camera[i]);
    let focal_deviation = (std_dev_k[0] / numbers[0]).max(std_dev_k[1] / numbers[1]);
    if focal_deviation > MOST_UNCERTAIN {
        return Err(open);
    }
    let mut used = 0..;
    let calibrated: Vec<Option<CalibratedView>> = views
        .iter()
        .map(|view| {
            let view = view.as_ref()?;
            let place = used.next()?;
            Some(CalibratedView {
                cam_from_board: State::pose(&state.views[place]),
                rms_px: problem.rms_px(&state, |o| o.view == place),
                num_marks: view.num_visible(),
            })
        })
        .collect();
    let coverage = coverage(&found_views, size);
    Ok(Calibration {
        camera,
        rms_px: problem.rms_px(&state, |_| true),
        std_dev_k,
        std_dev_lens: of_camera[4..4 + kind.num_coefficients()].to_vec(),
        coverage,
        warnings: warnings(&calibrated, focal_deviation, coverage),
        views: calibrated,
    })
}

/// Maximum relative standard deviation of the focal length; above, the views do not determine it.
const MOST_UNCERTAIN: f64 = 0.2;

/// Returns the marks in the frame of the board.
pub(super) fn marks(board: &Board) -> Vec<Point3<f64>> {
    let mark = |index| {
        let on_board = board.mark(index);
        Point3::new(on_board.x, on_board.y, 0.0)
    };
    (0..board.num_marks()).map(mark).collect()
}

pub(super) fn observations(views: &[&BoardView], eye: usize) -> Vec<DetectedMark> {
    let of_view = |(view, board_view): (usize, &&BoardView)| {
        let of_mark = move |(mark, pixel)| DetectedMark {
            view,
            mark,
            eye,
            pixel,
        };
        board_view.visible().map(of_mark).collect::<Vec<_>>()
    };
    views.iter().enumerate().flat_map(of_view).collect()
}

/// Returns which parameters are held for a single camera: all but its own.
fn held(kind: LensKind) -> [bool; SHARED] {
    let mut held = [true; SHARED];
    held[6..6 + 4 + kind.num_coefficients()].fill(false);
    held
}

pub(super) fn check(
    board: &Board,
    views: &[Option<BoardView>],
    (width, height): (u32, u32),
) -> Result<()> {
    if width == 0 || height == 0 {
        return Err(Error::OutOfRange {
            what: "the images' size in pixels",
            requirement: "at least 1 × 1",
            value: 0.0,
        });
    }
    for view in views.iter().flatten() {
        view.check(board)?;
        if view.num_visible() < 4 {
            return Err(Error::TooFew {
                what: "a view of a board, for a calibration from its marks,",
                needed: 4,
                got: view.num_visible(),
            });
        }
    }
    Ok(())
}

fn refine_from(
    board: &Board,
    views: &[&BoardView],
    start: Intrinsics,
    size: (u32, u32),
    options: &CalibrationOptions,
    problem: &Problem,
    monitor: &mut dyn Monitor,
) -> Result<(f64, State)> {
    let camera = plain(start, options.lens, size);
    let mut poses = Vec::new();
    for view in views {
        poses.push(pose_state(&board_pose(board, view, &camera)?));
    }
    let numbers = camera_numbers(&camera.intrinsics, &camera.lens);
    let mut state = State {
        views: poses,
        rig: pose_state(&RigidTransform::identity()),
        cameras: [numbers; 2],
    };
    // Free the lens parameters gradually: all at once may lead from a poor start to a wrong
    // minimum.
    let mut few = problem.held;
    few[6 + 4 + 1..6 + OF_CAMERA].fill(true);
    let first = Problem::new(
        problem.marks.clone(),
        problem.observations.clone(),
        problem.num_views,
        problem.kinds,
        few,
    );
    first.minimize(&mut state, &strict(30), monitor)?;
    let report = problem.minimize(&mut state, &strict(options.max_iterations), monitor)?;
    Ok((report.final_cost, state))
}
