//! Closing the loop: what the camera sees again at home, and how the path gives way to it.

use super::drive::{Drive, Errors};
use epipole::Result;
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use epipole::optim::{Iteration, RobustLoss};
use epipole::sfm::{AlignmentKind, LoopClosure, LoopMotion, align_points, close_loops};
use nalgebra::{Point3, Similarity3, Vector3};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Points at home that both visits know.
const NUM_POINTS: usize = 100;
/// How much the loop weighs beside one step: it is measured from many points at once.
const WEIGHT: f64 = 1e4;

/// What a closed loop may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Kind {
    /// Place and direction of each frame.
    Rigid,
    /// Its scale, too.
    Similarity,
}

/// The path after the loop was closed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Closed {
    pub(super) world_from_cam: Vec<RigidTransform>,
    /// By how much lengths around each frame are multiplied.
    pub(super) correction: Vec<f64>,
}

/// What the camera sees of home when it starts and when it returns: the points of the return in
/// the frame of the start, each visit in its own unit.
pub(super) fn recognize(drive: &Drive, errors: &Errors) -> Result<Similarity3<f64>> {
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
pub(super) fn close(
    drive: &Drive,
    first_from_last: Similarity3<f64>,
    kind: Kind,
) -> Result<Closed> {
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
    let closed = close_loops(path, &[closure], motion, RobustLoss::Trivial, &mut go_on)?;
    Ok(Closed {
        world_from_cam: closed.world_from_cam,
        correction: closed.scale,
    })
}

fn go_on(_: &Iteration) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
