//! E from five pairs of rays.

mod cubics;
mod polish;
mod resolvent;

use self::polish::{missing_sq, polished};
use self::resolvent::Resolvent;
use super::essential::{bearing_row, rotations_and_direction, signed_depths};
use crate::math::null_space::null_space;
use crate::math::real_roots::real_roots;
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Vector3};

/// Solves for the essential matrices, at most ten, that five pairs of rays satisfy exactly; unit
/// Frobenius norm.
///
/// The rays leave `E = x E1 + y E2 + z E3 + E4`; the ten cubic equations `det E = 0` and
/// `2 E Eᵀ E − tr(E Eᵀ) E = 0` are reduced to one polynomial of degree 10 in z.
///
/// * `rays1`, `rays2`: matching rays in the camera frames; their lengths do not matter
///
/// Every matrix satisfies `2 E Eᵀ E = tr(E Eᵀ) E` to within 10⁻⁸: matrices with larger rounding
/// errors, as near double solutions, are polished or dropped. Returns an empty list if there is no
/// real solution. Degenerate rays, such as those of a camera that only rotated, have a whole family
/// of solutions: some of these are returned, or none.
///
/// Source: Nistér 2004, "An efficient solution to the five-point relative pose problem". The change
/// of basis for solutions at infinity and the final Gauss–Newton steps are ours.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{essential_5point, essential_from_motion};
/// use nalgebra::{Point3, Vector3};
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let points = [(-1.0, -1.0, 4.0), (1.0, -0.5, 5.0), (0.2, 0.1, 6.0), (-0.7, 1.0, 5.5), (1.2, 0.8, 4.5)]
///     .map(|(x, y, z)| Point3::new(x, y, z));
/// let rays1 = points.map(|x| x.coords);
/// let rays2 = points.map(|x| (cam2_from_cam1 * x).coords);
/// // Several matrices satisfy all five pairs, one of them the true one.
/// let solutions = essential_5point(&rays1, &rays2);
/// let truth = essential_from_motion(&cam2_from_cam1)?;
/// assert!(solutions.iter().any(|e| (e - truth).norm().min((e + truth).norm()) < 1e-9));
/// for e in &solutions {
///     assert!(rays1.iter().zip(&rays2).all(|(x1, x2)| x2.dot(&(e * x1)).abs() < 1e-9));
/// }
/// # Ok(()) }
/// ```
pub fn essential_5point(
    rays1: &[Vector3<f64>; 5],
    rays2: &[Vector3<f64>; 5],
) -> ArrayVec<Matrix3<f64>, 10> {
    let unit = |rays: &[Vector3<f64>; 5]| rays.map(|ray| ray.normalize());
    let mut solutions = [Matrix3::zeros(); 10];
    let count = solve(&unit(rays1), &unit(rays2), &mut solutions);
    solutions.into_iter().take(count).collect()
}

/// Returns another orthonormal basis of the same space: the reflection in a plane oblique to all
/// axes.
///
/// The solver sets the coefficient of the last basis vector to 1 and finds roots of a polynomial in
/// that of the third. Special rays, such as those of a camera that moved along its rows, have
/// solutions whose last coefficient is 0.
fn mirror_basis(basis: &[[f64; 9]; 4]) -> [[f64; 9]; 4] {
    // Of length 1; no entry is the sum or difference of others.
    const NORMAL: [f64; 4] = [0.36, -0.48, 0.64, 0.48];
    let mut mirrored = *basis;
    for i in 0..9 {
        let mut along = 0.0;
        for (n, vector) in NORMAL.iter().zip(basis) {
            along += n * vector[i];
        }
        for (n, vector) in NORMAL.iter().zip(&mut mirrored) {
            vector[i] -= 2.0 * along * n;
        }
    }
    mirrored
}

/// Polishes the basis vectors into solutions, if dependent equations have a curve of solutions or
/// more. Returns their number.
#[cold]
fn some_of_many(basis: &[[f64; 9]; 4], solutions: &mut [Matrix3<f64>; 10]) -> usize {
    let mut count = 0;
    for vector in basis {
        if let Some(essential) = polished(&Matrix3::from_row_slice(vector), basis) {
            solutions[count] = essential;
            count += 1;
        }
    }
    count
}

