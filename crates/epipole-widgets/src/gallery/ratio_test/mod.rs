//! `ratio-test`: the nearest neighbors of two photographs' features, and which of them to believe.

mod model;
mod question;
mod tally;
mod view;
mod words;

pub(super) use view::RatioTestView as View;
