//! Ground truth of EuRoC MAV: CSV of time in nanoseconds, position in meters, quaternion with w
//! first, and perhaps velocity and biases, which are not read.
//!
//! The poses are of the body, the IMU, in the world; `sensor.yaml` of a camera has `T_BS`.
//!
//! Source: Burri et al. 2016, "The EuRoC micro aerial vehicle datasets", the files of
//! `state_groundtruth_estimate0`.

use super::path::Trajectory;
use super::stamp::check_order;
use super::words::{pose, words};
use crate::text::lines;
use crate::{Error, Result};
use std::fmt::Write;

pub(super) fn read(text: &str) -> Result<Trajectory> {
    let mut stamps = Vec::new();
    let mut world_from_cam = Vec::new();
    for (index, (line, content)) in lines(text).enumerate() {
        let words = words(content);
        let [t, x, y, z, qw, qx, qy, qz, ..] = words[..] else {
            let message =
                format!("not the eight values t, px, py, pz, qw, qx, qy, qz: \"{content:.60}\"");
            return Err(Error::at(line, message));
        };
        // A header without `#`.
        if index == 0 && t.starts_with(|c: char| c.is_alphabetic()) {
            continue;
        }
        let stamp: i64 = t.parse().map_err(|_| {
            Error::at(
                line,
                format!("\"{t:.40}\" is not a whole number of nanoseconds"),
            )
        })?;
        stamps.push((line, stamp));
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
    let mut text = String::from(
        "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n",
    );
    for (stamp, pose) in stamps_ns.iter().zip(&trajectory.world_from_cam) {
        let (t, q) = (pose.translation.vector, pose.rotation.coords);
        let _ = writeln!(
            text,
            "{stamp},{},{},{},{},{},{},{}",
            t.x, t.y, t.z, q.w, q.x, q.y, q.z
        );
    }
    text
}
