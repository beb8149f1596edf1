//! Trajectory error and loop closure. A worker computes them, since pose graph optimization and
//! alignment are too much code for the page's module.

use super::drive::{Drive, Errors, STEPS, centers};
use crate::contract::{Problem, Progress};
use crate::kit::question;
use epipole::Error;
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::sfm::{
    AlignmentKind, LoopClosure, LoopMotion, absolute_trajectory_error, align_points, close_loops,
};
use nalgebra::{Point3, Similarity3, Vector3};
use serde::{Deserialize, Serialize};

/// Number of points near the start that are reconstructed on both visits.
const NUM_POINTS: usize = 100;
/// Weight of the loop edge relative to a step; it is high, as it is measured from many points.
const WEIGHT: f64 = 1e4;

/// Degrees of freedom of loop closure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Kind {
    /// Position and orientation of each frame.
    Rigid,
    /// Also the scale of each frame.
    Similarity,
}

/// Input of the job.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) num_steps: usize,
    pub(super) traveled: usize,
    pub(super) errors: Errors,
    /// Kind of loop closure, if any.
    pub(super) kind: Option<Kind>,
}

/// A path and its trajectory error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Judged {
    /// `world_from_cam` of each frame.
    pub(super) poses: Vec<RigidTransform>,
    /// Scale of the reconstruction around each frame, relative to the truth.
    pub(super) scale: Vec<f64>,
    /// Trajectory error, in true steps; `None` if undefined or not yet known.
    pub(super) error: Option<f64>,
}

/// Result of the job.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    /// Trajectory error before loop closure, in true steps.
    pub(super) error: Option<f64>,
    /// Measured scale of the start when revisited; `None` before the return.
    pub(super) seen: Option<f64>,
    /// Path after loop closure.
    pub(super) closed: Option<Judged>,
}

impl Judged {
    /// Returns the distance between the first and the last position, in units of the first step.
    pub(super) fn gap(&self) -> f64 {
        let ends = (self.poses.first(), self.poses.last());
        let (Some(first), Some(last)) = ends else {
            return 0.0;
        };
        (last.translation.vector - first.translation.vector).norm()
    }

    /// Returns the scale of the last frame.
    pub(super) fn scale_at_end(&self) -> f64 {
        self.scale.last().copied().unwrap_or(1.0)
    }

    /// Returns the maximum relative error of the scale.
    pub(super) fn worst_scale(&self) -> f64 {
        let off = self.scale.iter().map(|scale| (scale - 1.0).abs());
        off.fold(0.0, f64::max)
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Judging the path";
    const FAILED: &'static str = "The path cannot be judged";

    fn answer(&self, _: Progress<'_>) -> Result<Answer, Problem> {
        let errors = &self.errors;
        let is_drive = STEPS.contains(&self.num_steps)
            && self.num_steps.is_multiple_of(2)
            && self.traveled <= self.num_steps
            && errors.rate.is_finite()
            && errors.noise.is_finite();
        if !is_drive {
            let (what, why) = ("a drive", "the request makes no sense");
            return Err(Error::Degenerate { what, why }.into());
        }
        let drive = Drive::new(self.num_steps, errors);
        let truth = centers(&drive.truth[..=self.traveled]);
        let mut answer = Answer {
            error: trajectory_error(&drive.believed[..=self.traveled], &truth),
            seen: None,
            closed: None,
        };
        if self.traveled == drive.last() {
            let first_from_last = recognize(&drive, errors)?;
            answer.seen = Some(1.0 / first_from_last.scaling());
            if let Some(kind) = self.kind {
                let mut closed = close(&drive, first_from_last, kind)?;
                closed.error = trajectory_error(&closed.poses, &truth);
                answer.closed = Some(closed);
            }
        }
        Ok(answer)
    }

    fn fits(&self, answer: &Answer) -> bool {
        let is_home = self.traveled == self.num_steps;
        let is_sound = |x: f64| x.abs() < 1e9;
        let is_pose = |pose: &RigidTransform| {
            pose.translation.vector.iter().all(|x| is_sound(*x))
                && (pose.rotation.coords.norm() - 1.0).abs() < 1e-6
        };
        let is_path = |path: &Judged| {
            path.poses.len() == self.num_steps + 1
                && path.scale.len() == path.poses.len()
                && path.poses.iter().all(is_pose)
                && path.scale.iter().all(|scale| is_sound(*scale))
                && path.error.is_none_or(is_sound)
        };
        answer.error.is_none_or(is_sound)
            && answer.seen.is_some() == is_home
            && answer.seen.is_none_or(is_sound)
            && answer.closed.is_some() == (is_home && self.kind.is_some())
            && answer.closed.iter().all(is_path)
    }
}

/// Returns the root mean square distance from the true positions after the best similarity
/// alignment, in true steps; `None` while the path is a straight line, for which the rotation of
/// the alignment is undetermined.
fn trajectory_error(path: &[RigidTransform], truth: &[Point3<f64>]) -> Option<f64> {
    let judged = absolute_trajectory_error(&centers(path), truth, AlignmentKind::Similarity);
    judged.ok().map(|(statistics, _)| statistics.rmse)
}

/// Aligns the points reconstructed on return with those reconstructed at the start, each in its own
/// scale.
fn recognize(drive: &Drive, errors: &Errors) -> Result<Similarity3<f64>, Error> {
    let mut random = Random::new(errors.seed ^ 0x5eed);
    let (mut then, mut now) = (Vec::new(), Vec::new());
    let scale = drive.scale[drive.last()];
    for _ in 0..NUM_POINTS {
        let place = Point3::new(
            random.uniform(-3.0, 3.0),
            random.uniform(-1.5, 0.5),
            random.uniform(2.0, 6.0),
        );
        let mut seen = || place + place.coords.norm() * errors.noise * normal(&mut random);
        then.push(seen());
        now.push(seen() * scale);
    }
    align_points(&now, &then, AlignmentKind::Similarity)
}

fn normal(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.normal())
}

