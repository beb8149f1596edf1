//! Trajectories of the TUM RGB-D benchmark: lines of `t tx ty tz qx qy qz qw`, seconds and meters,
//! `world_from_cam`, comments after `#`.
//!
//! Source: Computer Vision Group TUM, "RGB-D SLAM dataset and benchmark", File formats.

use super::path::Trajectory;
use super::stamp::to_seconds;
use super::words::numbers;
use std::fmt::Write;

pub(super) fn write(stamps_ns: &[i64], trajectory: &Trajectory) -> String {
    // Writing to a string cannot fail.
    let mut text = String::from("# timestamp tx ty tz qx qy qz qw\n");
    for (stamp, pose) in stamps_ns.iter().zip(&trajectory.world_from_cam) {
        let (t, q) = (pose.translation.vector, pose.rotation.coords);
        let stamp = to_seconds(*stamp);
        let numbers = numbers([t.x, t.y, t.z, q.x, q.y, q.z, q.w]).join(" ");
        let _ = writeln!(text, "{stamp} {numbers}");
    }
    text
}
