//! The pose from three points that are far away, close together, nearly on a line, or critical.

use epipole::absolute_pose::pose_p3p;
use epipole::camera::RigidTransform;
use epipole::math::random::Random;
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

fn vector(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.normal())
}

fn any_rotation(random: &mut Random) -> UnitQuaternion<f64> {
    let mut number = || random.normal();
    UnitQuaternion::from_quaternion(Quaternion::new(number(), number(), number(), number()))
}

/// `cam_from_world` of a camera at a center.
fn placed(rotation: &UnitQuaternion<f64>, center: &Vector3<f64>) -> RigidTransform {
    RigidTransform::from_parts((-(rotation * center)).into(), *rotation)
}

struct Triple {
    rotation: UnitQuaternion<f64>,
    center: Vector3<f64>,
    points: [Point3<f64>; 3],
}

/// Counts over many problems of a kind.
#[derive(Debug, Default)]
struct Tally {
    problems: usize,
    /// Problems whose true pose is among the solutions.
    found: usize,
    /// Solutions from which a point is off its ray by more than 10⁻⁶ radians, or behind.
    off_their_rays: usize,
    /// Solutions with the rotation of another one, within 10⁻⁷.
    twice: usize,
}

fn tally(length: f64, tolerance: f64, mut problem: impl FnMut(&mut Random) -> Triple) -> Tally {
    let mut random = Random::new(8);
    let mut tally = Tally::default();
    for _ in 0..3000 {
        let Triple {
            rotation,
            center,
            points,
        } = problem(&mut random);
        let truth = placed(&rotation, &center);
        let rays = points.map(|x| (rotation * (x.coords - center)).normalize());
        let found = pose_p3p(&rays, &points);
        let matrix = |m: &RigidTransform| m.rotation.to_rotation_matrix().into_inner();
        tally.problems += 1;
        tally.found += usize::from(found.iter().any(|m| {
            let shift = m.translation.vector - truth.translation.vector;
            (matrix(m) - matrix(&truth)).norm() + shift.norm() / length < tolerance
        }));
        for (i, m) in found.iter().enumerate() {
            let off = |ray: &Vector3<f64>, x: &Point3<f64>| {
                let in_cam = (m * x).coords;
                in_cam.dot(ray) <= 0.0 || in_cam.normalize().cross(ray).norm() > 1e-6
            };
            tally.off_their_rays += usize::from(rays.iter().zip(&points).any(|(r, x)| off(r, x)));
            let same = |other: &RigidTransform| (matrix(other) - matrix(m)).norm() < 1e-7;
            tally.twice += found[..i].iter().filter(|other| same(other)).count();
        }
    }
    assert_eq!(tally.off_their_rays, 0, "{tally:?}");
    assert_eq!(tally.twice, 0, "{tally:?}");
    tally
}

fn around(random: &mut Random) -> Vector3<f64> {
    vector(random).normalize() * random.uniform(2.0, 8.0)
}

#[test]
fn three_points_far_away() {
    let tally = tally(1e4, 1e-5, |random| Triple {
        rotation: any_rotation(random),
        center: vector(random).normalize() * 1e4,
        points: core::array::from_fn(|_| Point3::from(vector(random))),
    });
    assert!(tally.found >= 2999, "{tally:?}");
}

#[test]
fn three_points_close_together() {
    let tally = tally(1.0, 1e-5, |random| Triple {
        rotation: any_rotation(random),
        center: around(random),
        points: core::array::from_fn(|_| Point3::from(vector(random) * 1e-3)),
    });
    assert!(tally.found >= 2999, "{tally:?}");
}

#[test]
fn three_points_nearly_on_a_line() {
    let line = [(0.0, 0.0), (1.0, 1e-4), (2.5, 0.0)].map(|(x, y)| Point3::new(x, y, 0.0));
    let tally = tally(1.0, 1e-5, |random| Triple {
        rotation: any_rotation(random),
        center: around(random),
        points: line,
    });
    assert!(tally.found >= 2980, "{tally:?}");
}

/// Two of the solutions are one there, known to about the root of the rounding errors.
#[test]
fn three_points_from_the_danger_cylinder() {
    let tally = tally(1.0, 1e-3, |random| {
        let points: [Point3<f64>; 3] = core::array::from_fn(|_| Point3::from(vector(random)));
        let (u, v) = (points[1] - points[0], points[2] - points[0]);
        let normal = u.cross(&v);
        let to_center = (v.norm_squared() * normal.cross(&u) + u.norm_squared() * v.cross(&normal))
            / (2.0 * normal.norm_squared());
        let along = UnitQuaternion::from_scaled_axis(normal.normalize() * random.uniform(0.0, 6.3));
        let foot = points[0].coords + to_center + along * to_center;
        Triple {
            rotation: any_rotation(random),
            center: foot + normal.normalize() * random.uniform(0.5, 3.0),
            points,
        }
    });
    assert!(tally.found >= 2970, "{tally:?}");
}
