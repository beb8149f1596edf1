//! Problems with a compile-time number of parameters: no allocation.

use super::levenberg_marquardt::{
    DampedStep, Linearization, LmOptions, LmReport, System, minimize_visiting,
};
use super::loss::RobustLoss;
use crate::Result;
use nalgebra::{SMatrix, SVector};

/// A least-squares problem with `P` degrees of freedom.
///
/// The parameters may live on any manifold (a rotation, a unit vector, a matrix of rank 2): the
/// problem itself defines the effect of a step of `P` numbers.
pub(crate) trait FixedProblem<const P: usize> {
    /// The estimated quantities.
    type Parameters: Clone;

    /// Adds every residual with its Jacobian, by [`NormalEquations::add`].
    fn accumulate(&self, parameters: &Self::Parameters, normal: &mut NormalEquations<P>);

    /// Returns the cost `½ Σ ρ(‖r‖²)` alone. The sum must be the one that [`accumulate`] makes.
    ///
    /// [`accumulate`]: FixedProblem::accumulate
    fn cost(&self, parameters: &Self::Parameters) -> f64;

    /// Returns `parameters ⊞ delta`.
    fn plus(&self, parameters: &Self::Parameters, delta: &SVector<f64, P>) -> Self::Parameters;

    /// Returns the length of the parameters, for the relative step test.
    fn parameter_norm(&self, _parameters: &Self::Parameters) -> f64 {
        1.0
    }

    /// Returns whether the `index`-th degree of freedom is held fixed.
    fn is_held(&self, _index: usize) -> bool {
        false
    }
}

/// The sums `JᵀJ`, `Jᵀr` and `½ Σ ρ(‖r‖²)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NormalEquations<const P: usize> {
    /// `Σ ρ' JᵀJ`; only its lower triangle is filled.
    pub(crate) hessian: SMatrix<f64, P, P>,
    /// `Σ ρ' Jᵀr`.
    pub(crate) gradient: SVector<f64, P>,
    /// `½ Σ ρ(‖r‖²)`.
    pub(crate) cost: f64,
}

impl<const P: usize> NormalEquations<P> {
    /// Creates empty sums.
    pub(crate) fn new() -> Self {
        Self {
            hessian: SMatrix::zeros(),
            gradient: SVector::zeros(),
            cost: 0.0,
        }
    }

    /// Adds one residual of `R` components with its Jacobian `∂r/∂δ` under a loss.
    #[inline]
    pub(crate) fn add<const R: usize>(
        &mut self,
        residual: &SVector<f64, R>,
        jacobian: &SMatrix<f64, R, P>,
        loss: &RobustLoss,
    ) {
        let mut length_sq = 0.0;
        for r in 0..R {
            length_sq += residual[r] * residual[r];
        }
        self.cost += 0.5 * loss.rho(length_sq);
        let weight = loss.weight(length_sq);
        if weight == 0.0 {
            return;
        }
        for r in 0..R {
            for column in 0..P {
                let weighted = weight * jacobian[(r, column)];
                self.gradient[column] += weighted * residual[r];
                for row in column..P {
                    self.hessian[(row, column)] += weighted * jacobian[(r, row)];
                }
            }
        }
    }

    /// Adds one scalar residual.
    #[inline]
    pub(crate) fn add_scalar(
        &mut self,
        residual: f64,
        jacobian: &SVector<f64, P>,
        loss: &RobustLoss,
    ) {
        self.add(
            &SVector::<f64, 1>::new(residual),
            &jacobian.transpose(),
            loss,
        );
    }

    /// Adds sums over the nine entries of a matrix that moves along the columns of D: `DᵀHD` and
    /// `Dᵀg`.
    pub(crate) fn add_along(
        &mut self,
        directions: &SMatrix<f64, 9, P>,
        hessian: &SMatrix<f64, 9, 9>,
        gradient: &SVector<f64, 9>,
    ) {
        let directions = directions.as_slice().as_chunks::<9>().0;
        let columns = hessian.as_slice().as_chunks::<9>().0;
        for (sum, direction) in self.gradient.iter_mut().zip(directions) {
            *sum += dot(direction, &gradient.data.0[0]);
        }
        add_products(self.hessian.as_mut_slice(), directions, columns);
    }
}

