//! Frame of the exported files: that of control points or, without them, meters if the scale is
//! known, and z up from the floor if it is set.

use super::contents::Export;
use crate::tasks::camera_found::CameraFound;
use nalgebra::{Point3, Quaternion, Similarity3, UnitQuaternion, Vector3};

/// Returns the transform from the frame of the reconstruction to that of the files.
pub(super) fn file_from_world(export: &Export) -> Similarity3<f64> {
    if let Some(aligned) = &export.measures.aligned {
        let [i, j, k, w] = aligned.rotation;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        let translation = Vector3::from(aligned.translation);
        return Similarity3::from_parts(translation.into(), rotation, aligned.scale);
    }
    let scale = export.meters_per_unit.unwrap_or(1.0);
    let Some([origin, up]) = export.floor else {
        return Similarity3::from_scaling(scale);
    };
    let upside_down = || UnitQuaternion::from_quaternion(Quaternion::new(0.0, 1.0, 0.0, 0.0));
    let rotation = UnitQuaternion::rotation_between(&Vector3::from(up), &Vector3::z())
        .unwrap_or_else(upside_down);
    let to_origin = rotation * -Vector3::from(origin);
    Similarity3::from_parts((to_origin * scale).into(), rotation, scale)
}

/// Transforms a camera to the frame of the files.
pub(super) fn moved(camera: &CameraFound, file_from_world: &Similarity3<f64>) -> CameraFound {
    let [i, j, k, w] = camera.rotation;
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
        * file_from_world.isometry.rotation.inverse();
    let center: Point3<f64> = file_from_world * camera.center();
    CameraFound {
        rotation: rotation.coords.into(),
        translation: (-(rotation * center.coords)).into(),
        ..*camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_sees_a_moved_point_where_it_saw_it_before() {
        let camera = CameraFound {
            intrinsics: [500.0, 500.0, 320.0, 240.0],
            rotation: [0.1, -0.2, 0.05, 0.97],
            translation: [0.3, -0.1, 0.4],
        };
        let point = [0.2, 0.1, 3.0];
        for up in [[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [0.6, 0.0, 0.8]] {
            let turn = UnitQuaternion::rotation_between(&Vector3::from(up), &Vector3::z());
            let turn = turn.unwrap_or_else(|| {
                UnitQuaternion::from_quaternion(Quaternion::new(0.0, 1.0, 0.0, 0.0))
            });
            assert!((turn * Vector3::from(up) - Vector3::z()).norm() < 1e-12);
            let frame = Similarity3::from_parts(Vector3::new(1.0, 2.0, 3.0).into(), turn, 2.5);
            let seen = |camera: &CameraFound, point: Point3<f64>| {
                let (_, p) = camera.transform(&point);
                [p.x / p.z, p.y / p.z]
            };
            let before = seen(&camera, point.into());
            let after = seen(&moved(&camera, &frame), frame * Point3::from(point));
            for (a, b) in before.iter().zip(after) {
                assert!((a - b).abs() < 1e-9, "{up:?}: {a} {b}");
            }
        }
    }
}