/// Distance below which solutions are equal.
const SAME: f64 = 1e-6;

/// Essential matrices without repetitions.
struct Solutions<'a> {
    found: &'a mut [Matrix3<f64>; 10],
    count: usize,
}

impl Solutions<'_> {
    fn push(&mut self, essential: Matrix3<f64>) {
        if self.count < self.found.len() {
            self.found[self.count] = essential;
            self.count += 1;
        }
    }

    fn contain(&self, essential: &Matrix3<f64>) -> bool {
        let same = |e: &Matrix3<f64>| {
            (e - essential)
                .norm_squared()
                .min((e + essential).norm_squared())
                < SAME * SAME
        };
        self.found[..self.count].iter().any(same)
    }
}

/// Writes the solutions, unit Frobenius norm, and returns their number.
pub(crate) fn solve(
    rays1: &[Vector3<f64>; 5],
    rays2: &[Vector3<f64>; 5],
    solutions: &mut [Matrix3<f64>; 10],
) -> usize {
    let rows: [[f64; 9]; 5] = core::array::from_fn(|i| bearing_row(&rays1[i], &rays2[i]));
    if !rows.iter().flatten().all(|x: &f64| x.is_finite()) {
        return 0;
    }
    let mut solutions = Solutions {
        found: solutions,
        count: 0,
    };
    let basis: [[f64; 9]; 4] = null_space(rows);
    if let Some(resolvent) = Resolvent::new(&basis).filter(Resolvent::has_all_degrees) {
        let complete = take_roots(&basis, &resolvent, &mut solutions);
        if complete && !resolvent.is_rough {
            return solutions.count;
        }
    }
    in_another_basis(&mirror_basis(&basis), &mut solutions);
    solutions.count
}

/// Adds the solutions that were not found in the first basis.
#[cold]
fn in_another_basis(basis: &[[f64; 9]; 4], solutions: &mut Solutions<'_>) {
    if let Some(resolvent) = Resolvent::new(basis) {
        take_roots(basis, &resolvent, solutions);
    } else if solutions.count == 0 {
        solutions.count = some_of_many(basis, solutions.found);
    }
}

/// Maximum relative error of the polynomial's coefficients.
const NOISE: f64 = 1e-8;

/// Maximum constraint residual of an accurate root. Roots are inaccurate because of a small pivot,
/// two nearly equal solutions, or an extremum that might have been two roots.
const DOUBTFUL: f64 = 1e-7;

/// Adds the matrix of each real root; returns whether these seem to be all solutions.
fn take_roots(basis: &[[f64; 9]; 4], resolvent: &Resolvent, solutions: &mut Solutions<'_>) -> bool {
    let mut roots = [0.0; 10];
    let num_roots = real_roots(&resolvent.polynomial, NOISE, &mut roots);
    // Real roots come in pairs, unless two have merged.
    let mut complete = num_roots.is_multiple_of(2);
    let is_first_basis = solutions.count == 0;
    let (mut astray, mut num_astray) = ([Matrix3::zeros(); 10], 0);
    for &z in &roots[..num_roots] {
        let (x, y) = resolvent.others(z);
        let essential = Matrix3::from_fn(|i, j| {
            let k = 3 * i + j;
            x * basis[0][k] + y * basis[1][k] + z * basis[2][k] + basis[3][k]
        });
        let norm = essential.norm();
        if !(norm.is_finite() && norm > 0.0) {
            complete = false;
            continue;
        }
        let essential = essential / norm;
        if missing_sq(&essential) > DOUBTFUL * DOUBTFUL {
            complete = false;
            astray[num_astray] = essential;
            num_astray += 1;
        } else if let Some(essential) = polished(&essential, basis)
            && (is_first_basis || !solutions.contain(&essential))
        {
            solutions.push(essential);
        }
    }
    for essential in &astray[..num_astray] {
        if let Some(essential) = polished(essential, basis)
            && !solutions.contain(&essential)
        {
            solutions.push(essential);
        }
    }
    complete
}

