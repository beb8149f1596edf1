//! Nonlinear refinement of F: minimizes the Sampson error by Levenberg–Marquardt. Also contains
//! code shared with the refinements of a pose (`refine_pose`) and of a pose with focal length
//! (`refine_focal`).

use super::coordinates::{CommonFrame, Coordinates};
use super::enforce_rank2;
use super::from_cameras::unit_norm;
use super::sampson::{EntrySums, cost, linearize};
use crate::camera::cross_matrix;
use crate::math::svd3;
use crate::optim::{FixedProblem, LmOptions, NormalEquations, RobustLoss, minimize_fixed};
use crate::robust::MatchSet;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Rotation3, SMatrix, SVector, Vector3};

/// Refines a fundamental matrix: minimizes `½ Σ ρ(e²)` over the matches, where e is the Sampson
/// error in pixels.
///
/// F stays on the seven-dimensional manifold `U diag(1, σ, 0) Vᵀ`.
///
/// * `fundamental`: initial value, for instance from
///   [`fundamental_8point`](super::fundamental_8point)
/// * `loss`: width in pixels
///
/// # Errors
/// [`Error::TooFew`], [`Error::TooFewDistinct`] for fewer than 7 matches, [`Error::Degenerate`] for
/// an initial value of rank 1 or 0, [`Error::OutOfRange`] for a loss that [`RobustLoss::check`]
/// rejects, [`Error::NotFinite`] for an initial value with a NaN error at some match, and as
/// [`MatchSet::new`]; infinities and coordinates beyond 10⁹ pixels are rejected, as every match
/// counts.
///
/// Source: Bartoli & Sturm 2004, "Nonlinear estimation of the fundamental matrix with minimal
/// parameters" (the parameters); Hartley & Zisserman 2004, §11.4.3 (the error).
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{fundamental_8point, refine_fundamental, sampson_px};
/// use epipole::optim::RobustLoss;
/// use nalgebra::{Matrix3, Point2, Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..20 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // Half a pixel of noise, alternately up and down.
/// let p2: Vec<_> = p2.iter().enumerate().map(|(i, p)| Point2::new(p.x, p.y + if i % 3 == 0 { 0.5 } else { -0.5 })).collect();
/// let cost = |f: &Matrix3<f64>| p1.iter().zip(&p2).map(|(a, b)| sampson_px(f, a, b)).map(|e| e * e).sum::<f64>();
/// let linear = fundamental_8point(&p1, &p2)?;
/// let refined = refine_fundamental(&linear, &p1, &p2, RobustLoss::Trivial)?;
/// assert!(cost(&refined) < cost(&linear));
/// assert!(refined.determinant().abs() < 1e-15);
/// # Ok(()) }
/// ```
pub fn refine_fundamental(
    fundamental: &Matrix3<f64>,
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    loss: RobustLoss,
) -> Result<Matrix3<f64>> {
    let matches = MatchSet::of_all(pixels1, pixels2)?;
    matches.at_least(7, "a refined fundamental matrix")?;
    loss.check()?;
    let frame = CommonFrame::new(&matches);
    let coordinates = Coordinates::pixels(&matches).mapped(&frame);
    let start = frame.fundamental_to_frame(&unit_norm(fundamental)?);
    let singular = svd3(&start).singular_values;
    if singular[1] <= 1e-14 * singular[0] {
        return Err(Error::Degenerate {
            what: "a refined fundamental matrix",
            why: "the start has rank 1",
        });
    }
    let refined = refine_in_frame(
        &coordinates,
        &start,
        scaled(loss, frame.scale),
        &LmOptions::default(),
    )
    .ok_or(NO_ERROR_AT_THE_START)?;
    frame.fundamental_to_pixels(&refined)
}

/// All other causes were checked before the refinement.
pub(super) const NO_ERROR_AT_THE_START: Error = Error::NotFinite {
    what: "the Sampson error of every match at the start",
};

/// Returns the same loss for residuals scaled by `factor`.
pub(crate) fn scaled(loss: RobustLoss, factor: f64) -> RobustLoss {
    match loss {
        RobustLoss::Trivial => loss,
        RobustLoss::Huber { width } => RobustLoss::Huber {
            width: width * factor,
        },
        RobustLoss::Cauchy { width } => RobustLoss::Cauchy {
            width: width * factor,
        },
        RobustLoss::Truncated { width } => RobustLoss::Truncated {
            width: width * factor,
        },
    }
}

/// Returns `Dᵀ H D` and `Dᵀ g`, where the columns of D are the derivatives of F's entries.
pub(crate) fn project<const P: usize>(
    sums: &EntrySums,
    derivatives: &SMatrix<f64, 9, P>,
    normal: &mut NormalEquations<P>,
) {
    normal.cost += sums.cost;
    normal.add_along(derivatives, &sums.hessian, &sums.gradient);
}

