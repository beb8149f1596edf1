//! F from seven matches.

use super::Normalization;
use super::from_cameras::unit_norm;
use crate::math::null_space::null_space;
use crate::math::polynomial::cubic_roots;
use arrayvec::ArrayVec;
use nalgebra::{Matrix3, Point2};

/// Returns the row of the linear system `row · f = 0` of one match, with f the nine entries of F
/// row by row: `(u2 u1, u2 v1, u2, v2 u1, v2 v1, v2, u1, v1, 1)`.
///
/// Source: Hartley & Zisserman 2004, equation 11.2.
///
/// ```
/// use epipole::epipolar::epipolar_row;
/// use nalgebra::Point2;
/// let row = epipolar_row(&Point2::new(2.0, 3.0), &Point2::new(5.0, 7.0));
/// assert_eq!(row, [10.0, 15.0, 5.0, 14.0, 21.0, 7.0, 2.0, 3.0, 1.0]);
/// ```
pub fn epipolar_row(x1: &Point2<f64>, x2: &Point2<f64>) -> [f64; 9] {
    [
        x2.x * x1.x,
        x2.x * x1.y,
        x2.x,
        x2.y * x1.x,
        x2.y * x1.y,
        x2.y,
        x1.x,
        x1.y,
        1.0,
    ]
}

/// Solves for the one to three fundamental matrices that seven matches satisfy exactly.
///
/// The matches leave a pencil `F1 + λ F2` of matrices, and `det(F1 + λ F2) = 0` is a cubic in λ.
/// Points are normalized first (root-mean-square distance √2).
///
/// * `pixels1`, `pixels2`: matching pixels
///
/// Returns an empty list for NaN and infinities, if two matches are equal, or if all points of an
/// image are. If seven matches leave more than a pencil otherwise, as for a plane, returns some of
/// the solutions.
///
/// Source: Hartley & Zisserman 2004, §11.1.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{essential_from_motion, fundamental_7point, fundamental_from_essential};
/// use nalgebra::{Point2, Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..7 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// let seven = |p: &[Point2<f64>]| -> [Point2<f64>; 7] { core::array::from_fn(|i| p[i]) };
/// let solutions = fundamental_7point(&seven(&p1), &seven(&p2));
/// // One of them is the true one; each has rank 2 and unit Frobenius norm.
/// let truth = fundamental_from_essential(&essential_from_motion(&cam2_from_cam1)?, &k, &k)?;
/// assert!(solutions.len() <= 3);
/// assert!(solutions.iter().any(|f| (f - truth).norm().min((f + truth).norm()) < 1e-6));
/// assert!(solutions.iter().all(|f| f.determinant().abs() < 1e-12 && (f.norm() - 1.0).abs() < 1e-12));
/// # Ok(()) }
/// ```
pub fn fundamental_7point(
    pixels1: &[Point2<f64>; 7],
    pixels2: &[Point2<f64>; 7],
) -> ArrayVec<Matrix3<f64>, 3> {
    let is_repeated =
        |i: usize| (0..i).any(|j| pixels1[i] == pixels1[j] && pixels2[i] == pixels2[j]);
    if (1..7).any(is_repeated) {
        return ArrayVec::new();
    }
    let (Ok(n1), Ok(n2)) = (Normalization::new(pixels1), Normalization::new(pixels2)) else {
        return ArrayVec::new();
    };
    let rows =
        core::array::from_fn(|i| epipolar_row(&n1.apply(&pixels1[i]), &n2.apply(&pixels2[i])));
    let (mut solutions, count) = seven_point_rows(&rows);
    solutions[..count]
        .iter_mut()
        .filter_map(|f| unit_norm(&(n2.matrix().transpose() * *f * n1.matrix())).ok())
        .collect()
}