/// Depth of a point whose rays are parallel up to rounding.
const NO_DEPTH: f64 = 1e-12;

/// Returns the motion (R, t) of an essential matrix that puts all points in front of both cameras.
/// Points at infinity are in front if their rays are parallel; they alone do not determine the sign
/// of t.
pub(crate) fn pose_in_front(
    essential: &Matrix3<f64>,
    rays1: &[Vector3<f64>],
    rays2: &[Vector3<f64>],
) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let (rotations, direction) = rotations_and_direction(essential)?;
    rotations.iter().find_map(|rotation| {
        let side = side_in_front(rotation, &direction, rays1, rays2)?;
        Some((*rotation, direction * side))
    })
}

/// Returns the sign of t that puts all points in front of both cameras, if any.
pub(crate) fn side_in_front(
    rotation: &Matrix3<f64>,
    direction: &Vector3<f64>,
    rays1: &[Vector3<f64>],
    rays2: &[Vector3<f64>],
) -> Option<f64> {
    // Reversing t flips the signs of both depths.
    let (mut along, mut against) = (true, true);
    for (x1, x2) in rays1.iter().zip(rays2) {
        let (d1, d2) = signed_depths(rotation, direction, x1, x2);
        if d1.abs().max(d2.abs()) < NO_DEPTH && (rotation * x1).dot(x2) > 0.0 {
            continue;
        }
        along &= d1 > 0.0 && d2 > 0.0;
        against &= d1 < 0.0 && d2 < 0.0;
        if !(along || against) {
            return None;
        }
    }
    Some(if along { 1.0 } else { -1.0 })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::essential_from_motion;
    use super::*;
    use crate::camera::RigidTransform;
    use crate::math::random::Random;
    use nalgebra::{Point3, UnitQuaternion};

    /// Random problem as from PoseLib's generator: a field of view of 75°, depths from 0.1 to 10.
    pub(crate) fn problem<const N: usize>(
        random: &mut Random,
    ) -> (RigidTransform, [Vector3<f64>; N], [Vector3<f64>; N]) {
        let reach = libm::tan(37.5_f64.to_radians());
        loop {
            let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
                random.normal(),
                random.normal(),
                random.normal(),
                random.normal(),
            ));
            let t = Vector3::from_fn(|_, _| random.normal()).normalize();
            let motion = RigidTransform::from_parts(t.into(), rotation);
            let (mut r1, mut r2) = ([Vector3::z(); N], [Vector3::z(); N]);
            let mut count = 0;
            // Random views need not overlap.
            for _ in 0..100 {
                let (x, y) = (random.uniform(-reach, reach), random.uniform(-reach, reach));
                let ray = Vector3::new(x, y, 1.0).normalize();
                let in_cam2 = motion * Point3::from(ray * random.uniform(0.1, 10.0));
                if in_cam2.z > 0.0
                    && in_cam2.x.abs() < reach * in_cam2.z
                    && in_cam2.y.abs() < reach * in_cam2.z
                {
                    (r1[count], r2[count]) = (ray, in_cam2.coords.normalize());
                    count += 1;
                    if count == N {
                        return (motion, r1, r2);
                    }
                }
            }
        }
    }

    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let (mut found, mut found_pose, mut solutions_total) = (0, 0, 0);
        for _ in 0..10_000 {
            let (motion, r1, r2) = problem(&mut random);
            let truth = essential_from_motion(&motion).unwrap();
            let solutions = essential_5point(&r1, &r2);
            solutions_total += solutions.len();
            let near = |e: &Matrix3<f64>| (e - truth).norm().min((e + truth).norm()) < 1e-6;
            found += usize::from(solutions.iter().any(near));
            let rotation = motion.rotation.to_rotation_matrix().into_inner();
            let t = motion.translation.vector;
            found_pose += usize::from(solutions.iter().any(|e| {
                pose_in_front(e, &r1, &r2)
                    .is_some_and(|(r, d)| (r - rotation).norm() + (d - t).norm() < 1e-6)
            }));
        }
        println!("five points: {found} of 10000, poses {found_pose}, {solutions_total} solutions");
        assert!(found >= 9999, "{found}");
        assert!(found_pose >= 9999, "{found_pose}");
    }

    /// A motion and points of whole numbers with at most four digits, as in exercises and figures.
    fn whole_problem(
        random: &mut Random,
    ) -> (RigidTransform, [Vector3<f64>; 5], [Vector3<f64>; 5]) {
        loop {
            let mut whole = |reach: usize| random.below(2 * reach + 1) as f64 - reach as f64;
            // A rotation of rational numbers, and a translation.
            let axis = Vector3::from_fn(|_, _| whole(2));
            let t = Vector3::from_fn(|_, _| whole(3));
            let w = whole(3);
            let q = nalgebra::Quaternion::new(w, axis.x, axis.y, axis.z);
            if q.norm() == 0.0 || t.norm() == 0.0 {
                continue;
            }
            let motion = RigidTransform::from_parts(t.into(), UnitQuaternion::from_quaternion(q));
            let points: [Point3<f64>; 5] =
                core::array::from_fn(|_| Point3::new(whole(5), whole(5), 6.0 + whole(4)));
            let rays = (
                points.map(|x| x.coords),
                points.map(|x| (motion * x).coords),
            );
            if rays.1.iter().all(|ray| ray.norm() > 1e-9) {
                return (motion, rays.0, rays.1);
            }
        }
    }

    /// Distance of the true solution from a degenerate one: the smallest singular value of the five
    /// equations' derivatives along the five directions in which E can move.
    fn isolation(
        motion: &RigidTransform,
        rays1: &[Vector3<f64>; 5],
        rays2: &[Vector3<f64>; 5],
    ) -> f64 {
        let rotation = motion.rotation.to_rotation_matrix().into_inner();
        let t = motion.translation.vector.normalize();
        let (side, up) = {
            let side = crate::math::svd3::perpendicular(&t);
            (side, t.cross(&side))
        };
        let e = t.cross_matrix() * rotation;
        let along = [
            e * Vector3::x().cross_matrix(),
            e * Vector3::y().cross_matrix(),
            e * Vector3::z().cross_matrix(),
            side.cross_matrix() * rotation,
            up.cross_matrix() * rotation,
        ];
        let derivatives = nalgebra::Matrix5::from_fn(|i, j| {
            rays2[i].normalize().dot(&(along[j] * rays1[i].normalize()))
        });
        derivatives.singular_values().min()
    }

    type Problem = (RigidTransform, [Vector3<f64>; 5], [Vector3<f64>; 5]);

    /// Returns the number of problems whose true solution is not found, and of those that have one.
    fn lost_problems(num_problems: usize, mut draw: impl FnMut() -> Problem) -> (usize, usize) {
        let (mut lost, mut judged) = (0, 0);
        for place in 0..num_problems {
            let (motion, r1, r2) = draw();
            let isolation = isolation(&motion, &r1, &r2);
            if isolation < 1e-5 {
                continue;
            }
            judged += 1;
            let truth = essential_from_motion(&motion).unwrap();
            let off = |e: &Matrix3<f64>| (e - truth).norm().min((e + truth).norm());
            let solutions = essential_5point(&r1, &r2);
            let nearest = solutions.iter().map(off).fold(f64::INFINITY, f64::min);
            if nearest > 1e-8 / isolation.min(0.01) {
                lost += 1;
                println!("{place}: {nearest:.1e} with isolation {isolation:.1e}");
            }
        }
        println!("{lost} lost of {judged}");
        (lost, judged)
    }

    #[test]
    fn no_problem_is_lost() {
        let mut random = Random::new(5);
        assert_eq!(lost_problems(20_000, || problem(&mut random)).0, 0);
        let (lost, judged) = lost_problems(20_000, || whole_problem(&mut random));
        assert!(lost == 0 && judged > 10_000, "{lost} of {judged}");
    }

    #[test]
    #[ignore = "half a minute: to be run by hand after changes"]
    fn none_of_a_million_problems_is_lost() {
        let mut random = Random::new(6);
        assert_eq!(lost_problems(1_000_000, || problem(&mut random)).0, 0);
        assert_eq!(lost_problems(1_000_000, || whole_problem(&mut random)).0, 0);
    }

    /// Returns the constraint residual of a matrix of unit norm.
    fn missing(e: &Matrix3<f64>) -> f64 {
        (e * e.transpose() * e * 2.0 - e * (e * e.transpose()).trace()).norm()
    }

    #[test]
    fn solutions_are_essential_and_fit() {
        let mut random = Random::new(2);
        for _ in 0..10_000 {
            let (_, r1, r2) = problem(&mut random);
            for e in essential_5point(&r1, &r2) {
                assert!(e.determinant().abs() < 1e-8);
                assert!(missing(&e) < 1e-8, "{}", missing(&e));
                for (x1, x2) in r1.iter().zip(&r2) {
                    assert!(x2.dot(&(e * x1)).abs() < 1e-9);
                }
            }
        }
    }

    /// Translations along the axes after rotations between axes: many entries of E are zero.
    #[test]
    fn aligned_cameras_are_found() {
        let mut random = Random::new(3);
        let quarter = core::f64::consts::FRAC_PI_2;
        for (roll, t) in [
            (0.0, Vector3::x()),
            (0.0, Vector3::y()),
            (0.0, Vector3::z()),
            (quarter, Vector3::x()),
            (-quarter, Vector3::y()),
            (2.0 * quarter, Vector3::x()),
            (2.0 * quarter, Vector3::z()),
        ] {
            let motion = RigidTransform::new(t, Vector3::z() * roll);
            let truth = essential_from_motion(&motion).unwrap();
            let mut found = 0;
            for _ in 0..1000 {
                let mut draw = || random.uniform(-3.0, 3.0);
                let points: [Point3<f64>; 5] =
                    core::array::from_fn(|_| Point3::new(draw(), draw(), 6.0 + 0.7 * draw()));
                let rays1 = points.map(|x| x.coords);
                let rays2 = points.map(|x| (motion * x).coords);
                let solutions = essential_5point(&rays1, &rays2);
                assert!(solutions.iter().all(|e| missing(e) < 1e-8));
                let near = |e: &Matrix3<f64>| (e - truth).norm().min((e + truth).norm()) < 1e-6;
                found += usize::from(solutions.iter().any(near));
            }
            assert!(
                found >= 990,
                "{found} of 1000: roll {roll}, {:?}",
                t.as_slice()
            );
        }
    }

    #[test]
    fn a_rotation_is_found_though_it_has_no_direction() {
        let mut random = Random::new(4);
        for angle in [0.0, 0.3] {
            let motion = RigidTransform::rotation(Vector3::new(0.1, 1.0, -0.2) * angle);
            let rotation = motion.rotation.to_rotation_matrix().into_inner();
            let mut found = 0;
            for _ in 0..200 {
                let mut draw = || random.uniform(-0.5, 0.5);
                let rays1: [_; 5] =
                    core::array::from_fn(|_| Vector3::new(draw(), draw(), 1.0).normalize());
                let rays2 = rays1.map(|ray| rotation * ray);
                let solutions = essential_5point(&rays1, &rays2);
                assert!(solutions.iter().all(|e| missing(e) < 1e-8));
                let is_rotation = |e: &Matrix3<f64>| {
                    pose_in_front(e, &rays1, &rays2)
                        .is_some_and(|(r, _)| (r - rotation).norm() < 1e-6)
                };
                found += usize::from(solutions.iter().any(is_rotation));
            }
            assert!(found >= 190, "{found} of 200");
        }
    }

    #[test]
    fn degenerate_rays_give_finite_matrices() {
        let same = [Vector3::z(); 5];
        let line: [Vector3<f64>; 5] = core::array::from_fn(|i| Vector3::new(i as f64, 0.0, 5.0));
        let bad = [Vector3::from_element(f64::NAN); 5];
        for (a, b) in [
            (same, same),
            (line, line),
            (same, line),
            (bad, line),
            (line, bad),
        ] {
            for e in essential_5point(&a, &b) {
                assert!(e.iter().all(|x| x.is_finite()));
            }
        }
    }
}
