//! Relative pose from three matches with known gravity.

use super::five_point::side_in_front;
use crate::camera::RigidTransform;
use crate::math::real_roots::{DEGREE as ROOT_DEGREE, real_roots};
use crate::math::scaling::unit;
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Maximum number of solutions.
pub(super) const MAX_SOLUTIONS: usize = 4;

/// Maximum value of an extremum of the polynomial to count as a double root.
const NEARLY_TOUCHING: f64 = 1e-10;

/// Minimum length of cross products of unit rows to determine the direction.
const NO_DIRECTION: f64 = 1e-12;

/// Relative size of a leading coefficient below which it is zero up to rounding.
const NO_LEADING: f64 = 1e-12;

/// Solves for the motions `cam2_from_cam1`, at most four, with t of length 1, from three matches
/// and the direction of gravity.
///
/// With both cameras leveled, only the rotation about the vertical by θ and the direction of t are
/// unknown. A match requires t to be orthogonal to `R x1 × x2`, and three of these rows have a null
/// vector: their determinant has degree six in tan(θ/2) and the factor 1 + tan²(θ/2), so a quartic
/// remains.
///
/// * `rays1`, `rays2`: matching rays in the frames of cameras 1 and 2; their lengths do not matter
/// * `gravity1`, `gravity2`: the same world direction in the frames of both cameras, with any
///   length: down or up, as from an accelerometer
///
/// Only motions that put the three points in front of both cameras are returned. The list is empty
/// for a camera that only rotated, for points at infinity, for equal or nearly equal matches, and
/// for input that is not finite or zero gravity vectors.
///
/// Source: Fraundorfer, Tanskanen & Pollefeys 2010, "A minimal case solution to the calibrated
/// relative pose problem for the case of two known orientation angles".
///
/// ```
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::relative_pose_3point;
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-0.8, 0.0, 0.6), Vector3::new(0.1, 0.3, -0.05));
/// let points = [(-1.0, -1.0, 4.0), (1.0, -0.5, 5.0), (0.2, 0.7, 6.0)].map(|(x, y, z)| Point3::new(x, y, z));
/// let rays1 = points.map(|x| x.coords);
/// let rays2 = points.map(|x| (cam2_from_cam1 * x).coords);
/// // Camera 1 is nearly upright: y points down.
/// let gravity1 = Vector3::new(0.05, 1.0, 0.1);
/// let gravity2 = cam2_from_cam1.rotation * gravity1;
/// let motions = relative_pose_3point(&rays1, &rays2, &gravity1, &gravity2);
/// assert!(motions.len() <= 4);
/// assert!(motions.iter().any(|found| found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-9
///     && (found.translation.vector - cam2_from_cam1.translation.vector).norm() < 1e-9));
/// ```
pub fn relative_pose_3point(
    rays1: &[Vector3<f64>; 3],
    rays2: &[Vector3<f64>; 3],
    gravity1: &Vector3<f64>,
    gravity2: &Vector3<f64>,
) -> ArrayVec<RigidTransform, 4> {
    let mut solutions = ArrayVec::new();
    let Some(upright) = Upright::new(gravity1, gravity2) else {
        return solutions;
    };
    for (rotation, direction) in solve(
        &rays1.map(|r| r.normalize()),
        &rays2.map(|r| r.normalize()),
        &upright,
    ) {
        let rotation = Rotation3::from_matrix_unchecked(rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        solutions.push(RigidTransform::from_parts(direction.into(), rotation));
    }
    solutions
}

/// Rotations that level both cameras: gravity becomes the y axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Upright {
    from_cam1: Matrix3<f64>,
    from_cam2: Matrix3<f64>,
    /// Gravity in the frame of camera 2, of length 1.
    pub(super) gravity2: Vector3<f64>,
}

impl Upright {
    /// Returns `None` for zero gravity vectors.
    pub(super) fn new(gravity1: &Vector3<f64>, gravity2: &Vector3<f64>) -> Option<Self> {
        let alignment = |gravity: &Vector3<f64>| -> Option<(Vector3<f64>, Matrix3<f64>)> {
            let down = unit(gravity)?;
            let y = Vector3::y();
            let alignment = Rotation3::rotation_between(&down, &y)
                // From upside down, any 180° rotation about a horizontal axis will do.
                .unwrap_or_else(|| {
                    Rotation3::from_matrix_unchecked(Matrix3::from_diagonal(&Vector3::new(
                        1.0, -1.0, -1.0,
                    )))
                });
            Some((down, alignment.into_inner()))
        };
        let ((_, from_cam1), (gravity2, from_cam2)) = (alignment(gravity1)?, alignment(gravity2)?);
        Some(Self {
            from_cam1,
            from_cam2,
            gravity2,
        })
    }

