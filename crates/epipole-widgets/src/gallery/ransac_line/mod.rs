//! `ransac-line`: sample, band, votes; the tally of every sample, and what MSAC and local optimization
//! change over a hundred runs.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::RansacLineView as View;
