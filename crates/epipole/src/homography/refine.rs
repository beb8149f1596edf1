//! Nonlinear refinement of H: minimizes the transfer error by Levenberg–Marquardt.

use super::sums::{cost, linearize};
use crate::epipolar::coordinates::{CommonFrame, Coordinates};
use crate::epipolar::scaled_loss;
use crate::math::null_space::null_space;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use crate::robust::MatchSet;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, SMatrix, SVector};

/// Refines a homography: minimizes `½ Σ ρ(‖x2 − H x1‖²)`, pixels; unit Frobenius norm.
///
/// H moves on the unit sphere of its nine entries, with eight parameters.
///
/// * `homography`: initial value, for instance from [`fit_homography`](super::fit_homography)
/// * `loss`: width in pixels
///
/// # Errors
/// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 4 matches, [`Error::OutOfRange`] for
/// a loss that [`RobustLoss::check`] rejects, [`Error::NotFinite`] if the initial value maps a
/// pixel to infinity, and as [`MatchSet::new`]; infinities and coordinates beyond 10⁹ pixels are
/// rejected, as every match counts.
///
/// Source: Hartley & Zisserman 2004, §4.5.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::homography::{refine_homography, transfer};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Matrix3, Point2};
/// let truth = Matrix3::new(1.2, -0.1, 40.0, 0.2, 0.9, -30.0, 6e-4, -1e-4, 1.0);
/// let p1: Vec<_> = (0..12).map(|i| Point2::new(f64::from(i % 4) * 200.0, f64::from(i / 4) * 200.0)).collect();
/// let p2: Vec<_> = p1.iter().filter_map(|p| transfer(&truth, p)).collect();
/// // An initial value that is 5 pixels off.
/// let mut start = truth;
/// start[(0, 2)] += 5.0;
/// let refined = refine_homography(&start, &p1, &p2, RobustLoss::Trivial)?;
/// assert!((refined / refined[(2, 2)] - truth).norm() < 1e-6);
/// # Ok(()) }
/// ```
pub fn refine_homography(
    homography: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    loss: RobustLoss,
) -> Result<Matrix3<f64>> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    matches.at_least(4, "a refined homography")?;
    loss.check()?;
    let frame = CommonFrame::new(&matches);
    let coordinates = Coordinates::pixels(&matches).mapped(&frame);
    refine_in_frame(
        &coordinates,
        &to_frame(&frame, homography),
        scaled_loss(loss, frame.scale),
        &LmOptions::default(),
    )
    .and_then(|h| to_pixels(&frame, &h))
    .ok_or(Error::NotFinite {
        what: "the transfer error of the start",
    })
}

pub(super) fn to_frame(frame: &CommonFrame, h: &Matrix3<f64>) -> Matrix3<f64> {
    frame.pixels_to_frame(1) * h * frame.frame_to_pixels(0)
}

/// Converts H to pixels, with unit Frobenius norm; `None` if an entry is not finite.
pub(super) fn to_pixels(frame: &CommonFrame, h: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let pixels = frame.frame_to_pixels(1) * h * frame.pixels_to_frame(0);
    let norm = pixels.norm();
    (norm.is_finite() && norm > 0.0).then(|| pixels / norm)
}

struct Problem<'a> {
    coordinates: &'a Coordinates,
    loss: RobustLoss,
}

/// Returns an orthonormal basis of the steps that preserve the norm of H.
pub(super) fn tangent_basis(h: &Matrix3<f64>) -> SMatrix<f64, 9, 8> {
    let entries: [f64; 9] = core::array::from_fn(|i| h[(i / 3, i % 3)]);
    let basis: [[f64; 9]; 8] = null_space([entries]);
    SMatrix::from_fn(|i, j| basis[j][i])
}

/// Returns H after a step along its [`tangent_basis`], with unit norm.
pub(super) fn moved(h: &Matrix3<f64>, delta: &SVector<f64, 8>) -> Matrix3<f64> {
    let step = tangent_basis(h) * delta;
    let moved = h + Matrix3::from_fn(|i, j| step[3 * i + j]);
    moved / moved.norm()
}

impl FixedProblem<8> for Problem<'_> {
    type Parameters = Matrix3<f64>;

    fn accumulate(&self, h: &Matrix3<f64>, normal: &mut NormalEquations<8>) {
        let (hessian, gradient, cost) = linearize(self.coordinates, h, &self.loss);
        normal.cost += cost;
        normal.add_along(&tangent_basis(h), &hessian, &gradient);
    }

    fn cost(&self, h: &Matrix3<f64>) -> f64 {
        cost(self.coordinates, h, &self.loss)
    }

    fn plus(&self, h: &Matrix3<f64>, delta: &SVector<f64, 8>) -> Matrix3<f64> {
        moved(h, delta)
    }
}