    /// Returns the rotation from camera 1 to camera 2 with this cosine and sine of the angle about
    /// the vertical.
    fn rotation(&self, cos: f64, sin: f64) -> Matrix3<f64> {
        let about_y = Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos);
        self.from_cam2.transpose() * about_y * self.from_cam1
    }
}

/// Solves for unit rays: returns (R, t).
pub(super) fn solve(
    rays1: &[Vector3<f64>; 3],
    rays2: &[Vector3<f64>; 3],
    upright: &Upright,
) -> ArrayVec<(Matrix3<f64>, Vector3<f64>), MAX_SOLUTIONS> {
    let mut solutions = ArrayVec::new();
    let upright1 = rays1.map(|ray| upright.from_cam1 * ray);
    let upright2 = rays2.map(|ray| upright.from_cam2 * ray);
    // (1 + q²) R x1 × x2 with q = tan(θ/2): quadratics in q.
    let rows: [[[f64; 3]; 3]; 3] = core::array::from_fn(|i| {
        let (a, b) = (&upright1[i], &upright2[i]);
        let rotated = [
            [a.x, 2.0 * a.z, -a.x],
            [a.y, 0.0, a.y],
            [a.z, -2.0 * a.x, -a.z],
        ];
        let cross = |j: usize, k: usize| {
            core::array::from_fn(|n| rotated[j][n] * b[k] - rotated[k][n] * b[j])
        };
        [cross(1, 2), cross(2, 0), cross(0, 1)]
    });
    let quartic = quartic(&rows);
    let largest = quartic.iter().fold(0.0_f64, |far, c| far.max(c.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return solutions;
    }
    let mut coefficients = [0.0; ROOT_DEGREE + 1];
    coefficients[..5].copy_from_slice(&quartic);
    let mut roots = [0.0; ROOT_DEGREE];
    let count = real_roots(&coefficients, NEARLY_TOUCHING, &mut roots);
    let of_root = |q: &f64| {
        let scale = 1.0 / (1.0 + q * q);
        ((1.0 - q * q) * scale, 2.0 * q * scale)
    };
    let half_turn = (quartic[4].abs() < NO_LEADING * largest).then_some((-1.0, 0.0));
    for (cos, sin) in roots[..count].iter().map(of_root).chain(half_turn) {
        let rotation = upright.rotation(cos, sin);
        let Some(direction) = direction(&rotation, rays1, rays2) else {
            continue;
        };
        if let Some(side) = side_in_front(&rotation, &direction, rays1, rays2)
            && !solutions.is_full()
        {
            solutions.push((rotation, direction * side));
        }
    }
    solutions
}

/// Returns the determinant of three rows of quadratics, without its factor 1 + q².
fn quartic(rows: &[[[f64; 3]; 3]; 3]) -> [f64; 5] {
    let mut determinant = [0.0; 7];
    let terms = [
        (0, 1, 2, 1.0),
        (1, 2, 0, 1.0),
        (2, 0, 1, 1.0),
        (2, 1, 0, -1.0),
        (0, 2, 1, -1.0),
        (1, 0, 2, -1.0),
    ];
    for (a, b, c, sign) in terms {
        for i in 0..3 {
            for j in 0..3 {
                for k in 0..3 {
                    determinant[i + j + k] += sign * rows[0][a][i] * rows[1][b][j] * rows[2][c][k];
                }
            }
        }
    }
    let d = determinant;
    // Divided from both ends; the middle one is obtained twice.
    let middle = 0.5 * ((d[2] - d[0]) + (d[4] - d[6]));
    [d[0], d[1], middle, d[5], d[6]]
}

/// Returns the direction of t, up to its sign: orthogonal to `R x1 × x2` of all matches.
fn direction(
    rotation: &Matrix3<f64>,
    rays1: &[Vector3<f64>; 3],
    rays2: &[Vector3<f64>; 3],
) -> Option<Vector3<f64>> {
    let rows: [Vector3<f64>; 3] = core::array::from_fn(|i| (rotation * rays1[i]).cross(&rays2[i]));
    let crosses = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| rows[i].cross(&rows[j]));
    let longest = crosses
        .into_iter()
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    (longest.norm() > NO_DIRECTION).then(|| longest.normalize())
}

#[cfg(test)]
mod tests {
    use super::super::five_point::tests::problem;
    use super::*;
    use crate::math::random::Random;

    fn down(random: &mut Random) -> Vector3<f64> {
        Vector3::from_fn(|_, _| random.normal())
    }

