//! Nonlinear least squares by Levenberg–Marquardt.
//!
//! * `minimize` is the solver. It knows only a `System`: it linearizes itself, solves its damped
//!   normal equations and steps.
//! * `minimize_fixed` is for problems with a compile-time number of parameters, such as a pose or a
//!   fundamental matrix. It does not allocate.
//! * [`minimize_dense`] is for a [`DenseProblem`] of any size, by QR.
//! * `SchurSystem` is for bundle adjustment: some cameras, very many points.
//! * `GraphSystem` is for pose graphs, with sparse blocks.
//! * [`RobustLoss`] bounds the influence of outliers; a step is accepted only if the true robust
//!   cost decreases, never by a weighted surrogate.
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
