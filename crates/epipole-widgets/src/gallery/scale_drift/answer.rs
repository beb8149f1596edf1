//! What follows from the state: the drive, the closed path, and how far each is off.

use super::drive::{Drive, Errors};
use super::request::Told;
use epipole::camera::RigidTransform;

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
    /// Trajectory error, in true steps; `None` where there is none, or it is not known yet.
    pub(super) error: Option<f64>,
}

impl Judged {
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
    /// Drives `traveled` of `num_steps` steps; nothing is judged, and the loop is open.
    pub(super) fn open(num_steps: usize, traveled: usize, errors: &Errors) -> Self {
        let drive = Drive::new(num_steps, errors);
        let before = Judged {
            poses: drive.believed[..=traveled].to_vec(),
            scale: drive.scale[..=traveled].to_vec(),
            error: None,
        };
        Self {
            drive,
            before,
            after: None,
            seen: None,
        }
    }

    /// Takes what a worker told about this drive.
    pub(super) fn take(&mut self, told: &Told) {
        self.before.error = told.error;
        self.seen = told.seen;
        self.after = told.closed().map(|(closed, error)| {
            let scales = self.drive.scale.iter().zip(&closed.correction);
            Ok(Judged {
                scale: scales.map(|(scale, factor)| scale * factor).collect(),
                poses: closed.world_from_cam,
                error,
            })
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::closing::Kind;
    use super::super::request::{Request, compute, read};
    use super::*;

    fn answered(traveled: usize, errors: Errors, kind: Kind) -> Answer {
        let request = Request {
            num_steps: 80,
            traveled,
            errors,
            kind: Some(kind),
        };
        let mut answer = Answer::open(80, traveled, &errors);
        answer.take(&read(&compute(&request.job().request).unwrap()).unwrap());
        answer
    }

    fn closed(rate: f64, noise: f64, is_metric: bool, kind: Kind) -> (Judged, Judged) {
        let errors = Errors {
            rate,
            noise,
            is_metric,
            seed: 7,
        };
        let answer = answered(80, errors, kind);
        let after = answer.after.unwrap().unwrap();
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
        let answer = answered(40, errors, Kind::Similarity);
        assert_eq!((answer.after, answer.seen), (None, None));
        assert_eq!(answer.before.poses.len(), 41);
        assert!(answer.before.error.is_some());
        let straight = answered(3, errors, Kind::Similarity);
        assert_eq!(straight.before.error, None);
    }
}
