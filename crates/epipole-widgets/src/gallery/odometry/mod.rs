//! `odometry`: the path of a camera from corners tracked through its frames.

mod corners;
mod model;
mod question;
mod view;
mod words;

pub(super) use view::OdometryView as View;
