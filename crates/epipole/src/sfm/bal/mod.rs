//! Published bundle adjustment problems (BAL) and their solver.

mod adjust;
mod problem;
mod radial;
mod residuals;

pub use adjust::adjust_bal;
pub use problem::{BalCamera, BalProblem};
