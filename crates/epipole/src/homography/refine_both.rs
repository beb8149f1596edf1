//! Refinement of H with the errors of both images.

use super::refine::{moved, tangent_basis};
use super::sums_both::{Whitening, cost, linearize, whitenings};
use crate::epipolar::coordinates::Coordinates;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, minimize_fixed};
use nalgebra::{Matrix3, SVector};

/// Matches with transfer errors whitened by the noise of both images. The whitening is fixed at its
/// initial value; the caller repeats the refinement to update it.
struct BothImages<'a> {
    coordinates: &'a Coordinates,
    whitenings: Vec<Whitening>,
}

impl FixedProblem<8> for BothImages<'_> {
    type Parameters = Matrix3<f64>;

    fn accumulate(&self, h: &Matrix3<f64>, normal: &mut NormalEquations<8>) {
        let (hessian, gradient, cost) = linearize(self.coordinates, &self.whitenings, h);
        normal.cost += cost;
        normal.add_along(&tangent_basis(h), &hessian, &gradient);
    }

    fn cost(&self, h: &Matrix3<f64>) -> f64 {
        cost(self.coordinates, &self.whitenings, h)
    }

    fn plus(&self, h: &Matrix3<f64>, delta: &SVector<f64, 8>) -> Matrix3<f64> {
        moved(h, delta)
    }
}

/// Refines H in the frame of the coordinates, by least squares of the Sampson error, repeatedly
/// until H converges.
///
/// Source: Hartley & Zisserman 2004, §4.2.6.
pub(super) fn refine_by_both_images(
    coordinates: &Coordinates,
    start: &Matrix3<f64>,
    options: &LmOptions,
) -> Option<Matrix3<f64>> {
    let mut h = start / start.norm();
    let problem = BothImages {
        coordinates,
        whitenings: whitenings(coordinates, &h)?,
    };
    minimize_fixed(&problem, &mut h, options).ok()?;
    h.iter().all(|x| x.is_finite()).then_some(h)
}

#[cfg(test)]
mod tests {
    use super::super::{homography_sampson_sq, transfer};
    use super::*;
    use crate::math::random::Random;
    use crate::optim::RobustLoss;
    use crate::robust::MatchSet;
    use nalgebra::{DMatrix, DVector, Matrix2, Point2};

    /// A slanted plane: parts of image 1 are enlarged, others reduced.
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
    fn derivatives_and_error_are_those_of_sampson() {
        let mut random = Random::new(1);
        let (coordinates, h) = (noisy(&mut random, 0.01), leaning());
        // The last group of lanes must be incomplete.
        assert_ne!(coordinates.len() % 8, 0);
        let problem = BothImages {
            coordinates: &coordinates,
            whitenings: whitenings(&coordinates, &h).unwrap(),
        };
        // The square root of S⁻¹ by another method, Cholesky.
        let whitened = |i: usize, h: &Matrix3<f64>| {
            let [u1, v1, u2, v2] = coordinates.at(i);
            let pixel1 = Point2::new(u1, v1);
            let at =
                |du: f64, dv: f64| transfer(&leaning(), &Point2::new(u1 + du, v1 + dv)).unwrap();
            let step = 1e-6;
            let a = Matrix2::from_columns(&[
                (at(step, 0.0) - at(-step, 0.0)) / (2.0 * step),
                (at(0.0, step) - at(0.0, -step)) / (2.0 * step),
            ]);
            let scatter = 0.5 * (Matrix2::identity() + a * a.transpose());
            let root = scatter.cholesky().unwrap().l().try_inverse().unwrap();
            root * (transfer(h, &pixel1).unwrap() - Point2::new(u2, v2))
        };
        let mut total = 0.0;
        for i in 0..coordinates.len() {
            let [u1, v1, u2, v2] = coordinates.at(i);
            let sampson = homography_sampson_sq(&h, &Point2::new(u1, v1), &Point2::new(u2, v2));
            let ours = whitened(i, &h).norm_squared();
            total += 0.5 * ours;
            // They differ in the point at which A is evaluated: the match here, its projection by H
            // there.
            assert!(
                (ours - 2.0 * sampson).abs() < 0.1 * sampson + 1e-9,
                "{ours} {sampson}"
            );
        }
        let mut normal = NormalEquations::new();
        problem.accumulate(&h, &mut normal);
        assert!((normal.cost - total).abs() < 1e-6 * total);
        assert!((normal.cost - problem.cost(&h)).abs() < 1e-12 * total);
        // Compares gradient and Gauss–Newton matrix with differences of the residuals.
        let residuals = |delta: &DVector<f64>| {
            let h = problem.plus(&h, &SVector::from_column_slice(delta.as_slice()));
            let all = (0..coordinates.len()).flat_map(|i| whitened(i, &h).data.0[0]);
            DVector::from_vec(all.collect())
        };
        let jacobian = {
            let step = 1e-6;
            let along = |k: usize, by: f64| {
                residuals(&DVector::from_fn(8, |i, _| if i == k { by } else { 0.0 }))
            };
            let column = |k: usize| (along(k, step) - along(k, -step)) / (2.0 * step);
            DMatrix::from_columns(&(0..8).map(column).collect::<Vec<_>>())
        };
        let gradient = jacobian.transpose() * residuals(&DVector::zeros(8));
        let hessian = jacobian.transpose() * &jacobian;
        for i in 0..8 {
            assert!((gradient[i] - normal.gradient[i]).abs() < 1e-6 * gradient.amax());
            for j in 0..8 {
                let off = hessian[(i, j)] - normal.hessian[(i, j)];
                assert!(off.abs() < 1e-6 * hessian.amax(), "{i} {j}: {off}");
            }
        }
    }

    #[test]
    fn a_match_that_does_not_count_changes_nothing() {
        let mut random = Random::new(3);
        let (coordinates, h) = (noisy(&mut random, 0.01), leaning());
        let indices: Vec<_> = (0..40).collect();
        let mut weights = vec![1.0; 40];
        weights[30..].fill(0.0);
        let some = coordinates.weighted(&indices[..30], &weights[..30]);
        let with_rest = coordinates.weighted(&indices, &weights);
        let options = LmOptions::default();
        let refined = refine_by_both_images(&some, &h, &options).unwrap();
        let again = refine_by_both_images(&with_rest, &h, &options).unwrap();
        assert!((refined - again).norm() < 1e-12);
    }

    #[test]
    fn a_pixel_sent_to_infinity_is_refused() {
        let at = [(0.0, 1.0), (1.0, 1.0), (2.0, 0.0), (3.0, 5.0), (4.0, 2.0)];
        let pixels = at.map(|(u, v)| Point2::new(u, v));
        let coordinates = Coordinates::pixels(&MatchSet::new(&pixels, &pixels).unwrap());
        let h = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -2.0);
        assert!(refine_by_both_images(&coordinates, &h, &LmOptions::default()).is_none());
    }

    /// With noise in both images and a change of scale, the result is closer to the truth than that
    /// of the transfer error.
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
