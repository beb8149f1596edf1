//! Ground truth of EuRoC MAV: CSV of time in nanoseconds, position in meters, quaternion with w
//! first, and optionally velocity and biases, which are not read.
//!
//! The poses are those of the body (the IMU) in the world; `sensor.yaml` of a camera has `T_BS`.
//!
//! Source: Burri et al. 2016, "The EuRoC micro aerial vehicle datasets", the files of
//! `state_groundtruth_estimate0`.

use super::path::Trajectory;
use super::words::numbers;
use std::fmt::Write;

pub(super) fn write(stamps_ns: &[i64], trajectory: &Trajectory) -> String {
    // Writing to a string cannot fail.
    let mut text = String::from(
        "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n",
    );
    for (stamp, pose) in stamps_ns.iter().zip(&trajectory.world_from_cam) {
        let (t, q) = (pose.translation.vector, pose.rotation.coords);
        let numbers = numbers([t.x, t.y, t.z, q.w, q.x, q.y, q.z]).join(",");
        let _ = writeln!(text, "{stamp},{numbers}");
    }
    text
}
