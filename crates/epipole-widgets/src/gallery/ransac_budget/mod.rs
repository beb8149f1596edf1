//! `ransac-budget`: the number of samples needed, against the inlier ratio.

mod model;
mod view;
mod words;

pub use view::RansacBudgetView as View;
