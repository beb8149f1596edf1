//! `ransac-budget`: how many samples are needed, against the share of inliers.

mod model;
mod view;

pub use model::RansacBudget;
pub use view::RansacBudgetView as View;
