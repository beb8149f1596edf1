//! `ransac-budget`: the number of samples needed, against the inlier ratio.

mod guess;
mod model;
mod view;
mod words;

pub use view::RansacBudgetView as View;
