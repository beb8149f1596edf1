//! `epipole fit`, `two-view` and `rectify` against known geometry.

mod fit;
mod fit_options;
mod photos;

use crate::common::{
    Folder, angle_deg, epipole, fails, json, k, matrix, motion, moved, numbers, parse, path,
};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::epipolar::{fundamental_from_cameras, symmetric_epipolar_px};
use epipole::math::random::Random;
use epipole::robust::num_trials_without_replacement;
use epipole::synthetic::{Structure, TwoViewProblem, TwoViewProblemOptions};
use epipole_scenes::{Scene, Transfer};
use nalgebra::{Matrix3, Point2, Vector3};
use serde_json::Value;
use std::path::PathBuf;

const SIZE: (u32, u32) = (640, 480);
const K: &str = "600,600,319.5,239.5";

/// Matches of which two in five are wrong.
fn problem(structure: Structure) -> TwoViewProblem {
    TwoViewProblem::new(
        &TwoViewProblemOptions::default()
            .with_num_points(250)
            .with_structure(structure)
            .with_outlier_fraction(0.4)
            .with_seed(5),
    )
    .unwrap()
}

fn cube() -> Structure {
    Structure::Cube { half_side_m: 1.0 }
}

fn matches_file(folder: &Folder, pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> PathBuf {
    let rows = pixels1.iter().zip(pixels2).map(|(a, b)| {
        // Commas, further columns and comments are part of the format.
        format!("{} {}, {}\t{} 0.5 extra # a match\n", a.x, a.y, b.x, b.y)
    });
    let text = format!("# u1 v1 u2 v2\n\n{}", rows.collect::<String>());
    folder.write("matches.txt", &text)
}

fn file_of(folder: &Folder, problem: &TwoViewProblem) -> PathBuf {
    matches_file(folder, &problem.pixels1, &problem.pixels2)
}

fn mask(result: &Value) -> Vec<bool> {
    numbers(&result["inliers"])
        .iter()
        .map(|i| *i == 1.0)
        .collect()
}

fn transfer(h: &Matrix3<f64>, pixel: &Point2<f64>) -> Point2<f64> {
    Point2::from_homogeneous(h * pixel.to_homogeneous()).unwrap()
}

fn cam2_from_cam1(camera1: &PosedCamera, camera2: &PosedCamera) -> RigidTransform {
    camera2.cam_from_world * camera1.cam_from_world.inverse()
}

/// Degrees between the rotations, and between the directions of the translations.
fn errors_deg(found: &RigidTransform, truth: &RigidTransform) -> (f64, f64) {
    (
        found.rotation.angle_to(&truth.rotation).to_degrees(),
        angle_deg(&found.translation.vector, &truth.translation.vector),
    )
}
