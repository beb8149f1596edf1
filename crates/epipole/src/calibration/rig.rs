//! Relative pose of two calibrated cameras.

use super::board_symmetries::board_symmetries;
use super::calibrate::{WHAT, check, marks, observations};
use super::problem::{Problem, SHARED, State, camera_numbers, pose_state, strict};
use super::start::board_pose;
use super::uncertainty::standard_deviations;
use super::{Board, BoardView};
use crate::camera::{Camera, RigidTransform};
use crate::progress::{Monitor, Part, Stage};
use crate::{Error, Result};

/// Two rigidly connected cameras.
#[derive(Debug, Clone, PartialEq)]
pub struct RigCalibration {
    /// `x_in_right = right_from_left * x_in_left`, meters.
    pub right_from_left: RigidTransform,
    /// Distance between the cameras, meters.
    pub baseline_m: f64,
    /// RMS reprojection error of both cameras, pixels.
    pub rms_px: f64,
    /// Standard deviation of the rotation about the axes of the right camera, radians. The
    /// intrinsics are treated as exact; their uncertainty is not included.
    pub std_dev_rotation_rad: [f64; 3],
    /// Standard deviation of the translation, meters. The intrinsics are treated as exact; their
    /// uncertainty is not included.
    pub std_dev_translation_m: [f64; 3],
    /// RMS error in both cameras for each input pair, pixels; `None` if a board was not seen by
    /// both.
    pub pairs_rms_px: Vec<Option<f64>>,
}

/// Boards count as rotated if the disagreement of all pairs falls below this ratio.
const CLEARLY_LESS: f64 = 0.5;