/// Solves seven rows; the solutions are not scaled.
pub(crate) fn seven_point_rows(rows: &[[f64; 9]; 7]) -> ([Matrix3<f64>; 3], usize) {
    let [f, g]: [[f64; 9]; 2] = null_space(*rows);
    // det(f + λ g) by the multilinearity of the determinant in its rows: the minors of the lower
    // two rows are quadratics in λ.
    let minor = |i: usize, j: usize| {
        let (a, b, c, d) = (3 + i, 6 + j, 3 + j, 6 + i);
        [
            f[a] * f[b] - f[c] * f[d],
            f[a] * g[b] + g[a] * f[b] - f[c] * g[d] - g[c] * f[d],
            g[a] * g[b] - g[c] * g[d],
        ]
    };
    let minors = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let mut c = [0.0; 4];
    for (k, m) in minors.iter().enumerate() {
        c[0] += f[k] * m[0];
        c[1] += f[k] * m[1] + g[k] * m[0];
        c[2] += f[k] * m[2] + g[k] * m[1];
        c[3] += g[k] * m[2];
    }
    let mut solutions = [Matrix3::zeros(); 3];
    let mut roots = [0.0; 3];
    let mut count = cubic_roots(c, &mut roots);
    for (solution, root) in solutions.iter_mut().zip(&roots[..count]) {
        *solution = Matrix3::from_fn(|i, j| f[3 * i + j] + root * g[3 * i + j]);
    }
    if count < 3 && c[3] == 0.0 && g.iter().any(|x| *x != 0.0) {
        // λ = ∞: g itself is singular.
        solutions[count] = Matrix3::from_fn(|i, j| g[3 * i + j]);
        count += 1;
    }
    (solutions, count)
}

#[cfg(test)]
mod tests {
    use super::super::essential_from_motion;
    use super::super::five_point::tests::problem;
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn ten_thousand_problems() {
        let mut random = Random::new(1);
        let (mut found, mut solutions_total) = (0, 0);
        for _ in 0..10_000 {
            let (motion, r1, r2) = problem::<7>(&mut random);
            // With K = I, rays are pixels and F is E.
            let truth = essential_from_motion(&motion).unwrap();
            let truth = truth / truth.norm();
            let pixels =
                |rays: [nalgebra::Vector3<f64>; 7]| rays.map(|r| Point2::new(r.x / r.z, r.y / r.z));
            let solutions = fundamental_7point(&pixels(r1), &pixels(r2));
            solutions_total += solutions.len();
            let near = |f: &Matrix3<f64>| (f - truth).norm().min((f + truth).norm()) < 1e-6;
            found += usize::from(solutions.iter().any(near));
        }
        println!("seven points: {found} of 10000, {solutions_total} solutions");
        assert!(found >= 9990, "{found}");
    }

    fn points<const N: usize>(flat: &[f64]) -> [Point2<f64>; N] {
        core::array::from_fn(|i| Point2::new(flat[2 * i], flat[2 * i + 1]))
    }

    /// The values of COLMAP's src/colmap/estimators/solvers/fundamental_matrix_test.cc, originally
    /// from Matlab.
    #[test]
    fn published_reference() {
        let p1 = points(&[
            0.4964, 1.0577, 0.3650, -0.0919, -0.5412, 0.0159, -0.5239, 0.9467, 0.3467, 0.5301,
            0.2797, 0.0012, -0.1986, 0.0460,
        ]);
        let p2 = points(&[
            0.7570, 2.7340, 0.3961, 0.6981, -0.6014, 0.7110, -0.7385, 2.2712, 0.4177, 1.2132,
            0.3052, 0.4835, -0.2171, 0.5057,
        ]);
        let solutions = fundamental_7point(&p1, &p2);
        assert_eq!(solutions.len(), 1);
        let f = solutions[0] / solutions[0][(2, 2)];
        #[rustfmt::skip]
        let expected = Matrix3::new(
             4.81441976, -8.16978909,  6.73133404,
             5.16247992,  0.19325606, -2.87239381,
            -9.92570126,  3.64159554,  1.0,
        );
        assert!((f - expected).amax() < 1e-6, "{f}");
        assert!(solutions[0].determinant().abs() < 1e-14);
    }

    #[test]
    fn degenerate_matches_give_finite_matrices() {
        let same = [Point2::new(3.0, 4.0); 7];
        let line: [Point2<f64>; 7] = core::array::from_fn(|i| Point2::new(i as f64, 2.0));
        let bad = [Point2::new(f64::NAN, 0.0); 7];
        assert!(fundamental_7point(&same, &same).is_empty());
        assert!(fundamental_7point(&bad, &line).is_empty());
        // Six unique matches are too few, wherever the repeated one is.
        let mut random = Random::new(4);
        let mut anywhere =
            || core::array::from_fn(|_| Point2::new(random.normal(), random.normal()));
        for (i, j) in [(0, 6), (2, 3), (1, 5)] {
            let (mut p1, mut p2): ([_; 7], [_; 7]) = (anywhere(), anywhere());
            assert!(!fundamental_7point(&p1, &p2).is_empty());
            (p1[i], p2[i]) = (p1[j], p2[j]);
            assert!(fundamental_7point(&p1, &p2).is_empty());
        }
        for f in fundamental_7point(&line, &line) {
            assert!(f.iter().all(|x| x.is_finite()));
        }
    }
}