/// Refines H in the frame of the coordinates.
pub(super) fn refine_in_frame(
    coordinates: &Coordinates,
    start: &Matrix3<f64>,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Matrix3<f64>> {
    let mut h = start / start.norm();
    minimize_fixed(&Problem { coordinates, loss }, &mut h, options).ok()?;
    h.iter().all(|x| x.is_finite()).then_some(h)
}

#[cfg(test)]
mod tests {
    use super::super::{fit_homography, transfer, transfer_error_sq};
    use super::*;
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    fn noisy(random: &mut Random) -> (Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let truth = Matrix3::new(1.2, -0.1, 40.0, 0.2, 0.9, -30.0, 6e-4, -1e-4, 1.0);
        (0..40)
            .map(|_| {
                let p = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
                let q = transfer(&truth, &p).unwrap();
                (p, Point2::new(q.x + random.normal(), q.y + random.normal()))
            })
            .unzip()
    }

    #[test]
    fn jacobian_agrees_with_differences() {
        let mut random = Random::new(1);
        let (p1, p2) = noisy(&mut random);
        let matches = MatchSet::new(&p1, &p2).unwrap();
        let frame = CommonFrame::new(&matches);
        let all = Coordinates::pixels(&matches).mapped(&frame);
        let h = to_frame(&frame, &fit_homography(&p1, &p2).unwrap());
        let h = h / h.norm();
        // Compares gradient and Gauss–Newton matrix with differences of the residuals.
        let residuals = |delta: &DVector<f64>| {
            let delta = SVector::<f64, 8>::from_column_slice(delta.as_slice());
            let problem = Problem {
                coordinates: &all,
                loss: RobustLoss::Trivial,
            };
            let moved = problem.plus(&h, &delta);
            DVector::from_fn(2 * all.len(), |row, _| {
                let [u1, v1, u2, v2] = all.at(row / 2);
                let p = transfer(&moved, &Point2::new(u1, v1)).unwrap();
                if row % 2 == 0 { p.x - u2 } else { p.y - v2 }
            })
        };
        let basis = tangent_basis(&h);
        let analytic = DMatrix::from_fn(2 * all.len(), 8, |row, column| {
            let [u1, v1, _, _] = all.at(row / 2);
            let x = h * nalgebra::Vector3::new(u1, v1, 1.0);
            let scaled = [u1 / x.z, v1 / x.z, 1.0 / x.z];
            let shift = if row % 2 == 0 { 0 } else { 3 };
            let value = if row % 2 == 0 { x.x } else { x.y } / x.z;
            (0..3)
                .map(|i| scaled[i] * (basis[(shift + i, column)] - value * basis[(6 + i, column)]))
                .sum()
        });
        assert!(check_jacobian(&analytic, &residuals, 1e-6) < 1e-6);
        let mut normal = NormalEquations::new();
        Problem {
            coordinates: &all,
            loss: RobustLoss::Trivial,
        }
        .accumulate(&h, &mut normal);
        let r = residuals(&DVector::zeros(8));
        let gradient = analytic.transpose() * &r;
        let hessian = analytic.transpose() * &analytic;
        assert!((0..8).all(|i| (gradient[i] - normal.gradient[i]).abs() < 1e-9));
        assert!((0..64).all(|i| {
            (hessian[(i / 8, i % 8)] - normal.hessian[(i / 8, i % 8)]).abs() < 1e-9 * hessian.amax()
        }));
    }

    #[test]
    fn refinement_lowers_the_error() {
        let mut random = Random::new(2);
        for _ in 0..20 {
            let (p1, p2) = noisy(&mut random);
            let linear = fit_homography(&p1, &p2).unwrap();
            let refined = refine_homography(&linear, &p1, &p2, RobustLoss::Trivial).unwrap();
            let total = |h: &Matrix3<f64>| -> f64 {
                p1.iter()
                    .zip(&p2)
                    .map(|(a, b)| transfer_error_sq(h, a, b))
                    .sum()
            };
            assert!(total(&refined) <= total(&linear));
            assert!(total(&refined) < 2.0 * 72.0);
        }
    }

    #[test]
    fn a_loss_without_width_is_refused() {
        let (p1, p2) = noisy(&mut Random::new(3));
        let start = fit_homography(&p1, &p2).unwrap();
        for width in [0.0, -1.0, f64::NAN] {
            let refined = refine_homography(&start, &p1, &p2, RobustLoss::Truncated { width });
            assert!(
                matches!(refined, Err(Error::OutOfRange { .. })),
                "{refined:?}"
            );
        }
    }
}
