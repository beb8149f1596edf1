//! `calibrate`: ten photographs of a board, and the contribution of each to the calibration.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::CalibrateView as View;
