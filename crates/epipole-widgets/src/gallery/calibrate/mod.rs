//! `calibrate`: ten photographs of a board, and what each of them tells about the camera.

mod model;
mod question;
mod view;
mod words;

pub(super) use view::CalibrateView as View;
