//! Camera pose from three points.

use super::refine::rigid;
use super::sides::polish;
use crate::camera::RigidTransform;
use crate::math::polynomial::cubic_roots;
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Point3, Vector3};

/// Solves for the poses, at most four, from which three known points are seen along three rays.
///
/// The distances d of the points from the camera satisfy
/// `dᵢ² + dⱼ² − 2 dᵢ dⱼ cos θᵢⱼ = ‖Xᵢ − Xⱼ‖²`. Two ratios of these are conics in the projective
/// plane of (d0 : d1 : d2); a degenerate conic of their pencil, from a cubic, is a pair of lines,
/// and a line meets a conic in two points.
///
/// * `rays`: directions in the camera frame; their lengths do not matter
/// * `points_in_world`: the three points, in the same order
///
/// Returns `cam_from_world` of each solution, without repetitions; none if the points are
/// collinear, rays coincide, or input is not finite. A root is dropped if it does not reproduce the
/// sides of the triangle to within 10⁻¹¹ radians as seen from the camera.
///
/// Two solutions merge for a camera on the danger cylinder through the circle of the points. There
/// they are accurate only to about the square root of the rounding errors.
///
/// Source: Persson & Nordberg 2018, "Lambda Twist: an accurate fast robust perspective three point
/// (P3P) solver"; Richter-Gebert 2011, "Perspectives on projective geometry", §11.1 (splitting a
/// degenerate conic).
///
/// ```
/// use epipole::absolute_pose::pose_p3p;
/// use nalgebra::{Point3, Vector3};
/// // A camera at (0, 0, −5), with the axes of the world, sees three points.
/// let points = [Point3::new(1.0, 0.0, 0.0), Point3::new(-1.0, 0.5, 1.0), Point3::new(0.0, -1.0, 0.0)];
/// let rays = points.map(|x| x.coords + Vector3::new(0.0, 0.0, 5.0));
/// let poses = pose_p3p(&rays, &points);
/// // Three points look like this from up to four positions; one is correct.
/// assert!(poses.len() <= 4);
/// assert!(poses.iter().any(|cam_from_world| cam_from_world.rotation.angle() < 1e-7
///     && (cam_from_world.translation.vector - Vector3::new(0.0, 0.0, 5.0)).norm() < 1e-9));
/// ```
pub fn pose_p3p(
    rays: &[Vector3<f64>; 3],
    points_in_world: &[Point3<f64>; 3],
) -> ArrayVec<RigidTransform, 4> {
    let mut solutions = [(Matrix3::zeros(), Vector3::zeros()); 4];
    let count = solve(
        &rays.map(|ray| ray.normalize()),
        &points_in_world.map(|p| p.coords),
        &mut solutions,
    );
    solutions[..count]
        .iter()
        .map(|pose| rigid(pose, &points_in_world[0].coords))
        .collect()
}

/// Frobenius distance of rotations below which solutions are equal.
const SAME_ROTATION: f64 = 1e-7;

/// Relative difference of depths above which solutions are not compared further.
const SAME_DEPTH: f64 = 1e-3;

/// A symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz.
type Conic = [f64; 6];

/// Returns the adjugate of a symmetric matrix, also symmetric.
#[inline(always)]
fn adjugate(c: &Conic) -> Conic {
    [
        c[3] * c[5] - c[4] * c[4],
        c[2] * c[4] - c[1] * c[5],
        c[1] * c[4] - c[2] * c[3],
        c[0] * c[5] - c[2] * c[2],
        c[1] * c[2] - c[0] * c[4],
        c[0] * c[3] - c[1] * c[1],
    ]
}

/// Returns `tr(A B)` of symmetric matrices.
#[inline(always)]
fn trace_of_product(a: &Conic, b: &Conic) -> f64 {
    a[0] * b[0] + a[3] * b[3] + a[5] * b[5] + 2.0 * (a[1] * b[1] + a[2] * b[2] + a[4] * b[4])
}

/// Splits a conic of rank 2 into its two lines, if they are real.
#[inline]
fn split(c: &Conic) -> Option<[[f64; 3]; 2]> {
    // Up to rounding, −adj(C) = p pᵀ with p the intersection of the lines, scaled.
    let b = adjugate(c);
    let diagonal = [-b[0], -b[3], -b[5]];
    let largest = if diagonal[0] >= diagonal[1] && diagonal[0] >= diagonal[2] {
        0
    } else if diagonal[1] >= diagonal[2] {
        1
    } else {
        2
    };
    // A negative entry means complex lines. NaN is rejected as well.
    if diagonal[largest].is_nan() || diagonal[largest] <= 0.0 {
        return None;
    }
    let scale = 1.0 / diagonal[largest].sqrt();
    let p = match largest {
        0 => [-b[0] * scale, -b[1] * scale, -b[2] * scale],
        1 => [-b[1] * scale, -b[3] * scale, -b[4] * scale],
        _ => [-b[2] * scale, -b[4] * scale, -b[5] * scale],
    };
    // C + [p]ₓ has rank 1: its rows are multiples of one line, its columns of the other.
    let m = [
        [c[0], c[1] - p[2], c[2] + p[1]],
        [c[1] + p[2], c[3], c[4] - p[0]],
        [c[2] - p[1], c[4] + p[0], c[5]],
    ];
    let (mut row, mut column, mut size) = (0, 0, -1.0);
    for i in 0..3 {
        for j in 0..3 {
            if m[i][j].abs() > size {
                (row, column, size) = (i, j, m[i][j].abs());
            }
        }
    }
    Some([m[row], [m[0][column], m[1][column], m[2][column]]])
}

