//! Refinement of H by what the pixels of both images are off.

use super::refine::tangent_basis;
use crate::epipolar::coordinates::Coordinates;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use nalgebra::{Matrix2, Matrix3, SMatrix, SVector, Vector2, Vector3};

/// Matches whose transfer errors are measured by the noise that both images bring about.
///
/// With the derivative A of `x(H x1)` by pixel 1, noise of the same size in both images makes the transfer error scatter as
/// `1 + A Aᵀ`. The errors are divided by the root of that at the start and keep it: its change with H is
/// left to who repeats the refinement.
struct BothImages {
    /// A match, and what its transfer error is multiplied by.
    matches: Vec<([f64; 4], Matrix2<f64>)>,
}

impl BothImages {
    /// `None` if H sends one of the pixels infinitely far away.
    fn new(coordinates: &Coordinates, start: &Matrix3<f64>) -> Option<Self> {
        let weights = coordinates.weights(0);
        let whitened = |i: usize| {
            let at = coordinates.at(i);
            let (seen, x) = transferred(start, &at);
            let a = derivative(start, &seen) * Matrix3x2::new(1.0, 0.0, 0.0, 1.0, 0.0, 0.0) / x.z;
            // (1 + A Aᵀ)⁻¹ = Lᵀ L, of which 1 and A alike make 2 where H changes no length.
            let scatter = 0.5 * (Matrix2::identity() + a * a.transpose());
            let root = scatter.cholesky()?.l().try_inverse()?;
            let weight = weights.map_or(1.0, |weights| weights[i]);
            let whitening = root * weight.sqrt();
            whitening
                .iter()
                .all(|x| x.is_finite())
                .then_some((at, whitening))
        };
        let matches = (0..coordinates.len())
            .map(whitened)
            .collect::<Option<_>>()?;
        Some(Self { matches })
    }
}

type Matrix3x2 = SMatrix<f64, 3, 2>;

/// Where H sends pixel 1, and the vector before its division.
fn transferred(h: &Matrix3<f64>, [u1, v1, _, _]: &[f64; 4]) -> (Vector2<f64>, Vector3<f64>) {
    let x = h * Vector3::new(*u1, *v1, 1.0);
    (x.xy() / x.z, x)
}

/// The derivative of a transferred pixel by (u1, v1, 1), times z.
fn derivative(h: &Matrix3<f64>, seen: &Vector2<f64>) -> SMatrix<f64, 2, 3> {
    SMatrix::<f64, 2, 3>::new(1.0, 0.0, -seen.x, 0.0, 1.0, -seen.y) * h
}

impl FixedProblem<8> for BothImages {
    type Parameters = Matrix3<f64>;

    fn accumulate(&self, h: &Matrix3<f64>, normal: &mut NormalEquations<8>) {
        let basis = tangent_basis(h);
        for (at, whitening) in &self.matches {
            let (seen, x) = transferred(h, at);
            let residual = seen - Vector2::new(at[2], at[3]);
            let by = Vector3::new(at[0], at[1], 1.0) / x.z;
            let by_entries = SMatrix::<f64, 2, 9>::from_fn(|row, entry| match entry / 3 {
                2 => -seen[row] * by[entry % 3],
                line if line == row => by[entry % 3],
                _ => 0.0,
            });
            let jacobian = whitening * by_entries * basis;
            normal.add(&(whitening * residual), &jacobian, &RobustLoss::Trivial);
        }
    }

    fn cost(&self, h: &Matrix3<f64>) -> f64 {
        let residual_sq = |(at, whitening): &([f64; 4], Matrix2<f64>)| {
            let (seen, _) = transferred(h, at);
            (whitening * (seen - Vector2::new(at[2], at[3]))).norm_squared()
        };
        0.5 * self.matches.iter().map(residual_sq).sum::<f64>()
    }

    fn plus(&self, h: &Matrix3<f64>, delta: &SVector<f64, 8>) -> Matrix3<f64> {
        let step = tangent_basis(h) * delta;
        let moved = h + Matrix3::from_fn(|i, j| step[3 * i + j]);
        moved / moved.norm()
    }
}

