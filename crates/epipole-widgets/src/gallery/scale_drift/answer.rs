//! What follows from the state: the drive, the closed path, and how far each is off.

use super::closing::{Closed, recognize};
use super::drive::{Drive, Errors, centers};
use epipole::camera::RigidTransform;
use epipole::sfm::{AlignmentKind, absolute_trajectory_error};
use nalgebra::Point3;

/// A drive up to some step, with what closing its loop made of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    pub(super) drive: Drive,
    /// Of what odometry believes.
    pub(super) before: Judged,
    /// Of the closed path, once it is known; an error is a sentence.
    pub(super) after: Option<Result<Judged, String>>,
    /// How many times as large the places at home look on the return, as measured there.
    pub(super) seen: Option<f64>,
}

/// A path and how far it is off.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Judged {
    pub(super) poses: Vec<RigidTransform>,
    /// How many times too large everything around each frame comes out.
    pub(super) scale: Vec<f64>,
    /// Root mean square of the distances to the true places after the best similarity, in true
    /// steps; `None` while the path is a straight line, which no alignment can turn.
    pub(super) error: Option<f64>,
}

impl Judged {
    fn new(poses: &[RigidTransform], scale: Vec<f64>, truth: &[Point3<f64>]) -> Self {
        let judged = absolute_trajectory_error(&centers(poses), truth, AlignmentKind::Similarity);
        Self {
            poses: poses.to_vec(),
            scale,
            error: judged.ok().map(|(statistics, _)| statistics.rmse),
        }
    }

    /// From the first place to the last one, in first steps.
    pub(super) fn gap(&self) -> f64 {
        let ends = (self.poses.first(), self.poses.last());
        let (Some(first), Some(last)) = ends else {
            return 0.0;
        };
        (last.translation.vector - first.translation.vector).norm()
    }

    /// The scale of the last frame.
    pub(super) fn scale_at_end(&self) -> f64 {
        self.scale.last().copied().unwrap_or(1.0)
    }

    /// The largest error of the scale, as a share.
    pub(super) fn worst_scale(&self) -> f64 {
        let off = self.scale.iter().map(|scale| (scale - 1.0).abs());
        off.fold(0.0, f64::max)
    }
}

impl Answer {
    /// Drives `traveled` of `num_steps` steps; the loop is still open.
    pub(super) fn new(num_steps: usize, traveled: usize, errors: &Errors) -> Self {
        let drive = Drive::new(num_steps, errors);
        let before = Judged::new(
            &drive.believed[..=traveled],
            drive.scale[..=traveled].to_vec(),
            &centers(&drive.truth[..=traveled]),
        );
        let recognized = (traveled == num_steps).then(|| recognize(&drive, errors).ok());
        let seen = recognized
            .flatten()
            .map(|first_from_last| 1.0 / first_from_last.scaling());
        Self {
            drive,
            before,
            after: None,
            seen,
        }
    }

    /// The closed path of this drive.
    pub(super) fn judge(&self, closed: &Closed) -> Judged {
        let scales = self.drive.scale.iter().zip(&closed.correction);
        let scale = scales.map(|(scale, factor)| scale * factor).collect();
        Judged::new(&closed.world_from_cam, scale, &centers(&self.drive.truth))
    }
}

#[cfg(test)]
mod tests {
    use super::super::closing::{Kind, close};
    use super::*;

    fn closed(rate: f64, noise: f64, is_metric: bool, kind: Kind) -> (Judged, Judged) {
        let errors = Errors {
            rate,
            noise,
            is_metric,
            seed: 7,
        };
        let answer = Answer::new(80, 80, &errors);
        let seen = recognize(&answer.drive, &errors).unwrap();
        let after = answer.judge(&close(&answer.drive, seen, kind).unwrap());
        (answer.before, after)
    }

    #[test]
    fn without_errors_there_is_no_gap_and_nothing_to_repair() {
        for kind in [Kind::Rigid, Kind::Similarity] {
            let (before, after) = closed(0.0, 0.0, false, kind);
            for path in [before, after] {
                assert!(path.gap() < 1e-9 && path.error.unwrap() < 1e-9);
                assert!(path.worst_scale() < 1e-9);
            }
        }
    }

    #[test]
    fn an_even_drift_is_undone_by_similarities_and_not_by_rigid_motions() {
        let (before, rigid) = closed(0.01, 0.0, false, Kind::Rigid);
        let (_, similar) = closed(0.01, 0.0, false, Kind::Similarity);
        // NumPy: 1.01 ** 80
        assert!((before.scale_at_end() - 2.216_715).abs() < 1e-6);
        assert!(before.gap() > 8.0, "{}", before.gap());
        let [before, rigid_error, similar_error] =
            [&before, &rigid, &similar].map(|path| path.error.unwrap());
        assert!(similar_error < 1e-3 * before, "{similar_error} of {before}");
        assert!(rigid_error > 0.5 * before, "{rigid_error} of {before}");
        assert!(similar.worst_scale() < 1e-3 && similar.gap() < 1e-3);
        // The ends meet, and yet the last frame is as much too large as before.
        assert!(rigid.gap() < 0.05 && rigid.worst_scale() > 1.2);
        // Rigid edges keep the lengths of their steps.
        let last_step =
            (rigid.poses[80].translation.vector - rigid.poses[79].translation.vector).norm();
        assert!(last_step > 2.0, "{last_step}");
    }

    #[test]
    fn a_stereo_rig_needs_no_similarity() {
        let (before, rigid) = closed(0.01, 0.01, true, Kind::Rigid);
        let (before, rigid) = (before.error.unwrap(), rigid.error.unwrap());
        assert!(before > 0.2 && rigid < 0.2 * before, "{before} to {rigid}");
    }

    #[test]
    fn noise_is_spread_but_not_undone() {
        let (before, after) = closed(0.01, 0.01, false, Kind::Similarity);
        let (before, after) = (before.error.unwrap(), after.error.unwrap());
        assert!(after < 0.2 * before && after > 0.02, "{before} to {after}");
    }

    #[test]
    fn on_the_way_there_is_nothing_to_close() {
        let errors = Errors {
            rate: 0.01,
            noise: 0.0,
            is_metric: false,
            seed: 1,
        };
        let answer = Answer::new(80, 40, &errors);
        assert_eq!((answer.after, answer.seen), (None, None));
        assert_eq!(answer.before.poses.len(), 41);
        assert!(answer.before.error.is_some());
        let straight = Answer::new(80, 3, &errors);
        assert_eq!(straight.before.error, None);
    }
}