/// Estimates the motion between two calibrated cameras: minimizes the reprojection errors of a
/// board that both see at the same time. The intrinsics do not change.
///
/// A board with rotational symmetry, such as one of 7 × 5 corners, may be numbered from another
/// corner in the right view than in the left one, for instance if a camera is mounted upside down.
/// The rotations on which all pairs agree are used.
///
/// * `cameras`: left and right, from [`calibrate`](super::calibrate)
/// * `left`, `right`: simultaneous views, in the same order; `None` if no board was found
/// * `monitor`: notified after each step of the refinement, in the only stage,
///   [`Stage::Calibration`]
///
/// # Errors
/// [`Error::TooFew`] if no board was seen by both, [`Error::SizeMismatch`] for lists of different
/// length, and as [`calibrate`](super::calibrate).
///
/// Source: Bradski & Kaehler 2008, "Learning OpenCV", ch. 12; initialized with the motion of a
/// single pair that agrees best with the others.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::calibration::{Board, BoardView, Pattern, calibrate_rig};
/// use epipole::camera::{Camera, Intrinsics, Lens, LensKind, RigidTransform};
/// use nalgebra::{Point3, Vector3};
/// let board = Board::new(Pattern::Chessboard, 7, 5, 0.03)?;
/// let camera = Camera {
///     intrinsics: Intrinsics::centered(600.0, 640, 480)?,
///     lens: Lens::from_coefficients(LensKind::Brown, &[0.0; 5])?,
///     width: 640,
///     height: 480,
/// };
/// let right_from_left = RigidTransform::new(Vector3::new(-0.1, 0.0, 0.01), Vector3::new(0.0, 0.02, 0.0));
/// let pose = RigidTransform::new(Vector3::new(-0.05, -0.06, 0.5), Vector3::new(0.4, 0.1, 0.0));
/// let see = |pose: RigidTransform| {
///     let pixel = |mark| {
///         let p = board.mark(mark);
///         camera.project(&(pose * Point3::new(p.x, p.y, 0.0))).ok()
///     };
///     vec![Some(BoardView { pixels: (0..board.num_marks()).map(pixel).collect() })]
/// };
/// let found = calibrate_rig(&board, &[camera, camera], &see(pose), &see(right_from_left * pose), &mut ())?;
/// assert!((found.baseline_m - right_from_left.translation.vector.norm()).abs() < 1e-9);
/// # Ok(()) }
/// ```
#[doc(alias = "stereoCalibrate")]
pub fn calibrate_rig(
    board: &Board,
    cameras: &[Camera; 2],
    left: &[Option<BoardView>],
    right: &[Option<BoardView>],
    monitor: &mut dyn Monitor,
) -> Result<RigCalibration> {
    if left.len() != right.len() {
        return Err(Error::SizeMismatch {
            what: "the lists of left and right views",
            first: left.len(),
            second: right.len(),
        });
    }
    for (views, camera) in [(left, &cameras[0]), (right, &cameras[1])] {
        check(board, views, (camera.width, camera.height))?;
    }
    let both: Vec<Option<[&BoardView; 2]>> = left
        .iter()
        .zip(right)
        .map(|(left, right)| Some([left.as_ref()?, right.as_ref()?]))
        .collect();
    let pairs: Vec<[&BoardView; 2]> = both.iter().flatten().copied().collect();
    if pairs.is_empty() {
        return Err(Error::TooFew {
            what: "a stereo calibration from pairs in which both cameras see the board",
            needed: 1,
            got: 0,
        });
    }
    let mut poses = Vec::new();
    for [in_left, in_right] in &pairs {
        poses.push([
            board_pose(board, in_left, &cameras[0])?,
            board_pose(board, in_right, &cameras[1])?,
        ]);
    }
    // For each pair, the motion for each rotation of the right board.
    let symmetries = board_symmetries(board);
    let motions: Vec<Vec<RigidTransform>> = poses
        .iter()
        .map(|[l, r]| {
            let motion = |board_from_rotated| r * board_from_rotated * l.inverse();
            symmetries
                .iter()
                .map(|symmetry| motion(symmetry.board_from_rotated))
                .collect()
        })
        .collect();
    let (start, chosen) = find_common_motion(&motions);
    let in_left: Vec<&BoardView> = pairs.iter().map(|[left, _]| *left).collect();
    let in_right = pairs.iter().zip(&chosen);
    let in_right: Vec<BoardView> = in_right
        .map(|([_, right], &n)| symmetries[n].view(right))
        .collect();
    let mut observed = observations(&in_left, 0);
    observed.extend(observations(&in_right.iter().collect::<Vec<_>>(), 1));
    let mut held = [true; SHARED];
    held[..6].fill(false);
    let kinds = cameras.each_ref().map(|camera| camera.lens.kind());
    let problem = Problem::new(marks(board), observed, pairs.len(), kinds, held);
    let mut state = State {
        views: poses.iter().map(|[l, _]| pose_state(l)).collect(),
        rig: pose_state(&start),
        cameras: cameras
            .each_ref()
            .map(|camera| camera_numbers(&camera.intrinsics, &camera.lens)),
    };
    let mut whole = Part::new(monitor, 0.0, 1.0).of_stage(Stage::Calibration);
    problem.minimize(&mut state, &strict(200), &mut whole)?;
    let deviations = standard_deviations(&problem, &state).ok_or(Error::Degenerate {
        what: WHAT,
        why: "the pairs leave the motion between the cameras open",
    })?;
    let right_from_left = State::pose(&state.rig);
    let mut used = 0..;
    let pairs_rms_px = both
        .iter()
        .map(|pair| {
            pair.as_ref()?;
            let place = used.next()?;
            Some(problem.rms_px(&state, |o| o.view == place))
        })
        .collect();
    Ok(RigCalibration {
        baseline_m: right_from_left.translation.vector.norm(),
        right_from_left,
        rms_px: problem.rms_px(&state, |_| true),
        std_dev_rotation_rad: core::array::from_fn(|i| deviations[i]),
        std_dev_translation_m: core::array::from_fn(|i| deviations[3 + i]),
        pairs_rms_px,
    })
}

/// Returns the motion on which the pairs agree best, and the rotation of each pair.
///
/// * `motions`: motions of each pair for each rotation, the identity first
fn find_common_motion(motions: &[Vec<RigidTransform>]) -> (RigidTransform, Vec<usize>) {
    let off = |a: &RigidTransform, b: &RigidTransform| {
        a.rotation.angle_to(&b.rotation)
            + (a.translation.vector - b.translation.vector).norm()
                / b.translation.vector.norm().max(f64::MIN_POSITIVE)
    };
    let nearest = |a: &RigidTransform, of_pair: &[RigidTransform]| {
        let offs = of_pair.iter().map(|b| off(a, b)).enumerate();
        offs.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    };
    let best = |num_rotations: usize| {
        let allowed = || motions.iter().map(|of_pair| &of_pair[..num_rotations]);
        let disagreement = |a| allowed().map(|of_pair| nearest(a, of_pair).1).sum::<f64>();
        let all = allowed().flatten().map(|a| (disagreement(a), *a));
        let found = all.min_by(|a, b| a.0.total_cmp(&b.0));
        found.unwrap_or((0.0, RigidTransform::identity()))
    };
    let num_rotations = motions.first().map_or(1, Vec::len);
    let (as_found, rotated) = (best(1), best(num_rotations));
    let (start, num_rotations) = match rotated.0 < CLEARLY_LESS * as_found.0 {
        true => (rotated.1, num_rotations),
        false => (as_found.1, 1),
    };
    let chosen = motions
        .iter()
        .map(|of_pair| nearest(&start, &of_pair[..num_rotations]).0);
    (start, chosen.collect())
}