/// Refines H in the frame of the coordinates, by least squares of the Sampson error: once repeated, until H stays.
///
/// Source: Hartley & Zisserman 2004, §4.2.6.
pub(super) fn refine_by_both_images(
    coordinates: &Coordinates,
    start: &Matrix3<f64>,
    options: &LmOptions,
) -> Option<Matrix3<f64>> {
    let mut h = start / start.norm();
    let problem = BothImages::new(coordinates, &h)?;
    minimize_fixed(&problem, &mut h, options).ok()?;
    h.iter().all(|x| x.is_finite()).then_some(h)
}

#[cfg(test)]
mod tests {
    use super::super::{homography_sampson_sq, transfer};
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use crate::robust::MatchSet;
    use nalgebra::{DMatrix, DVector, Point2};

    /// A plane that leans away: what it shows of image 1 is enlarged here and made smaller there.
    fn leaning() -> Matrix3<f64> {
        let h = Matrix3::new(2.0, 0.3, 0.1, -0.2, 0.7, -0.2, 0.4, -0.3, 1.0);
        h / h.norm()
    }

    fn noisy(random: &mut Random, noise: f64) -> Coordinates {
        let (p1, p2): (Vec<_>, Vec<_>) = (0..60)
            .map(|_| {
                let p = Point2::new(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
                let q = transfer(&leaning(), &p).unwrap();
                let mut moved = |p: Point2<f64>| {
                    Point2::new(p.x + noise * random.normal(), p.y + noise * random.normal())
                };
                (moved(p), moved(q))
            })
            .unzip();
        Coordinates::pixels(&MatchSet::new(&p1, &p2).unwrap())
    }

    #[test]
    fn jacobian_and_error_are_those_of_sampson() {
        let mut random = Random::new(1);
        let (coordinates, h) = (noisy(&mut random, 0.01), leaning());
        let problem = BothImages::new(&coordinates, &h).unwrap();
        let residuals = |h: &Matrix3<f64>| {
            let one = |(at, whitening): &([f64; 4], Matrix2<f64>)| {
                let (seen, _) = transferred(h, at);
                let r = whitening * (seen - Vector2::new(at[2], at[3]));
                [r.x, r.y]
            };
            DVector::from_vec(problem.matches.iter().flat_map(one).collect())
        };
        // The gradient by differences, as the Jacobian of the cost.
        let cost = |delta: &DVector<f64>| {
            let delta = SVector::<f64, 8>::from_column_slice(delta.as_slice());
            DVector::from_element(1, problem.cost(&problem.plus(&h, &delta)))
        };
        let mut normal = NormalEquations::new();
        problem.accumulate(&h, &mut normal);
        let gradient = DMatrix::from_row_slice(1, 8, normal.gradient.as_slice());
        assert!(check_jacobian(&gradient, &cost, 1e-6) < 1e-6);
        let found = residuals(&h);
        for i in 0..coordinates.len() {
            let [u1, v1, u2, v2] = coordinates.at(i);
            let sampson = homography_sampson_sq(&h, &Point2::new(u1, v1), &Point2::new(u2, v2));
            let ours = found[2 * i] * found[2 * i] + found[2 * i + 1] * found[2 * i + 1];
            // They differ in where A is taken: at the match here, where H sends it there.
            assert!(
                (ours - 2.0 * sampson).abs() < 0.1 * sampson + 1e-9,
                "{ours} {sampson}"
            );
        }
    }

    /// Where both images are noisy and lengths change, it is nearer to the truth than the transfer error.
    #[test]
    fn it_is_nearer_to_the_truth() {
        use super::super::refine::refine_in_frame;
        let mut random = Random::new(2);
        let options = LmOptions::default();
        let (mut both, mut one) = (0.0, 0.0);
        for _ in 0..200 {
            let coordinates = noisy(&mut random, 0.01);
            let start = leaning();
            let off = |h: &Matrix3<f64>| (h - start).norm_squared().min((h + start).norm_squared());
            let loss = RobustLoss::Trivial;
            one += off(&refine_in_frame(&coordinates, &start, loss, &options).unwrap());
            let mut h = start;
            for _ in 0..5 {
                h = refine_by_both_images(&coordinates, &h, &options).unwrap();
            }
            both += off(&h);
        }
        assert!(both < 0.9 * one, "{both} {one}");
    }
}
