//! What a worker is asked about the loop, and what it answers: closing it is too much code for the
//! page's own module.

use super::closing::{Closed, Kind, close, recognize};
use super::drive::{Drive, Errors};
use crate::contract::{Job, Problem};
use epipole::Error;
use epipole::camera::RigidTransform;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// What the page says meanwhile.
pub(super) const WAITING: &str = "Closing the loop";

/// Everything that the closed path depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Request {
    pub(super) num_steps: usize,
    pub(super) errors: Errors,
    pub(super) kind: Kind,
}

/// A frame of the closed path: its rotation (x, y, z, w), its place, and by how much lengths around
/// it are multiplied.
#[derive(Serialize, Deserialize)]
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

/// Closes the loop.
///
/// # Errors
/// A sentence.
pub(super) fn compute(bytes: &[u8]) -> Result<Vec<u8>, Problem> {
    let unreadable = |_| Error::Degenerate {
        what: "a closed loop",
        why: "the request cannot be read",
    };
    let request: Request = postcard::from_bytes(bytes).map_err(unreadable)?;
    let drive = Drive::new(request.num_steps, &request.errors);
    let first_from_last = recognize(&drive, &request.errors)?;
    let closed = close(&drive, first_from_last, request.kind)?;
    let frames: Vec<Frame> = (closed.world_from_cam.iter().zip(&closed.correction))
        .map(|(pose, &correction)| Frame {
            rotation: pose.rotation.coords.into(),
            center: pose.translation.vector.into(),
            correction,
        })
        .collect();
    Ok(postcard::to_allocvec(&frames).unwrap_or_default())
}

/// The answer as a path; `None` for bytes that are no answer.
pub(super) fn read(bytes: &[u8]) -> Option<Closed> {
    let frames: Vec<Frame> = postcard::from_bytes(bytes).ok()?;
    // Unit quaternions come as they went; to normalize them again would change their bits.
    let pose = |frame: &Frame| {
        RigidTransform::from_parts(
            Translation3::from(frame.center),
            UnitQuaternion::new_unchecked(Quaternion::from(frame.rotation)),
        )
    };
    Some(Closed {
        world_from_cam: frames.iter().map(pose).collect(),
        correction: frames.iter().map(|frame| frame.correction).collect(),
    })
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
                errors,
                kind,
            };
            let drive = Drive::new(80, &errors);
            let expected = close(&drive, recognize(&drive, &errors).unwrap(), kind).unwrap();
            assert_eq!(
                read(&compute(&request.job().request).unwrap()),
                Some(expected)
            );
        }
        assert!(compute(&[]).is_err());
        assert_eq!(read(&[]), None);
    }
}
