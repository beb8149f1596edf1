//! Bundle adjustment in the large: published problems and their solution.

mod adjust;
mod problem;
mod radial;
mod residuals;

pub use adjust::adjust_bal;
pub use problem::{BalCamera, BalProblem};
