//! Trajectories of KITTI's odometry benchmark: lines of twelve numbers, the 3 × 4 matrix
//! `world_from_cam` row by row, meters. There are no times: a line is a frame.
//!
//! Source: Geiger, Lenz & Urtasun 2012, KITTI, development kit of odometry, `readme.txt`.

use super::path::Trajectory;
use super::words::words;
use crate::text::{lines, number};
use crate::{Error, Result};
use epipole::camera::RigidTransform;
use epipole::math::svd3;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use std::fmt::Write;

/// Largest entry of RᵀR − I for a matrix with few digits.
const ROUNDED_ROTATION: f64 = 1e-2;

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
        world_from_cam.push(RigidTransform::from_parts(
            Translation3::new(m[3], m[7], m[11]),
            rotation(
                line,
                &Matrix3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
            )?,
        ));
    }
    Ok(Trajectory {
        stamps_ns: None,
        world_from_cam,
    })
}

/// The rotation nearest to a matrix.
fn rotation(line: usize, matrix: &Matrix3<f64>) -> Result<UnitQuaternion<f64>> {
    let off = (matrix.transpose() * matrix - Matrix3::identity()).amax();
    if !(off < ROUNDED_ROTATION && matrix.determinant() > 0.0) {
        let message = "columns 1 to 3, 5 to 7 and 9 to 11 are not a rotation";
        return Err(Error::at(line, message));
    }
    let axes = svd3(matrix);
    let nearest = Rotation3::from_matrix_unchecked(axes.u * axes.v.transpose());
    Ok(UnitQuaternion::from_rotation_matrix(&nearest))
}

pub(super) fn write(trajectory: &Trajectory) -> String {
    let mut text = String::new();
    for pose in &trajectory.world_from_cam {
        let matrix = pose.to_homogeneous();
        let numbers: Vec<String> = (0..12)
            .map(|i| matrix[(i / 4, i % 4)].to_string())
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", numbers.join(" "));
    }
    text
}