/// Entries row by row.
pub(super) fn flatten(m: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|i, _| m[(i / 3, i % 3)])
}

/// `F = U diag(1, σ, 0) Vᵀ`, with U and V rotations up to sign.
#[derive(Debug, Clone)]
pub(crate) struct Factored {
    u: Matrix3<f64>,
    v: Matrix3<f64>,
    sigma: f64,
}

impl Factored {
    pub(crate) fn new(f: &Matrix3<f64>) -> Option<Self> {
        let svd = svd3(f);
        let sigma = svd.singular_values[1] / svd.singular_values[0];
        sigma.is_finite().then_some(Self {
            u: svd.u,
            v: svd.v,
            sigma,
        })
    }

    pub(crate) fn matrix(&self) -> Matrix3<f64> {
        self.u.column(0) * self.v.column(0).transpose()
            + self.u.column(1) * self.v.column(1).transpose() * self.sigma
    }

    /// Returns the derivatives of F's entries by (rotation of U, rotation of V, σ), with the
    /// rotations acting from the left: `U ← exp([δ]ₓ) U`.
    pub(crate) fn derivatives(&self) -> SMatrix<f64, 9, 7> {
        let f = self.matrix();
        let mut d = SMatrix::<f64, 9, 7>::zeros();
        for axis in 0..3 {
            let generator = cross_matrix(&Vector3::ith(axis, 1.0));
            d.set_column(axis, &flatten(&(generator * f)));
            d.set_column(3 + axis, &flatten(&(f * generator.transpose())));
        }
        d.set_column(
            6,
            &flatten(&(self.u.column(1) * self.v.column(1).transpose())),
        );
        d
    }

    pub(crate) fn plus(&self, delta: &SVector<f64, 7>) -> Self {
        let rotation = |i: usize| {
            Rotation3::from_scaled_axis(Vector3::new(delta[i], delta[i + 1], delta[i + 2]))
                .into_inner()
        };
        Self {
            u: rotation(0) * self.u,
            v: rotation(3) * self.v,
            sigma: self.sigma + delta[6],
        }
    }
}

struct FundamentalProblem<'a> {
    coordinates: &'a Coordinates,
    loss: RobustLoss,
}

impl FixedProblem<7> for FundamentalProblem<'_> {
    type Parameters = Factored;

    fn accumulate(&self, factored: &Factored, normal: &mut NormalEquations<7>) {
        let sums = linearize(self.coordinates, &factored.matrix(), &self.loss);
        project(&sums, &factored.derivatives(), normal);
    }

    fn cost(&self, factored: &Factored) -> f64 {
        cost(self.coordinates, &factored.matrix(), &self.loss)
    }

    fn plus(&self, factored: &Factored, delta: &SVector<f64, 7>) -> Factored {
        factored.plus(delta)
    }
}

/// Refines F in the frame of the coordinates.
pub(crate) fn refine_in_frame(
    coordinates: &Coordinates,
    start: &Matrix3<f64>,
    loss: RobustLoss,
    options: &LmOptions,
) -> Option<Matrix3<f64>> {
    let mut factored = Factored::new(start)?;
    let problem = FundamentalProblem { coordinates, loss };
    minimize_fixed(&problem, &mut factored, options).ok()?;
    enforce_rank2(&factored.matrix()).ok()
}

#[cfg(test)]
mod tests {
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::{
        RelativePose, fundamental_8point, fundamental_from_cameras, refine_relative_pose,
        sampson_sq,
    };
    use super::*;
    use crate::camera::{Camera, Intrinsics};
    use crate::math::random::Random;
    use crate::optim::check_jacobian;
    use nalgebra::{DMatrix, DVector};

    fn noisy_matches(
        random: &mut Random,
        noise_px: f64,
    ) -> (Matrix3<f64>, Vec<Point2<f64>>, Vec<Point2<f64>>) {
        let (cam1, cam2) = random_cameras(random);
        let (mut p1, mut p2) = (Vec::new(), Vec::new());
        for _ in 0..60 {
            let point = random_point(random);
            let mut noisy = |p: Point2<f64>| {
                Point2::new(
                    p.x + noise_px * random.normal(),
                    p.y + noise_px * random.normal(),
                )
            };
            p1.push(noisy(cam1.project(&point).unwrap()));
            p2.push(noisy(cam2.project(&point).unwrap()));
        }
        (fundamental_from_cameras(&cam1, &cam2).unwrap(), p1, p2)
    }

