//! Two cameras in front of a house, their essential matrix, and its four poses.

use epipole::Result;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::epipolar::{decompose_essential, essential_from_motion};
use epipole::triangulation::triangulate_midpoint;
use nalgebra::{Point3, Rotation3, Vector3};

/// Minimum baseline for an essential matrix, scene units.
const SHORTEST: f64 = 0.05;
/// Focal length and size of both photographs, pixels.
pub(super) const FOCAL_PX: f64 = 500.0;
pub(super) const SIZE: (u32, u32) = (640, 480);

/// Corners of the house: the four of its base, then the two ends of its ridge.
const HOUSE: [[f64; 3]; 6] = [
    [-0.75, 0.5, -0.45],
    [0.75, 0.5, -0.45],
    [0.75, 0.5, 0.45],
    [-0.75, 0.5, 0.45],
    [-0.75, -0.5, 0.0],
    [0.75, -0.5, 0.0],
];
/// The corner whose rays are drawn: an end of the ridge.
pub(super) const RIDGE: usize = 4;
/// Edges between corners: walls and ridge.
pub(super) const EDGES: [(usize, usize); 5] = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5)];
/// Position of the house, scene units, and its rotation about y, degrees.
const HOUSE_AT: [f64; 3] = [0.15, 0.0, 3.0];
const HOUSE_TURN_DEG: f64 = 24.0;

/// A corner triangulated with one of the poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Position in the frame of camera 1.
    pub(super) point: Point3<f64>,
    /// Whether the point is in front of camera 1, and of camera 2.
    pub(super) in_front: [bool; 2],
}

impl Crossing {
    pub(super) fn is_good(&self) -> bool {
        self.in_front == [true, true]
    }
}

/// One of the four poses.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pose {
    pub(super) cam2_from_cam1: RigidTransform,
    /// Triangulated corners; `None` unless both cameras see the corner and its rays intersect.
    pub(super) crossings: Vec<Option<Crossing>>,
}

impl Pose {
    pub(super) fn num_in_front(&self) -> usize {
        let crossings = self.crossings.iter().flatten();
        crossings.filter(|crossing| crossing.is_good()).count()
    }
}

/// The poses that two photographs of the house allow.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ambiguity {
    /// (R, t), (R, −t), (half-turned R, t) and (half-turned R, −t); empty without a baseline.
    pub(super) poses: Vec<Pose>,
    /// Number of corners visible to both cameras.
    pub(super) num_matches: usize,
}

impl Ambiguity {
    /// * `motion`: true `cam2_from_cam1`
    ///
    /// # Errors
    /// As [`decompose_essential`], for values that are not finite.
    pub(super) fn of(motion: &RigidTransform) -> Result<Self> {
        let step = motion.translation.vector.norm();
        let rays: Vec<_> = house().iter().map(|corner| rays(corner, motion)).collect();
        let num_matches = rays.iter().flatten().count();
        if step < SHORTEST {
            let poses = Vec::new();
            return Ok(Self { poses, num_matches });
        }
        let found = decompose_essential(&essential_from_motion(motion)?)?;
        // True rotation first, and true direction first within each.
        let key = |pose: &RigidTransform| {
            let turned = pose.rotation.angle_to(&motion.rotation) > 1e-3;
            let ahead = pose.translation.vector.dot(&motion.translation.vector) > 0.0;
            (turned, !ahead)
        };
        let order = [(false, false), (false, true), (true, false), (true, true)];
        let pose = |mut pose: RigidTransform| {
            // E does not fix the scale; the length of the true baseline is used.
            pose.translation.vector *= step;
            let crossing = |rays: &Option<[Vector3<f64>; 2]>| crossing(&pose, &(*rays)?);
            Pose {
                cam2_from_cam1: pose,
                crossings: rays.iter().map(crossing).collect(),
            }
        };
        let poses = order
            .into_iter()
            .flat_map(|wanted| found.iter().filter(move |pose| key(pose) == wanted))
            .map(|found| pose(*found))
            .collect();
        Ok(Self { poses, num_matches })
    }
}

/// Returns the corners of the house in the frame of camera 1.
fn house() -> [Point3<f64>; HOUSE.len()] {
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), HOUSE_TURN_DEG.to_radians());
    HOUSE.map(|corner| Point3::from(HOUSE_AT) + turn * Vector3::from(corner))
}

/// Returns the rays of a corner in both cameras; `None` unless both see it.
fn rays(corner: &Point3<f64>, motion: &RigidTransform) -> Option<[Vector3<f64>; 2]> {
    let lens = Intrinsics::centered(FOCAL_PX, SIZE.0, SIZE.1).ok()?;
    let camera = |cam_from_world| PosedCamera {
        camera: Camera::pinhole(lens, SIZE.0, SIZE.1),
        cam_from_world,
    };
    let ray = |camera: PosedCamera| {
        let pixel = camera.project(corner).ok()?;
        let inside = (0.0..f64::from(SIZE.0)).contains(&pixel.x)
            && (0.0..f64::from(SIZE.1)).contains(&pixel.y);
        inside.then(|| lens.ray(&pixel))
    };
    Some([
        ray(camera(RigidTransform::identity()))?,
        ray(camera(*motion))?,
    ])
}

/// Returns the intersection of two rays, in front of or behind each camera. An intersection behind
/// a camera is one in front of it on the reversed ray.
fn crossing(pose: &RigidTransform, rays: &[Vector3<f64>; 2]) -> Option<Crossing> {
    let sides = [[true, true], [false, false], [true, false], [false, true]];
    sides.into_iter().find_map(|in_front| {
        let ray = |index: usize| match in_front[index] {
            true => rays[index],
            false => -rays[index],
        };
        let point = triangulate_midpoint(pose, &ray(0), &ray(1)).ok()?;
        Some(Crossing { point, in_front })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Translation3, UnitQuaternion};

    #[test]
    fn wherever_camera_2_stands_only_the_true_pose_has_all_in_front() {
        for (x, z) in [(1.0, 0.2), (-1.0, -0.5), (0.3, 1.0), (0.0, -1.0)] {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.28);
            let world_from_cam = RigidTransform::from_parts(Translation3::new(x, 0.0, z), turn);
            let found = Ambiguity::of(&world_from_cam.inverse()).unwrap();
            let counts: Vec<usize> = found.poses.iter().map(Pose::num_in_front).collect();
            assert_eq!(counts[0], found.num_matches, "at {x}, {z}");
            assert_eq!(counts[1..], [0, 0, 0], "at {x}, {z}");
            for (corner, crossing) in house().iter().zip(&found.poses[0].crossings) {
                let near = |c: &Crossing| (c.point - corner).norm() < 1e-6;
                assert!(crossing.as_ref().is_none_or(near), "at {x}, {z}");
            }
        }
    }

    #[test]
    fn without_a_step_there_is_no_pose() {
        let found = Ambiguity::of(&RigidTransform::identity()).unwrap();
        assert_eq!((found.poses.len(), found.num_matches), (0, 6));
    }
}
