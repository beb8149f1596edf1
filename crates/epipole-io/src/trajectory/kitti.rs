//! Trajectories of KITTI's odometry benchmark: lines of twelve numbers, the 3 × 4 matrix
//! `world_from_cam` row by row, meters. There are no times; each line is a frame.
//!
//! Source: Geiger, Lenz & Urtasun 2012, KITTI, development kit of odometry, `readme.txt`.

use super::path::Trajectory;
use super::words::{numbers, words};
use crate::rotation::rotation_from_matrix;
use crate::text::{lines, number};
use crate::{Error, Result};
use epipole::camera::RigidTransform;
use nalgebra::{Matrix3, Translation3};
use std::fmt::Write;

/// Largest entry of RᵀR − I of a rotation matrix written with three digits.
const FEW_DIGITS: f64 = 1e-2;

pub(super) fn read(text: &str) -> Result<Trajectory> {
    let mut world_from_cam = Vec::new();
    for (line, content) in lines(text) {
        let words = words(content);
        if words.len() != 12 {
            let message = format!("not the twelve numbers of a 3 × 4 matrix: \"{content:.60}\"");
            return Err(Error::at(line, message));
        }
        let mut m = [0.0; 12];
        for (value, word) in m.iter_mut().zip(words) {
            *value = number(line, word)?;
        }
        let matrix = Matrix3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
        let rotation = rotation_from_matrix(&matrix, FEW_DIGITS).ok_or_else(|| {
            Error::at(
                line,
                "columns 1 to 3, 5 to 7 and 9 to 11 are not a rotation",
            )
        })?;
        world_from_cam.push(RigidTransform::from_parts(
            Translation3::new(m[3], m[7], m[11]),
            rotation,
        ));
    }
    Ok(Trajectory {
        world_from_cam,
        ..Trajectory::default()
    })
}

pub(super) fn write(trajectory: &Trajectory) -> String {
    let mut text = String::new();
    for pose in &trajectory.world_from_cam {
        let matrix = pose.to_homogeneous();
        let numbers = numbers((0..12).map(|i| matrix[(i / 4, i % 4)]));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", numbers.join(" "));
    }
    text
}