#[cfg(test)]
mod tests {
    use super::super::Pattern;
    use super::super::synthetic::{poses, true_view};
    use super::*;
    use crate::camera::{Intrinsics, Lens, LensKind};
    use nalgebra::{Point2, Vector3};

    #[test]
    fn boards_counted_from_other_corners_agree() {
        let camera = Camera::pinhole(Intrinsics::centered(600.0, 640, 480).unwrap(), 640, 480);
        // The right camera is upside down.
        let truth =
            RigidTransform::new(Vector3::new(0.12, 0.01, 0.0), Vector3::new(0.02, 0.0, 3.1));
        for (columns, rows) in [(7, 5), (6, 6)] {
            let board = Board::new(Pattern::Chessboard, columns, rows, 0.025).unwrap();
            let symmetries = board_symmetries(&board);
            let poses = poses(&board, 6, 15.0, 2);
            let left: Vec<_> = (poses.iter())
                .map(|pose| Some(true_view(&board, &camera, pose)))
                .collect();
            // Every view is numbered from its own corner.
            let right = poses.iter().enumerate().map(|(n, pose)| {
                let view = true_view(&board, &camera, &(truth * pose));
                Some(symmetries[n % symmetries.len()].view(&view))
            });
            let right: Vec<_> = right.collect();
            let found = calibrate_rig(&board, &[camera; 2], &left, &right, &mut ()).unwrap();
            assert!(found.rms_px < 1e-6, "{columns} × {rows}: {}", found.rms_px);
            let off = found.right_from_left.inverse() * truth;
            assert!(off.rotation.angle() < 1e-7 && off.translation.vector.norm() < 1e-8);
        }
    }

    #[test]
    fn two_different_cameras_find_each_other() {
        let board = Board::new(Pattern::Chessboard, 9, 6, 0.025).unwrap();
        let camera = |kind, focal: f64, k: &[f64]| Camera {
            intrinsics: Intrinsics::new(focal, focal, 320.0, 240.0).unwrap(),
            lens: Lens::from_coefficients(kind, k).unwrap(),
            width: 640,
            height: 480,
        };
        let cameras = [
            camera(LensKind::Brown, 540.0, &[-0.2, 0.02, 0.0, 0.001, 0.0]),
            camera(LensKind::Fisheye, 300.0, &[-0.02, 0.004, 0.0, 0.0]),
        ];
        let truth = RigidTransform::new(
            Vector3::new(-0.1, 0.02, 0.015),
            Vector3::new(0.03, -0.1, 0.4),
        );
        let observe =
            |camera: &Camera, pose: RigidTransform| Some(true_view(&board, camera, &pose));
        let poses = poses(&board, 5, 15.0, 2);
        let mut left: Vec<_> = poses.iter().map(|p| observe(&cameras[0], *p)).collect();
        let mut right: Vec<_> = poses
            .iter()
            .map(|p| observe(&cameras[1], truth * p))
            .collect();
        left[1] = None;
        // Part of the board is hidden from the right camera.
        right[3].as_mut().unwrap().pixels[10..30].fill(None);
        let found = calibrate_rig(&board, &cameras, &left, &right, &mut ()).unwrap();
        assert!(found.rms_px < 1e-6);
        let off = found.right_from_left.inverse() * truth;
        assert!(off.rotation.angle() < 1e-7 && off.translation.vector.norm() < 1e-8);
        assert_eq!(found.pairs_rms_px.iter().flatten().count(), 4);
        assert!(found.pairs_rms_px[1].is_none());
        right[0] = None;
        right[2..].fill(None);
        let error = calibrate_rig(&board, &cameras, &left, &right, &mut ()).unwrap_err();
        assert!(matches!(error, Error::TooFew { .. }));
        assert!(calibrate_rig(&board, &cameras, &left, &right[..3], &mut ()).is_err());
        let bad = BoardView {
            pixels: vec![Some(Point2::new(f64::INFINITY, 0.0)); 54],
        };
        assert!(
            calibrate_rig(
                &board,
                &cameras,
                &[Some(bad.clone())],
                &[Some(bad)],
                &mut ()
            )
            .is_err()
        );
    }
}
