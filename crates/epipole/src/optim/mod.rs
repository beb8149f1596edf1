//! Nonlinear least squares: one Levenberg–Marquardt loop for every problem of the crate.
//!
//! * `minimize` is the loop. It knows a `System` only: something that can linearize itself,
//!   solve its damped normal equations and step.
//! * `minimize_fixed` serves problems whose number of parameters is known when compiling, such
//!   as a pose or a fundamental matrix. It does not allocate.
//! * [`minimize_dense`] serves a [`DenseProblem`] of any size, by QR.
//! * `SchurSystem` serves bundle adjustment: some cameras, very many points.
//! * `GraphSystem` serves pose graphs: blocks, few of which meet.
//! * [`RobustLoss`] bounds the influence of outliers; the loop accepts a step only if the true
//!   robust cost decreases, never a weighted surrogate.
//! * [`check_jacobian`] compares an analytic Jacobian with central differences.
//!
//! The cost is always `½ Σ ρ(‖rᵢ‖²)`.

mod check;
pub(crate) mod cholesky;
mod dense;
mod fixed;
mod graph;
mod levenberg_marquardt;
mod loss;
mod schur;
pub(crate) mod sparse;
mod subset;

pub use check::check_jacobian;
pub use dense::{DenseProblem, minimize_dense};
pub(crate) use fixed::{FixedProblem, NormalEquations, minimize_fixed};
pub use graph::EdgeTerms;
pub(crate) use graph::{GraphProblem, GraphSystem};
pub use levenberg_marquardt::{Iteration, LmOptions, LmReport, Termination};
pub(crate) use levenberg_marquardt::{System, minimize};
pub use loss::RobustLoss;
pub(crate) use schur::{BundleProblem, BundleStep, ObservationTerms, PriorTerms, SchurSystem};
pub(crate) use subset::Subset;
