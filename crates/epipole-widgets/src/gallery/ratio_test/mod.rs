//! `ratio-test`: nearest neighbors of two photographs' features, accepted by the ratio test and the
//! mutual check.

mod model;
mod question;
mod tally;
mod view;
mod words;

pub(super) use view::RatioTestView as View;
