//! Nonlinear least squares: one Levenberg–Marquardt loop for every problem of the crate.
//!
//! * [`minimize`] is the loop. It knows a [`System`] only: something that can linearize itself,
//!   solve its damped normal equations and step.
//! * [`minimize_fixed`] serves problems whose number of parameters is known when compiling, such
//!   as a pose or a fundamental matrix. It does not allocate.
//! * [`minimize_dense`] serves a [`DenseProblem`] of any size, by QR.
//! * [`RobustLoss`] bounds the influence of outliers; the loop accepts a step only if the true
//!   robust cost decreases, never a weighted surrogate.
//! * [`check_jacobian`] compares an analytic Jacobian with central differences.
//!
//! The cost is always `½ Σ ρ(‖rᵢ‖²)`.

mod check;
mod dense;
mod fixed;
mod levenberg_marquardt;
mod loss;

pub use check::{check_jacobian, numeric_jacobian};
pub use dense::{DenseProblem, minimize_dense};
pub use fixed::{FixedProblem, NormalEquations, minimize_fixed};
pub use levenberg_marquardt::{
    Iteration, Linearization, LmOptions, LmReport, Step, System, Termination, minimize,
};
pub use loss::RobustLoss;
