//! `ransac-line`: sample, band and votes; the votes of every sample, and the effect of MSAC and
//! local optimization over a hundred runs.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::RansacLineView as View;