/// Adds `DᵀHD`, column by column. Products of fixed-size matrices would be compiled for each number
/// of directions, with all loops unrolled: 13 KB for eight of them.
fn add_products(sums: &mut [f64], directions: &[[f64; 9]], columns: &[[f64; 9]]) {
    for (sums, direction) in sums.chunks_exact_mut(directions.len()).zip(directions) {
        // Adding to −0 changes nothing.
        let mut moved = [-0.0; 9];
        for (factor, column) in direction.iter().zip(columns) {
            for (sum, entry) in moved.iter_mut().zip(column) {
                *sum += entry * factor;
            }
        }
        for (sum, direction) in sums.iter_mut().zip(directions) {
            *sum += dot(direction, &moved);
        }
    }
}

/// Returns the sum of products, in the order of the entries.
fn dot(a: &[f64; 9], b: &[f64; 9]) -> f64 {
    a.iter().zip(b).fold(-0.0, |sum, (a, b)| sum + a * b)
}

impl<const P: usize> Default for NormalEquations<P> {
    fn default() -> Self {
        Self::new()
    }
}

struct FixedSystem<'a, const P: usize, F> {
    problem: &'a F,
    normal: NormalEquations<P>,
    delta: SVector<f64, P>,
}

/// Returns the diagonal entry that damps a parameter: its own curvature, so that the units of
/// parameters do not matter. A parameter without influence has none; any positive number keeps it
/// in place.
#[inline]
pub(super) fn damping_scale(curvature: f64) -> f64 {
    curvature.max(1e-200)
}

impl<const P: usize, F: FixedProblem<P>> System for FixedSystem<'_, P, F> {
    type Parameters = F::Parameters;

    fn linearize(&mut self, parameters: &F::Parameters) -> Linearization {
        self.normal = NormalEquations::new();
        self.problem.accumulate(parameters, &mut self.normal);
        for i in 0..P {
            if self.problem.is_held(i) {
                self.normal.gradient[i] = 0.0;
                for j in 0..P {
                    self.normal.hessian[(i, j)] = 0.0;
                    self.normal.hessian[(j, i)] = 0.0;
                }
            }
        }
        let mut gradient_max: f64 = 0.0;
        for g in self.normal.gradient.iter() {
            // `max` would ignore a NaN.
            if !g.is_finite() {
                gradient_max = f64::NAN;
                break;
            }
            gradient_max = gradient_max.max(g.abs());
        }
        Linearization {
            cost: self.normal.cost,
            gradient_max,
            parameter_norm: self.problem.parameter_norm(parameters),
        }
    }

    fn solve(&mut self, damping: f64) -> Option<DampedStep> {
        let mut lower = self.normal.hessian;
        for i in 0..P {
            lower[(i, i)] += damping * damping_scale(lower[(i, i)]);
        }
        if !cholesky_in_place(&mut lower) {
            return None;
        }
        let mut delta = -self.normal.gradient;
        solve_cholesky_in_place(&lower, &mut delta);
        let (mut predicted, mut norm_sq) = (0.0, 0.0);
        for i in 0..P {
            let scale = damping_scale(self.normal.hessian[(i, i)]);
            predicted += delta[i] * (damping * scale * delta[i] - self.normal.gradient[i]);
            norm_sq += delta[i] * delta[i];
        }
        self.delta = delta;
        Some(DampedStep {
            predicted_decrease: 0.5 * predicted,
            norm: norm_sq.sqrt(),
        })
    }

    fn step(&self, from: &F::Parameters, into: &mut F::Parameters) {
        *into = self.problem.plus(from, &self.delta);
    }

    fn cost(&mut self, parameters: &F::Parameters) -> f64 {
        self.problem.cost(parameters)
    }
}

