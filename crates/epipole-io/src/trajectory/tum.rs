//! Trajectories of the TUM RGB-D benchmark: lines of `t tx ty tz qx qy qz qw`, seconds and meters,
//! `world_from_cam`, comments after `#`.
//!
//! Source: Computer Vision Group TUM, "RGB-D SLAM dataset and benchmark", File formats.

use super::path::Trajectory;
use super::stamp::{check_order, from_seconds, to_seconds};
use super::words::{pose, words};
use crate::text::lines;
use crate::{Error, Result};
use std::fmt::Write;

pub(super) fn read(text: &str) -> Result<Trajectory> {
    let mut stamps = Vec::new();
    let mut world_from_cam = Vec::new();
    for (line, content) in lines(text) {
        let [t, x, y, z, qx, qy, qz, qw] = words(content)[..] else {
            let message = format!("not the eight values t tx ty tz qx qy qz qw: \"{content:.60}\"");
            return Err(Error::at(line, message));
        };
        stamps.push((line, from_seconds(line, t)?));
        world_from_cam.push(pose(line, &[x, y, z], [qx, qy, qz, qw])?);
    }
    check_order(&stamps)?;
    Ok(Trajectory {
        stamps_ns: Some(stamps.iter().map(|(_, stamp)| *stamp).collect()),
        world_from_cam,
    })
}

pub(super) fn write(stamps_ns: &[i64], trajectory: &Trajectory) -> String {
    // Writing to a string cannot fail.
    let mut text = String::from("# timestamp tx ty tz qx qy qz qw\n");
    for (stamp, pose) in stamps_ns.iter().zip(&trajectory.world_from_cam) {
        let (t, q) = (pose.translation.vector, pose.rotation.coords);
        let stamp = to_seconds(*stamp);
        let _ = writeln!(
            text,
            "{stamp} {} {} {} {} {} {} {}",
            t.x, t.y, t.z, q.x, q.y, q.z, q.w
        );
    }
    text
}
