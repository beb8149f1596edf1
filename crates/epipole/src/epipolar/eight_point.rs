//! F from eight or more matches, by linear least squares.

use super::from_cameras::unit_norm;
use super::{Normalization, epipolar_row};
use crate::math::null_space::{Reflections, right_singular_vectors};
use crate::math::scaling::power_of_two;
use crate::math::svd3;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// Result and diagnostics of the eight-point algorithm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EightPoint {
    /// F with rank 2 and unit Frobenius norm.
    pub fundamental: Matrix3<f64>,
    /// The least-squares solution before the rank constraint, unit norm.
    pub full_rank: Matrix3<f64>,
    /// The singular values of the n × 9 system, largest first.
    pub singular_values: [f64; 9],
    /// `σ₁ / σ₈`: maximum amplification of data errors. σ₉ belongs to the solution.
    pub condition_number: f64,
}

/// Estimates the fundamental matrix that minimizes `Σ (x2ᵀ F x1)²`, by the normalized eight-point
/// algorithm.
///
/// Points of each image are translated and scaled so that their root-mean-square distance from the
/// origin is √2; then the system of [`epipolar_row`](super::epipolar_row)s is solved by a singular
/// value decomposition, the smallest singular value of the solution is set to 0, and the
/// normalization is undone.
///
/// * `pixels1`, `pixels2`: at least 8 matching pixels
///
/// # Errors
/// [`Error::TooFew`] for fewer than 8 matches, [`Error::SizeMismatch`] for lists of different
/// length, [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if the matches do not
/// determine F: all on a plane or on a line, equal, or from a camera that only rotated.
///
/// Source: Hartley 1997, "In defense of the eight-point algorithm".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::fundamental_8point;
/// use nalgebra::Point2;
/// // A step to the right past points of different depth: each keeps its row.
/// let p1 = [(0.0, 0.0), (90.0, 10.0), (15.0, 80.0), (70.0, 60.0), (40.0, 30.0), (20.0, 55.0),
///     (85.0, 95.0), (5.0, 35.0)].map(|(u, v)| Point2::new(u, v));
/// let shifts = [7.0, 3.0, 9.0, 4.0, 11.0, 2.0, 6.0, 13.0];
/// let p2: [Point2<f64>; 8] = core::array::from_fn(|i| Point2::new(p1[i].x - shifts[i], p1[i].y));
/// let f = fundamental_8point(&p1, &p2)?;
/// assert!((f[(1, 2)] / f[(2, 1)] + 1.0).abs() < 1e-9 && f[(0, 0)].abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn fundamental_8point(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<Matrix3<f64>> {
    let (n1, n2) = (
        Normalization::new(check(pixels1, pixels2)?.0)?,
        Normalization::new(pixels2)?,
    );
    if let Some(f) = exact(pixels1, pixels2, &n1, &n2) {
        return f;
    }
    Ok(solve(pixels1, pixels2, &n1, &n2)?.fundamental)
}