/// Closes the loop between the first frame and the last one.
fn close(drive: &Drive, first_from_last: Similarity3<f64>, kind: Kind) -> Result<Judged, Error> {
    let closure = LoopClosure {
        from: 0,
        to: drive.last(),
        from_from_to: first_from_last,
        weight: WEIGHT,
    };
    let motion = match kind {
        Kind::Rigid => LoopMotion::Rigid,
        Kind::Similarity => LoopMotion::Similarity,
    };
    let path = &drive.believed;
    let closed = close_loops(path, &[closure], motion, RobustLoss::Trivial, &mut ())?;
    let scales = drive.scale.iter().zip(&closed.scale);
    Ok(Judged {
        scale: scales
            .map(|(scale, correction)| scale * correction)
            .collect(),
        poses: closed.world_from_cam,
        error: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use question::Question as _;
    use std::ops::ControlFlow;

    /// Returns the path before and after loop closure.
    fn closed(rate: f64, noise: f64, is_metric: bool, kind: Kind) -> (Judged, Judged) {
        let errors = Errors {
            rate,
            noise,
            is_metric,
            seed: 7,
        };
        let answer = answered(80, errors, kind);
        let drive = Drive::new(80, &errors);
        let before = Judged {
            poses: drive.believed,
            scale: drive.scale,
            error: answer.error,
        };
        (before, answer.closed.unwrap())
    }

    fn answered(traveled: usize, errors: Errors, kind: Kind) -> Answer {
        let question = Question {
            num_steps: 80,
            traveled,
            errors,
            kind: Some(kind),
        };
        let answer = question.answer(&mut |_| ControlFlow::Continue(())).unwrap();
        assert!(question.fits(&answer));
        // Unit quaternions survive serialization.
        let bytes = postcard::to_allocvec(&answer).unwrap();
        assert_eq!(postcard::from_bytes::<Answer>(&bytes).unwrap(), answer);
        answer
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
        // The ends meet, but the scale error of the last frame remains.
        assert!(rigid.gap() < 0.05 && rigid.worst_scale() > 1.2);
        // Rigid edges preserve the lengths of the steps.
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
        assert_eq!((&answer.closed, answer.seen), (&None, None));
        assert!(answer.error.is_some());
        let straight = answered(3, errors, Kind::Similarity);
        assert_eq!(straight.error, None);
    }
}
