//! Values of a figure's state for readers' code: matches, matrices, cameras.

use epipole::camera::PosedCamera;
use nalgebra::{Matrix3, Point2};
use serde::Serialize;
use std::collections::BTreeMap;

/// Values by name, named and shaped as in the npm package of the core.
pub type Data = BTreeMap<&'static str, Datum>;

/// A value.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Datum {
    /// A number.
    Number(f64),
    /// Points in the plane.
    Points(Vec<[f64; 2]>),
    /// A matrix, row by row.
    Matrix([[f64; 3]; 3]),
    /// A pinhole camera with its pose.
    Camera(CameraData),
}

/// A pinhole camera with its pose.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CameraData {
    camera: PinholeData,
    cam_from_world: PoseData,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct PinholeData {
    width: u32,
    height: u32,
    intrinsics: IntrinsicsData,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct IntrinsicsData {
    fu_px: f64,
    fv_px: f64,
    cu_px: f64,
    cv_px: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct PoseData {
    rotation: [[f64; 3]; 3],
    translation: [f64; 3],
}

impl Datum {
    /// Creates points.
    pub fn points<'a>(points: impl IntoIterator<Item = &'a Point2<f64>>) -> Self {
        Self::Points(points.into_iter().map(|point| [point.x, point.y]).collect())
    }

    /// Creates a matrix.
    pub fn matrix(matrix: &Matrix3<f64>) -> Self {
        Self::Matrix(rows(matrix))
    }

    /// Creates a camera without its lens, since figures use none.
    pub fn camera(camera: &PosedCamera) -> Self {
        let (width, height) = (camera.camera.width, camera.camera.height);
        let intrinsics = &camera.camera.intrinsics;
        let pose = &camera.cam_from_world;
        Self::Camera(CameraData {
            camera: PinholeData {
                width,
                height,
                intrinsics: IntrinsicsData {
                    fu_px: intrinsics.fu_px(),
                    fv_px: intrinsics.fv_px(),
                    cu_px: intrinsics.principal_point().x,
                    cv_px: intrinsics.principal_point().y,
                },
            },
            cam_from_world: PoseData {
                rotation: rows(&pose.rotation.to_rotation_matrix().into_inner()),
                translation: pose.translation.into(),
            },
        })
    }
}

fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    matrix.transpose().data.0
}

/// Returns the matches of two images, as `pixels1` and `pixels2`.
pub(crate) fn match_data<'a>(
    matches: impl IntoIterator<Item = (&'a Point2<f64>, &'a Point2<f64>)>,
) -> [(&'static str, Datum); 2] {
    let (pixels1, pixels2): (Vec<_>, Vec<_>) = matches
        .into_iter()
        .map(|(pixel1, pixel2)| ([pixel1.x, pixel1.y], [pixel2.x, pixel2.y]))
        .unzip();
    [
        ("pixels1", Datum::Points(pixels1)),
        ("pixels2", Datum::Points(pixels2)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_is_written_by_row() {
        let matrix = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
        let by_row = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
        assert_eq!(Datum::matrix(&matrix), Datum::Matrix(by_row));
    }
}