/// Writes the solutions (R, t) and returns their number; rays must have unit length.
pub(crate) fn solve(
    rays: &[Vector3<f64>; 3],
    points: &[Vector3<f64>; 3],
    solutions: &mut [(Matrix3<f64>, Vector3<f64>); 4],
) -> usize {
    let (side01, side02, side12) = (
        points[0] - points[1],
        points[0] - points[2],
        points[1] - points[2],
    );
    let (a01, a02, a12) = (
        side01.norm_squared(),
        side02.norm_squared(),
        side12.norm_squared(),
    );
    let normal = side01.cross(&side02);
    let normal_sq = normal.norm_squared();
    // With collinear points the camera can rotate freely about their line.
    let longest = a01.max(a02).max(a12);
    if !(normal_sq > 1e-20 * longest * longest && normal_sq.is_finite()) {
        return 0;
    }
    let (m01, m02, m12) = (
        rays[0].dot(&rays[1]),
        rays[0].dot(&rays[2]),
        rays[1].dot(&rays[2]),
    );
    // Two conics, scaled by the longest side; both divide by the equation of side 12.
    let (r01, r02) = (a01 / a12, a02 / a12);
    let first: Conic = [1.0, -m01, 0.0, 1.0 - r01, r01 * m12, -r01];
    let second: Conic = [1.0, 0.0, -m02, -r02, r02 * m12, 1.0 - r02];
    // det(first + s second).
    let (adj1, adj2) = (adjugate(&first), adjugate(&second));
    let c = [
        trace_of_product(&adj1, &first) / 3.0,
        trace_of_product(&adj1, &second),
        trace_of_product(&adj2, &first),
        trace_of_product(&adj2, &second) / 3.0,
    ];
    let mut roots = [0.0; 3];
    let num_roots = cubic_roots(c, &mut roots);
    let mut lines = None;
    for s in &roots[..num_roots] {
        let conic: Conic = core::array::from_fn(|i| first[i] + s * second[i]);
        lines = split(&conic);
        if lines.is_some() {
            break;
        }
    }
    let Some(lines) = lines else { return 0 };

    // 1 − cos θ without cancellation: the rays to far points are nearly parallel.
    let (c01, c02, c12) = (
        0.5 * (rays[0] - rays[1]).norm_squared(),
        0.5 * (rays[0] - rays[2]).norm_squared(),
        0.5 * (rays[1] - rays[2]).norm_squared(),
    );
    // Rows of [side01 side02 normal]⁻¹.
    let inverse = [
        side02.cross(&normal) / normal_sq,
        normal.cross(&side01) / normal_sq,
        normal / normal_sq,
    ];
    let (mut count, mut depths0) = (0, [0.0; 4]);
    for line in &lines {
        let mut depths = [[0.0; 3]; 2];
        let num_depths = meet(line, &second, &mut depths);
        for d in &mut depths[..num_depths] {
            // Convert ratios to distances by the longest side, which is most accurate.
            let [x, y, z] = *d;
            let size_sq = if a12 >= a01 && a12 >= a02 {
                a12 / (y * y + z * z - 2.0 * y * z * m12)
            } else if a01 >= a02 {
                a01 / (x * x + y * y - 2.0 * x * y * m01)
            } else {
                a02 / (x * x + z * z - 2.0 * x * z * m02)
            };
            let size = size_sq.sqrt();
            if !size.is_finite() {
                continue;
            }
            let mut d = [x * size, y * size, z * size];
            let fits = polish(&mut d, [a01, a02, a12], [c01, c02, c12]);
            let in_front = d[0] > 0.0 && d[1] > 0.0 && d[2] > 0.0;
            if !(fits && in_front) || count == 4 {
                continue;
            }
            let place = [rays[0] * d[0], rays[1] * d[1], rays[2] * d[2]];
            let (e1, e2) = (place[0] - place[1], place[0] - place[2]);
            let rotation = e1 * inverse[0].transpose()
                + e2 * inverse[1].transpose()
                + e1.cross(&e2) * inverse[2].transpose();
            let t = place[0] - rotation * points[0];
            // On the danger cylinder two solutions coincide, and both lines lead there.
            let known = (0..count).any(|i| {
                (depths0[i] - d[0]).abs() < SAME_DEPTH * d[0]
                    && (solutions[i].0 - rotation).norm_squared() < SAME_ROTATION * SAME_ROTATION
            });
            let finite = |value: &f64| value.is_finite();
            if !known && rotation.iter().chain(t.iter()).all(finite) {
                solutions[count] = (rotation, t);
                depths0[count] = d[0];
                count += 1;
            }
        }
    }
    count
}