/// Replaces the lower triangle by L with `L Lᵀ = A`; returns false unless A is positive definite.
pub(super) fn cholesky_in_place<const P: usize>(a: &mut SMatrix<f64, P, P>) -> bool {
    for j in 0..P {
        for k in 0..j {
            let factor = a[(j, k)];
            for i in j..P {
                a[(i, j)] -= factor * a[(i, k)];
            }
        }
        let pivot = a[(j, j)];
        if !(pivot > 0.0 && pivot.is_finite()) {
            return false;
        }
        let scale = 1.0 / pivot.sqrt();
        for i in j..P {
            a[(i, j)] *= scale;
        }
    }
    true
}

/// Solves `L Lᵀ x = b` in place.
pub(super) fn solve_cholesky_in_place<const P: usize>(
    lower: &SMatrix<f64, P, P>,
    b: &mut SVector<f64, P>,
) {
    for j in 0..P {
        b[j] /= lower[(j, j)];
        for i in j + 1..P {
            b[i] -= lower[(i, j)] * b[j];
        }
    }
    for j in (0..P).rev() {
        for i in j + 1..P {
            b[j] -= lower[(i, j)] * b[i];
        }
        b[j] /= lower[(j, j)];
    }
}

/// Minimizes a [`FixedProblem`] from `parameters`, in place, without allocating.
///
/// # Errors
/// [`Error::NotFinite`](crate::Error::NotFinite) if the initial cost or gradient is not finite.
///
/// Source: as [`minimize`](super::minimize).
pub(crate) fn minimize_fixed<const P: usize, F: FixedProblem<P>>(
    problem: &F,
    parameters: &mut F::Parameters,
    options: &LmOptions,
) -> Result<LmReport> {
    let mut system = FixedSystem {
        problem,
        normal: NormalEquations::new(),
        delta: SVector::zeros(),
    };
    minimize_visiting(&mut system, parameters, options, &mut |_| Ok(()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::math::random::Random;
    use nalgebra::{Rotation3, UnitQuaternion, Vector2, Vector3};

    #[test]
    fn products_along_directions_are_those_of_matrices() {
        let mut random = Random::new(5);
        for _ in 0..20 {
            let directions = SMatrix::<f64, 9, 7>::from_fn(|_, _| random.normal());
            let hessian = SMatrix::<f64, 9, 9>::from_fn(|_, _| random.normal());
            let gradient = SVector::<f64, 9>::from_fn(|_, _| random.normal());
            let mut normal = NormalEquations::new();
            normal.add_along(&directions, &hessian, &gradient);
            // Equal to the last bit, as the sums have the same order.
            assert_eq!(normal.gradient, directions.transpose() * gradient);
            assert_eq!(
                normal.hessian,
                directions.transpose() * (hessian * directions)
            );
        }
    }

    /// Rosenbrock's valley as residuals (10 (y − x²), 1 − x).
    struct Rosenbrock {
        hold_x: bool,
    }

    impl FixedProblem<2> for Rosenbrock {
        type Parameters = Vector2<f64>;
        fn accumulate(&self, p: &Vector2<f64>, normal: &mut NormalEquations<2>) {
            let residual = Vector2::new(10.0 * (p.y - p.x * p.x), 1.0 - p.x);
            let jacobian = SMatrix::<f64, 2, 2>::new(-20.0 * p.x, 10.0, -1.0, 0.0);
            normal.add(&residual, &jacobian, &RobustLoss::Trivial);
        }
        fn cost(&self, p: &Vector2<f64>) -> f64 {
            let (a, b) = (10.0 * (p.y - p.x * p.x), 1.0 - p.x);
            0.5 * (a * a + b * b)
        }
        fn plus(&self, p: &Vector2<f64>, delta: &Vector2<f64>) -> Vector2<f64> {
            p + delta
        }
        fn is_held(&self, index: usize) -> bool {
            self.hold_x && index == 0
        }
    }

    #[test]
    fn the_bottom_of_rosenbrocks_valley() {
        let mut p = Vector2::new(-1.2, 1.0);
        let report =
            minimize_fixed(&Rosenbrock { hold_x: false }, &mut p, &LmOptions::default()).unwrap();
        assert!((p - Vector2::new(1.0, 1.0)).norm() < 1e-9, "{p} {report:?}");
        assert!((report.initial_cost - 12.1).abs() < 1e-12);
        assert!(report.termination.is_converged());
    }

    #[test]
    fn a_held_parameter_stays() {
        let mut p = Vector2::new(-1.2, 1.0);
        let options = LmOptions {
            cost_tolerance: 0.0,
            ..LmOptions::default()
        };
        minimize_fixed(&Rosenbrock { hold_x: true }, &mut p, &options).unwrap();
        assert_eq!(p.x, -1.2);
        // The cost is 2.42 + 50 (y − 1.44)², so rounding hides an error of 3e-9 in y.
        assert!((p.y - 1.44).abs() < 1e-8);
    }

    #[test]
    fn a_start_without_cost_is_refused() {
        let mut p = Vector2::new(f64::NAN, 1.0);
        let result = minimize_fixed(&Rosenbrock { hold_x: false }, &mut p, &LmOptions::default());
        assert!(matches!(result, Err(Error::NotFinite { .. })));
    }

    /// A rotation from matched directions: a manifold, and a loss.
    struct Align<'a> {
        pairs: &'a [(Vector3<f64>, Vector3<f64>)],
        loss: RobustLoss,
    }

    impl FixedProblem<3> for Align<'_> {
        type Parameters = UnitQuaternion<f64>;
        fn accumulate(&self, q: &UnitQuaternion<f64>, normal: &mut NormalEquations<3>) {
            for (a, b) in self.pairs {
                let rotated = q * a;
                // exp(δ) R a ≈ R a + δ × R a.
                normal.add(&(rotated - b), &(-rotated.cross_matrix()), &self.loss);
            }
        }
        fn cost(&self, q: &UnitQuaternion<f64>) -> f64 {
            self.pairs
                .iter()
                .map(|(a, b)| 0.5 * self.loss.rho((q * a - b).norm_squared()))
                .sum()
        }
        fn plus(&self, q: &UnitQuaternion<f64>, delta: &Vector3<f64>) -> UnitQuaternion<f64> {
            UnitQuaternion::from_scaled_axis(*delta) * q
        }
    }

    #[test]
    fn a_robust_loss_ignores_outliers() {
        let mut random = Random::new(5);
        let truth =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_euler_angles(0.4, -0.3, 0.8));
        let mut direction =
            || Vector3::new(random.normal(), random.normal(), random.normal()).normalize();
        let mut pairs: Vec<_> = (0..40)
            .map(|_| {
                let a = direction();
                (a, truth * a)
            })
            .collect();
        for pair in pairs.iter_mut().take(8) {
            pair.1 = direction();
        }
        let angle_with = |loss| {
            let mut q = UnitQuaternion::identity();
            let problem = Align {
                pairs: &pairs,
                loss,
            };
            let options = LmOptions {
                max_iterations: 200,
                ..LmOptions::default()
            };
            minimize_fixed(&problem, &mut q, &options).unwrap();
            q.angle_to(&truth)
        };
        assert!(angle_with(RobustLoss::Trivial) > 0.03);
        assert!(angle_with(RobustLoss::Cauchy { width: 0.01 }) < 1e-3);
        assert!(angle_with(RobustLoss::Huber { width: 0.01 }) < 2e-2);
    }

    #[test]
    fn cholesky_solves() {
        let a = SMatrix::<f64, 3, 3>::new(4.0, 2.0, 0.6, 2.0, 5.0, 1.0, 0.6, 1.0, 3.0);
        let x = Vector3::new(1.0, -2.0, 0.5);
        let mut b = a * x;
        let mut lower = a;
        assert!(cholesky_in_place(&mut lower));
        solve_cholesky_in_place(&lower, &mut b);
        assert!((b - x).norm() < 1e-14);
        let mut indefinite = SMatrix::<f64, 2, 2>::new(1.0, 2.0, 2.0, 1.0);
        assert!(!cholesky_in_place(&mut indefinite));
    }
}