/// Runs [`fundamental_8point`] and returns its intermediate results.
///
/// # Errors
/// As [`fundamental_8point`].
///
/// Source: as [`fundamental_8point`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::{fundamental_8point, fundamental_8point_explained};
/// use nalgebra::Point2;
/// // A step to the right past points of different depth: each keeps its row.
/// let p1 = [(0.0, 0.0), (90.0, 10.0), (15.0, 80.0), (70.0, 60.0), (40.0, 30.0), (20.0, 55.0),
///     (85.0, 95.0), (5.0, 35.0)].map(|(u, v)| Point2::new(u, v));
/// let shifts = [7.0, 3.0, 9.0, 4.0, 11.0, 2.0, 6.0, 13.0];
/// let p2: [Point2<f64>; 8] = core::array::from_fn(|i| Point2::new(p1[i].x - shifts[i], p1[i].y));
/// let explained = fundamental_8point_explained(&p1, &p2)?;
/// // Exact matches: the ninth singular value is 0, and the solution already has rank 2.
/// assert!(explained.singular_values[8] < 1e-12 && explained.singular_values[7] > 1e-3);
/// assert!(explained.full_rank.determinant().abs() < 1e-12);
/// let f = fundamental_8point(&p1, &p2)?;
/// assert!((f - explained.fundamental).norm().min((f + explained.fundamental).norm()) < 1e-9);
/// # Ok(()) }
/// ```
pub fn fundamental_8point_explained(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<EightPoint> {
    check(pixels1, pixels2)?;
    let (n1, n2) = (Normalization::new(pixels1)?, Normalization::new(pixels2)?);
    solve(pixels1, pixels2, &n1, &n2)
}

/// Runs the eight-point algorithm without normalization, for comparison: with pixels around 1000
/// the columns of the system differ by 10⁶ in size, which amplifies noise accordingly.
///
/// # Errors
/// As [`fundamental_8point`].
///
/// Source: Longuet-Higgins 1981.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::{fundamental_8point_explained, fundamental_8point_unnormalized};
/// use nalgebra::Point2;
/// let p1 = [(0.0, 0.0), (90.0, 10.0), (15.0, 80.0), (70.0, 60.0), (40.0, 30.0), (20.0, 55.0),
///     (85.0, 95.0), (5.0, 35.0)].map(|(u, v)| Point2::new(u, v));
/// let shifts = [7.0, 3.0, 9.0, 4.0, 11.0, 2.0, 6.0, 13.0];
/// let p2: [Point2<f64>; 8] = core::array::from_fn(|i| Point2::new(p1[i].x - shifts[i], p1[i].y));
/// let (raw, normalized) =
///     (fundamental_8point_unnormalized(&p1, &p2)?, fundamental_8point_explained(&p1, &p2)?);
/// // Even with pixels below 100, errors may be amplified a hundred times more.
/// assert!(raw.condition_number > 100.0 * normalized.condition_number);
/// # Ok(()) }
/// ```
pub fn fundamental_8point_unnormalized(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
) -> Result<EightPoint> {
    check(pixels1, pixels2)?;
    let identity = Normalization::identity();
    solve(pixels1, pixels2, &identity, &identity)
}

/// Returns the nearest matrix of rank 2, in Frobenius norm: the smallest singular value becomes 0.
///
/// # Errors
/// [`Error::NotFinite`] for NaN and infinities, and for entries so large that those of the result
/// overflow.
///
/// Source: Hartley & Zisserman 2004, §11.1.1.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::epipolar::enforce_rank2;
/// use nalgebra::{Matrix3, Vector3};
/// let nearest = enforce_rank2(&Matrix3::from_diagonal(&Vector3::new(3.0, 0.1, -2.0)))?;
/// assert_eq!(nearest, Matrix3::from_diagonal(&Vector3::new(3.0, 0.0, -2.0)));
/// # Ok(()) }
/// ```
pub fn enforce_rank2(matrix: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    let size = power_of_two(matrix.amax());
    let mut svd = svd3(&(matrix / size));
    svd.singular_values[2] = 0.0;
    let nearest = svd.u * Matrix3::from_diagonal(&svd.singular_values) * svd.v.transpose() * size;
    if nearest.iter().all(|x| x.is_finite()) {
        Ok(nearest)
    } else {
        Err(Error::NotFinite {
            what: "a matrix and the nearest one of rank 2",
        })
    }
}

type Pixels<'a> = (&'a [Point2<f64>], &'a [Point2<f64>]);

fn check<'a>(pixels1: &'a [Point2<f64>], pixels2: &'a [Point2<f64>]) -> Result<Pixels<'a>> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    if pixels1.len() < 8 {
        return Err(Error::TooFew {
            what: "the eight-point algorithm",
            needed: 8,
            got: pixels1.len(),
        });
    }
    if !pixels1
        .iter()
        .chain(pixels2)
        .all(|p| p.x.is_finite() && p.y.is_finite())
    {
        return Err(Error::NotFinite {
            what: "a matched pixel",
        });
    }
    Ok((pixels1, pixels2))
}