/// Intersections of a line and a conic with three positive coordinates.
#[inline]
fn meet(line: &[f64; 3], conic: &Conic, points: &mut [[f64; 3]; 2]) -> usize {
    // Eliminate the largest coefficient: coordinate k = −(l_i d_i + l_j d_j)/l_k.
    let k = if line[0].abs() >= line[1].abs() && line[0].abs() >= line[2].abs() {
        0
    } else if line[1].abs() >= line[2].abs() {
        1
    } else {
        2
    };
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let (wi, wj) = (-line[i] / line[k], -line[j] / line[k]);
    const PLACE: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    let q = |a: usize, b: usize| conic[PLACE[a][b]];
    // d_i = 1, d_j = τ.
    let c0 = q(i, i) + wi * (2.0 * q(i, k) + wi * q(k, k));
    let c1 = q(i, j) + wi * q(j, k) + wj * q(i, k) + wi * wj * q(k, k);
    let c2 = q(j, j) + wj * (2.0 * q(j, k) + wj * q(k, k));
    let mut discriminant = c1 * c1 - c0 * c2;
    if discriminant < 0.0 {
        // A tangent line up to rounding.
        if discriminant < -1e-10 * (c1 * c1 + (c0 * c2).abs()) {
            return 0;
        }
        discriminant = 0.0;
    }
    let sum = -(c1 + discriminant.sqrt().copysign(c1));
    let mut count = 0;
    for tau in [sum / c2, c0 / sum] {
        if tau > 0.0 && tau.is_finite() {
            let dk = wi + wj * tau;
            if dk > 0.0 {
                points[count][i] = 1.0;
                points[count][j] = tau;
                points[count][k] = dk;
                count += 1;
            }
        }
    }
    count
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::UnitQuaternion;

    /// Random problem as from PoseLib's generator: a field of view of 75°, depths from 0.1 to 10.
    pub(crate) fn problem<const N: usize>(
        random: &mut Random,
    ) -> (RigidTransform, [Vector3<f64>; N], [Point3<f64>; N]) {
        let reach = libm::tan(37.5_f64.to_radians());
        let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
            random.normal(),
            random.normal(),
            random.normal(),
            random.normal(),
        ));
        let t = Vector3::from_fn(|_, _| random.normal());
        let cam_from_world = RigidTransform::from_parts(t.into(), rotation);
        let rays = core::array::from_fn(|_| {
            let (x, y) = (random.uniform(-reach, reach), random.uniform(-reach, reach));
            Vector3::new(x, y, 1.0).normalize()
        });
        let points = rays.map(|ray| {
            cam_from_world.inverse_transform_point(&Point3::from(ray * random.uniform(0.1, 10.0)))
        });
        (cam_from_world, rays, points)
    }

    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let (mut found, mut total) = (0, 0);
        for _ in 0..10_000 {
            let (truth, rays, points) = problem(&mut random);
            let solutions = pose_p3p(&rays, &points);
            total += solutions.len();
            found += usize::from(solutions.iter().any(|m| {
                let r = m.rotation.to_rotation_matrix().into_inner()
                    - truth.rotation.to_rotation_matrix().into_inner();
                r.norm() + (m.translation.vector - truth.translation.vector).norm() < 1e-6
            }));
            for m in &solutions {
                for (ray, x) in rays.iter().zip(&points) {
                    assert!((m * x).coords.normalize().dot(ray) > 1.0 - 1e-9);
                }
            }
        }
        println!("three points: {found} of 10000, {total} solutions");
        assert!(found >= 9990, "{found}");
    }

    #[test]
    fn degenerate_problems_end() {
        let rays = [(0.0, 0.0), (0.1, 0.0), (0.0, 0.1)].map(|(x, y)| Vector3::new(x, y, 1.0));
        let line = [0.0, 1.0, 2.0].map(|x| Point3::new(x, x, 5.0));
        let same = [Point3::new(1.0, 2.0, 3.0); 3];
        let far = [1e200, 2e200, -1e200].map(|x| Point3::new(x, x * x, 5.0));
        let nan = [Point3::new(f64::NAN, 0.0, 0.0); 3];
        for points in [line, same, far, nan] {
            assert!(pose_p3p(&rays, &points).is_empty());
        }
        let good = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point3::new(x, y, 5.0));
        for bad_rays in [
            [Vector3::z(); 3],
            [Vector3::zeros(); 3],
            [rays[0], rays[0], rays[1]],
        ] {
            for m in pose_p3p(&bad_rays, &good) {
                assert!(m.translation.vector.iter().all(|x| x.is_finite()));
            }
        }
    }
}