    fn off(found: &RigidTransform, truth: &RigidTransform) -> f64 {
        found.rotation.angle_to(&truth.rotation)
            + (found.translation.vector - truth.translation.vector.normalize()).norm()
    }

    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let (mut found, mut total) = (0, 0);
        for _ in 0..10_000 {
            let (motion, rays1, rays2) = problem::<3>(&mut random);
            let gravity = down(&mut random);
            let solutions =
                relative_pose_3point(&rays1, &rays2, &gravity, &(motion.rotation * gravity));
            total += solutions.len();
            found += usize::from(solutions.iter().any(|s| off(s, &motion) < 1e-6));
            for s in &solutions {
                // Gravity is preserved, and the rays meet.
                let tilt = (s.rotation * gravity).angle(&(motion.rotation * gravity));
                assert!(tilt < 1e-6, "{tilt:e}");
                for (a, b) in rays1.iter().zip(&rays2) {
                    let volume = s.translation.vector.dot(&(s.rotation * a).cross(b));
                    assert!(volume.abs() < 1e-8, "{volume:e}");
                }
            }
        }
        println!("three points and gravity: {found} of 10000, {total} solutions");
        assert!(found >= 9990, "{found}");
    }

    /// Upside down, and rotated by 180° about the vertical.
    #[test]
    fn special_rotations() {
        let mut random = Random::new(2);
        let half = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), core::f64::consts::PI);
        for gravity in [Vector3::y(), -Vector3::y(), Vector3::new(1e-9, -1.0, 0.0)] {
            for rotation in [half, UnitQuaternion::identity()] {
                let mut found = 0;
                for _ in 0..200 {
                    let t = Vector3::from_fn(|_, _| random.normal()).normalize();
                    let motion = RigidTransform::from_parts(t.into(), rotation);
                    // In front of camera 1, and of camera 2 for any direction.
                    let rays: [_; 3] = core::array::from_fn(|_| {
                        let x = Vector3::from_fn(|_, _| 4.0 * random.normal());
                        (x, motion.rotation * x + t)
                    });
                    let solutions = relative_pose_3point(
                        &rays.map(|r| r.0),
                        &rays.map(|r| r.1),
                        &gravity,
                        &(rotation * gravity),
                    );
                    found += usize::from(solutions.iter().any(|s| off(s, &motion) < 1e-6));
                }
                assert!(found >= 199, "{found}");
            }
        }
    }

    #[test]
    fn noise_moves_the_answer_no_more_than_it_must() {
        let mut medians = Vec::new();
        for noise in [1e-5, 1e-4, 1e-3] {
            let mut random = Random::new(3);
            let mut errors = Vec::new();
            for _ in 0..1000 {
                let (motion, rays1, rays2) = problem::<3>(&mut random);
                let gravity = down(&mut random).normalize();
                let shaken = |random: &mut Random, ray: &Vector3<f64>| {
                    ray + noise * Vector3::from_fn(|_, _| random.normal())
                };
                let noisy2: [_; 3] = core::array::from_fn(|i| shaken(&mut random, &rays2[i]));
                let gravity2 = shaken(&mut random, &(motion.rotation * gravity));
                let solutions = relative_pose_3point(&rays1, &noisy2, &gravity, &gravity2);
                let best = solutions.iter().map(|s| off(s, &motion));
                errors.push(best.fold(2.0, f64::min));
            }
            errors.sort_by(f64::total_cmp);
            println!(
                "noise {noise:e}: median {:e}, 90 % {:e}",
                errors[500], errors[900]
            );
            medians.push(errors[500]);
        }
        assert!(
            medians[1] < 20.0 * medians[0] && medians[2] < 20.0 * medians[1],
            "{medians:?}"
        );
        assert!(medians[2] < 0.05, "{medians:?}");
    }

    #[test]
    fn degenerate_input_has_no_solution_or_finite_ones() {
        let mut random = Random::new(4);
        let (motion, rays1, rays2) = problem::<3>(&mut random);
        let (g1, g2) = (Vector3::y(), motion.rotation * Vector3::y());
        let none = |r1: &[Vector3<f64>; 3], r2: &[Vector3<f64>; 3], g1: &Vector3<f64>| {
            assert!(relative_pose_3point(r1, r2, g1, &g2).is_empty());
        };
        none(&rays1, &rays2, &Vector3::zeros());
        none(&rays1, &rays2, &Vector3::new(f64::NAN, 1.0, 0.0));
        none(&[rays1[0]; 3], &[rays2[0]; 3], &g1);
        none(&[Vector3::zeros(); 3], &rays2, &g1);
        for bad in [f64::NAN, f64::INFINITY] {
            let mut r = rays1;
            r[1].x = bad;
            none(&r, &rays2, &g1);
        }
        // Random rays with random gravity: finite motions, or none.
        for _ in 0..2000 {
            let mut any = || -> [Vector3<f64>; 3] { [(); 3].map(|()| down(&mut random)) };
            let (a, b, c) = (any(), any(), any());
            for s in relative_pose_3point(&a, &b, &c[0], &c[1]) {
                assert!(s.to_homogeneous().iter().all(|x| x.is_finite()));
            }
        }
    }
}