/// Computes F from exactly eight matches as the vector orthogonal to the rows, in a tenth of the
/// time of an SVD. `None` for more matches, and for a row so close to a combination of the previous
/// ones that only singular values show whether the matches determine F.
fn exact(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    n1: &Normalization,
    n2: &Normalization,
) -> Option<Result<Matrix3<f64>>> {
    let (pixels1, pixels2): (&[_; 8], &[_; 8]) =
        (pixels1.try_into().ok()?, pixels2.try_into().ok()?);
    let rows =
        core::array::from_fn(|i| epipolar_row(&n1.apply(&pixels1[i]), &n2.apply(&pixels2[i])));
    let reflections = Reflections::<8, 9>::new(rows);
    let most = reflections
        .left
        .iter()
        .fold(0.0, |most: f64, &x| most.max(x));
    if !reflections.left.iter().all(|&left| left > 1e-4 * most) {
        return None;
    }
    let [solution]: [[f64; 9]; 1] = reflections.null_space();
    Some(
        enforce_rank2(&Matrix3::from_row_slice(&solution))
            .and_then(|f| unit_norm(&(n2.matrix().transpose() * f * n1.matrix()))),
    )
}

fn solve(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    n1: &Normalization,
    n2: &Normalization,
) -> Result<EightPoint> {
    let (singular_values, vectors) = right_singular_vectors(pixels1.len(), |i| {
        epipolar_row(&n1.apply(&pixels1[i]), &n2.apply(&pixels2[i]))
    });
    let condition_number = singular_values[0] / singular_values[7];
    // With σ₈ = 0 there is a pencil of solutions. Unnormalized systems are badly conditioned
    // without being degenerate.
    if !condition_number.is_finite() || condition_number > 1e13 {
        return Err(Error::Degenerate {
            what: "the fundamental matrix",
            why: "the matches fit many: they lie on a plane or a line, or the camera only rotated",
        });
    }
    let solution = Matrix3::from_row_slice(&vectors[8]);
    let undo = |f: &Matrix3<f64>| unit_norm(&(n2.matrix().transpose() * f * n1.matrix()));
    Ok(EightPoint {
        fundamental: undo(&enforce_rank2(&solution)?)?,
        full_rank: undo(&solution)?,
        singular_values,
        condition_number,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Intrinsics, RigidTransform};
    use crate::epipolar::{
        essential_from_motion, five_point, fundamental_7point, fundamental_from_essential,
        sampson_sq,
    };
    use crate::math::random::Random;
    use nalgebra::{Point3, UnitQuaternion, Vector3};

    /// The values of COLMAP's src/colmap/estimators/solvers/fundamental_matrix_test.cc, originally
    /// from Matlab.
    #[test]
    fn published_reference() {
        let points = |flat: &[f64]| -> Vec<Point2<f64>> {
            flat.chunks(2).map(|p| Point2::new(p[0], p[1])).collect()
        };
        let p1 = points(&[
            1.839035, 1.924743, 0.543582, 0.375221, 0.473240, 0.142522, 0.964910, 0.598376,
            0.102388, 0.140092, 15.994343, 9.622164, 0.285901, 0.430055, 0.091150, 0.254594,
        ]);
        let p2 = points(&[
            1.002114, 1.129644, 1.521742, 1.846002, 1.084332, 0.275134, 0.293328, 0.588992,
            0.839509, 0.087290, 1.779735, 1.116857, 0.878616, 0.602447, 0.642616, 1.028681,
        ]);
        let f = fundamental_8point(&p1, &p2).unwrap();
        #[rustfmt::skip]
        let expected = Matrix3::new(
            -9.85701,  18.97038, -1.55224,
            -3.24832,   2.04346,  0.977619,
            11.22355, -19.43171,  1.0,
        );
        assert!((f / f[(2, 2)] - expected).amax() < 1e-5, "{f}");
        assert!((f.norm() - 1.0).abs() < 1e-14);
    }

    /// A random problem as in that test: coordinates scaled by `scale`, noise on image 2.
    fn problem(
        random: &mut Random,
        num_points: usize,
        scale: f64,
        noise: f64,
    ) -> (Matrix3<f64>, Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let k = Intrinsics::new(
            scale * random.uniform(800.0, 1200.0),
            scale * random.uniform(800.0, 1200.0),
            scale * random.uniform(400.0, 600.0),
            scale * random.uniform(400.0, 600.0),
        )
        .unwrap();
        let mut normal = || random.normal();
        let axis = nalgebra::Quaternion::new(normal(), normal(), normal(), normal());
        let rotation = UnitQuaternion::from_quaternion(axis);
        let t = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
        let motion = RigidTransform::from_parts(t.into(), rotation);
        let (mut p1, mut p2) = (Vec::new(), Vec::new());
        while p1.len() < num_points {
            let ray = Vector3::new(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0);
            let x = k.matrix() * (motion * Point3::from(ray * random.uniform(0.2, 2.0)));
            let pixel2 = Point2::new(x.x / x.z, x.y / x.z);
            let first = k.matrix() * ray;
            p1.push(first.xy().into());
            p2.push(Point2::new(
                pixel2.x + noise * random.uniform(-1.0, 1.0),
                pixel2.y + noise * random.uniform(-1.0, 1.0),
            ));
        }
        let e = essential_from_motion(&motion).unwrap();
        (fundamental_from_essential(&e, &k, &k).unwrap(), p1, p2)
    }

    /// Difference up to scale, as in COLMAP: divided by the last entry, relative norm.
    fn difference(f: &Matrix3<f64>, truth: &Matrix3<f64>) -> f64 {
        let (f, truth) = (f / f[(2, 2)], truth / truth[(2, 2)]);
        (f - truth).norm() / truth.norm().min(f.norm())
    }

    #[test]
    fn published_nominal_stability_and_noise() {
        for (scale, noise, f_tolerance, r_tolerance) in [
            (1.0, 0.0, 1e-6, 1e-6),
            (1e3, 0.0, 1e-4, 1e-4),
            (1.0, 1e-4, 1e-3, 1e-2),
        ] {
            for num_points in [8, 64, 1024] {
                let mut random = Random::new(1);
                let (mut worst, mut over): (f64, usize) = (0.0, 0);
                for _ in 0..100 {
                    let (truth, p1, p2) = problem(&mut random, num_points, scale, noise);
                    let f = fundamental_8point(&p1, &p2).unwrap();
                    let off = difference(&f, &truth);
                    worst = worst.max(off);
                    over += usize::from(off >= f_tolerance);
                    for (x1, x2) in p1.iter().zip(&p2) {
                        assert!(sampson_sq(&f, x1, x2) < r_tolerance);
                    }
                }
                println!("{num_points} {scale} {noise}: worst {worst:e}, over {over}");
                assert_eq!(over, 0, "{num_points} {scale} {noise}: {worst}");
            }
        }
    }

    /// Problems as from PoseLib's generator. With K = I, rays are pixels and F is E.
    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let mut found = 0;
        for _ in 0..10_000 {
            let (motion, r1, r2) = five_point::tests::problem::<8>(&mut random);
            let truth = essential_from_motion(&motion).unwrap();
            let truth = truth / truth.norm();
            let pixels = |rays: [Vector3<f64>; 8]| rays.map(|r| Point2::new(r.x / r.z, r.y / r.z));
            found += usize::from(
                fundamental_8point(&pixels(r1), &pixels(r2))
                    .is_ok_and(|f| (f - truth).norm().min((f + truth).norm()) < 1e-6),
            );
        }
        println!("eight points: {found} of 10000");
        assert!(found >= 9990, "{found}");
    }

    #[test]
    fn seven_points_find_the_truth() {
        let mut random = Random::new(3);
        for trial in 0..100 {
            let (truth, p1, p2) = problem(&mut random, 7, 1.0, 0.0);
            let (p1, p2) = (
                core::array::from_fn(|i| p1[i]),
                core::array::from_fn(|i| p2[i]),
            );
            let best = fundamental_7point(&p1, &p2)
                .iter()
                .map(|f| difference(f, &truth))
                .fold(f64::INFINITY, f64::min);
            assert!(best < 1e-6, "{trial}: {best}");
        }
    }

    #[test]
    fn both_ways_to_solve_for_eight_agree() {
        let mut random = Random::new(4);
        let mut exact_ones = 0;
        for trial in 0..1000 {
            let (_, p1, p2) = problem(&mut random, 8, 1.0, 1.0);
            let n = [&p1, &p2].map(|p| Normalization::new(p).unwrap());
            let Some(exact) = exact(&p1, &p2, &n[0], &n[1]) else {
                continue;
            };
            exact_ones += 1;
            let (exact, explained) = (
                exact.unwrap(),
                fundamental_8point_explained(&p1, &p2).unwrap(),
            );
            let f = explained.fundamental;
            let off = (exact - f).norm().min((exact + f).norm());
            assert!(off < 1e-13 * explained.condition_number, "{trial}: {off:e}");
        }
        assert!(exact_ones > 900, "{exact_ones}");
    }

    #[test]
    fn normalization_improves_the_condition() {
        let (_, p1, p2) = problem(&mut Random::new(5), 50, 1.0, 0.0);
        let with = fundamental_8point_explained(&p1, &p2).unwrap();
        let without = fundamental_8point_unnormalized(&p1, &p2).unwrap();
        assert!(without.condition_number > 1000.0 * with.condition_number);
        assert!(without.singular_values[0] > without.singular_values[7]);
        assert!(with.fundamental.determinant().abs() < 1e-15);
    }

    #[test]
    fn rank_2_of_matrices_of_any_size() {
        let m = Matrix3::new(1.0, 2.0, -0.5, 0.3, -1.5, 0.7, 1.1, 0.2, -0.9);
        let nearest = enforce_rank2(&m).unwrap();
        assert!(nearest.determinant().abs() < 1e-15);
        for size in [1e-300, 1e300] {
            assert!((enforce_rank2(&(m * size)).unwrap() / size - nearest).amax() < 1e-14);
        }
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(enforce_rank2(&Matrix3::from_element(bad)).is_err());
        }
    }

    #[test]
    fn degenerate_matches_are_refused() {
        let mut random = Random::new(6);
        let p1: Vec<_> = (0..20)
            .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
            .collect();
        // A plane: any homography. The identity, no motion, is one as well.
        let h = Matrix3::new(1.1, 0.02, 5.0, -0.01, 0.95, -3.0, 1e-4, -2e-4, 1.0);
        let plane: Vec<_> = p1
            .iter()
            .map(|p| Point2::from_homogeneous(h * p.to_homogeneous()).unwrap())
            .collect();
        let line: Vec<_> = (0..20).map(|i| Point2::new(f64::from(i), 3.0)).collect();
        let same = vec![Point2::new(1.0, 2.0); 20];
        for p2 in [&plane, &p1, &same] {
            assert!(fundamental_8point(&p1, p2).is_err());
            assert!(fundamental_8point(&p1[..8], &p2[..8]).is_err());
        }
        assert!(fundamental_8point(&line, &line).is_err());
        assert!(fundamental_8point(&line[..8], &line[..8]).is_err());
        assert!(fundamental_8point(&p1[..7], &plane[..7]).is_err());
        assert!(fundamental_8point(&p1, &plane[..9]).is_err());
        let mut bad = p1.clone();
        bad[4].x = f64::NAN;
        assert!(fundamental_8point(&bad, &plane).is_err());
    }
}