    /// Returns the signed Sampson residuals, in the frame.
    fn residuals(coordinates: &Coordinates, f: &Matrix3<f64>) -> DVector<f64> {
        DVector::from_fn(coordinates.len(), |i, _| {
            let [u1, v1, u2, v2] = coordinates.at(i);
            let (x1, x2) = (Vector3::new(u1, v1, 1.0), Vector3::new(u2, v2, 1.0));
            let (l2, l1) = (f * x1, f.transpose() * x2);
            x2.dot(&l2) / (l2.xy().norm_squared() + l1.xy().norm_squared()).sqrt()
        })
    }

    #[test]
    fn jacobians_agree_with_differences() {
        let mut random = Random::new(1);
        for _ in 0..20 {
            let (truth, p1, p2) = noisy_matches(&mut random, 2.0);
            let matches = MatchSet::new(&p1, &p2).unwrap();
            let frame = CommonFrame::new(&matches);
            let coordinates = Coordinates::pixels(&matches).mapped(&frame);
            let factored = Factored::new(&frame.fundamental_to_frame(&truth)).unwrap();
            // One residual at a time: the Jacobian of a single match is recovered from its sums,
            // gradient = Jᵀ r.
            let at = |delta: &DVector<f64>| {
                let delta = SVector::<f64, 7>::from_column_slice(delta.as_slice());
                residuals(&coordinates, &factored.plus(&delta).matrix())
            };
            let mut analytic = DMatrix::zeros(matches.len(), 7);
            let r = residuals(&coordinates, &factored.matrix());
            for i in 0..matches.len() {
                let (a, b) = matches.pair(i);
                let one = MatchSet::new(&[a], &[b]).unwrap();
                let single = Coordinates::pixels(&one).mapped(&frame);
                let sums = linearize(&single, &factored.matrix(), &RobustLoss::Trivial);
                let mut normal = NormalEquations::new();
                project(&sums, &factored.derivatives(), &mut normal);
                analytic.set_row(i, &(normal.gradient / r[i]).transpose());
                let outer = normal.gradient * normal.gradient.transpose() / (r[i] * r[i]);
                assert!((outer - normal.hessian).amax() < 1e-9 * normal.hessian.amax());
            }
            assert!(check_jacobian(&analytic, &at, 1e-6) < 1e-6);
        }
    }

    #[test]
    fn refinement_lowers_the_error() {
        let mut random = Random::new(3);
        for _ in 0..20 {
            let (_, p1, p2) = noisy_matches(&mut random, 0.5);
            let linear = fundamental_8point(&p1, &p2).unwrap();
            let refined = refine_fundamental(&linear, &p1, &p2, RobustLoss::Trivial).unwrap();
            let total = |f: &Matrix3<f64>| -> f64 {
                p1.iter().zip(&p2).map(|(a, b)| sampson_sq(f, a, b)).sum()
            };
            assert!(total(&refined) <= total(&linear));
            // 60 residuals, 7 parameters, variance 0.25.
            assert!(total(&refined) < 0.25 * 53.0 * 2.0);
            assert!(refined.determinant().abs() < 1e-16);
        }
    }

    #[test]
    fn each_failure_has_its_own_sentence() {
        let (f, p1, p2) = noisy_matches(&mut Random::new(4), 0.5);
        let k = Intrinsics::centered(700.0, 640, 480).unwrap();
        let camera = Camera::pinhole(k, 640, 480);
        let pose = RelativePose::from((Matrix3::identity(), Vector3::x()));
        for width in [0.0, -1.0, f64::NAN] {
            for loss in [
                RobustLoss::Huber { width },
                RobustLoss::Cauchy { width },
                RobustLoss::Truncated { width },
            ] {
                let refused = loss.check().unwrap_err();
                let refined = refine_fundamental(&f, &p1, &p2, loss).unwrap_err();
                // Compare as text, since NaN does not equal itself.
                assert_eq!(refined.to_string(), refused.to_string());
                let refined =
                    refine_relative_pose(&pose, &p1, &p2, [&camera; 2], loss).unwrap_err();
                assert_eq!(refined.to_string(), refused.to_string());
            }
        }
        let loss = RobustLoss::Trivial;
        let rank1 = Vector3::new(1.0, 2.0, 3.0) * Vector3::new(0.5, -1.0, 1.0).transpose();
        for start in [rank1, Matrix3::zeros()] {
            let refined = refine_fundamental(&start, &p1, &p2, loss);
            assert!(
                matches!(refined, Err(Error::Degenerate { .. })),
                "{refined:?}"
            );
        }
        let nowhere = RelativePose {
            direction: Vector3::from_element(f64::NAN),
            ..pose
        };
        let refined = refine_relative_pose(&nowhere, &p1, &p2, [&camera; 2], loss);
        assert!(
            matches!(refined, Err(Error::NotFinite { .. })),
            "{refined:?}"
        );
    }
}
