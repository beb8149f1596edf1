//! What a worker is asked about a drive, and what it answers: closing the loop and aligning paths is
//! too much code for the page's own module.

use super::closing::{Closed, Kind, close, recognize};
use super::drive::{Drive, Errors, centers};
use super::knobs::STEPS;
use crate::contract::{Job, Problem};
use epipole::Error;
use epipole::camera::RigidTransform;
use epipole::sfm::{AlignmentKind, absolute_trajectory_error};
use nalgebra::{Point3, Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// What the page says meanwhile.
pub(super) const WAITING: &str = "Judging the path";

/// Everything that the answer depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    pub(super) num_steps: usize,
    pub(super) traveled: usize,
    pub(super) errors: Errors,
    /// How the loop is closed at home, if at all.
    pub(super) kind: Option<Kind>,
}

/// The answer.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Told {
    /// Trajectory error of the path before the loop is closed; see [`trajectory_error`].
    pub(super) error: Option<f64>,
    /// How many times as large the places at home look on the return; `None` on the way.
    pub(super) seen: Option<f64>,
    /// The frames of the closed path, and its trajectory error.
    closed: Option<(Vec<Frame>, Option<f64>)>,
}

/// A frame of the closed path: its rotation (x, y, z, w), its place, and by how much lengths around
/// it are multiplied.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Frame {
    rotation: [f64; 4],
    center: [f64; 3],
    correction: f64,
}

impl Request {
    pub(super) fn job(&self) -> Job {
        Job {
            label: WAITING,
            request: postcard::to_allocvec(self).unwrap_or_default(),
        }
    }
}

/// Judges the path, and closes the loop at home.
///
/// # Errors
/// A sentence.
pub(super) fn compute(bytes: &[u8]) -> Result<Vec<u8>, Problem> {
    let unreadable = Error::Degenerate {
        what: "a drive",
        why: "the request cannot be read",
    };
    let Ok(request) = postcard::from_bytes::<Request>(bytes) else {
        return Err(unreadable.into());
    };
    let Request {
        num_steps, errors, ..
    } = request;
    let steps = STEPS.min as usize..=STEPS.max as usize;
    if !steps.contains(&num_steps)
        || num_steps % 2 != 0
        || request.traveled > num_steps
        || !(errors.rate.is_finite() && errors.noise.is_finite())
    {
        return Err(unreadable.into());
    }
    let drive = Drive::new(num_steps, &errors);
    let truth = centers(&drive.truth[..=request.traveled]);
    let mut told = Told {
        error: trajectory_error(&drive.believed[..=request.traveled], &truth),
        seen: None,
        closed: None,
    };
    if request.traveled == drive.last() {
        let first_from_last = recognize(&drive, &errors)?;
        told.seen = Some(1.0 / first_from_last.scaling());
        if let Some(kind) = request.kind {
            let closed = close(&drive, first_from_last, kind)?;
            let error = trajectory_error(&closed.world_from_cam, &truth);
            told.closed = Some((frames(&closed), error));
        }
    }
    Ok(postcard::to_allocvec(&told).unwrap_or_default())
}

/// Root mean square of the distances to the true places after the best similarity, in true steps;
/// `None` while the path is a straight line, which no alignment can turn.
fn trajectory_error(path: &[RigidTransform], truth: &[Point3<f64>]) -> Option<f64> {
    let judged = absolute_trajectory_error(&centers(path), truth, AlignmentKind::Similarity);
    judged.ok().map(|(statistics, _)| statistics.rmse)
}

fn frames(closed: &Closed) -> Vec<Frame> {
    (closed.world_from_cam.iter().zip(&closed.correction))
        .map(|(pose, &correction)| Frame {
            rotation: pose.rotation.coords.into(),
            center: pose.translation.vector.into(),
            correction,
        })
        .collect()
}

/// The answer of these bytes; `None` if they are none.
pub(super) fn read(bytes: &[u8]) -> Option<Told> {
    postcard::from_bytes(bytes).ok()
}

impl Told {
    /// The closed path and its trajectory error.
    pub(super) fn closed(&self) -> Option<(Closed, Option<f64>)> {
        let (frames, error) = self.closed.as_ref()?;
        // Unit quaternions come as they went; to normalize them again would change their bits.
        let pose = |frame: &Frame| {
            RigidTransform::from_parts(
                Translation3::from(frame.center),
                UnitQuaternion::new_unchecked(Quaternion::from(frame.rotation)),
            )
        };
        let closed = Closed {
            world_from_cam: frames.iter().map(pose).collect(),
            correction: frames.iter().map(|frame| frame.correction).collect(),
        };
        Some((closed, *error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_answer_is_what_was_computed() {
        for kind in [Kind::Rigid, Kind::Similarity] {
            let errors = Errors {
                rate: 0.01,
                noise: 0.01,
                is_metric: false,
                seed: 7,
            };
            let request = Request {
                num_steps: 80,
                traveled: 80,
                errors,
                kind: Some(kind),
            };
            let drive = Drive::new(80, &errors);
            let expected = close(&drive, recognize(&drive, &errors).unwrap(), kind).unwrap();
            let told = read(&compute(&request.job().request).unwrap()).unwrap();
            assert_eq!(told.closed().unwrap().0, expected);
        }
        assert!(compute(&[]).is_err());
        assert_eq!(read(&[]), None);
    }
}
